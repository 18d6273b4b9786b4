"""The lubricant's data and its viscosity under pressure."""

import json

import numpy as np
import pytest

from macroslip.catalogue import TAGS
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.lubricant.viscosity import barus


@pytest.fixture(scope="module")
def base():
    return Lubricant.read("vg460-pao")


def test_base_lubricant_has_the_specified_values_in_si(base):
    assert "vg460-pao" in Lubricant.catalogue()
    values = base.model_dump()
    assert values.pop("title")
    assert values == {
        "name": "vg460-pao", "inlet_temperature": 308.15, "viscosity": 0.54, "pressure_viscosity": 21e-9,
        "temperature_viscosity": 0.056, "thermal_conductivity": 0.125, "density": 900.0, "fill_factor": 0.7,
        "drag_coefficient": 1.0, "limiting_shear": 0.042, "eyring_stress": 3.3e6, "boundary_friction": 0.1,
        "starvation": 0.7,
    }  # fmt: skip


def test_every_quantity_says_where_it_comes_from(base):
    assert set(base.provenance) == set(Lubricant.model_fields) - {"name", "title"}
    assert all(origin.tag in TAGS and origin.tag != "U" and origin.note for origin in base.provenance.values())
    assert "misprint" in base.provenance["thermal_conductivity"].note
    assert [base.provenance[key].tag for key in ("pressure_viscosity", "temperature_viscosity")] == ["P", "P"]


def test_round_trip(base):
    assert Lubricant.from_dict(json.loads(json.dumps(base.as_dict()))) == base
    assert Lubricant(**base.model_dump()).model_dump() == base.model_dump()


def test_other_units_give_the_same(base):
    entries = base.as_dict()
    entries["inlet_temperature"] = {"value": 308.15, "unit": "K"}
    entries["pressure_viscosity"] = {"value": 2.1e-8, "unit": "1/Pa"}
    assert Lubricant.from_dict(entries).model_dump() == base.model_dump()


@pytest.mark.parametrize(
    ("key", "low", "high"),
    [
        ("inlet_temperature", 199.9, 500.1), ("viscosity", 0, 1001), ("pressure_viscosity", 0, 1.1e-7),
        ("temperature_viscosity", 0, 1.1), ("thermal_conductivity", 0, 10.1), ("density", 99, 5001),
        ("fill_factor", -0.1, 1.1), ("drag_coefficient", -0.1, 101), ("limiting_shear", 0, 0.6),
        ("eyring_stress", 9e3, 1.1e9), ("boundary_friction", -0.1, 1.1), ("starvation", 0, 1.1),
    ],
)  # fmt: skip
def test_every_quantity_has_a_range(base, key, low, high):
    for value in (low, high):
        with pytest.raises(InputError, match=f"^{key} is .* Allowed: a number (above|at least) .* and at most "):
            base.replace(**{key: value})


def test_a_range_is_told_in_the_unit_of_the_file(base):
    entries = base.as_dict()
    entries["inlet_temperature"]["value"] = 308.15
    with pytest.raises(InputError, match="^inlet_temperature is 308.15 degC. Allowed: .* at least -73.15 degC and"):
        Lubricant.from_dict(entries)


def test_errors_speak_of_a_lubricant():
    with pytest.raises(InputError, match="^the lubricant has no name, no inlet_temperature, no viscosity,.*name=..."):
        Lubricant()


def test_barus_is_exponential_in_pressure(base):
    for pressure in np.linspace(0, 1.5e9, 7):
        expected = 0.54 * np.exp(21 * pressure / 1e9)
        assert barus(base.viscosity, base.pressure_viscosity, pressure) == pytest.approx(expected, rel=1e-13)
    assert barus(0.54, 2.1e-8, 1e13) == np.inf
