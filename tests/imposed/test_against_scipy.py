"""The slip of one roller against SciPy's Radau: with the forces of its tables, which have references of their own."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from macroslip import Laws
from macroslip.imposed.status import Status
from macroslip.ring.orbit import instant
from tests.one_roller import (
    RATED,
    end_slips,
    energies,
    forces_of,
    limits_of,
    models,
    motion_of,
    net,
    powers_of,
    rollers,
    station_of,
    walk,
)
from tests.quick import COARSE

pytestmark = pytest.mark.slow


#: Ring displacements [m], start angle, start slip [m/s], shaft acceleration [rad/s²] and span [s]; the radial ones leave the top
#: unloaded.
STORIES = {
    "leaves the load zone and coasts over the top": ((0.0, -2.3e-4, 0.0), -0.55, 0.0, 0.0, 1.6),
    "coasts into the load zone and snaps back": ((0.0, -2.3e-4, 0.0), 3.6, -0.15, 0.0, 0.9),
    "unloaded all round": ((0.0, 0.0, -3e-4), 0.3, -0.02, 0.0, 2.0),
    "the shaft brakes while the roller is lightly loaded": (
        (0.0, -1.1e-4, 0.0),
        -2.2,
        0.0,
        -0.4,
        1.5,
    ),
    # At 150 rad/s² the light contacts cannot pull the roller along: slip grows although traction has peaked.
    "the shaft is too quick for traction": ((0.0, -0.3e-4, 0.0), -math.pi / 2, 0.0, 150.0, 0.2),
}

FULL = Laws.physical()
HOT = {
    "paper": Laws.paper(),
    "physical": FULL,
    "barus, newtonian": FULL.but(
        rheology="newtonian", viscosity="barus", asperities="none", rolling="none"
    ),
    "limiting shear": FULL.but(rheology="limiting-shear"),
    "without microslip": FULL.but(microslip=False),
}


def of(name):
    # Without weight a roller meets the same all the time. The coarsest tables serve: both integrators have them.
    made = models(HOT[name], gravity=False, drag=False)
    return rollers(made, speeds=(-0.6, 0.6), tolerance=COARSE.tolerance)["downwind"]


def thrust(roller, load):
    """Axial displacement of the ring [m] that presses every roller of the downwind row with a load [N]."""
    body = roller.body[0]
    approach = (load / float(body["stiffness"])) ** (2 / 3) + float(
        body["radial_play"] * body["cos_contact_angle"]
    )
    return 0.0, 0.0, approach / float(body["sin_contact_angle"])


def by_scipy(roller, motion, angle, slip, times):
    """Slips at `times` [m/s], and energies of inner, outer and cage interface [J], sample by sample by SciPy's Radau.

    dv/dt = du2/dt − (r²/I)(F_i + F_o + F_c + resistance).
    """
    body = roller.body[0]

    def rate(t, y):
        k = min(int(np.searchsorted(motion.time, t, side="right")) - 1, motion.time.size - 2)
        acceleration = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (
            motion.time[k + 1] - motion.time[k]
        )
        at = station_of(roller, angle, instant(motion, k, t))
        forces, drive = (
            forces_of(roller, at, y[0]),
            -body["orbit_ratio"] * body["outer_radius"] * acceleration,
        )
        return [drive - body["mobility"] * net(forces), *powers_of(roller, at, forces, y[0])]

    state, ends = [slip, 0.0, 0.0, 0.0], np.unique(np.concatenate([motion.time, times]))
    at = {ends[0]: slip}
    for start, end in itertools.pairwise(ends):
        piece = solve_ivp(
            rate, (start, end), state, method="Radau", rtol=1e-8, atol=[1e-12, 1e-10, 1e-10, 1e-10]
        )
        assert piece.success
        state = piece.y[:, -1]
        at[end] = float(state[0])
    return np.array([at[t] for t in times]), state[1:]


@pytest.mark.parametrize("story", STORIES)
def test_slip_and_energies_of_the_papers_model(story):
    displacement, angle, slip, acceleration, span = STORIES[story]
    roller = rollers(models(Laws.paper()), speeds=(-6.0, 6.0), tolerance=1e-5)["downwind"]
    time, times = np.linspace(0.0, span, 401), np.linspace(span / 8, span, 8)
    motion = motion_of(time, 2.143 + acceleration * time, displacement)
    steps, status, _ = walk(
        roller, motion, limits_of(roller, motion, 1e-7), times, angle, slip=slip
    )
    assert status == Status.COMPLETED
    whole = motion_of([0.0, span], 2.143 + acceleration * np.array([0.0, span]), displacement)
    slips, spent = by_scipy(roller, whole, angle, slip, times)
    assert end_slips(steps, times) == pytest.approx(slips, rel=3e-6, abs=2e-8)
    assert energies(steps) == pytest.approx(spent, rel=1e-5, abs=1e-9)


@pytest.mark.parametrize(
    ("name", "slip"),
    [*((name, -0.35) for name in HOT), ("physical", 0.3), ("barus, newtonian", -0.02)],
)
def test_a_skidding_roller_follows_its_past(name, slip):
    """Set down far from rolling under a heavy load: traction falls with slip at first, and rolling, where the roller would be
    gripped, is another root of a long implicit step. SciPy's integrator in small steps knows the way."""
    roller = of(name)
    motion = motion_of(np.linspace(0.0, 4e-3, 5), RATED, thrust(roller, 1.8e4))
    times = np.linspace(1e-5, 4e-3, 60)
    steps, status, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), times, 0.2, slip=slip)
    wanted, _ = by_scipy(roller, motion, 0.2, slip, times)
    assert status == Status.COMPLETED
    assert np.abs(end_slips(steps, times) - wanted).max() < 2e-4 * abs(slip) + 2e-6


def test_a_roller_whose_shaft_jerks_follows_its_past():
    """The shaft gains a third of its speed within 2 ms: more than traction of a lightly loaded roller can give."""
    roller = of("physical")
    motion = motion_of(
        [0.0, 0.02, 0.022, 0.05], RATED * np.array([1.0, 1.0, 1.33, 1.33]), thrust(roller, 700.0)
    )
    times = np.linspace(1e-3, 0.05, 80)
    steps, _, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), times, 0.2)
    wanted, _ = by_scipy(roller, motion, 0.2, 0.0, times)
    assert np.abs(wanted).max() > 0.05
    assert np.abs(end_slips(steps, times) - wanted).max() < 3e-4 * np.abs(wanted).max()


@pytest.mark.parametrize("load", [5e3, 3e4, 8e4])
@pytest.mark.parametrize("name", ["physical", "limiting shear"])
def test_slip_settles_where_moments_balance(name, load):
    roller = of(name)
    motion = motion_of(np.linspace(0.0, 0.5, 11), RATED, thrust(roller, load))
    steps, _, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), [0.5], 0.2)
    at = station_of(roller, 0.2, instant(motion, 9, 0.5))
    root = brentq(lambda slip: net(forces_of(roller, at, slip)), -0.02, 0.02, xtol=1e-15)
    assert abs(root) > 1e-5
    assert end_slips(steps, [0.5]) == pytest.approx(root, rel=1e-3)
