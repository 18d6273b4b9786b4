"""The production integrator against SciPy's Radau on the equation written again with quadrature and no shared code."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from macroslip.integrate.entries import sealed
from macroslip.integrate.load_zone import empty_classes, firm_interference
from macroslip.integrate.path import Limits, Path
from macroslip.integrate.radau import integrate_radau
from macroslip.integrate.record import new_record
from macroslip.imposed.status import Status
from macroslip.ring.orbit import Motion, shaft_angle
from macroslip.roller.model import roller_model

pytestmark = pytest.mark.slow


def solve(bearing, lubricant, displacement, speed, start_angle, slip, times, acceleration=0.0, tolerance=1e-7):
    """Slip at `times` and energies up to the last, from the production integrator under a fixed ring displacement."""
    model = roller_model(bearing, lubricant, 1, tilt=math.radians(5))
    time = np.linspace(0.0, times[-1], 401)
    shaft_speed = speed + acceleration * time
    motion = Motion(time, shaft_speed, shaft_angle(time, shaft_speed), np.tile(displacement, (401, 1)))
    fastest = np.abs(shaft_speed).max() * model.orbit_ratio * model.outer_radius
    limits = Limits(
        tolerance=tolerance,
        max_steps=10**6,
        speed_scale=fastest,
        energy_scale=fastest**2 / model.mobility,
        longest_step=0.1 * times[-1],
        cold_slip=0.0,
        firm=firm_interference(sealed(model), fastest),
        interrupt=np.zeros(1, dtype=np.int8),
    )
    record = new_record(np.array([0.0, times[-1]]), np.array(times), fastest)
    status = integrate_radau(
        Path(sealed(model), motion, start_angle, limits), slip, np.array(times), empty_classes(time.size), record
    )
    assert status == Status.COMPLETED
    return record.trace[:, 0], record.energy


def independent(roller, slip, times):
    found = solve_ivp(
        roller.rate,
        (0.0, times[-1]),
        [slip, 0.0, 0.0, 0.0],
        method="Radau",
        t_eval=times,
        rtol=1e-8,
        atol=[1e-12, 1e-10, 1e-10, 1e-10],
        first_step=1e-7,
        max_step=0.02,
    )
    assert found.success
    return found.y


# Ring displacements [m], start angle, start slip [m/s]; the radial ones leave the top unloaded.
STORIES = {
    "leaves the load zone and coasts over the top": ((0.0, -2.3e-4, 0.0), -0.55, 0.0, 0.0, 1.6),
    "coasts into the load zone and snaps back": ((0.0, -2.3e-4, 0.0), 3.6, -0.15, 0.0, 0.9),
    "unloaded all round": ((0.0, 0.0, -3e-4), 0.3, -0.02, 0.0, 2.0),
    "the shaft brakes while the roller is lightly loaded": ((0.0, -1.1e-4, 0.0), -2.2, 0.0, -0.4, 1.5),
}


@pytest.mark.parametrize("story", STORIES)
def test_slip_and_energies(bearing, lubricant, plain_roller, story):
    displacement, angle, slip, acceleration, span = STORIES[story]
    times = np.linspace(span / 8, span, 8)
    reference = independent(plain_roller(bearing, lubricant, displacement, 2.143, angle, acceleration), slip, times)
    found, energy = solve(bearing, lubricant, displacement, 2.143, angle, slip, times, acceleration)
    assert found == pytest.approx(reference[0], rel=2e-6, abs=2e-8)
    assert energy == pytest.approx(reference[1:, -1], rel=5e-6, abs=1e-9)


def test_roller_forced_to_skid_follows_the_root_continuous_with_the_past(bearing, lubricant, plain_roller):
    """A heavily loaded roller that starts with large slip sits on the falling branch of its traction curve.

    Every implicit step then has up to three roots: skidding on, the unstable one, and gripped. The solution is the one
    that time leads to, and the roller grips when, not before, its traction has stopped it.
    """
    displacement, angle, slip = (0.0, -1.25e-4, 0.0), -math.pi / 2, 0.36
    roller = plain_roller(bearing, lubricant, displacement, 2.143, angle)
    inner, outer, _, _ = roller.forces(0.0, slip)
    more, outer_more, _, _ = roller.forces(0.0, 1.05 * slip)
    assert more + outer_more < inner + outer  # the falling branch
    grip = solve_ivp(
        roller.rate, (0.0, 0.01), [slip, 0, 0, 0], method="Radau", rtol=1e-9, atol=1e-13, dense_output=True
    )
    stopped = grip.t[np.argmax(grip.y[0] < 0.01 * slip)]
    times = np.array([0.2, 0.5, 0.8, 0.95, 1.5, 3.0]) * stopped
    reference = independent(roller, slip, times)
    for tolerance, accuracy in ((1e-2, 2e-2), (1e-4, 3e-4), (1e-8, 1e-6)):
        found, energy = solve(bearing, lubricant, displacement, 2.143, angle, slip, times, tolerance=tolerance)
        assert found == pytest.approx(reference[0], abs=accuracy * slip)
        assert energy.sum() == pytest.approx(reference[1:, -1].sum(), rel=5 * accuracy)


def test_shaft_too_quick_for_traction_makes_the_roller_skid(bearing, lubricant, plain_roller):
    """At 150 rad/s² the light contacts cannot pull the roller along: slip grows although traction has peaked."""
    displacement, angle, acceleration = (0.0, -0.3e-4, 0.0), -math.pi / 2, 150.0
    roller = plain_roller(bearing, lubricant, displacement, 2.143, angle, acceleration)
    times = np.linspace(0.02, 0.2, 10)
    reference = independent(roller, 0.0, times)
    assert abs(reference[0, -1]) > 1.0
    found, energy = solve(bearing, lubricant, displacement, 2.143, angle, 0.0, times, acceleration)
    assert found == pytest.approx(reference[0], rel=1e-6)
    assert energy == pytest.approx(reference[1:, -1], rel=1e-5, abs=1e-9)
