"""Ranges hold the base values, agree with the catalogue's tags, and the study's points are a sample of them."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip.reproduction.studies import base_case, reproduction_study
from macroslip.reproduction.uncertain_points import POINTS, SEED, sample_points
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.study.build import template
from macroslip.study.settings import Setting

pytestmark = pytest.mark.slow

#: Units of the ranges over those of the study file.
SCALES = {
    "mm": 1e-3, "µm": 1e-6, "GPa": 1e9, "MPa": 1e6, "1/GPa": 1e-9, "1": 1.0, "m": 1.0, "kg": 1.0, "Pa s": 1.0,
    "1/K": 1.0, "°C": 1.0, "°": math.pi / 180.0,
}  # fmt: skip
CONTINUOUS = [one for one in VALUES if not one.choices and not one.whole]


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
        if one.choices:
            assert own(case, one.key) in one.choices
            continue
        # Stress and Roelands' slope at the lubricant's own temperature, as the study's base case has it.
        assert in_si(one.low, one.unit) <= own(case, one.key) <= in_si(one.high, one.unit) * (1 + 1e-12), one.name


def test_tags_are_those_of_the_catalogue(study):
    case = base_case(study)
    for one in VALUES:
        part, name = one.key.replace("lubricant.at", "lubricant.inlet_temperature").split(".")
        assert one.reason
        if part not in ("drivetrain", "laws"):
            assert getattr(case, part).provenance[name].tag == one.tag, one.name


def test_ranges_of_the_oil_are_those_of_its_file(study):
    oil = base_case(study).lubricant
    for key in ("limiting_shear", "eyring_stress", "pressure_viscosity", "boundary_friction", "starvation", "fullness"):
        one = next(one for one in VALUES if one.key == f"lubricant.{key}")
        stated = oil.provenance[key].range
        assert (one.low, one.high) == pytest.approx(stated), key


def test_everything_that_the_answer_rests_on_is_drawn():
    """Temperature, oil, law of shear and its stresses, fullness, contact angle, rollers and shaft, beside the geometry."""
    keys = {one.key for one in VALUES}
    oil = ("at", "viscosity", "pressure_viscosity", "temperature_viscosity", "limiting_shear", "eyring_stress")
    assert {f"lubricant.{key}" for key in (*oil, "fullness", "inlet_film", "starvation")} <= keys
    assert {"laws.rheology", "bearing.contact_angle", "bearing.rollers_per_row", "drivetrain.shaft_mass"} <= keys
    assert len(keys) == len(VALUES)


def test_the_points_are_the_scrambled_sobol_sequence_that_the_file_names(points):
    from scipy.stats import qmc

    unit = qmc.Sobol(len(VALUES), rng=np.random.default_rng(SEED)).random(POINTS)
    assert points[0] == {}
    for k, one in enumerate(VALUES):
        found = [point[one.key] for point in points[1:]]
        if one.choices:
            assert found == [one.choices[0 if place < 0.5 else 1] for place in unit[:, k]]
        elif one.whole:
            counts = range(int(one.low), int(one.high) + 1)
            assert found == [counts[int(place * len(counts))] for place in unit[:, k]]
        else:
            ends = [math.log(end) if one.log else end for end in (one.low, one.high)]
            drawn = ends[0] + unit[:, k] * (ends[1] - ends[0])
            expected = [in_si(value, one.unit) for value in (np.exp(drawn) if one.log else drawn)]
            np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-15)


def test_the_file_is_what_the_ranges_make(study):
    made = [{key: Setting.written(key, value) for key, value in point.items()} for point in sample_points()]
    assert [{one.key: one for one in settings} for settings in study.variations] == made


def test_every_value_has_one_point_in_each_part_of_its_range(points):
    for one in CONTINUOUS:
        values = np.array([point[one.key] for point in points[1:]])
        if one.unit == "°C":
            values = values - 273.15
        places = one.place(values / SCALES[one.unit])
        assert sorted((POINTS * places).astype(int)) == list(range(POINTS)), one.name


def test_both_laws_and_all_counts_are_drawn_alike(points):
    laws = [point["laws.rheology"] for point in points[1:]]
    assert laws.count("eyring") == laws.count("limiting-shear") == POINTS // 2
    counts = [point["bearing.rollers_per_row"] for point in points[1:]]
    assert all(abs(counts.count(count) - POINTS / 5) < 2 for count in range(26, 31))


def test_values_that_follow_from_others_are_right(study, points):
    bearing = base_case(study).bearing
    for point in points[1:]:
        of_bearing = SimpleNamespace(**{key.partition(".")[2]: value for key, value in point.items()})
        centre = bearing.outer_raceway_radius - 0.5 * of_bearing.roller_diameter
        assert of_bearing.pitch_radius == pytest.approx(centre * math.cos(of_bearing.contact_angle), rel=1e-11)
        assert of_bearing.row_offset == pytest.approx(centre * math.sin(of_bearing.contact_angle), rel=1e-11)
        assert of_bearing.osculation_inner == of_bearing.osculation_outer


def test_every_point_makes_a_case_with_its_values(study):
    records = {"bearing": next(iter(study.bearings.values())), "lubricant": next(iter(study.lubricants.values()))}
    # What the oil has at its own temperature before it is warmed or cooled to that of the point.
    moved = ("lubricant.viscosity", "lubricant.pressure_viscosity", "lubricant.temperature_viscosity",
             "lubricant.eyring_stress")  # fmt: skip
    for settings in study.variations[1:]:
        case, _ = template(study.case, list(settings), records)
        values = {one.key: one.value for one in settings}
        for key in values.keys() - set(moved):
            expected = values[key]
            assert own(case, key) == (expected if isinstance(expected, str) else pytest.approx(expected, rel=1e-14)), (
                key
            )
        oil = records["lubricant"].replace(**{key.partition(".")[2]: values[key] for key in moved})
        oil = oil.at(values["lubricant.at"])
        for key in moved:
            assert own(case, key) == pytest.approx(getattr(oil, key.partition(".")[2]), rel=1e-13), key
