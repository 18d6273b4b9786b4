"""A lubricant at another inlet temperature, and values that follow from a data sheet."""

import json
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from macroslip.errors import InputError
from macroslip.input.record import fields_of
from macroslip.lubricant import Lubricant

INLET = (
    "inlet_temperature",
    "density",
    "viscosity",
    "temperature_viscosity",
    "pressure_viscosity",
    "eyring_stress",
)


@pytest.fixture(scope="module")
def base():
    return Lubricant.read("vg460-pao")


def figures(**changes):
    """A lubricant file with the figures of a data sheet alone."""
    entries = {
        key: entry
        for key, entry in Lubricant.read("vg460-pao").as_dict().items()
        if key not in INLET
    }
    entries |= {
        "inlet_temperature": "35 degC", "kinematic_viscosity_40": "460 mm2/s", "kinematic_viscosity_100": "46 cSt",
        "density_15": "860 kg/m3", "roelands_index": 0.45,
    }  # fmt: skip
    return {key: entry for key, entry in (entries | changes).items() if entry is not None}


def line_viscosity(temperature, first=(313.15, 460.0), second=(373.15, 46.0)):
    """Kinematic viscosity [mm2/s]: straight line by NumPy in the coordinates of ASTM D341."""
    ordinates = np.log10(np.log10(np.array([first[1], second[1]]) + 0.7))
    fit = np.polyfit(np.log10([first[0], second[0]]), ordinates, 1)
    return 10.0**10.0 ** np.polyval(fit, math.log10(temperature)) - 0.7


def test_values_at_the_inlet_follow_from_a_data_sheet():
    oil = Lubricant.from_dict(figures())
    density = 860.0 - 0.65 * 20.0
    assert oil.density == pytest.approx(density, rel=1e-14)
    viscosity = line_viscosity(308.15) * 1e-6 * density
    assert oil.viscosity == pytest.approx(viscosity, rel=1e-9)
    step = 0.01
    logs = [math.log(line_viscosity(308.15 + s) * (density - 0.65 * s)) for s in (-step, step)]
    assert oil.temperature_viscosity == pytest.approx((logs[0] - logs[1]) / (2 * step), rel=1e-7)
    assert oil.pressure_viscosity == pytest.approx(
        0.45 * (math.log(viscosity) + 9.67) / 1.96e8, rel=1e-9
    )
    assert {oil.provenance[key].tag for key in ("viscosity", "density", "pressure_viscosity")} == {
        "D"
    }


def test_what_follows_is_not_written_and_follows_again():
    oil = Lubricant.from_dict(figures())
    assert not oil.as_dict().keys() & {
        "viscosity",
        "temperature_viscosity",
        "pressure_viscosity",
        "density",
    }
    assert Lubricant.from_dict(json.loads(json.dumps(oil.as_dict()))) == oil
    assert pickle.loads(pickle.dumps(oil)) == oil
    warm = oil.replace(inlet_temperature=323.15)
    assert warm.viscosity == pytest.approx(oil.at(323.15).viscosity, rel=1e-9)


def test_a_coefficient_at_a_stated_temperature_is_that_there():
    oil = Lubricant.from_dict(
        figures(
            roelands_index=None,
            reference_pressure_viscosity="20 1/GPa",
            reference_temperature="25 degC",
        )
    )
    assert oil.pressure_viscosity < 20e-9
    assert oil.at("25 degC").pressure_viscosity == pytest.approx(20e-9, rel=1e-9)


def test_at_its_own_temperature_it_is_the_lubricant_itself(base):
    assert base.at(308.15) is base and base.at("35 degC") is base


@settings(deadline=None)
@given(st.floats(260.0, 400.0), st.floats(260.0, 400.0))
def test_two_changes_of_temperature_are_as_one(first, second):
    base = Lubricant.read("vg460-pao")
    once, twice = base.at(second), base.at(first).at(second)
    for key in INLET:
        assert getattr(twice, key) == pytest.approx(getattr(once, key), rel=1e-7), key


@pytest.mark.parametrize("celsius", [-10.0, 20.0, 50.0, 80.0])
def test_the_line_through_a_viscosity_and_its_slope(base, celsius):
    # The same line by another way: the slope of the line is found by a root search on its viscosity at 100 degC.
    def fall(at_100):
        logs = [
            math.log(
                line_viscosity(308.15 + s, (308.15, 600.0), (373.15, at_100)) * (900.0 - 0.65 * s)
            )
            for s in (-0.01, 0.01)
        ]
        return (logs[0] - logs[1]) / 0.02

    at_100 = brentq(lambda guess: fall(guess) - 0.056, 20.0, 120.0, xtol=1e-12)
    temperature = 273.15 + celsius
    density = 900.0 - 0.65 * (celsius - 35.0)
    warm = base.at(temperature)
    expected = line_viscosity(temperature, (308.15, 600.0), (373.15, at_100)) * 1e-6 * density
    assert warm.viscosity == pytest.approx(expected, rel=1e-5)
    assert warm.density == pytest.approx(density, rel=1e-13)
    index = 21e-9 * 1.96e8 / (math.log(0.54) + 9.67)
    assert warm.pressure_viscosity == pytest.approx(
        index * (math.log(expected) + 9.67) / 1.96e8, rel=1e-5
    )
    assert warm.eyring_stress * warm.pressure_viscosity == pytest.approx(6.7e6 * 21e-9, rel=1e-12)
    kept = fields_of(Lubricant).keys() - set(INLET)
    assert all(getattr(warm, key) == getattr(base, key) for key in kept)


def test_what_changes_is_derived_and_its_range_goes_with_it(base):
    warm = base.at("50 degC")
    assert {warm.provenance[key].tag for key in INLET[1:]} == {"D"}
    assert warm.provenance["inlet_temperature"].tag == "U"
    assert all(
        warm.provenance[key] == base.provenance[key] for key in warm.provenance.keys() - set(INLET)
    )
    low, high = warm.provenance["pressure_viscosity"].range
    assert (low / warm.pressure_viscosity, high / warm.pressure_viscosity) == pytest.approx(
        (16.5 / 21, 22 / 21)
    )
    assert Lubricant.from_dict(warm.as_dict()) == warm


@pytest.mark.parametrize(
    "temperature", [float("nan"), "40", "40 bar", 10.0, 250.0, 430.0, "200 degC", True, None]
)
def test_a_temperature_that_is_none_is_refused(base, temperature):
    with pytest.raises(
        InputError, match="^lubricant vg460-pao: the inlet temperature .* Allowed: "
    ) as caught:
        base.at(temperature)
    assert "\n" not in str(caught.value)


def test_a_viscosity_that_hardly_falls_has_no_line(base):
    with pytest.raises(
        InputError, match="^lubricant vg460-pao: the kinematic viscosity falls by -"
    ):
        base.replace(temperature_viscosity=1e-4).at(320.0)


def test_a_value_at_the_inlet_takes_the_place_of_figures():
    oil = Lubricant.from_dict(figures())
    other = oil.replace(viscosity=0.6)
    assert (other.viscosity, other.provenance["viscosity"].tag) == (0.6, "U")
    assert other.kinematic_viscosity_40 is None
    assert other.temperature_viscosity == oil.temperature_viscosity and other.density == oil.density
    assert oil.replace(kinematic_viscosity_40=500e-6).viscosity > oil.viscosity


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"viscosity": "0.5 Pa s"}, "viscosity and kinematic_viscosity_40 and kinematic_viscosity_100 are given"),
        ({"density": "900 kg/m3"}, "density and density_15 are given. Allowed: one or the other"),
        ({"pressure_viscosity": "20 1/GPa"}, "pressure_viscosity and roelands_index are given"),
        ({"reference_pressure_viscosity": "20 1/GPa", "reference_temperature": "40 degC"},
         "roelands_index and reference_pressure_viscosity are given. Allowed: one of the two"),
        ({"kinematic_viscosity_100": None}, "^3 problems: .1. 'viscosity' is missing .* from which it follows: kinematic_viscosity_40 and kinematic_viscosity_100"),
        ({"roelands_index": None}, "^'pressure_viscosity' is missing .* Add it, or the figures .*: roelands_index and"),
        ({"kinematic_viscosity_100": "500 mm2/s"}, "the viscosity is 460 mm2/s at 313.15 K and 500 mm2/s"),
        ({"base_oil": "whale"}, "base_oil is 'whale'. Allowed: pao, mineral, "),
        ({"kinematic_viscosity_40": "-3 mm2/s"}, "kinematic_viscosity_40: it is -3 mm2/s. Allowed: 2 to 100000 mm2/s"),
    ],
)  # fmt: skip
def test_figures_that_lack_or_contradict(changes, message):
    with pytest.raises(InputError, match=message) as caught:
        Lubricant.from_dict(figures(**changes))
    assert "\n" not in str(caught.value)


def test_every_shipped_lubricant_runs_over_temperature():
    names = Lubricant.catalogue()
    assert len(names) >= 7
    for name in names:
        oil = Lubricant.read(name)
        assert oil.name == name and oil.title and oil.base_oil
        oil.require(
            "limiting_shear", "eyring_stress", "boundary_friction", purpose="the physical model"
        )
        assert all(origin.tag in "PVDRE" and origin.note for origin in oil.provenance.values())
        assert oil.provenance["limiting_shear"].range and oil.provenance["eyring_stress"].range
        states = [oil.at(temperature) for temperature in (263.15, 293.15, 323.15, 353.15)]
        for key, sign in (("viscosity", -1), ("density", -1), ("pressure_viscosity", -1), ("temperature_viscosity", -1),
                          ("eyring_stress", 1)):  # fmt: skip
            assert (sign * np.diff([getattr(state, key) for state in states]) > 0.0).all(), (
                name,
                key,
            )


def test_the_base_lubricant_says_where_its_viscosity_comes_from(base):
    # The paper gives the grade, not the viscosity: VG 460 with 46 mm2/s at 100 degC on the line of ASTM D341.
    origin = base.provenance["viscosity"]
    assert origin.tag == "D" and "460 and 46 mm2/s" in origin.note and "900 kg/m3" in origin.note
    assert round(line_viscosity(308.15)) == 602
    assert line_viscosity(308.15) * 1e-6 * 900.0 == pytest.approx(0.54, rel=0.005)
