"""Sections of a case beside its loads, and the words of its choices.

The sections are integrators, window, traces and loss of heat.
"""

from __future__ import annotations

from typing import Annotated

from macroslip.constants import IMPOSED_ORBIT, WHOLE_BEARING
from macroslip.errors import InputError
from macroslip.input.fields import Positive, Quantity, Whole
from macroslip.input.section import input_section
from macroslip.input.stored import IF_GIVEN
from macroslip.input.units import CONDUCTANCE, MASS, NUMBER, TEMPERATURE, TIME

DYNAMICS = (IMPOSED_ORBIT, WHOLE_BEARING)

_Step = Annotated[float, Quantity("fixed time step", TIME, 1e-7, 1.0)]


@input_section("integrator", "error-controlled, implicit, in the slip")
class Radau:
    """The production integrator: Radau IIA in the slip, L-stable, order 5, error-controlled.

    Parameters
    ----------
    tolerance : float
        Relative tolerance per step on slip (against the raceway speed) and on energy, 1e-10 to
        1e-2.
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
    max_steps: Annotated[int, Whole("number of steps after which a roller counts as failed", 1)] = (
        100_000_000
    )


@input_section("integrator", "fixed step, explicit, on the spin")
class ExplicitEuler:
    """Explicit Euler on the spin at a fixed step [s], as in the paper's Appendix A.

    It is unstable in the load zone.
    """

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
    """Part of the history over which energies and peaks are taken.

    The simulation always starts with the history.

    Parameters
    ----------
    start : float, optional
        [s] on the loads' time axis. None: when the rollers have completed one orbit, or at the
        first sample if they never do, or if the loads are an event.
    end : float, optional
        [s]; None: the last sample, which may also be one step before the end that is given.
    """

    start: Annotated[
        float | None,
        Quantity("start; auto: when the rollers have completed one orbit", TIME, words=("auto",)),
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

    step: Annotated[float, Positive("time between samples", TIME)]
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
    inner_mass, outer_mass : float, optional
        Masses that warm with the rings [kg]: inner ring with the shaft, outer ring with the
        housing.
    ring_conductance : float, optional
        Heat flow between them per kelvin [W/K]. With these three the rings have temperatures of
        their own.
    clearance_temperature : float, optional
        Temperature of the oil at which the bearing's warm clearance holds [K]; None: that of the
        lubricant's values.

    Notes
    -----
    Two nodes: half of the friction goes into each ring, the inner one loses its half to the outer
    one, and that loses all of
    it by `conductance`. The oil has the mean of both temperatures.
    """

    conductance: Annotated[float, Positive("heat flow to the surroundings per kelvin", CONDUCTANCE)]
    ambient: Annotated[
        float, Quantity("temperature of the surroundings", TEMPERATURE, 253.15, 363.15)
    ]
    inner_mass: Annotated[
        float | None, Positive("mass that warms with the inner ring", MASS, 1e6), IF_GIVEN
    ] = None
    outer_mass: Annotated[
        float | None, Positive("mass that warms with the outer ring", MASS, 1e6), IF_GIVEN
    ] = None
    ring_conductance: Annotated[
        float | None, Positive("heat flow between the rings per kelvin", CONDUCTANCE), IF_GIVEN
    ] = None
    clearance_temperature: Annotated[
        float | None,
        Quantity(
            "oil at which the bearing's warm clearance holds; without it that of its values",
            TEMPERATURE,
            253.15,
            423.15,
        ),
        IF_GIVEN,
    ] = None

    def __post_init__(self) -> None:
        values_given = [
            value
            for value in (self.inner_mass, self.outer_mass, self.ring_conductance)
            if value is not None
        ]
        if len(values_given) not in (0, 3):
            raise InputError(
                "rings with temperatures of their own need inner_mass, outer_mass and "
                "ring_conductance",
                allowed="all three, or none of them",
                remedy="Some tonnes of shaft and housing go with the rings.",
            )

    @property
    def to_oil(self) -> float:
        """Heat flow to the surroundings per kelvin of the oil [W/K].

        It passes `conductance` and the way from ring to ring in series.
        """
        if self.ring_conductance is None:
            return self.conductance
        of_outer_ring = 1.0 / self.conductance
        between_rings = 0.25 / self.ring_conductance
        return 1.0 / (of_outer_ring + between_rings)
