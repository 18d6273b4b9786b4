"""Conservation, symmetry, limits and convergence of the whole bearing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Cage, Case, Laws, Lubricant, Radau, Window, simulate
from macroslip.result.prepared import prepare
from macroslip.roller.model import with_tables as rollers_with_tables
from macroslip.whole.books import FLOWS
from macroslip.whole.model import whole_bearing, with_tables
from macroslip.whole.sdirk import pure_rolling
from tests.quick import COARSE
from tests.whole.conftest import gather

pytestmark = pytest.mark.slow

RADIAL = (0.0, -2.0e-4, 0.0)
THRUST = (0.0, 0.0, 8.0e-4)
FREE = (0.0, 0.0, 0.0)


def assert_momentum_closes(run):
    impulses = np.abs(
        run.books.flows[:, [k for k, name in enumerate(FLOWS) if name.endswith("impulse")]]
    ).max()
    assert np.abs(run.books.momentum_residual()).max() < 1e-6 * impulses


@pytest.mark.parametrize("impact", ["squeeze-film", "dry"])
@pytest.mark.parametrize("arrangement", ["one", "per-row"])
def test_books_close(run, impact, arrangement):
    cage = Cage(impact=impact, arrangement=arrangement, guide_friction=5.0, offsets="random")
    result = run(cage, RADIAL, 2.143, 0.4)
    assert result.status == 0
    assert_momentum_closes(result)
    turned_over = np.abs(result.flow("friction_loss")[-1]) + np.abs(result.books.pocket_loss()[-1])
    assert turned_over > 0.0
    assert np.abs(result.books.energy_residual()).max() < 0.02 * turned_over


ROLLING = Laws.paper().but(rolling="whole-film")


def test_books_close_with_rolling_resistance(run):
    """Shear and push of the inlets act on roller and ring with equal and opposite torques, and cost 2 F_R u."""
    cage = Cage(guide_friction=5.0, offsets="random")
    result = run(cage, RADIAL, 2.143, 0.4, tolerance=2e-5, laws=ROLLING)
    assert result.status == 0
    assert_momentum_closes(result)
    lost = np.array([result.flow("raceway_loss")[-1], result.flow("friction_loss")[-1]])
    assert np.abs(result.books.energy_residual()).max() < 2e-4 * lost.sum()
    rolling = result.energy("rolling")
    booked = result.energy().sum(axis=0) + rolling.sum(axis=0)
    # The couple that keeps rollers from skewing is an outside one: its power is no part of the books.
    booked[:2] -= result.energy("skew_power").sum(axis=0)
    assert [booked[:2].sum(), booked[2]] == pytest.approx(lost, rel=1e-6)
    assert (rolling > 0.0).all()


def test_energies_spin_and_force_converge(run):
    def figures(tolerance):
        result = run(Cage(), RADIAL, 2.143, 1.0, tolerance=tolerance)
        return np.array(
            [
                *result.energy().sum(axis=0),
                result.at_end("outer_slip")[-1, :28].mean(),
                np.abs(result.offset[-1]).mean(),
            ]
        )

    coarse, fine, finest = figures(2e-5), figures(2e-6), figures(2e-7)
    off, less = np.abs(coarse / finest - 1.0), np.abs(fine / finest - 1.0)
    assert off.max() < 5e-3
    assert less.max() < 1e-3


def test_tractions_that_rest_change_nothing(run):
    """Between evaluations tractions follow from slopes; evaluated in every iteration they give the same."""
    result = run(Cage(), RADIAL, 2.143, 0.2)
    other = run(Cage(), RADIAL, 2.143, 0.2, extrapolates=False)
    assert result.memory["evaluations"] < 0.5 * other.memory["evaluations"]
    assert result.energy().sum(axis=0) == pytest.approx(
        other.energy().sum(axis=0), rel=2e-3, abs=1e-6
    )


def test_free_coast_only_loses_energy(run):
    """No gravity, no drag, rings at rest: friction never gives energy, and nothing but the rings takes momentum."""
    result = run(
        Cage(weight=False), FREE, 0.0, 0.5, gravity=False, drag=False,
        start=lambda begin: begin._replace(cage_lead=np.full(1, 0.05)),
    )  # fmt: skip
    energy = result.books.stocks[:, 1]
    assert energy[0] > 0.0
    assert (np.diff(energy) <= 1e-12).all()
    assert np.abs(result.flow("body_impulse")).max() == 0.0
    assert np.abs(result.books.momentum_residual()).max() < 1e-6 * result.books.stocks[0, 0]


def test_a_released_cage_is_caught_by_the_rollers(run):
    """A cage at rest among gripped rollers is carried along within its gap, and the rollers do not notice."""
    nominal = 2.143 * 0.5 * 0.338367
    result = run(
        Cage(),
        THRUST,
        2.143,
        0.3,
        start=lambda begin: begin._replace(cage_lead=np.full(1, -nominal)),
        outputs=31,
    )
    assert result.status == 0
    assert result.cage_speed()[0] == pytest.approx(0.0, abs=1e-5)
    assert result.cage_speed()[-1] == pytest.approx(nominal / 0.3727, rel=0.02)
    # Gripped rollers keep their orbit's speed.
    assert np.abs(result.at_end("inner_slip") - result.at_end("outer_slip"))[-1, :28].max() < 1e-5


def test_mirrored_thrust_swaps_the_rows(run):
    result = run(Cage(weight=False), THRUST, 2.143, 0.5, gravity=False)
    mirrored = run(Cage(weight=False), (0.0, 0.0, -THRUST[2]), 2.143, 0.5, gravity=False)
    energy, other = result.energy(), mirrored.energy()
    assert energy[:28].sum(axis=0) == pytest.approx(other[28:].sum(axis=0), rel=1e-6, abs=1e-12)
    assert energy[28:].sum(axis=0) == pytest.approx(other[:28].sum(axis=0), rel=1e-6, abs=1e-12)


def test_renumbering_changes_nothing(run):
    order = np.concatenate([np.arange(27, -1, -1), np.arange(55, 27, -1)])

    def renumber(prepared):
        return replace(prepared, positions=prepared.positions[order])

    result = run(Cage(), RADIAL, 2.143, 0.3, tolerance=1e-5)
    other = run(Cage(), RADIAL, 2.143, 0.3, tolerance=1e-5, change=renumber)
    assert other.energy() == pytest.approx(result.energy()[order], rel=1e-3, abs=1e-6)


def test_one_roller_model_is_the_limit_with_rolling_resistance_too():
    """Shear, push of the pressure, oil of the pockets and films of rollers with play, all as on an imposed orbit."""
    loads = BearingLoads.constant([0.0, -3e3, 0.0], 2.143, 1.5)
    case = Case(loads=loads, laws=ROLLING, oil_supply="flooded", integrator=Radau(tolerance=2e-5))
    imposed = simulate(case)
    cage = Cage(gap=0.0, impact="dry", weight=False)
    # The oil of an imposed orbit's pockets has play, which spars in this limit have not; its cage cannot be slowed.
    ready = prepare(case)
    held = whole_bearing(case.bearing, case.oil, cage, tilt=case.drivetrain.tilt, laws=ROLLING)
    held = replace(held, cage_mass=1e8)
    assembly, _ = with_tables(held, ready.box)
    bodies = rollers_with_tables(held.models, ready.box)[0]
    for k, row in enumerate(held.models):
        assembly.bodies[k]["cage"] = bodies[row].body[0]["cage"]
    assembly = assembly._replace(tables=bodies["downwind"].tables)
    window = np.array([imposed.attrs["window_start"], imposed.attrs["window_end"]])
    times = np.union1d(ready.motion.time[:1], window)
    measures = gather(held, assembly, ready.motion, pure_rolling(held, cage), times, tolerance=2e-5)
    assert measures.status == 0
    within = measures._replace(steps=measures.steps[measures.whole["start"] >= window[0]])
    rolling, friction = (
        each.values.reshape(56, 3) for each in (imposed.rolling_energy, imposed.energy)
    )
    assert (rolling > 0.0).all()
    assert within.energy("rolling") == pytest.approx(rolling, rel=1e-3)
    assert within.energy() == pytest.approx(friction, rel=1e-3)


@pytest.mark.parametrize(
    "shaft",
    [
        ([0.0, 0.5, 1.0], [0.0, 2.143, 2.143]),
        ([0.0, 1.0], [1.0, -1.0]),
        ([0.0, 0.3, 0.4, 1.0], [2.143, 2.143, 0.0, 0.0]),
        ([0.0, 1.0], [0.0, 0.0]),
    ],
    ids=["start", "reversal", "emergency stop", "standstill"],
)
def test_every_operation_runs(run, shaft):
    result = run(Cage(), RADIAL, shaft, 1.0)
    assert result.status == 0
    assert np.isfinite(result.energy()).all()
    assert (result.energy() > -1e-9).all()


def test_rollers_of_unlike_diameter_drift_and_then_push_each_other(run):
    """δΩ/Ω = −0.11 δr/r in pure rolling; gripped rollers' places drift apart by it."""
    cage = Cage(diameter_scatter=1.5e-6, weight=False, gap=5e-4)
    result = run(cage, THRUST, 2.143, 1.0)
    nominal = 2.143 * 0.5 * result.bearing.inner_radius
    expected = (
        0.5 * 2.143 * (result.bearing.positions["inner_radius"][:28] - result.bearing.inner_radius)
    )
    drift = result.offset[-1, :28] - result.offset[-1, :28].mean()
    assert np.abs(expected).max() > 1e-6 * nominal
    assert drift == pytest.approx(expected - expected.mean(), abs=0.05 * np.abs(expected).max())


def test_rollers_that_drop_faster_than_the_rings_creep_stay_in_the_tables():
    loads = BearingLoads.constant((0.0, -5e3, 0.0), 0.01, 3.0)
    result = simulate(
        Case(
            loads=loads,
            laws=Laws.paper(),
            dynamics="whole-bearing",
            rating=False,
            contact_details=False,
        )
    )
    assert (result.status == 0).all()
    drop = result.book_body_work.max() + result.book_cage_weight_work.max()
    assert np.abs(result.energy_residual).max() < 5e-3 * drop


def test_a_shaft_that_starts_under_load_gives_rollers_no_energy_of_their_own():
    """A contact at rest has no slopes, and friction at its limit none by slip: beyond either, rollers ran away by them."""
    time = np.linspace(0.0, 1.2, 129)
    shaft = np.clip(2.36 * (time - 0.244), 0.0, 1.88)
    force = np.outer(1.0 + 15.0 * time, [0.0, -5.0e3, -8.6e2])
    case = Case(
        loads=BearingLoads(time, shaft, force, "start"), bearing=Bearing.read("skf-230-900-ca"),
        lubricant=Lubricant.read("skf-lgwm-1"), temperature=292.0, laws=Laws.physical(), dynamics="whole-bearing",
        rating=False, contact_details=False, gravity=False, window=Window(start=0.0, end=0.28), integrator=COARSE,
    )  # fmt: skip
    result = simulate(case)
    assert (result.status == 0).all()
    assert (result.energy > -1e-9).all()
    # Nothing but the shaft and falling rollers can move a raceway's rollers.
    assert float(result.book_kinetic_energy.sum()) < float(
        (result.book_shaft_work + result.book_body_work).sum()
    )
