"""Balances of angular momentum and energy of the bearing.

Momentum Σ(m r~² Ω + I_z' cos α ω_z') + Σ I_c Ω_c changes by the torques alone that raceways,
weight, drag and guide exert, and by that of the pushes on a cage off the axis. A step's torques are
summed with the method's weights, so that the balances close to what Newton's method leaves
unbalanced. Kinetic energy of rollers and cages and elastic energy of the spars change by the work
of the shaft and of weights, less what friction and pockets dissipate; the residual is the error of
the method.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured

from macroslip.compiled import jit_inline
from macroslip.mechanics.cage import cage_guide
from macroslip.mechanics.power import cage_power
from macroslip.mechanics.speeds import cage_speed, centre_speed, spin_surface_speed
from macroslip.whole.pocket import elastic_energy, stop_energy, stop_force
from macroslip.whole.stage import FIRST

if TYPE_CHECKING:
    from macroslip.whole.model import WholeBearing
    from macroslip.whole.sdirk import Part

#: Flows during a step: angular impulses and energies.
STEP_FLOWS = np.dtype(
    [
        ("inner_impulse", "f8"),  # of the inner raceway [N m s]
        ("outer_impulse", "f8"),  # of the outer raceway [N m s]
        ("body_impulse", "f8"),  # of weight and drag of the rollers [N m s]
        ("guide_impulse", "f8"),  # of the cages' guides [N m s]
        ("eccentric_impulse", "f8"),  # of pushes on a cage off the axis [N m s]
        ("shaft_work", "f8"),  # of the shaft [J]
        ("body_work", "f8"),  # of weight and drag of the rollers [J]
        ("cage_weight_work", "f8"),  # of the cages' weight [J]
        ("raceway_loss", "f8"),  # dissipated in the raceway contacts [J]
        ("friction_loss", "f8"),  # dissipated by friction in the pockets [J]
        ("guide_loss", "f8"),  # dissipated by the cages' guides [J]
        ("pocket_work", "f8"),  # into the pockets, stored or dissipated [J]
        ("support_work", "f8"),  # into the radial stop, stored or dissipated [J]
    ]
)
#: Names of the flows, in the order of the columns of `Books.flows`.
FLOWS: tuple[str, ...] = tuple(STEP_FLOWS.names or ())
#: Stocks of the bearing.
STOCKS = (
    "momentum",  # angular momentum [N m s]
    "kinetic_energy",  # of rollers and cages [J]
    "elastic_energy",  # of spars and radial stop [J]
)
#: Flows that bring energy (+) or take it away (−).
_ENERGY_SIGNS = {
    "shaft_work": 1.0, "body_work": 1.0, "cage_weight_work": 1.0, "raceway_loss": -1.0, "friction_loss": -1.0,
    "guide_loss": -1.0, "pocket_work": -1.0, "support_work": -1.0,
}  # fmt: skip


@jit_inline
def add_flows(assembly, shaft_speed, k, span, space, flows):
    """Add the impulses and energies that flow during a solved stage.

    Parameters
    ----------
    assembly : macroslip.whole.model.Assembly
    shaft_speed : float
        Ω_in at the stage [rad/s].
    k : int
        Number of the stage, 0 or 1.
    span : float
        Weight of the stage in its step [s].
    space : macroslip.whole.stage.Space
        With the solved stage.
    flows : record of `STEP_FLOWS`
        The stage's impulses [N m s] and energies [J] are added.
    """
    bearing = assembly.bearing[0]
    positions = assembly.positions
    rollers = space.rollers
    cages = space.cages
    conditions = space.conditions[k]
    pitch = bearing.pitch_radius
    arm = bearing.lever * pitch
    for j in range(positions.size):
        position = positions[j]
        at = conditions[j]
        own = rollers[j].y[FIRST + k]
        orbital = centre_speed(own[0], own[1], at.ring)
        lag_in = at.pull_inner - at.turning_inner
        lag_out = at.pull_outer - at.turning_outer
        cage = cages[position.cage].y[FIRST + k]
        off_axis = cage[4] * at.cosine + cage[5] * at.sine
        shaft_torque = position.inner_radius * at.turning_inner + pitch * lag_in
        flows.inner_impulse -= span * (pitch * at.pull_inner - arm * at.turning_inner)
        flows.outer_impulse += span * (pitch * at.pull_outer + arm * at.turning_outer)
        flows.body_impulse -= span * pitch * at.tangential
        flows.eccentric_impulse += span * at.push * off_axis
        flows.shaft_work -= span * shaft_speed * shaft_torque
        flows.body_work -= span * at.tangential * orbital
        passing = shaft_speed * pitch - orbital
        loss = at.turning_inner * own[0] - lag_in * passing
        loss += at.turning_outer * own[1] - lag_out * orbital
        flows.raceway_loss += span * loss
        flows.friction_loss += span * cage_power(at.friction, at.sliding)
        flows.pocket_work -= span * at.push * at.pocket_speed
    for c in range(cages.size):
        cage = cages[c].y[FIRST + k]
        speed = cage_speed(cage[0], shaft_speed, bearing.inner_radius)
        guide = cage_guide(bearing, speed, shaft_speed)
        flows.guide_impulse -= span * pitch * (guide.friction + guide.drag)
        flows.shaft_work -= span * guide.drag * guide.land_speed
        flows.cage_weight_work -= span * bearing.cage_weight * cage[3]
        land_loss = guide.drag * (speed - guide.land_speed)
        flows.guide_loss += span * (guide.friction * speed + land_loss)
        if bearing.translates:
            push, n_x, n_y, _, _ = stop_force(
                bearing.radial_play, cage[4], cage[5], cage[2], cage[3]
            )
            flows.support_work += span * push * (n_x * cage[2] + n_y * cage[3])


class Books:
    """Balances of angular momentum and energy at given times.

    Attributes
    ----------
    times : ndarray, shape (m,)
        At which steps end, the start of the integration included [s].
    flows : ndarray, shape (m, 13)
        Impulses [N m s] and energies [J] since the start, by `FLOWS`. NaN where the integration did
        not arrive.
    stocks : ndarray, shape (m, 3)
        Angular momentum [N m s] and energies [J] of the bearing, by `STOCKS`. NaN where the
        integration did not arrive.
    driven : float
        Energy of the steps in which friction gave more than it took [J], which only an error can
        do.
    """

    def __init__(self, bearing: WholeBearing, times: np.ndarray):
        self.times = times
        self.flows = np.full((times.size, len(FLOWS)), np.nan)
        self.stocks = np.full((times.size, len(STOCKS)), np.nan)
        self._bearing = bearing
        self._sum = np.zeros(len(FLOWS))
        self.driven = 0.0

    def add(self, part: Part) -> None:
        """Add a part of the integration to the balances."""
        if not part.bearing.size:
            return
        flows = part.bearing["flows"]
        lost = flows["raceway_loss"] + flows["friction_loss"]
        self.driven -= float(np.minimum(lost, 0.0).sum())
        sums = self._sum + np.cumsum(structured_to_unstructured(flows), axis=0)
        self._sum = sums[-1]
        _, rows, places = np.intersect1d(part.bearing["end"], self.times, return_indices=True)
        self.flows[places] = sums[rows]
        self.stocks[places] = _stocks(self._bearing, part, rows)

    def momentum_residual(self) -> np.ndarray:
        """Change of angular momentum since the first time less all impulses [N m s], shape (m,)."""
        held = self.stocks[:, STOCKS.index("momentum")]
        impulses = [k for k, name in enumerate(FLOWS) if name.endswith("_impulse")]
        impulse = self.flows[:, impulses].sum(axis=1)
        return (held - held[0]) - (impulse - impulse[0])

    def energy_residual(self) -> np.ndarray:
        """Change of kinetic energy since the first time less all flows of energy [J], shape (m,).

        Work into pockets and supports holds what they store and what they dissipate.
        """
        kinetic = self.stocks[:, STOCKS.index("kinetic_energy")]
        columns = [FLOWS.index(name) for name in _ENERGY_SIGNS]
        signs = np.array(list(_ENERGY_SIGNS.values()))
        flow = self.flows[:, columns] @ signs
        return (kinetic - kinetic[0]) - (flow - flow[0])

    def pocket_loss(self) -> np.ndarray:
        """Energy dissipated by impacts, squeeze films and radial stop since the first time [J]."""
        stored = self.stocks[:, STOCKS.index("elastic_energy")]
        pocket_work = self.flows[:, FLOWS.index("pocket_work")]
        support_work = self.flows[:, FLOWS.index("support_work")]
        work = pocket_work + support_work
        return (work - work[0]) - (stored - stored[0])


def _stocks(bearing: WholeBearing, part: Part, rows: np.ndarray) -> np.ndarray:
    """Angular momentum, kinetic and elastic energy at the ends of steps, shape (rows, 3)."""
    steps = part.steps[rows]
    whole = part.bearing[rows]
    last = np.maximum(steps["stages"][:, 0] - 1, 0)
    every = np.arange(rows.size)
    slip_in = steps["inner_slip"][every, :, last]
    slip_out = steps["outer_slip"][every, :, last]
    shaft_speed = whole["shaft_speed"][every, last][:, None]
    ring = shaft_speed * bearing.positions["inner_radius"]
    orbital = centre_speed(slip_in, slip_out, ring)
    spinning = spin_surface_speed(slip_in, slip_out, ring)
    cages = whole["cages"][:, : bearing.cages]
    turning = cage_speed(cages[..., 0], shaft_speed, bearing.inner_radius)
    pitch = bearing.pitch_radius
    mass = bearing.roller_mass
    of_rollers = orbital + 0.5 * bearing.lever * spinning
    momentum = mass * pitch * of_rollers.sum(axis=1)
    momentum = momentum + bearing.cage_mass * pitch * turning.sum(axis=1)
    roller_squares = orbital**2 + 0.5 * spinning**2
    cage_squares = turning**2 + cages[..., 2] ** 2 + cages[..., 3] ** 2
    kinetic = 0.5 * mass * roller_squares.sum(axis=1)
    kinetic += 0.5 * bearing.cage_mass * cage_squares.sum(axis=1)
    elastic = elastic_energy(bearing.pocket, part.offset[rows]).sum(axis=1)
    if bearing.translates:
        of_stop = stop_energy(bearing.radial_play, cages[..., 4], cages[..., 5])
        elastic += of_stop.sum(axis=1)
    return np.stack([momentum, kinetic, elastic], axis=-1)
