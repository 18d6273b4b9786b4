"""The cage: as a user describes it, rollers off their nominal place and size, and the cage's radial guidance.

Pockets follow the rollers' contour, so a cage that leaves the bearing's axis by more than the radial play rests on
rollers all round, which the raceways hold. The model replaces them by one elastic, damped stop at the distance of the gap.
It is the same in every direction and has no friction of its own. Gripped rollers at either side, whose spars close at half
of that distance, carry the cage first. Without the stop only the few gripped rollers would hold the cage and, with it, the
weight of all other rollers. The stop's push on single rollers is small against their load and is neglected.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated

import numpy as np

from macroslip.bearing import geometry
from macroslip.bearing.geometry import ROWS
from macroslip.compiled import jit_inline
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Flag, Quantity, Whole
from macroslip.input.section import input_section
from macroslip.input.units import FORCE, INVERSE_SPEED, LENGTH, MASS, NUMBER

if TYPE_CHECKING:
    from macroslip.bearing import Bearing

#: How a roller meets a spar.
IMPACTS = ("squeeze-film", "dry")
#: One cage for both rows, or one a row.
ARRANGEMENTS = ("one", "per-row")
#: Where rollers are in their pockets at the start.
OFFSETS = ("centred", "random")
#: Stiffness [N/m] and damping [N s/m] of the radial stop, estimates: it yields some micrometres to the cage's weight and does
#: not bounce.
STIFFNESS, DAMPING = 1e8, 1e5


@input_section("cage", "the cage, with dynamics: whole-bearing")
class Cage:
    """The cage of a coupled simulation. Defaults are engineering estimates for the base bearing.

    Parameters
    ----------
    gap : float
        Diametral play of a roller in its pocket [m], ≥ 0: free way along the orbit between the two spars.
    impact : "squeeze-film" or "dry"
        Whether oil between roller and spar resists their approach, or they meet dry.
    damping : float
        D of the dry contact [s/m], K δ^1.5 (1 + D δ'); larger takes more energy from an impact.
    film_fullness : float
        Part of the flooded squeeze film's force, above 0 to 1; how full the gaps of a real cage are is not known.
    arrangement : "one" or "per-row"
        One cage for both rows, or two that turn on their own.
    mass : float
        Mass of the cage [kg], of both together where each row has its own. It is a thin ring at the pitch radius.
    weight : bool
        Whether the cage's weight acts. It rests on the rollers at either side, through two translations of the cage;
        without weight the cage stays concentric.
    guide_friction : float
        Friction force at the pitch radius that brakes each cage [N]; zero for a cage that only rollers guide.
    offsets : "centred" or "random"
        Rollers start in the middle of their pockets, or anywhere in them with equal probability.
    diameter_scatter : float
        Standard deviation of the roller diameters [m].
    seed : int
        Of the random offsets and diameters.

    Raises
    ------
    InputError
        A value out of its range.

    Examples
    --------
    >>> Cage(gap=2e-4).impact
    'squeeze-film'
    """

    gap: Annotated[float, Quantity("play of a roller between the two spars of its pocket", LENGTH, 0.0, 0.1)] = 0.5e-3
    impact: Annotated[str, Choice("how a roller meets a spar", lambda: IMPACTS)] = "squeeze-film"
    damping: Annotated[float, Quantity("D of the dry contact K δ^1.5 (1 + D δ')", INVERSE_SPEED, 0.0, 1e6)] = 50.0
    film_fullness: Annotated[
        float,
        Quantity(
            "part of the flooded squeeze film's force", NUMBER, 0.0, 1.0, above=True,
            remedy="Without oil between roller and spar set impact: dry.",
        ),
    ] = 1.0  # fmt: skip
    arrangement: Annotated[str, Choice("one cage for both rows, or one a row", lambda: ARRANGEMENTS)] = "one"
    mass: Annotated[
        float,
        Quantity(
            "mass of the cage, or of both together", MASS, 1e-3, 1e5,
            remedy="A cage without mass has no speed of its own; 35 to 60 kg are likely for the base bearing.",
        ),
    ] = 50.0  # fmt: skip
    weight: Annotated[bool, Flag("weight of the cage")] = True
    guide_friction: Annotated[
        float,
        Quantity("force at the pitch radius that brakes each cage", FORCE, 0.0, 1e6),
    ] = 0.0
    offsets: Annotated[str, Choice("where rollers start in their pockets", lambda: OFFSETS)] = "centred"
    diameter_scatter: Annotated[float, Quantity("standard deviation of the roller diameters", LENGTH, 0.0, 1e-4)] = 0.0
    seed: Annotated[int, Whole("seed of the random offsets and diameters")] = 1

    def check_fit(self, bearing: Bearing) -> None:
        """Refuse pockets that do not fit between the rollers.

        Raises
        ------
        InputError
            If rollers, play and spars need more than the circumference.
        """
        spacing = 2.0 * bearing.pitch_radius * math.sin(math.pi / bearing.rollers_per_row)
        if self.gap >= spacing - bearing.roller_diameter:
            raise InputError(
                f"the gap is {self.gap * 1e3:.4g} mm, and {bearing.rollers_per_row} rollers a row leave "
                f"{(spacing - bearing.roller_diameter) * 1e3:.4g} mm between neighbours, so pockets would overlap",
                where="cage.gap",
                allowed="less than the distance between neighbouring rollers",
                remedy="Check the gap and the bearing's rollers_per_row, roller_diameter and pitch_radius.",
            )

    def start_offsets(self, count: int) -> np.ndarray:
        """Offsets of all rollers in their pockets at the start [m], shape (rows, count)."""
        if self.offsets == "centred":
            return np.zeros((len(ROWS), count))
        generator = np.random.default_rng([self.seed, 0])
        return generator.uniform(-0.5 * self.gap, 0.5 * self.gap, (len(ROWS), count))

    def diameter_deviations(self, count: int) -> np.ndarray:
        """Deviations of the roller diameters from their mean [m], shape (rows, count)."""
        if self.diameter_scatter == 0.0:
            return np.zeros((len(ROWS), count))
        drawn = np.random.default_rng([self.seed, 1]).normal(0.0, self.diameter_scatter, (len(ROWS), count))
        return drawn - drawn.mean(axis=1, keepdims=True)


def inner_radii(bearing: Bearing, diameter_deviation: np.ndarray) -> np.ndarray:
    """Effective inner contact radius r~_in of rollers whose diameter deviates [m].

    A thicker roller touches the outer raceway's sphere at the same place, has its centre further in and touches an inner
    ring of smaller radius; pure rolling then has δΩ/Ω = −(r cos α/r~_in)(r~_out/r~) δr/r, −0.11 δr/r for the base bearing.
    The model gives the roller the inner contact radius that turns it at this orbit speed and leaves all else.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> base = Bearing.read("skf-240-600-bc")
    >>> nominal, thick = inner_radii(base, np.array([0.0, 70e-6]))
    >>> round(float((thick - nominal) / nominal / 1e-3), 3)
    -0.111
    """
    inner, outer = geometry.inner_contact_radius(bearing), geometry.outer_contact_radius(bearing)
    slope = math.cos(bearing.contact_angle) / inner * outer / bearing.pitch_radius
    return inner * (1.0 - slope * 0.5 * diameter_deviation)


@jit_inline
def guide_force(play, a, b, p, q):
    """Push of the rollers on a cage that has left the axis by (a, b) [m] at the speed (p, q) [m/s].

    Parameters
    ----------
    play : float
        Distance [m] that is free.

    Returns
    -------
    push : float
        Towards the axis [N], never below zero.
    n_x, n_y : float
        Direction in which the cage has left it.
    by_place, by_speed : float
        Derivatives of the push by the distance [N/m] and by its rate [N s/m].

    Examples
    --------
    >>> push, n_x, n_y, _, _ = guide_force(1e-4, 0.0, -1.05e-4, 0.0, 0.0)
    >>> round(push), n_y
    (500, -1.0)
    """
    distance = math.sqrt(a * a + b * b)
    depth = distance - play
    if depth <= 0.0 or distance == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    n_x, n_y = a / distance, b / distance
    push = STIFFNESS * depth + DAMPING * (p * n_x + q * n_y)
    if push <= 0.0:
        return 0.0, n_x, n_y, 0.0, 0.0
    return push, n_x, n_y, STIFFNESS, DAMPING


def guide_energy(play: float, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Elastic energy of the stop [J] of cages that have left the axis by (a, b) [m]."""
    return 0.5 * STIFFNESS * np.maximum(np.hypot(a, b) - play, 0.0) ** 2
