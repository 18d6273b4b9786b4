"""Traction of a curved and tilted contact, summed over its chords.

It gives values for tables, and power by station for maps.

With the station ζ along the roller's axis and the drop of the common contour h = ζ²/(2 R_d) slip is

    v(ζ) = Δu + κ h − s ζ,

where κ = ω_rel − (Ω_in − Ω) cos α and s = −(Ω_in − Ω) sin α at the inner raceway, κ = ω_rel + Ω cos
α and s = −Ω sin α at the outer one of the downwind row, with ζ along z'; in the upwind row sin α is
negative. Where v passes through zero the roller rolls purely. A film that grips changes its stress
from one limit to the other there within a small part of the contact's length, the smaller the
higher the load, so the quadrature is divided at these lines and graded towards them. Stress along a
chord is that of the oil's table (`macroslip.contact.traction`).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from macroslip.compiled import jit, jit_inline
from macroslip.contact.asperities import asperity_patch
from macroslip.contact.chords import (
    FIRST_SLICE,
    NO_SLIP,
    SLICES,
    chord_stresses,
    film_node,
    write_film,
)
from macroslip.contact.traction import ChordTable, Fluid, chord_stress

if TYPE_CHECKING:
    from macroslip.contact.laws import PreparedContact

_asperity_patch = jit(asperity_patch)
#: Part of the half length below which a piece of the contact is left out.
_SHORTEST = 1e-12


class Patch(NamedTuple):
    """A contact ellipse over which slip varies, as a compiled function takes it."""

    microslip: bool  #: Whether slip varies; otherwise the middle's serves everywhere
    contour_radius: float  #: R_d [m]
    roller_radius: float  #: r [m]
    half_length: float  #: Half the roller's length [m]
    curvature_ratio: float  #: κ/u2 in pure rolling [1/m]
    spin_ratio: float  #: s/u2 in pure rolling [1/m]
    across: float  #: Semi-axis across rolling per Q^(1/3) [m/N^(1/3)]
    along: float  #: Semi-axis along rolling per Q^(1/3) [m/N^(1/3)]
    pressure: float  #: p0 per Q^(1/3) [Pa/N^(1/3)]
    boundary_friction: float  #: µ_b [-]
    full_slip: float  #: Slip from which on asperities slide [m/s]


def patch_of(contact: PreparedContact) -> Patch:
    """Geometry of a contact, its roller's axis tilted to the positive side."""
    shape = contact.shape
    hertz = contact.interface.hertz
    return Patch(
        bool(shape.microslip), shape.contour_radius, shape.roller_radius, shape.half_length, shape.curvature_ratio,
        abs(shape.spin_ratio), hertz.semi_axis_across, hertz.semi_axis_along, hertz.pressure,
        contact.boundary_friction, contact.full_slip,
    )  # fmt: skip


def graded_rule(nodes: int) -> tuple[np.ndarray, np.ndarray]:
    """Quadrature on [0, 1], graded towards both ends: nodes m and weights.

    Gauss-Legendre in t with m = 3t² − 2t³. At a line of pure rolling this resolves how fast stress
    turns there; at the end of an ellipse it makes the root of the chord's length smooth.
    """
    t, weights = np.polynomial.legendre.leggauss(nodes)
    t = 0.5 * (t + 1.0)
    weights = 0.5 * weights
    return t * t * (3.0 - 2.0 * t), weights * 6.0 * t * (1.0 - t)


_NODES, _WEIGHTS = graded_rule(10)
_FINE_NODES, _FINE_WEIGHTS = graded_rule(20)


@jit_inline
def rolling_lines(bend, spin, slip, end):
    """Stations of pure rolling, at which v = slip + bend ζ² − spin ζ vanishes.

    Where v has no zero both are its extremum, so that they change continuously with the state.

    Parameters
    ----------
    bend : float
        Curvature of the slip along the roller [1/(m s)].
    spin : float
        Its slope at the middle, with the opposite sign [1/s].
    slip : float
        Δu in the middle [m/s].
    end : float
        Half the length of the contact [m], > 0.

    Returns
    -------
    first, second : float
        Stations ζ [m] in rising order, kept within ± `end`.
    """
    root = spin * spin - 4.0 * bend * slip
    if root <= 0.0:
        first = second = 0.5 * spin / bend if bend != 0.0 else end
    else:
        larger = 0.5 * (spin + math.copysign(math.sqrt(root), spin))
        first = larger / bend if bend != 0.0 else math.copysign(math.inf, larger)
        second = slip / larger
    low, high = min(first, second), max(first, second)
    return min(max(low, -end), end), min(max(high, -end), end)


@jit_inline
def _patch_traction(patch, chords, load, film, share, ring_speed, slip, slices):
    """Traction of a raceway contact in one state, as `patch_tractions` gives it."""
    root = load ** (1.0 / 3.0)
    across = patch.across * root
    pressure = patch.pressure * root
    end = min(1.0, patch.half_length / across)
    bend = 0.0
    spin = 0.0
    if patch.microslip:
        bend = (ring_speed * patch.curvature_ratio - slip / patch.roller_radius) / (
            2.0 * patch.contour_radius
        )
        spin = ring_speed * patch.spin_ratio
    first, second = rolling_lines(bend, spin, slip, across * end)
    edges = (-end, first / across, second / across, end)
    area = 2.0 * across * patch.along * root * (1.0 - share)
    pull = 0.0
    lag = 0.0
    skew = 0.0
    per_drop = 0.5 / (patch.contour_radius * patch.roller_radius)
    behind = FIRST_SLICE
    for segment in range(3):
        length = edges[segment + 1] - edges[segment]
        if length < _SHORTEST:
            continue
        for k in range(_NODES.size):
            x = edges[segment] + length * _NODES[k]
            station = across * x
            local = slip + station * (bend * station - spin)
            cosine = math.sqrt(1.0 - x * x)
            slices.station[behind] = station
            slices.area[behind] = area * _WEIGHTS[k] * length * cosine
            slices.pressure[behind] = pressure * cosine
            slices.slip[behind] = local
            slices.speed[behind] = abs(local)
            behind += 1
    write_film(film_node(chords, film), slices, FIRST_SLICE, behind)
    chord_stresses(chords, slices, behind)
    for k in range(FIRST_SLICE, behind):
        station = slices.station[k]
        part = math.copysign(slices.area[k] * slices.stress[k], slices.slip[k])
        pull += part
        lag += part * station * station * per_drop
        skew += part * station
    rough = 0.0
    if share > 0.0 and patch.boundary_friction > 0.0:
        scale = 0.75 * patch.boundary_friction * share * load / across
        more, second_moment, more_skew, rough = _asperity_patch(
            scale, patch.full_slip, across, across * end, slip, bend, spin
        )
        pull = pull + more
        lag = lag + second_moment * per_drop
        skew = skew + more_skew
    return pull, lag, skew, rough


@jit
def _integrate(patch, chords, states, slices, tractions):
    """Write what `_patch_traction` gives in many states, its numbers over (state, 4).

    States are load, film, share of asperities, ring speed and slip, over (5, state); slices are an
    array of one record of `macroslip.contact.chords.SLICES`.
    """
    for n in range(states.shape[1]):
        pull, lag, skew, rough = _patch_traction(
            patch,
            chords,
            states[0, n],
            states[1, n],
            states[2, n],
            states[3, n],
            states[4, n],
            slices[0],
        )
        tractions[n, 0] = pull
        tractions[n, 1] = lag
        tractions[n, 2] = skew
        tractions[n, 3] = rough


def patch_tractions(
    patch: Patch, chords: ChordTable, load, film, share, ring_speed, slip
) -> np.ndarray:
    """Traction of a raceway contact, integrated over its ellipse.

    The ellipse ends at the roller's ends; what Hertz's pressure would carry beyond is left out.

    Parameters
    ----------
    patch : Patch
        Geometry of the contact and friction of its asperities.
    chords : ChordTable
        Table of the oil.
    load : array_like
        Q [N], > 0.
    film : array_like
        h [m], > 0, the same all over the ellipse.
    share : array_like
        Share of the load that asperities carry [-], 0 to 1. Film and asperities each have their
        share of the area at the full Hertz pressure.
    ring_speed, slip : array_like
        u2 and Δu in the middle of the contact [m/s].

    Returns
    -------
    ndarray, shape (..., 4)
        Pull [N], lag [N], skew moment [N m] and power of asperities [W], of the shape to which the
        arguments broadcast.
    """
    states = np.array(np.broadcast_arrays(load, film, share, ring_speed, slip), dtype=float)
    shape = states.shape[1:]
    tractions = np.zeros((math.prod(shape), 4))
    _integrate(patch, chords, states.reshape(5, -1), np.zeros(1, SLICES), tractions)
    return tractions.reshape(*shape, 4)


def patch_power(patch: Patch, chords: ChordTable, load, film, ring_speed, slip):
    """Frictional power of a film, ∫τ v dA, by the rule of `patch_tractions`.

    Parameters
    ----------
    patch : Patch
        Geometry of the contact.
    chords : ChordTable
        Table of the oil.
    load : array_like
        Q [N], > 0.
    film : array_like
        h [m], > 0.
    ring_speed, slip : array_like
        u2 and Δu in the middle of the contact [m/s].

    Returns
    -------
    ndarray or float
        Power [W].
    """
    tractions = patch_tractions(patch, chords, load, film, 0.0, ring_speed, slip)
    pull, lag, skew, _ = np.moveaxis(tractions, -1, 0)
    return _power(patch, pull, lag, skew, ring_speed, slip)


def _power(patch: Patch, pull, lag, skew, ring_speed, slip):
    curvature = patch.curvature_ratio * patch.roller_radius
    return slip * (pull - lag) + ring_speed * (curvature * lag - patch.spin_ratio * skew)


def fine_power(patch: Patch, fluid: Fluid, load, film, ring_speed, slip):
    """Frictional power of a film by a finer rule than that of `patch_power`.

    The stress of every chord is found by quadrature in place of the oil's table.

    Parameters
    ----------
    patch : Patch
        Geometry of the contact.
    fluid : Fluid
        The sheared film.
    load : array_like
        Q [N], > 0.
    film : array_like
        h [m], > 0.
    ring_speed, slip : array_like
        u2 and Δu in the middle of the contact [m/s].

    Returns
    -------
    ndarray
        Power [W].
    """
    load, film, ring_speed, slip = np.broadcast_arrays(load, film, ring_speed, slip)
    root = load ** (1.0 / 3.0)
    across = patch.across * root
    end = np.minimum(1.0, patch.half_length / across)
    bend = (ring_speed * patch.curvature_ratio - slip / patch.roller_radius) / (
        2.0 * patch.contour_radius
    )
    spin = ring_speed * patch.spin_ratio
    lines = np.array(
        [
            rolling_lines(*state)
            for state in zip(bend.flat, spin.flat, slip.flat, (across * end).flat, strict=True)
        ]
    ).reshape(*load.shape, 2)
    edges = np.concatenate([-end[..., None], lines / across[..., None], end[..., None]], axis=-1)
    lengths = np.diff(edges)
    # Quadrature nodes are the last axis.
    nodes = (*load.shape, 3 * _FINE_NODES.size)
    relative = (edges[..., :-1, None] + lengths[..., None] * _FINE_NODES).reshape(nodes)
    weight = (lengths[..., None] * _FINE_WEIGHTS).reshape(nodes)
    station = across[..., None] * relative
    cosine = np.sqrt(1.0 - relative**2)
    local = slip[..., None] + station * (bend[..., None] * station - spin[..., None])
    stress = chord_stress(
        fluid,
        patch.pressure * root[..., None] * np.maximum(cosine, 1e-9),
        film[..., None],
        np.maximum(np.abs(local), NO_SLIP),
    )
    area = 2.0 * across * patch.along * root
    part = area[..., None] * weight * cosine * np.copysign(stress, local)
    lag = part * station**2 * 0.5 / (patch.contour_radius * patch.roller_radius)
    sums = part.sum(axis=-1), lag.sum(axis=-1), (part * station).sum(axis=-1)
    return _power(patch, *sums, ring_speed, slip)
