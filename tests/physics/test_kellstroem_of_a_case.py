"""Kellström's friction over a case: its power, where it lies along the roller, and the skew that it leaves."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Case, Laws, RollerLoads, Traces, simulate
from macroslip.bearing import geometry
from macroslip.contact.laws import prepare
from macroslip.contact.patch import patch_of
from macroslip.roller.skew import skew_stop
from macroslip.whole.cage import Cage

pytestmark = pytest.mark.slow
LOAD = 9e3
PLACES = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
LOADS = RollerLoads(
    np.array([0.0, 10.0]), np.full(2, 2.143), PLACES, np.full(PLACES.shape, LOAD), "even"
)
LAWS = Laws.physical().but(
    rolling="none",
    asperities="none",
    traction="kellstroem",
    traction_limit_outer=0.04,
    traction_saturation=0.003,
)


@pytest.fixture(scope="module")
def results():
    """A case with rollers that skew until nothing turns them on, and one with straight rollers."""
    skews = Case(
        loads=LOADS,
        rollers=[0],
        laws=LAWS.but(skew="quasi-static"),
        cage=Cage(alignment="none"),
        traces=Traces(step=0.5),
    )
    straight = replace(skews, laws=LAWS, cage=Cage())
    return skews, simulate(skews, threads=1), simulate(straight, threads=1)


def power_along(contact, load, ring_speed, slip, places):
    """∫ τ v dA of a straight roller by quadrature, and by the middles of its parts between places."""
    patch = patch_of(contact)
    limit, saturation = contact.friction
    across = patch.across * load ** (1.0 / 3.0)
    fall = ring_speed * patch.curvature_ratio - slip / patch.roller_radius

    def along(zeta):
        local = slip + fall * zeta**2 / (2.0 * patch.contour_radius)
        local -= ring_speed * contact.shape.spin_ratio * zeta
        full = saturation * abs(ring_speed - 0.5 * slip)
        per_length = 0.75 * load / across * (1.0 - (zeta / across) ** 2)
        return limit * per_length * min(abs(local) / full, 1.0) * abs(local)

    ends = np.clip(places, -across, across)
    total = quad(along, -across, across, limit=400, epsabs=1e-9)[0]
    parts = [along(0.5 * (low + high)) * (high - low) for low, high in itertools.pairwise(ends)]
    return total, np.array(parts)


def test_power_and_where_it_lies_along_the_roller_are_those_of_the_friction(results):
    case, _, straight = results
    contacts = prepare(case.laws, case.bearing, case.lubricant, 1)
    pitch = case.bearing.pitch_radius
    shift = geometry.roller_radius(case.bearing) * math.cos(case.bearing.contact_angle)
    # Both raceways pass a roller in pure rolling at this speed.
    speed = -2.143 * (pitch - shift) * (pitch + shift) / (2.0 * pitch)
    half = 0.5 * case.bearing.roller_length
    places = np.linspace(-half, half, straight.station.size + 1)
    # It starts in pure rolling, and slips as it does in the long run soon after.
    result = straight.sel(row="downwind", roller=0).isel(time=slice(1, None))
    for contact, name in zip(contacts[:2], ("inner", "outer"), strict=True):
        total, parts = power_along(contact, LOAD, speed, float(result.slip.mean()), places)
        # Weight adds up to 31 N to the load of 9 kN.
        power = result.power.sel(interface=name)
        assert power.values == pytest.approx(np.full(power.size, total), rel=0.01)
        shares = result.station_energy.sel(raceway=name) / result.energy.sel(interface=name)
        # A station counts with the power of its middle, at the mean load of the orbit.
        assert shares.values == pytest.approx(parts / parts.sum(), abs=0.002)


def test_a_higher_limit_inside_turns_rollers_to_the_unfavourable_stop(results):
    case, skewed, _ = results
    stop = skew_stop(case.bearing, "conforming-pocket", case.cage.gap).largest
    for row, sign in (("downwind", 1.0), ("upwind", -1.0)):
        angles = skewed.skew_angle.sel(row=row, roller=0).values
        assert angles == pytest.approx(np.full(angles.size, sign * stop), rel=1e-9)
