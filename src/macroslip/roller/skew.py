"""Equilibrium of a skewed roller on an imposed orbit, and its skew moment.

The equilibrium fixes its slip, tilt and shift.

At a given skew ψ three conditions fix the slip Δu, the tilt θ and the shift δ (inner raceway i,
outer raceway o, σ = κ_z times the contact's place on the raceway is its slope there, F the axial
tractions):

* spin: the moment of the tractions about the roller's axis is that of rolling resistance,
* axial force: F_i + F_o = Q (σ_i + σ_o),
* couple about x: Σ k [r (F − Q σ) + Q (ζ + k r θ)] = 0.

What is left is the net moment about the contact normal. It turns the roller within tenths of a
second, an orbit being seconds, until it vanishes (equilibrium) or a stop carries it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.bearing import geometry
from macroslip.contact.rolling import light_contact
from macroslip.contact.skewed import Resultants, SkewedContact, resultants, skewed_contact

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.contact.laws import PreparedLaws
    from macroslip.contact.skewed import Shear

#: Longest step of the slip over the speed of the rings, and what may be left of the spin moment
#: over radius, and change of the axial tractions, over the load.
_LONGEST = 0.01
_LEFT = 1e-7
_STILL = 1e-6
#: Iterations: at most, and from which on changes of the axial tractions are halved, for contacts
#: that would swing.
_ITERATIONS = 80
#: Iteration from which on a step stays between the slips at which the spin moment last had either
#: sign: where its slope falls to both sides of the zero, Newton's steps may swing for ever.
_BRACKETED = 40
_DAMPED = 20
#: Difference of slip over the speed of the rings, for the slope of the spin moment.
_STEP = 1e-6
#: Skew up to which states are computed [rad]: an unguided roller beyond it is lost.
LARGEST_SKEW = 0.06


class Equilibrium(NamedTuple):
    """A roller in equilibrium but for its skew moment; arrays of one shape."""

    slip: np.ndarray  #: Δu at the middle of the roller [m/s]; NaN where none was found
    tractions: np.ndarray  #: Shape (2, ...). Tractions of the raceways along z' [N]
    tilt: np.ndarray  #: θ [rad], positive about +x
    shift: np.ndarray  #: δ of the roller's middle along z' [m]
    #: Net moment about +y' [N m], tractions and pressure of both raceways; positive turns the
    #: roller to positive skew.
    moment: np.ndarray
    moments: np.ndarray  #: Shape (..., 2). The same by raceway
    power: np.ndarray  #: Shape (..., 2). Frictional power of the raceways [W]
    asperity_power: np.ndarray  #: Shape (..., 2). Part of that power by asperities [W]
    #: Axial force on the inner ring along z' [N], of friction and of the turned normal force
    axial: np.ndarray
    #: Force of the raceways on the roller along +x [N], of tractions and rolling resistance; a spar
    #: bears it, with weight and drag.
    push: np.ndarray
    unbalanced: np.ndarray  #: Unbalanced spin moment over radius and load [-]


class Pair(NamedTuple):
    """Both raceway contacts of a roller that may be skewed."""

    inner: SkewedContact  #: With the inner raceway
    outer: SkewedContact  #: With the outer raceway


def raceways(
    laws: PreparedLaws, bearing: Bearing, axial_sign: int, shear: Shear | None = None
) -> Pair:
    """Raceway contacts of a roller that may be skewed.

    Parameters
    ----------
    laws : PreparedLaws
        Laws of the roller's contacts, with a sheared film.
    bearing : Bearing
        Its dimensions.
    axial_sign : int
        +1 for the downwind and −1 for the upwind row.
    shear : Shear, optional
        Stress in place of that of the sheared film.

    Returns
    -------
    Pair
        Contacts with the inner and the outer raceway.
    """
    inner, outer = (
        skewed_contact(contact, bearing, axial_sign, shear) for contact in (laws.inner, laws.outer)
    )
    return Pair(inner, outer)


def _resistance_on(laws: PreparedLaws, load, speed) -> tuple[np.ndarray, np.ndarray]:
    """Rolling resistance of both raceways [N]: in the spin equation, and along +x.

    In the spin equation it acts against the spin's own sign.
    """
    total = np.zeros(np.broadcast(load, speed).shape)
    push = np.zeros(total.shape)
    for contact, sign in ((laws.inner, 1.0), (laws.outer, -1.0)):
        if contact.rolling is not None:
            _, resistance, _ = light_contact(contact.rolling, load, np.abs(speed))
            shear = -np.copysign(resistance, speed)
            # Of pressure's inclination and shear on the roller, by shear.
            along = 1.0 - 2.0 * contact.rolling.share_1
            total = total + shear
            push = push + sign * along * shear
    return np.asarray(total), np.asarray(push)


def placed(pair: Pair, load, axial) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axial shift and tilt of a roller in balance with axial tractions.

    Parameters
    ----------
    load : ndarray
        Q [N].
    axial : ndarray, shape (2, ...)
        F of inner and outer raceway along z' [N].

    Returns
    -------
    tilt, shift : ndarray
        θ [rad] and δ [m].
    middles : ndarray, shape (2, ...)
        ζ_c [m].
    """
    r = pair.inner.roller_radius
    sides = np.array([contact.side for contact in pair])
    along = np.array([contact.along for contact in pair])
    lateral = np.array([contact.lateral for contact in pair])
    # By θ and δ: ζ_c, the place ζ + δ + k r θ on the raceway, and the arm of the normal force.
    by_tilt = sides * (along * r - 1.0)
    middle = np.stack([by_tilt, along], axis=1) / lateral[:, None]
    arm = middle + np.stack([sides * r, np.zeros(2)], axis=1)
    on_raceway = arm + np.array([0.0, 1.0])
    slope = along[:, None] * on_raceway
    by_force = slope.sum(axis=0)
    by_couple = sides @ (r * slope - arm)
    conditions = np.stack([by_force, by_couple])
    couple = r * np.tensordot(sides, axial, 1)
    right = np.stack([axial.sum(axis=0), couple]) / load
    lies = np.tensordot(np.linalg.inv(conditions), right, 1)
    return lies[0], lies[1], np.tensordot(middle, lies, 1)


class _States(NamedTuple):
    """Loads, speeds and skews of rollers, arrays of shape (n,)."""

    load: np.ndarray  #: Q [N]
    ring_speed: np.ndarray  #: u2 [m/s]
    skew: np.ndarray  #: ψ [rad]

    def at(self, index: np.ndarray) -> _States:
        """The states of these numbers."""
        return _States(*(values[index] for values in self))


#: What is known of a state beside its slip and its axial tractions: fields of `Equilibrium`.
_KNOWN = np.dtype(
    [
        ("tilt", "f8"),  # [rad]
        ("shift", "f8"),  # [m]
        ("moments", "f8", (2,)),  # [N m]
        ("power", "f8", (2,)),  # [W]
        ("asperity_power", "f8", (2,)),  # [W]
        ("axial", "f8"),  # [N]
        ("push", "f8"),  # [N]
        ("unbalanced", "f8"),  # [-]
    ]
)


class _SlipSearch:
    """Newton's method for the slips at which spin moments vanish, one for each state.

    Behind a zero a step goes at most half of the way back: where the slope falls to both sides,
    whole steps would swing for ever. From iteration `_BRACKETED` on it stays between the slips at
    which the moment last had either sign.
    """

    def __init__(self, slip: np.ndarray, longest: np.ndarray):
        self.slip = slip  #: Shape (n,) [m/s]
        self._longest = longest  # steps [m/s]
        self._turning = np.zeros(slip.size)  # the last moments over radius [N]
        self._taken = np.zeros(slip.size)  # the last steps [m/s]
        self._below = np.full(slip.size, -np.inf)  # slips at which moments last were < 0 [m/s]
        self._above = np.full(slip.size, np.inf)  # the same, > 0 [m/s]

    def advance(
        self,
        going: np.ndarray,
        turning: np.ndarray,
        slope: np.ndarray,
        iteration: int,
    ) -> None:
        """Take a step of Newton's method.

        Parameters
        ----------
        going : ndarray of int
            Numbers of the states whose slips change.
        turning, slope : ndarray
            Their moments over radius [N], and the slopes of these by slip [N s/m].
        iteration : int
            Number of the step.
        """
        here = self.slip[going]
        longest = self._longest[going]
        back = turning * self._turning[going] < 0.0
        half_way = 0.5 * np.abs(self._taken[going])
        most = np.where(back, half_way, longest)
        least_slope = np.abs(turning) / longest
        change = turning / np.maximum(slope, least_slope)
        change = np.clip(change, -most, most)
        following = here - change
        if iteration >= _BRACKETED:
            following = self._bracketed(going, turning, following)
        self._turning[going] = turning
        self._taken[going] = here - following
        self.slip[going] = following

    def _bracketed(
        self, going: np.ndarray, turning: np.ndarray, following: np.ndarray
    ) -> np.ndarray:
        """The following slips, or the middles of their brackets where they lie outside."""
        here = self.slip[going]
        self._below[going] = np.where(turning < 0.0, here, self._below[going])
        self._above[going] = np.where(turning > 0.0, here, self._above[going])
        below = self._below[going]
        above = self._above[going]
        outside = (following <= below) | (following >= above)
        width = above - below
        middle = below + 0.5 * width
        return np.where(outside & np.isfinite(width), middle, following)


def _contacts_at(pair: Pair, states: _States, slip, tilt, middles) -> list[Resultants]:
    """Forces of the raceways on a roller."""
    return [
        resultants(contact, states.load, states.ring_speed, slip, states.skew, middle, tilt)
        for contact, middle in zip(pair, middles, strict=True)
    ]


def _slope_of_turning(
    pair: Pair, states: _States, slip, tilt, middles, turning: np.ndarray
) -> np.ndarray:
    """Slope by slip [N s/m] of the spin forces `turning` of both raceways on a roller [N]."""
    step = _STEP * np.abs(states.ring_speed)
    inner, outer = _contacts_at(pair, states, slip + step, tilt, middles)
    return (inner.turning + outer.turning - turning) / step


def _known_at(both: list[Resultants], tilt: np.ndarray, shift: np.ndarray) -> np.ndarray:
    """Forces and moments of both raceways at a tilt [rad] and a shift [m]."""
    known = np.zeros(tilt.size, _KNOWN)
    known["tilt"] = tilt
    known["shift"] = shift
    for i, contact in enumerate(both):
        known["moments"][:, i] = contact.moment + contact.pressure_moment
        known["power"][:, i] = contact.power
        known["asperity_power"][:, i] = contact.asperity_power
    return known


def _fields(known: np.ndarray, shape: tuple[int, ...]) -> dict[str, np.ndarray]:
    """Fields of records, by name, of the shape of the states."""
    return {
        name: known[name].reshape((*shape, *known[name].shape[1:]))[()]
        for name in known.dtype.names or ()
    }


def equilibrium(
    pair: Pair, laws: PreparedLaws, load, ring_speed, skew, start: Equilibrium | None = None
) -> Equilibrium:
    """Slip, tilt and axial shift of a roller in equilibrium at a given skew.

    Parameters
    ----------
    pair : Pair
        Both raceway contacts.
    laws : PreparedLaws
        For rolling resistance.
    load : array_like
        Q > 0 [N], the same at both raceways.
    ring_speed : array_like
        u2 ≠ 0 [m/s], the same at both.
    skew : array_like
        ψ [rad].
    start : Equilibrium, optional
        States nearby, such as those of a smaller skew, of the same shape.

    Returns
    -------
    Equilibrium
        Arrays of the shape to which load, speed and skew broadcast.
    """
    shape = np.broadcast_shapes(*map(np.shape, (load, ring_speed, skew)))
    states = _States(
        *(
            np.broadcast_to(values, shape).astype(float).ravel()
            for values in (load, ring_speed, skew)
        )
    )
    resistance, push = _resistance_on(laws, states.load, states.ring_speed)
    slip = np.zeros(states.load.size)
    axial = np.zeros((2, states.load.size))
    if start is not None:
        slip = np.nan_to_num(start.slip).reshape(-1).copy()
        axial = np.nan_to_num(start.tractions).reshape(2, -1)
    search = _SlipSearch(slip, _LONGEST * np.abs(states.ring_speed))
    known = np.zeros(states.load.size, _KNOWN)
    going = np.arange(states.load.size)
    for iteration in range(_ITERATIONS):
        here = states.at(going)
        tilt, shift, middles = placed(pair, here.load, axial[:, going])
        inner, outer = _contacts_at(pair, here, search.slip[going], tilt, middles)
        friction = inner.turning + outer.turning
        turning = friction + resistance[going]
        tractions = np.stack([inner.axial, outer.axial])
        change = np.abs(tractions - axial[:, going]).max(axis=0)
        if iteration >= _DAMPED:
            tractions = 0.5 * (tractions + axial[:, going])
        axial[:, going] = tractions
        now = _known_at([inner, outer], tilt, shift)
        # By the place of the contact on the inner raceway.
        now["axial"] = middles[0] + shift - pair.inner.roller_radius * tilt
        now["axial"] *= here.load * pair.inner.along
        now["axial"] -= inner.axial
        now["push"] = push[going] + inner.pull - outer.pull
        now["unbalanced"] = np.abs(turning) / here.load
        known[going] = now
        moving = (now["unbalanced"] >= _LEFT) | (change >= _STILL * here.load)
        going = going[moving]
        if not going.size:
            break
        slope = _slope_of_turning(
            pair,
            here.at(moving),
            search.slip[going],
            tilt[moving],
            middles[:, moving],
            friction[moving],
        )
        search.advance(going, turning[moving], slope, iteration)
    slip[going] = np.nan
    axial[:, going] = np.nan
    for name in _KNOWN.names or ():
        known[name][going] = np.nan
    return Equilibrium(
        slip=slip.reshape(shape)[()],
        tractions=axial.reshape(2, *shape),
        moment=known["moments"].sum(axis=-1).reshape(shape)[()],
        **_fields(known, shape),
    )


class SkewStop(NamedTuple):
    """Skew stop of a pocket, by the shape of its spars."""

    largest: float  #: Largest skew [rad]
    arm: float  #: Moment of the two spars over the force of either, with the roller at its stop [m]
    #: Moment by which one spar straightens the roller, over its force and the skew [m/rad], until
    #: it touches the roller's end.
    effective_radius: float


def skew_stop(bearing: Bearing, guidance: str, gap: float, play: float | None = None) -> SkewStop:
    """Skew stop of a pocket whose spars follow the outer raceway's contour or are straight.

    A roller that turns by ψ in a pocket of curvature κ slides along it at its radius r, so that its
    contour comes nearer by ψ ζ (1 − κ r) at the station ζ. It touches first at ζ = ψ (1 − κ r)/C,
    with C = 1/R_roller − κ, or at its end. A conforming pocket of the base bearing therefore leaves
    9 % more skew than one that is taken as flat over the radius.

    Parameters
    ----------
    guidance : "conforming-pocket", "straight-bars", "guide-ring" or "none"
        A guide ring stands beside straight spars; without guidance a roller turns up to
        `LARGEST_SKEW`.
    gap : float
        Free way of the roller between its two spars [m], ≥ 0.
    play : float, optional
        Largest skew in place of what follows from the gap [rad]; a guide ring needs it.

    Examples
    --------
    >>> from macroslip import Bearing
    >>> base = Bearing.read("skf-240-600-bc")
    >>> [round(1e3 * skew_stop(base, one, 0.5e-3).largest, 2) for one in ("conforming-pocket", "straight-bars")]
    [6.58, 36.68]
    """
    if guidance == "none":
        return SkewStop(LARGEST_SKEW if play is None else play, np.inf, 0.0)
    r = geometry.roller_radius(bearing)
    half = 0.5 * bearing.roller_length
    bend = 1.0 / bearing.outer_raceway_radius if guidance == "conforming-pocket" else 0.0
    curvature = 1.0 / geometry.roller_contour_radius(bearing) - bend
    nearer = 1.0 - bend * r
    effective = nearer * (nearer / curvature - r)
    arm_of_ends = 2.0 * half * nearer
    if play is not None:
        return SkewStop(play, arm_of_ends, effective)
    # Without play spars would hold a roller with no arm; rough surfaces leave it some.
    gap = max(gap, bearing.composite_roughness)
    inside = float(np.sqrt(gap / effective))
    if inside * nearer / curvature < half:
        return SkewStop(inside, 2.0 * effective * inside, effective)
    # Way and drop of the contour at the roller's end.
    way = 0.5 * gap + 0.5 * curvature * half**2
    return SkewStop(way / (half * nearer), arm_of_ends, effective)
