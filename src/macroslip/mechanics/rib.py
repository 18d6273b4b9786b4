"""Friction of a tapered roller's large end on the rib of the inner ring.

The rib belongs to the inner ring, whose surface passes the contact at −(Ω_in − Ω) R_P, the roller's
end at ω_rel ρ_P: they slide past each other in pure rolling too. The friction F_f drives the spin
with the arm ρ_P, and holds the orbit back with (R̃ + ζ_P sin α)/R̃ of it; raceways that grip pass
both on, the inner one −(e + g)/2 F_f and the outer one (g − e)/2 F_f with e = ρ_P/r and g = 1 + ζ_P
sin α/R̃.
"""

from __future__ import annotations

from typing import NamedTuple

from macroslip.compiled import jit_evaluation
from macroslip.contact.look_up import contact_load, contact_speeds, traction, traction_cell


class RibForces(NamedTuple):
    """Friction of the rib on a roller."""

    friction: float  #: F_f, positive where it drives the spin up [N]
    by_slip: float  #: ∂F_f/∂Δu, Δu the slip at the raceways [N s/m]
    power: float  #: F_f times the sliding speed [W]
    asperity_power: float  #: Part of it that asperities dissipate [W]


NO_RIB_FORCES = RibForces(0.0, 0.0, 0.0, 0.0)


@jit_evaluation
def rib_forces(rib, tables, elastic_load, ring_speed, slip):
    """Friction of a tapered roller's rib at a load of the rings and a slip of the raceways.

    Parameters
    ----------
    rib : record of `macroslip.roller.model.RIB`
    tables : int
        Address of the flat array of tables.
    elastic_load : float
        Load Q that the rings press on the roller [N], > 0; the rib has a fixed part of it.
    ring_speed, slip : float
        u2 and Δu at the raceways, at the roller's middle [m/s].

    Returns
    -------
    RibForces
    """
    surface = rib.speed * ring_speed
    sliding = surface - rib.arm * (ring_speed - slip)
    load = contact_load(rib.share * elastic_load)
    speeds = contact_speeds(surface, sliding, 0)
    cell = traction_cell(rib.traction, load, speeds)
    friction = traction(rib.traction, tables, load, speeds, cell)
    return RibForces(
        friction.pull,
        rib.arm * friction.pull_by_slip,
        friction.pull * sliding,
        friction.asperity_power,
    )
