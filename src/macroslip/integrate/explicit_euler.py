"""Explicit Euler on the spin, one step (the paper's Appendix A: unstable in the load zone)."""

from __future__ import annotations

from macroslip.compiled import jit
from macroslip.integrate.sealed import forces_of
from macroslip.roller.forces import net_force


@jit
def explicit_euler_step(model, at, spin, step):
    """Spin after one explicit step of I_z' dω/dt = r (F_i + F_o + F_c) (16).

    Parameters
    ----------
    model : RollerModel
    at : Station
        At the start of the step.
    spin : float
        ω at the start, relative to the orbiting frame [rad/s].
    step : float
        [s].

    Returns
    -------
    float
        ω after the step [rad/s]. Stable only while step · (r²/I_z') dF/dv < 2.
    """
    forces = forces_of(model, at, at.ring_speed - model.radius * spin)
    return spin + step * model.mobility / model.radius * net_force(forces)
