"""Wear by Archard's law where asperities slide, and how a worn profile spreads the pressure."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from macroslip.arrays import FloatArray

REFERENCE = "Archard, J. Appl. Phys. 24 (1953) 981, doi:10.1063/1.1721448"
#: Wear of steel in a lubricated contact per work of asperities' pressure times slip [m²/N]: the
#: range over which rigs scatter.
COEFFICIENTS = (1e-18, 1e-17, 1e-16)
#: Depths to which times are computed, and depth after which the pressure is computed anew [m].
DEPTHS = (1e-6, 1e-5, 1e-4)
STEP = 1e-6
#: Steps after which bodies that hardly wear are given up.
_MOST_STEPS = 2000


def worn_volume(coefficient: float, asperity_energy: ArrayLike, friction: float) -> FloatArray:
    """Volume k E/µ_b [m³] that wears where asperities dissipate E; with E per area the depth [m].

    Asperities dissipate µ_b p |v| of the area that they carry, so E/µ_b is their pressure times
    slip over time and area. Where slip is too slow for them to slide, they dissipate and wear less.
    k [m²/N] is the dimensionless coefficient over hardness, µ_b > 0 the boundary friction [-], and
    E in J or J/m².

    Archard, J. Appl. Phys. 24 (1953) 981, doi:10.1063/1.1721448. Each of the two surfaces wears by
    k.

    Examples
    --------
    A pass with p v of 1.15e4 J/m² fully on asperities, 5.21 times a second for a year of 365 days,
    at k = 1e-17 m²/N:

    >>> round(float(worn_volume(1e-17, 0.1 * 1.15e4 * 5.21 * 3.1536e7, 0.1)) * 1e6, 1)
    18.9
    """
    return coefficient * np.asarray(asperity_energy, float) / friction


def slice_loads(gap: ArrayLike, load: float, stiffness: float, width: float) -> FloatArray:
    """Load per length of slices that press a roller like springs, w = c (δ − gap) ≥ 0 [N/m].

    Parameters
    ----------
    gap : array_like, shape (n,)
        Gap of each slice where the roller just touches [m]: its contour and what has worn.
    load : float
        Sum of the slices' loads [N], not negative, from which the approach δ follows.
    stiffness : float
        c [Pa].
    width : float
        Width of a slice [m].

    Returns
    -------
    ndarray, shape (n,)

    Notes
    -----
    Neighbours do not hold each other, as they do in a half-space: a groove narrower than the
    contact is long loses its load a little too fast. With c of `hertz_slices` the unworn contour
    carries Hertz' load per length.

    Examples
    --------
    >>> slice_loads([0.0, 1e-6, 5e-6], 30.0, 1e10, 1e-3).tolist()
    [20000.0, 10000.0, 0.0]
    """
    gap = np.asarray(gap, float)
    rising = np.sort(gap)
    count = np.arange(1, gap.size + 1)
    # The approach if only the slices up to each gap were pressed.
    of_load = load / (stiffness * width)
    approach = (of_load + np.cumsum(rising)) / count
    pressed = np.flatnonzero(approach > rising)
    last = pressed[-1] if pressed.size else 0
    penetration = np.maximum(approach[last] - gap, 0.0)
    return stiffness * penetration


def hertz_slices(load: float, half_length: float, curvature: float) -> float:
    """Stiffness c [Pa] with which slices carry w = 3Q/(4a) (1 − ζ²/a²) on a contour κ ζ²/2.

    Of Q [N], the semi-axis a [m] and the relative curvature κ [1/m], both across rolling.

    Examples
    --------
    >>> place = np.linspace(-0.0999, 0.0999, 1000) * 0.3
    >>> c = hertz_slices(35e3, 0.029, 0.05)
    >>> float(round(slice_loads(0.025 * place**2, 35e3, c, place[1] - place[0]).max() / (0.75 * 35e3 / 0.029), 4))
    1.0
    """
    return 1.5 * load / (half_length**3 * curvature)


class Pressed(NamedTuple):
    """Load, contour and slip of a raceway contact that wears."""

    load: float  #: Q [N]
    contour: FloatArray  #: Gap of each slice [m]
    stiffness: float  #: c of the slices [Pa]
    slip: FloatArray  #: |v| of each slice [m/s]
    ring: float  #: Passes per way that a place of the ring feels [1/m]
    roller: float  #: The same of a place of the roller


class Worn(NamedTuple):
    """Depth of wear over sliding work."""

    work: FloatArray  #: k t [m²/N s], shape (m,): time is this over k
    depth: FloatArray  #: Of inner raceway, outer raceway and roller by slice [m], shape (m, 3, n)

    def work_at(self, depth: float) -> FloatArray:
        """K t [m²/N s] after which the deepest slice of each body has this depth [m].

        Infinite where it is not reached while the deepest of all wears by 2 mm.
        """
        deepest = self.depth.max(axis=-1)
        works = [np.interp(depth, body, self.work, right=math.inf) for body in deepest.T]
        return np.array(works)

    def depth_at(self, work: float) -> FloatArray:
        """Depth [m] of each body by slice at a k t; NaN beyond the time that was computed."""
        slices = self.depth.reshape(self.work.size, -1).T
        depths = [np.interp(work, self.work, depth, right=math.nan) for depth in slices]
        return np.reshape(depths, self.depth.shape[1:])


def grow(contacts: tuple[Pressed, Pressed], width: float, *, deepest: float = DEPTHS[-1]) -> Worn:
    """Wear of both raceways and the roller, with the pressure computed anew after every `STEP`.

    dh/dt = k w |v| × passes per way, at a constant roller load and slip: where the profile moves
    the lines of pure rolling, it does not follow. The roller wears in both contacts, and its worn
    profile counts in both.

    Parameters
    ----------
    contacts : tuple of Pressed
        Inner and outer raceway contact.
    width : float
        Width of a slice [m].
    deepest : float, optional
        Depth at which every body that wears is done [m].

    Returns
    -------
    Worn

    References
    ----------
    Archard, J. Appl. Phys. 24 (1953) 981, doi:10.1063/1.1721448.

    Examples
    --------
    >>> flat = Pressed(1e4, np.zeros(10), 1e10, np.full(10, 1e-3), 5.0, 2.0)
    >>> worn = grow((flat, flat), 0.01)
    >>> [float(f"{one:.4g}") for one in worn.work_at(1e-6)]
    [2e-09, 2e-09, 2.5e-09]
    """
    depth = np.zeros((3, contacts[0].contour.size))
    work = [0.0]
    depths = [depth]
    ring_wears = [bool(contact.ring * contact.load) for contact in contacts]
    roller_wears = any(contact.roller * contact.load for contact in contacts)
    wears = np.append(np.array(ring_wears), roller_wears)
    while wears.any() and len(work) < _MOST_STEPS:
        deepest_now = depth.max(axis=-1)[wears]
        if not (deepest_now < deepest).any():
            break
        rate = np.zeros_like(depth)
        for i, contact in enumerate(contacts):
            if contact.load > 0.0:
                gap = contact.contour + depth[i] + depth[2]
                pressed = slice_loads(gap, contact.load, contact.stiffness, width)
                power = pressed * contact.slip
                rate[i] += contact.ring * power
                rate[2] += contact.roller * power
        fastest = rate.max()
        if fastest <= 0.0:
            break
        step = STEP / fastest
        depth = depth + rate * step
        work.append(work[-1] + step)
        depths.append(depth)
    return Worn(np.array(work), np.array(depths))
