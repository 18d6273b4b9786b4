"""Ranges hold the base values, agree with the catalogue's tags, and the study's points are a sample of them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip import Case
from macroslip.study.settings import template
from macroslip.study.study_file import study_of
from paper.studies import content
from paper.values import POINTS, SEED, VALUES

pytestmark = pytest.mark.slow

CONTINUOUS = [value for value in VALUES if value.kind in ("even", "log")]


@pytest.fixture(scope="module")
def study():
    return study_of(content("uncertainty", "physical"))


@pytest.fixture(scope="module")
def records(study):
    return {
        "bearing": next(iter(study.bearings.values())),
        "lubricant": next(iter(study.lubricants.values())),
    }


@pytest.fixture(scope="module")
def base(study, records):
    return template(study.case, [], records)[0]


@pytest.fixture(scope="module")
def points(study):
    """Values of every point by key, in SI units; the first has none."""
    return [in_si_units(settings) for settings in study.variations]


def in_si_units(settings):
    """Values of settings by key, in SI units."""
    units = {value.key: value.unit for value in VALUES if not value.choices}
    return {
        setting.key: in_si(setting.value, units[setting.key])
        if setting.key in units
        else setting.value
        for setting in settings
    }


#: SI units in the units of the ranges.
SCALES = {"mm": 1e-3, "um": 1e-6, "GPa": 1e9, "MPa": 1e6, "1/GPa": 1e-9, "deg": math.pi / 180.0}


def in_si(value, unit):
    return value + 273.15 if unit == "degC" else value * SCALES.get(unit, 1.0)


def own(case, key):
    if key == "oil_supply":
        return case.inlet_supply
    part, name = parts_of(key)
    value = getattr(getattr(case, part), name)
    return 0.0 if value is None else value  # a file without waves has a round outer ring


def parts_of(key):
    return (
        key.replace("lubricant.at", "lubricant.inlet_temperature")
        .replace("out_of_round.", "out_of_round_")
        .split(".")
    )


def test_ends_of_a_range_are_its_first_and_last_place():
    for value in CONTINUOUS:
        assert [value.at(0.0), value.at(1.0)] == pytest.approx(
            [value.low, value.high], rel=1e-12
        ), value.name


def test_the_base_values_are_in_the_ranges(base):
    assert isinstance(base, Case)
    for value in VALUES:
        if value.choices:
            assert own(base, value.key) in value.choices
            continue
        # Stress and Roelands' slope at the lubricant's own temperature, as the study's base case has it.
        assert (
            in_si(value.low, value.unit)
            <= own(base, value.key)
            <= in_si(value.high, value.unit) * (1 + 1e-12)
        ), value.name


def test_tags_are_those_of_the_catalogue(base):
    for value in VALUES:
        if value.tag == "C" or "." not in value.key:
            continue
        part, name = parts_of(value.key)
        if part != "drivetrain" and name in getattr(base, part).provenance:
            assert getattr(base, part).provenance[name].tag == value.tag, value.name


def test_ranges_of_the_oil_are_those_of_its_file(base):
    for key in ("limiting_shear", "eyring_stress", "pressure_viscosity", "boundary_friction"):
        listed = next(listed for listed in VALUES if listed.key == f"lubricant.{key}")
        assert (listed.low, listed.high) == pytest.approx(base.lubricant.provenance[key].range), key


def test_the_points_are_a_scrambled_sobol_sequence_with_the_seed(points):
    from scipy.stats import qmc

    unit = qmc.Sobol(len(VALUES), rng=np.random.default_rng(SEED)).random(POINTS)
    assert points[0] == {}
    for k, listed in enumerate(VALUES):
        drawn_values = [point[listed.key] for point in points[1:]]
        if listed.choices:
            assert drawn_values == [
                listed.choices[int(fraction * len(listed.choices))] for fraction in unit[:, k]
            ]
        elif listed.kind == "count":
            counts = range(int(listed.low), int(listed.high) + 1)
            assert drawn_values == [counts[int(fraction * len(counts))] for fraction in unit[:, k]]
        else:
            ends = [
                math.log(end) if listed.kind == "log" else end for end in (listed.low, listed.high)
            ]
            drawn = ends[0] + unit[:, k] * (ends[1] - ends[0])
            expected = [
                in_si(value, listed.unit)
                for value in (np.exp(drawn) if listed.kind == "log" else drawn)
            ]
            np.testing.assert_allclose(drawn_values, expected, rtol=1e-11, atol=1e-15)


def test_values_that_follow_from_others_are_right(base, points):
    bearing = base.bearing
    for point in points[1:]:
        of_bearing = SimpleNamespace(
            **{key.partition(".")[2]: value for key, value in point.items()}
        )
        centre = bearing.outer_raceway_radius - 0.5 * of_bearing.roller_diameter
        assert of_bearing.pitch_radius == pytest.approx(
            centre * math.cos(of_bearing.contact_angle), rel=1e-11
        )
        assert of_bearing.row_offset == pytest.approx(
            centre * math.sin(of_bearing.contact_angle), rel=1e-11
        )
        assert of_bearing.osculation_inner == of_bearing.osculation_outer


def test_every_point_makes_a_case_with_its_values(study, records):
    # What the oil has at its own temperature before it is warmed or cooled to that of the point.
    moved = ("lubricant.viscosity", "lubricant.pressure_viscosity", "lubricant.temperature_viscosity",
             "lubricant.eyring_stress")  # fmt: skip
    for settings in study.variations[1:]:
        case, _ = template(study.case, list(settings), records)
        values = in_si_units(settings)
        for key in values.keys() - set(moved):
            expected = values[key]
            assert own(case, key) == (
                expected if isinstance(expected, str) else pytest.approx(expected, rel=1e-14)
            ), key
        oil = records["lubricant"].replace(**{key.partition(".")[2]: values[key] for key in moved})
        oil = oil.at(values["lubricant.at"])
        for key in moved:
            assert own(case, key) == pytest.approx(
                getattr(oil, key.partition(".")[2]), rel=1e-13
            ), key
