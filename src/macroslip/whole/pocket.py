"""Forces between a roller and the two spars of its pocket, and the radial stop of the cage.

The pocket offset x is the roller's way ahead of the middle of its pocket, along the orbit. The
front spar is at x = c/2, the rear one at −c/2; N is their push on the roller along the orbit. A
spar never pulls.

Dry, a spar pushes with K δ^1.5 (1 + D δ'). A **squeeze film** resists the approach: between a
cylinder of radius R and a plane, Reynolds' equation for a gap h + x²/(2R) that closes at V gives
p = 6 η V R/(h + x²/(2R))², hence the force 3√2 π η l V (R/h)^1.5. On opening the film cavitates and
gives nothing. It would keep surfaces apart for ever. Real ones are rough: when the gap g falls
below their roughness h_m, their asperities meet (Hertz, on −g) while oil is left in the valleys, so
the film thickness of the formula is h_m + ½(g + √(g² + h_m²)). It tends to g + h_m in the open gap
and to h_m in a loaded contact, without a corner, so that the film's damping is bounded by that at
h_m.

Pockets follow the rollers' contour, so a cage that leaves the bearing's axis by more than the
radial play rests on rollers all round, which the raceways hold. The model replaces them by one
elastic, damped stop at the distance of the gap. It is the same in every direction and has no
friction of its own. Gripped rollers at either side, whose spars close at half of that distance,
carry the cage first. Without the stop only the few gripped rollers would hold the cage and, with
it, the weight of all other rollers. The stop's push on single rollers is small against their load
and is neglected.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.compiled import jit_inline
from macroslip.constants import FLOODED_GAP
from macroslip.elementary import arctangent
from macroslip.lubricant import Lubricant
from macroslip.whole.cage import Cage

#: Composite roughness times this is the film in a loaded contact; beyond Λ = 3 surfaces count as
#: apart.
_ROUGHNESS_FILMS = 3.0
#: Stiffness of the radial stop [N/m], an estimate: it yields some micrometres to the cage's weight.
STIFFNESS = 1e8
#: Damping of the radial stop [N s/m], an estimate: it does not bounce.
DAMPING = 1e5


class Pocket(NamedTuple):
    """Stiffness, damping and oil film of the spars of a pocket."""

    half_gap: float  #: c/2 [m]
    stiffness: float  #: K of the roller on a spar [N/m^1.5]
    damping: float  #: D [s/m]; zero with a squeeze film
    film: float  #: 3√2 π η l R^1.5 [N s √m]; zero without film
    least_film: float  #: h_m [m]
    #: h_e, gap from which on pockets hold no oil [m]; infinite where flooded
    oil_gap: float = math.inf


#: A `Pocket` as compiled functions take it.
POCKET = np.dtype(
    [
        ("half_gap", "f8"),  # c/2 [m]
        ("stiffness", "f8"),  # K of the roller on a spar [N/m^1.5]
        ("damping", "f8"),  # D [s/m]; zero with a squeeze film
        ("film", "f8"),  # 3√2 π η l R^1.5 [N s √m]; zero without film
        ("least_film", "f8"),  # h_m [m]
        ("oil_gap", "f8"),  # h_e, gap from which on pockets hold no oil [m]; infinite where flooded
    ]
)


def squeeze_coefficient(viscosity: float, length: float, radius: float) -> float:
    """Coefficient 3√2 π η l R^1.5 of the squeeze film between a long cylinder and a plane [N s √m].

    Over h^1.5 it is the resistance to approach.

    Parameters
    ----------
    viscosity : float
        η of the oil [Pa s].
    length, radius : float
        l and R of the cylinder [m].

    Returns
    -------
    float

    Examples
    --------
    >>> round(squeeze_coefficient(0.54, 0.106, 0.035) / 1e-4**1.5)     # at 0.1 mm, N s/m
    4996
    """
    return 3.0 * math.sqrt(2.0) * math.pi * viscosity * length * radius**1.5


def prepare_pocket(cage: Cage, bearing: Bearing, lubricant: Lubricant, stiffness: float) -> Pocket:
    """Stiffness, damping and oil film of a pocket, from cage, bearing and oil.

    Parameters
    ----------
    cage : Cage
    bearing : Bearing
    lubricant : Lubricant
        Its viscosity is that of the squeeze film, its oil gap that of the pocket.
    stiffness : float
        K of the Hertz contact of roller and spar [N/m^1.5].

    Returns
    -------
    Pocket
    """
    dry = cage.impact == "dry"
    film = squeeze_coefficient(
        lubricant.viscosity, bearing.roller_length, geometry.roller_radius(bearing)
    )
    return Pocket(
        half_gap=0.5 * cage.gap,
        stiffness=stiffness,
        damping=cage.damping if dry else 0.0,
        film=0.0 if dry else film,
        least_film=_ROUGHNESS_FILMS * bearing.composite_roughness,
        oil_gap=lubricant.oil_gap,
    )


@jit_inline
def squeeze_resistance(pocket, film):
    """Resistance of the squeeze film to approach, and its derivative by the gap.

    Oil fills the gap as far as it is below h_e. With t = √(h_e/h − 1) the flooded film's resistance
    has the factor (2/π) [atan t + t/(1 + t²) − 2t/(1 + t²)²]: Reynolds' pressure
    6 η V R (1/h(x)² − 1/h_e²), V the speed of approach, over |x| < √(2Rh) t.

    Parameters
    ----------
    pocket : Pocket
    film : float
        Smallest gap h > 0 of the film [m].

    Returns
    -------
    resistance : float
        Force over speed of approach [N s/m].
    by_film : float
        Its derivative by h [N s/m²].

    Examples
    --------
    >>> wet, short = (Pocket(1e-4, 1e10, 0.0, 5e-3, 1e-6, filled) for filled in (math.inf, 1e-4))
    >>> [round(squeeze_resistance(one, 2e-5)[0] / squeeze_resistance(wet, 2e-5)[0], 4) for one in (wet, short)]
    [1.0, 0.8576]
    """
    if film >= pocket.oil_gap:
        return 0.0, 0.0
    resistance = pocket.film / (film * math.sqrt(film))
    by_film = -1.5 * resistance / film
    if pocket.oil_gap < FLOODED_GAP:
        over = pocket.oil_gap / film
        way = math.sqrt(over - 1.0)
        square = over * over
        filled = 2.0 / math.pi * (arctangent(way) + way / over - 2.0 * way / square)
        by_filling = 8.0 / math.pi * resistance * way / (square * film)
        by_film = by_film * filled - by_filling
        resistance *= filled
    return resistance, by_film


@jit_inline
def spar_push(pocket, gap, closing):
    """Push of one spar on its roller, and its derivatives.

    Parameters
    ----------
    pocket : Pocket
    gap : float
        g [m], negative where the bodies press on each other.
    closing : float
        −g' [m/s].

    Returns
    -------
    push : float
        Push, never below zero [N].
    by_gap : float
        Its derivative by the gap [N/m].
    by_closing : float
        Its derivative by the closing speed [N s/m].
    """
    push = 0.0
    by_gap = 0.0
    by_closing = 0.0
    if gap < 0.0:
        yielding = 1.0 + pocket.damping * closing
        if yielding > 0.0:
            root = math.sqrt(-gap)
            elastic = -pocket.stiffness * gap * root
            push = elastic * yielding
            by_gap = -1.5 * pocket.stiffness * root * yielding
            by_closing = elastic * pocket.damping
    # The film is thicker than the gap: without oil in that there is none to be squeezed.
    if closing > 0.0 and pocket.film > 0.0 and gap < pocket.oil_gap:
        root = math.sqrt(gap * gap + pocket.least_film * pocket.least_film)
        film = pocket.least_film + 0.5 * (gap + root)
        resistance, by_film = squeeze_resistance(pocket, film)
        push += resistance * closing
        by_closing += resistance
        by_gap += 0.5 * by_film * closing * (1.0 + gap / root)
    return push, by_gap, by_closing


@jit_inline
def pocket_force(pocket, offset, speed):
    """Push N of the pocket on its roller along the orbit, and its derivatives.

    Parameters
    ----------
    pocket : Pocket
    offset : float
        x [m], positive where the roller is ahead of the middle of its pocket.
    speed : float
        x' [m/s].

    Returns
    -------
    push : float
        N, positive along the orbit [N].
    by_offset : float
        ∂N/∂x [N/m].
    by_speed : float
        ∂N/∂x' [N s/m].

    Examples
    --------
    >>> dry = Pocket(half_gap=1e-4, stiffness=1e10, damping=50.0, film=0.0, least_film=1e-6)
    >>> push, _, _ = pocket_force(dry, 1.1e-4, 0.0)
    >>> round(push, 1), pocket_force(dry, 0.9e-4, 0.1)[0]
    (-316.2, 0.0)
    """
    front, front_by_gap, front_by_closing = spar_push(pocket, pocket.half_gap - offset, speed)
    rear, rear_by_gap, rear_by_closing = spar_push(pocket, pocket.half_gap + offset, -speed)
    return rear - front, rear_by_gap + front_by_gap, -(rear_by_closing + front_by_closing)


def elastic_energy(pocket: Pocket, offset: np.ndarray) -> np.ndarray:
    """Elastic energy ⅖ K δ^2.5 of the spars [J] at pocket offsets [m] of any shape."""
    depth = np.maximum(np.abs(offset) - pocket.half_gap, 0.0)
    return 0.4 * pocket.stiffness * depth**2.5


@jit_inline
def stop_force(play, a, b, p, q):
    """Push of the radial stop on a cage that has left the bearing's axis.

    Parameters
    ----------
    play : float
        Distance from the axis that is free [m].
    a, b : float
        Displacements of the cage along X0 and Y0 [m].
    p, q : float
        Speeds of the cage along X0 and Y0 [m/s].

    Returns
    -------
    push : float
        Towards the axis [N], never below zero.
    n_x, n_y : float
        Direction in which the cage has left it.
    by_distance, by_speed : float
        Derivatives of the push by the distance [N/m] and by its rate [N s/m].

    Examples
    --------
    >>> push, n_x, n_y, _, _ = stop_force(1e-4, 0.0, -1.05e-4, 0.0, 0.0)
    >>> round(push), n_y
    (500, -1.0)
    """
    distance = math.sqrt(a * a + b * b)
    depth = distance - play
    if depth <= 0.0 or distance == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    n_x = a / distance
    n_y = b / distance
    push = STIFFNESS * depth + DAMPING * (p * n_x + q * n_y)
    if push <= 0.0:
        return 0.0, n_x, n_y, 0.0, 0.0
    return push, n_x, n_y, STIFFNESS, DAMPING


def stop_energy(play: float, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Elastic energy of the radial stop [J] for displacements (a, b) of cages [m]."""
    depth = np.maximum(np.hypot(a, b) - play, 0.0)
    return 0.5 * STIFFNESS * depth**2
