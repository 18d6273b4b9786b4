"""Kellström's friction over a case: its power, where it lies along the roller, and the skew that it leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Case, Laws, RollerLoads, Traces, simulate
from macroslip.contact.laws import prepare
from macroslip.contact.patch import patch_of
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
    straight = replace(skews, laws=LAWS, cage=None)
    return skews, simulate(skews, threads=1), simulate(straight, threads=1)


def patch_power(laws, bearing, load, ring_speed, slip):
    """∫ τ v dA of a straight roller by quadrature along it, with the friction of the docstring."""
    patch = patch_of(laws)
    limit, saturation = laws.friction
    across = patch.across * load ** (1.0 / 3.0)
    fall = ring_speed * patch.curvature_ratio - slip / patch.roller_radius

    def along(zeta):
        local = slip + fall * zeta**2 / (2.0 * patch.contour_radius)
        local -= ring_speed * patch.spin_ratio * zeta
        full = saturation * abs(ring_speed - 0.5 * slip)
        per_length = 0.75 * load / across * (1.0 - (zeta / across) ** 2)
        return limit * per_length * min(abs(local) / full, 1.0) * abs(local)

    return quad(along, -across, across, limit=400, epsabs=1e-9)[0]


def test_print(results):
    case, skewed, straight = results
    print(straight)
    for name in ("station_energy","energy","surface_energy"):
        if name in straight: print(name, straight[name].sizes)
    one = straight.isel(roller=0, time=10)
    print(one.slip.values, one.load.values if "load" in one else "", one.power.values)
    print(skewed.isel(roller=0).skew_angle.values[:, ::5], skewed.skew_residual.values)
    inner,outer,_ = prepare(case.laws, case.bearing, case.lubricant, 1)
    for c in (inner,outer): print(patch_power(c, case.bearing, 9e3, -0.396, float(one.slip.values.ravel()[0])))
