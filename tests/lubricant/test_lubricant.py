"""The lubricant's data and its viscosity under pressure."""

import json

import numpy as np
import pytest

from macroslip.errors import InputError
from macroslip.input.record import TAGS
from macroslip.lubricant import Lubricant
from macroslip.lubricant.temperature import (
    dowson_higginson,
    mean_pressure_viscosity,
    roelands_index,
)
from tests.records import values_of


@pytest.fixture(scope="module")
def base():
    return Lubricant.read("vg460-pao")


def test_base_lubricant_has_the_specified_values_in_si(base):
    assert "vg460-pao" in Lubricant.catalogue()
    values = values_of(base)
    assert values.pop("title")
    assert [key for key, value in values.items() if value is None] == [
        "kinematic_viscosity_40", "kinematic_viscosity_100", "roelands_index", "reference_pressure_viscosity",
        "reference_temperature", "density_15", "grease_yield_stress",
    ]  # fmt: skip
    assert {key: value for key, value in values.items() if value is not None} == {
        "base_oil": "pao", "thickener": "",
        "name": "vg460-pao", "inlet_temperature": 308.15, "viscosity": 0.54, "pressure_viscosity": 21e-9,
        "temperature_viscosity": 0.056, "thermal_conductivity": 0.125, "density": 900.0, "fill_factor": 0.7,
        "drag_coefficient": 1.0, "limiting_shear": 0.042, "eyring_stress": 6.7e6, "boundary_friction": 0.1,
    }  # fmt: skip


def test_every_quantity_says_where_it_comes_from(base):
    assert set(base.provenance) == {
        key for key, value in values_of(base).items() if isinstance(value, float)
    }
    assert all(
        origin.tag in TAGS and origin.tag != "U" and origin.note
        for origin in base.provenance.values()
    )
    assert "misprint" in base.provenance["thermal_conductivity"].note
    assert [
        base.provenance[key].tag for key in ("pressure_viscosity", "temperature_viscosity")
    ] == ["P", "P"]


def test_round_trip(base):
    assert Lubricant.from_dict(json.loads(json.dumps(base.as_dict()))) == base
    assert values_of(Lubricant(**values_of(base))) == values_of(base)


def test_other_units_give_the_same(base):
    entries = base.as_dict()
    entries["inlet_temperature"] = {"value": 308.15, "unit": "K"}
    entries["pressure_viscosity"] = {"value": 2.1e-8, "unit": "1/Pa"}
    assert values_of(Lubricant.from_dict(entries)) == values_of(base)


@pytest.mark.parametrize(
    ("key", "low", "high"),
    [
        ("inlet_temperature", 199.9, 500.1), ("viscosity", 0, 1001), ("pressure_viscosity", 0, 1.1e-7),
        ("temperature_viscosity", 0, 1.1), ("thermal_conductivity", 0, 10.1), ("density", 99, 5001),
        ("fill_factor", -0.1, 1.1), ("drag_coefficient", -0.1, 101), ("limiting_shear", 0, 0.6),
        ("eyring_stress", 9e3, 1.1e9), ("boundary_friction", -0.1, 1.1),
    ],
)  # fmt: skip
def test_every_quantity_has_a_range(base, key, low, high):
    for value in (low, high):
        with pytest.raises(
            InputError, match=f"^{key}: it is .* Allowed: (above )?[0-9.e]+,? (up )?to [0-9]"
        ):
            base.replace(**{key: value})


def test_a_range_is_reported_in_the_unit_of_the_file(base):
    entries = base.as_dict()
    entries["inlet_temperature"]["value"] = 308.15
    with pytest.raises(
        InputError, match="^inlet_temperature: it is 308.15 degC. Allowed: -73.15 to 226.85 degC"
    ):
        Lubricant.from_dict(entries)


def test_errors_speak_of_a_lubricant():
    with pytest.raises(
        InputError,
        match="^9 problems: .1. 'name' is missing .short name of the lubricant.* 'inlet_temperature' is missing",
    ):
        Lubricant()


PHYSICAL = ("limiting_shear", "eyring_stress", "boundary_friction")


def test_a_file_without_the_data_of_the_physical_model_is_read_and_they_are_asked_for_by_name(base):
    entries = {key: entry for key, entry in base.as_dict().items() if key not in PHYSICAL}
    old = Lubricant.from_dict(entries)
    assert old.limiting_shear is None and "limiting_shear" not in old.provenance
    assert old.as_dict() == entries
    base.require(*PHYSICAL, purpose="the physical model")
    with pytest.raises(InputError) as caught:
        old.require(*PHYSICAL, purpose="the physical model")
    message = str(caught.value)
    assert message.startswith(
        "lubricant vg460-pao: it has no limiting_shear, no eyring_stress, no boundary_friction, which "
        "the physical model needs. Allowed: limiting_shear: above 0, up to 0.5; eyring_stress: 10000 to 1e9 Pa; "
    )
    assert message.endswith('boundary_friction: {value: ..., unit: "1"}.') and "\n" not in message
    with pytest.raises(
        InputError,
        match="it has no limiting_shear, which grease needs. Allowed: limiting_shear: above 0",
    ):
        base.replace(limiting_shear=None).require(
            "eyring_stress", "limiting_shear", purpose="grease"
        )


def test_roelands_lies_below_barus_and_bends(base):
    eta, alpha = base.viscosity, base.pressure_viscosity
    assert 0.4 < roelands_index(eta, alpha) < 0.7
    pressures = np.linspace(1e7, 2e9, 200)
    logs = np.array([mean_pressure_viscosity(eta, alpha, p) * p for p in pressures])
    assert (logs < alpha * pressures).all()
    slopes = np.diff(logs)
    assert (slopes > 0).all() and (np.diff(slopes) < 0).all()


def test_a_viscosity_too_low_for_roelands_is_reported():
    for viscosity in (6e-5, 1e-9, 0.0):
        with pytest.raises(
            InputError,
            match="^viscosity: Roelands' law has no viscosity of .* Allowed: above 6.3e-05 Pa s",
        ):
            roelands_index(viscosity, 2.1e-8)
    assert roelands_index(6.4e-5, 2.1e-8) > 0.0


def test_density_under_pressure():
    assert dowson_higginson(0.0) == 1.0
    assert dowson_higginson(1e30) == pytest.approx(1.0 + 0.6 / 1.7, rel=1e-15)
    assert (dowson_higginson(1e3) - 1.0) / 1e3 == pytest.approx(0.6e-9, rel=1e-5)
