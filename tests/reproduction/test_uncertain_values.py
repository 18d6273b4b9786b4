"""Ranges hold the base values, agree with the catalogue's tags, and the study's points are a sample of them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip.reproduction.studies import base_case, reproduction_study
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.study.build import template

pytestmark = pytest.mark.slow

#: Units of the ranges over those of the study file.
SCALES = {"mm": 1e-3, "µm": 1e-6, "GPa": 1e9, "1": 1.0, "m": 1.0, "°C": 1.0}


@pytest.fixture(scope="module")
def study():
    return reproduction_study("uncertainty_physical")


@pytest.fixture(scope="module")
def points(study):
    """Values of every point by key, in SI units; the first has none."""
    return [{one.key: one.value for one in settings} for settings in study.variations]


def in_si(value, unit):
    return value + 273.15 if unit == "°C" else value * SCALES[unit]


def own(case, key):
    part, name = key.replace("lubricant.at", "lubricant.inlet_temperature").split(".")
    return getattr(getattr(case, part), name)


def test_the_base_values_are_in_the_ranges(study):
    case = base_case(study)
    for one in VALUES:
        assert in_si(one.low, one.unit) <= own(case, one.key) <= in_si(one.high, one.unit) * (1 + 1e-12), one.name


def test_tags_are_those_of_the_catalogue(study):
    case = base_case(study)
    for one in VALUES:
        part, name = one.key.replace("lubricant.at", "lubricant.inlet_temperature").split(".")
        assert one.reason
        if part != "drivetrain":
            assert getattr(case, part).provenance[name].tag == one.tag, one.name


def test_the_points_are_the_scrambled_sobol_sequence_that_the_file_names(points):
    from scipy.stats import qmc

    unit = qmc.Sobol(len(VALUES), seed=20240613).random(64)
    assert points[0] == {}
    for k, one in enumerate(VALUES):
        expected = [in_si(one.low + place * (one.high - one.low), one.unit) for place in unit[:, k]]
        np.testing.assert_allclose([point[one.key] for point in points[1:]], expected, rtol=1e-11, atol=1e-15)


def test_every_value_has_one_point_in_each_64th_of_its_range(points):
    for one in VALUES:
        low, high = (in_si(value, one.unit) for value in (one.low, one.high))
        places = [int(64.0 * (point[one.key] - low) / (high - low)) for point in points[1:]]
        assert sorted(places) == list(range(64)), one.name


def test_values_that_follow_from_others_are_right(study, points):
    case = base_case(study)
    bearing = case.bearing
    for point in points[1:]:
        of_bearing = SimpleNamespace(**{key.partition(".")[2]: value for key, value in point.items()})
        centre = bearing.outer_raceway_radius - 0.5 * of_bearing.roller_diameter
        assert of_bearing.pitch_radius == pytest.approx(centre * math.cos(bearing.contact_angle), rel=1e-11)
        assert of_bearing.row_offset == pytest.approx(centre * math.sin(bearing.contact_angle), rel=1e-11)
        assert of_bearing.osculation_inner == of_bearing.osculation_outer


def test_every_point_makes_a_case_with_its_values(study):
    records = {"bearing": next(iter(study.bearings.values())), "lubricant": next(iter(study.lubricants.values()))}
    for settings in study.variations[1:]:
        case, _ = template(study.case, list(settings), records)
        for one in settings:
            assert own(case, one.key) == pytest.approx(one.value, rel=1e-14), one.key
        temperature = next(one.value for one in settings if one.key == "lubricant.at")
        assert case.lubricant.viscosity == records["lubricant"].at(temperature).viscosity
