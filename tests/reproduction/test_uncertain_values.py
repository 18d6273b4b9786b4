"""Ranges hold the base values, agree with the catalogue's tags, and make bearings."""

import itertools

import pytest

from macroslip import Case, HubLoads, InputError
from macroslip.reproduction import uncertain_values as module
from macroslip.reproduction.uncertain_values import VALUES, with_values
from macroslip.reproduction.uncertainty import _base_values

KEYS = {
    module.CLEARANCE: "diametral_clearance",
    module.OSCULATION: "osculation_inner",
    module.DIAMETER: "roller_diameter",
    module.LENGTH: "roller_length",
    module.ROUGHNESS: "composite_roughness",
    module.HARDNESS: "hardness",
    module.CAGE: "cage_youngs_modulus",
    module.LIMITING: "limiting_shear",
    module.BOUNDARY: "boundary_friction",
    module.STARVATION: "starvation",
    module.TEMPERATURE: "inlet_temperature",
}


@pytest.fixture(scope="module")
def case():
    return Case(loads=HubLoads.bundled("14B").window(0.0, 10.0), rollers=[0])


@pytest.fixture(scope="module")
def base(case):
    return dict(zip([one.name for one in VALUES], _base_values(case), strict=True))


def test_the_base_values_are_in_the_ranges_and_change_nothing(case, base):
    assert all(one.low <= base[one.name] <= one.high for one in VALUES)
    same = with_values(case, base)
    for key in ("diametral_clearance", "osculation_outer", "roller_diameter", "roller_length", "cage_youngs_modulus"):
        assert getattr(same.bearing, key) == pytest.approx(getattr(case.bearing, key), rel=1e-12)
    # The catalogue's pitch radius and row offset are rounded.
    assert same.bearing.pitch_radius == pytest.approx(case.bearing.pitch_radius, rel=1e-3)
    assert same.lubricant.viscosity == pytest.approx(case.lubricant.viscosity)
    assert same.drivetrain == case.drivetrain


def test_tags_are_those_of_the_catalogue(case):
    for one in VALUES:
        if one.name in KEYS:
            key = KEYS[one.name]
            source = case.bearing if hasattr(case.bearing, key) else case.lubricant
            assert source.provenance[key].tag == one.tag, one.name
        assert one.reason


def test_each_value_arrives_where_it_belongs(case, base):
    for one in VALUES:
        changed = with_values(case, base | {one.name: one.high})
        again = dict(zip([value.name for value in VALUES], _base_values(changed), strict=True))
        assert again == pytest.approx(base | {one.name: one.high}), one.name


@pytest.mark.parametrize("name", ["high", "low"])
def test_rollers_touch_the_sphere_whatever_their_size(case, base, name):
    sizes = [one for one in VALUES if one.name in (module.DIAMETER, module.LENGTH, module.OSCULATION)]
    for corner in itertools.product(*((one.low, one.high) for one in sizes)):
        rest = {one.name: getattr(one, name) for one in VALUES}
        bearing = with_values(case, rest | dict(zip([one.name for one in sizes], corner, strict=True))).bearing
        centre = (bearing.pitch_radius**2 + bearing.row_offset**2) ** 0.5
        assert centre + 0.5 * bearing.roller_diameter == pytest.approx(bearing.outer_raceway_radius, rel=1e-9)


def test_an_impossible_value_is_refused(case, base):
    with pytest.raises(InputError, match="osculation"):
        with_values(case, base | {module.OSCULATION: 1.2})
