"""Sections of a case beside its loads: integrators, window, traces, and how the bearing loses its heat."""

from __future__ import annotations

from typing import Annotated

from macroslip.input.fields import Quantity, Whole
from macroslip.input.section import input_section
from macroslip.input.units import CONDUCTANCE, NUMBER, TEMPERATURE, TIME

_Step = Annotated[float, Quantity("fixed time step", TIME, 1e-7, 1.0)]


@input_section(
    "integrator",
    "error-controlled, implicit, in the slip",
    gone={"tables": "Contacts are always looked up in tables now; remove the key."},
)
class Radau:
    """The production integrator: Radau IIA in the slip, L-stable, order 5, error-controlled.

    Parameters
    ----------
    tolerance : float
        Relative tolerance per step on slip (against the raceway speed) and on energy, 1e-10 to 1e-2.
    max_steps : int
        Steps and rejections after which a roller counts as failed.
    """

    tolerance: Annotated[
        float,
        Quantity(
            "relative tolerance per step", NUMBER, 1e-10, 1e-2,
            remedy="2e-4 gives energies and spin to 1e-4 and peak power to 1 %.",
        ),
    ] = 2e-4  # fmt: skip
    max_steps: Annotated[int, Whole("number of steps after which a roller counts as failed", 1)] = 100_000_000


@input_section("integrator", "fixed step, explicit, on the spin")
class ExplicitEuler:
    """Explicit Euler on the spin at a fixed step [s], as in the paper's Appendix A; unstable in the load zone."""

    step: _Step


@input_section("integrator", "fixed step, implicit, on the spin")
class BackwardEuler:
    """Backward Euler on the spin at a fixed step, the paper's method.

    Parameters
    ----------
    step : float
        [s].
    tolerance : float
        Relative change of spin at which the nonlinear iteration stops, 1e-16 to 1e-2.
    """

    step: _Step
    tolerance: Annotated[
        float, Quantity("relative change of spin at which the iteration stops", NUMBER, 1e-16, 1e-2)
    ] = 1e-12


INTEGRATORS = {"radau": Radau, "backward-euler": BackwardEuler, "explicit-euler": ExplicitEuler}


@input_section("window", "part of the time over which energies and peaks are taken")
class Window:
    """Part of the history over which energies and peaks are taken; the simulation always starts with the history.

    Parameters
    ----------
    start : float, optional
        [s] on the loads' time axis. None: when the rollers have completed one orbit, or at the first sample if they
        never do.
    end : float, optional
        [s]; None: the last sample.
    """

    start: Annotated[
        float | None, Quantity("start; auto: when the rollers have completed one orbit", TIME, words=("auto",))
    ] = None
    end: Annotated[float | None, Quantity("end; without it, the end of the loads", TIME)] = None


@input_section("traces", "series to keep for every simulated roller")
class Traces:
    """Series to be kept for every simulated roller.

    Parameters
    ----------
    step : float
        Time between samples [s]. The integrator ends a step at each of them.
    start, end : float, optional
        First and last time [s] on the loads' time axis; None: first and last sample of the loads.
    """

    step: Annotated[float, Quantity("time between samples", TIME, 0.0, above=True)]
    start: Annotated[float | None, Quantity("first time", TIME)] = None
    end: Annotated[float | None, Quantity("last time", TIME)] = None


@input_section("heat", "how the bearing loses its heat, for temperature: balance")
class Heat:
    """How the bearing loses the heat of its friction to its surroundings.

    Parameters
    ----------
    conductance : float
        Heat flow per kelvin [W/K]; 40 to 80 is an estimate for the main bearing of a 2 MW turbine.
    ambient : float
        Temperature of the surroundings [K].
    """

    conductance: Annotated[float, Quantity("heat flow to the surroundings per kelvin", CONDUCTANCE, 0.0, above=True)]
    ambient: Annotated[float, Quantity("temperature of the surroundings", TEMPERATURE, 253.15, 363.15)]
