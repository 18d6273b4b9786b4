"""Conservation, symmetry, limits and convergence of the whole bearing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from macroslip import BearingLoads, Cage, Case, Laws, Radau, simulate
from macroslip.ring.motion import ring_motion
from macroslip.roller.model import highest_load, ring_geometry
from macroslip.whole_bearing.books import energy_residual, momentum_residual, pocket_loss
from macroslip.whole_bearing.ledger import FLOWS
from macroslip.whole_bearing.model import whole_bearing
from macroslip.whole_bearing.pocket import restitution
from macroslip.whole_bearing.run import Times, pure_rolling, run_whole_bearing

pytestmark = pytest.mark.slow

RADIAL = (0.0, -2.0e-4, 0.0)
THRUST = (0.0, 0.0, 8.0e-4)
FREE = (0.0, 0.0, 0.0)


@pytest.mark.parametrize("impact", ["squeeze-film", "dry"])
@pytest.mark.parametrize("arrangement", ["one", "per-row"])
def test_books_close(run, impact, arrangement):
    cage = Cage(impact=impact, arrangement=arrangement, guide_friction=5.0, offsets="random")
    status, record, _ = run(cage, RADIAL, 2.143, 0.4)
    assert status == 0
    impulses = np.abs(record.flows[:, [k for k, name in enumerate(FLOWS) if name.endswith("impulse")]]).max()
    assert np.abs(momentum_residual(record)).max() < 1e-6 * impulses
    turned_over = np.abs(record.flows[-1, FLOWS.index("friction_loss")]) + np.abs(pocket_loss(record)[-1])
    assert turned_over > 0.0
    assert np.abs(energy_residual(record)).max() < 0.02 * turned_over


ROLLING = Laws.paper().but(rolling="whole-film")


def test_books_close_with_rolling_resistance(run):
    """Shear and push of the inlets act on roller and ring with equal and opposite torques, and cost 2 F_R u."""
    cage = Cage(guide_friction=5.0, offsets="random")
    status, record, _ = run(cage, RADIAL, 2.143, 0.4, tolerance=2e-5, laws=ROLLING)
    assert status == 0
    impulses = np.abs(record.flows[:, [k for k, name in enumerate(FLOWS) if name.endswith("impulse")]]).max()
    assert np.abs(momentum_residual(record)).max() < 1e-6 * impulses
    lost = record.flows[-1, [FLOWS.index("raceway_loss"), FLOWS.index("friction_loss")]]
    assert np.abs(energy_residual(record)).max() < 2e-4 * lost.sum()
    # The couple that keeps rollers from skewing is an outside one: its power is no part of the books.
    booked = (
        record.energy.sum(axis=0) + record.rolling_energy.sum(axis=0) - record.mechanism_energy[:, :, 2].sum(axis=0)
    )
    assert [booked[:2].sum(), booked[2]] == pytest.approx(lost, rel=1e-6)
    assert (record.rolling_energy > 0.0).all()


def test_rolling_resistance_of_gripped_rollers_is_that_of_an_imposed_orbit():
    """Rollers that thrust grips travel as the imposed orbit has it, so the oil of their raceways resists as much."""
    case = Case(loads=BearingLoads.constant([0.0, 0.0, 4e5], 2.143, 1.5), laws=ROLLING)
    imposed = simulate(case).rolling_energy.sel(row="downwind").sum("roller")
    coupled = simulate(replace(case, dynamics="whole-bearing")).rolling_energy.sel(row="downwind").sum("roller")
    assert coupled.values[:2] == pytest.approx(imposed.values[:2], rel=1e-3)


def test_residual_of_energy_falls_with_tolerance(run):
    found = []
    for tolerance in (1e-3, 1e-5):
        _, record, _ = run(Cage(), RADIAL, 2.143, 0.5, tolerance=tolerance)
        found.append(np.abs(energy_residual(record)).max())
    assert found[1] < 0.2 * found[0]


def test_energies_spin_and_force_converge(run):
    def figures(tolerance):
        _, record, _ = run(Cage(), RADIAL, 2.143, 1.0, tolerance=tolerance)
        return np.array(
            [*record.energy.sum(axis=0), record.trace[-1, :28, 0].mean(), np.abs(record.trace[-1, :, 11]).mean()]
        )

    coarse, fine, finest = figures(2e-5), figures(2e-6), figures(2e-7)
    off, less = np.abs(coarse / finest - 1.0), np.abs(fine / finest - 1.0)
    assert off.max() < 5e-3
    assert less.max() < 1e-3


def test_tractions_that_rest_change_nothing(run):
    """Between evaluations tractions follow from slopes; evaluated in every iteration they give the same."""
    _, record, _ = run(Cage(), RADIAL, 2.143, 0.2)
    _, other, _ = run(Cage(), RADIAL, 2.143, 0.2, rests=False)
    assert record.count[2] < 0.5 * other.count[2]
    assert record.energy.sum(axis=0) == pytest.approx(other.energy.sum(axis=0), rel=2e-3, abs=1e-6)


def test_free_coast_only_loses_energy(run):
    """No gravity, no drag, rings at rest: friction never gives energy, and nothing but the rings takes momentum."""
    _, record, _ = run(
        Cage(weight=False), FREE, 0.0, 0.5, gravity=False, drag=False,
        start=lambda begin: begin._replace(cage_lead=np.full(1, 0.05)),
    )  # fmt: skip
    energy = record.held[:, 1]
    assert energy[0] > 0.0
    assert (np.diff(energy) <= 1e-12).all()
    assert np.abs(record.flows[:, FLOWS.index("body_impulse")]).max() == 0.0
    assert np.abs(momentum_residual(record)).max() < 1e-6 * record.held[0, 0]


def test_a_released_cage_is_caught_by_the_rollers(run):
    """A cage at rest among gripped rollers is carried along within its gap, and the rollers do not notice."""
    nominal = 2.143 * 0.5 * 0.338367
    status, record, _ = run(
        Cage(), THRUST, 2.143, 0.3, start=lambda begin: begin._replace(cage_lead=np.full(1, -nominal)), outputs=31
    )
    assert status == 0
    assert record.cage_trace[0, 0, 0] == pytest.approx(0.0, abs=1e-5)
    assert record.cage_trace[-1, 0, 0] == pytest.approx(nominal / 0.3727, rel=0.02)
    assert np.abs(record.trace[-1, :28, 12]).max() < 1e-5  # gripped rollers keep their orbit's speed


def test_an_impact_in_the_bearing_gives_back_what_the_equation_says(run):
    """A cage runs into gripped rollers, all at once: it leaves with e times its speed of approach."""
    speed = 0.02
    cage = Cage(weight=False, impact="dry", gap=2e-4, arrangement="per-row")
    _, record, _ = run(
        cage, THRUST, 0.0, 8e-3, gravity=False, drag=False, tolerance=1e-6,
        start=lambda begin: begin._replace(cage_lead=np.full(2, speed)), outputs=401,
    )  # fmt: skip
    lead = record.cage_trace[:, 0, 0] * 0.3727
    assert lead[0] == pytest.approx(speed, rel=1e-3)
    assert -lead.min() / speed == pytest.approx(restitution(cage.damping, speed), rel=0.02)


def test_pitch_symmetry(run):
    """Under pure thrust without weight all rollers of a row do the same."""
    _, record, _ = run(Cage(weight=False), THRUST, ([0.0, 0.25, 0.5], [2.0, 2.5, 1.5]), 0.5, gravity=False)
    for row in (slice(0, 28), slice(28, 56)):
        energy = record.energy[row].sum(axis=1)
        assert energy == pytest.approx(energy[0], rel=1e-6, abs=1e-12)


def test_mirrored_thrust_swaps_the_rows(run):
    _, record, _ = run(Cage(weight=False), THRUST, 2.143, 0.5, gravity=False)
    _, mirrored, _ = run(Cage(weight=False), (0.0, 0.0, -THRUST[2]), 2.143, 0.5, gravity=False)
    assert record.energy[:28].sum(axis=0) == pytest.approx(mirrored.energy[28:].sum(axis=0), rel=1e-6, abs=1e-12)
    assert record.energy[28:].sum(axis=0) == pytest.approx(mirrored.energy[:28].sum(axis=0), rel=1e-6, abs=1e-12)


def test_renumbering_changes_nothing(run):
    order = np.concatenate([np.arange(27, -1, -1), np.arange(55, 27, -1)])

    def renumber(prepared):
        return prepared._replace(rollers=type(prepared.rollers)(*(values[order] for values in prepared.rollers)))

    _, record, _ = run(Cage(), RADIAL, 2.143, 0.3, tolerance=1e-5)
    _, other, _ = run(Cage(), RADIAL, 2.143, 0.3, tolerance=1e-5, change=renumber)
    assert other.energy == pytest.approx(record.energy[order], rel=1e-3, abs=1e-6)


def test_one_roller_model_is_the_limit_of_rigid_bilateral_spars():
    """Pockets without play and a cage that cannot be slowed: unloaded rollers hang their weight on the cage as (32) has it."""
    loads = BearingLoads.constant([0.0, -3e3, 0.0], 2.143, 1.5)
    case = Case(loads=loads, integrator=Radau(tolerance=2e-5))
    imposed = simulate(case).energy
    cage = Cage(gap=0.0, impact="dry", mass=1e5, weight=False)
    coupled = simulate(Case(loads=loads, integrator=Radau(tolerance=2e-5), dynamics="whole-bearing", cage=cage)).energy
    assert coupled.sel(interface="cage").sum("roller").values == pytest.approx(
        imposed.sel(interface="cage").sum("roller").values, rel=0.01
    )


def test_one_roller_model_is_the_limit_with_rolling_resistance_too():
    """Shear, push of the pressure, oil of the pockets and films of rollers with play, all as on an imposed orbit."""
    loads = BearingLoads.constant([0.0, -3e3, 0.0], 2.143, 1.5)
    case = Case(loads=loads, laws=ROLLING, integrator=Radau(tolerance=2e-5))
    imposed = simulate(case)
    cage = Cage(gap=0.0, impact="dry", weight=False)
    held = whole_bearing(case.bearing, case.oil, cage, tilt=case.drivetrain.tilt, laws=ROLLING)
    # The oil of an imposed orbit's pockets has play, which spars in this limit have not; its cage cannot be slowed.
    held = held._replace(films=held.models[0].films, cage_mass=1e8)
    ring = ring_geometry(case.bearing, held.models[0])
    motion, _ = ring_motion(loads, case.bearing, ring, highest_load(case.bearing, case.oil, ROLLING))
    window = np.array([imposed.attrs["window_start"], imposed.attrs["window_end"]])
    status, record = run_whole_bearing(
        held, motion, pure_rolling(held, cage), Times(window, window, window[1]), tolerance=2e-5
    )
    assert status == 0
    rolling, friction = (each.values.reshape(56, 3) for each in (imposed.rolling_energy, imposed.energy))
    assert (rolling > 0.0).all()
    assert record.rolling_energy == pytest.approx(rolling, rel=1e-3)
    assert record.energy == pytest.approx(friction, rel=1e-3)


@pytest.mark.parametrize(
    "shaft",
    [
        ([0.0, 0.5, 1.0], [0.0, 2.143, 2.143]),
        ([0.0, 0.5, 1.0], [2.143, 0.0, 0.0]),
        ([0.0, 1.0], [1.0, -1.0]),
        ([0.0, 1.0], [0.2143, 0.2143]),
        ([0.0, 0.3, 0.4, 1.0], [2.143, 2.143, 0.0, 0.0]),
        ([0.0, 1.0], [0.0, 0.0]),
    ],
    ids=["start", "stop", "reversal", "idling", "emergency stop", "standstill"],
)
def test_every_operation_runs(run, shaft):
    status, record, _ = run(Cage(), RADIAL, shaft, 1.0)
    assert status == 0
    assert np.isfinite(record.energy).all()
    assert (record.energy > -1e-9).all()


def test_rollers_of_unlike_diameter_drift_and_then_push_each_other(run):
    """δΩ/Ω = −0.11 δr/r in pure rolling; gripped rollers' places drift apart by it."""
    cage = Cage(diameter_scatter=1.5e-6, weight=False, gap=5e-4)
    _, record, prepared = run(cage, THRUST, 2.143, 1.0)
    nominal = 2.143 * 0.5 * prepared.inner_radius
    expected = 0.5 * 2.143 * (prepared.rollers.inner_radius[:28] - prepared.inner_radius)
    drift = record.trace[-1, :28, 11] - record.trace[-1, :28, 11].mean()
    assert np.abs(expected).max() > 1e-6 * nominal
    assert drift == pytest.approx(expected - expected.mean(), abs=0.05 * np.abs(expected).max())
