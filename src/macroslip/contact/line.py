"""Line contact of a roller in strips: approach and load per length, profile, and half-width.

A roller that touches a raceway along a line is cut into strips across its axis, each of which takes
a load per length q [N/m] by its own approach δ [m]. A half-space has no such law for a line, since
its displacement depends on how far away the solid is held; two laws are offered, which differ by up
to a fifth. Strips do not press each other down, so that edges have no peak of pressure beyond that
of their own load: with a logarithmic profile a contact that is solved as a whole has none either,
and its largest pressure is 1 to 5 % above that of the strips.
"""

from __future__ import annotations

import numpy as np

from macroslip.bearing.profile import profile_depth

#: Approach of Palmgren's law [m] at 1 N on a contact of 1 m in the units of his formula: δ = 3.84e-5
#: mm · Q^0.9/l^0.8, Q in N and l in mm.
_PALMGREN = 3.84e-5
#: Exponent n of Palmgren's q ∝ δ^n [-].
PALMGREN_EXPONENT = 10.0 / 9.0
#: Loads per length between which a power of the approach is fitted to plane strain [N/m].
_FITTED_LOADS = (1e4, 3e6)


def palmgren_coefficient(contact_length: float) -> float:
    """Coefficient c of Palmgren's law q = c δ^(10/9) [N/m per m^(10/9)] for solid steel rings.

    Parameters
    ----------
    contact_length : float
        Effective length of the roller l [m], > 0; made for l/Dw of 1 to 2.5.

    Returns
    -------
    float
        c, with q in N/m and δ in m.

    Notes
    -----
    Palmgren's δ = 3.84e-5 Q^0.9/l^0.8 (N, mm) for one contact of a steel roller with a raceway is q
    = (δ/3.84e-5)^(10/9) l^(−1/9) for the load per length q = Q/l.

    References
    ----------
    Palmgren, Grundlagen der Wälzlagertechnik, 3rd ed. (1964).

    Examples
    --------
    >>> load = palmgren_coefficient(0.107) * (28.894e-6) ** (10 / 9) * 0.107
    >>> round(load / 1e3, 2)
    100.0
    """
    millimetre = 1e3
    in_millimetres = (millimetre / _PALMGREN) ** (10.0 / 9.0)
    return millimetre * in_millimetres * (millimetre * contact_length) ** (-1.0 / 9.0)


def half_width(load_per_length, rolling_curvature, modulus):
    """Half-width b of a Hertzian line contact along rolling [m], √(8 q/(π E' κ)).

    Parameters
    ----------
    load_per_length : array_like
        q [N/m], not negative.
    rolling_curvature : array_like
        Sum of both bodies' curvatures in the plane of rolling κ [1/m], > 0.
    modulus : float
        Effective modulus E' = 2/[(1−ν1²)/E1 + (1−ν2²)/E2] [Pa].

    References
    ----------
    Johnson, Contact Mechanics (1985), section 4.2(c), where E* = E'/2.

    Examples
    --------
    >>> round(1e3 * float(half_width(1e6, 30.0, 230.8e9)), 4)
    0.6064
    """
    return np.sqrt(8.0 * load_per_length / (np.pi * modulus * rolling_curvature))


def line_pressure(load_per_length, rolling_curvature, modulus):
    """Largest pressure of a Hertzian line contact [Pa], √(q κ E'/(2π)).

    Parameters
    ----------
    load_per_length : array_like
        q [N/m], not negative.
    rolling_curvature : array_like
        Sum of both bodies' curvatures in the plane of rolling κ [1/m], > 0.
    modulus : float
        Effective modulus E' = 2/[(1−ν1²)/E1 + (1−ν2²)/E2] [Pa].

    References
    ----------
    Johnson, Contact Mechanics (1985), section 4.2(c), where E* = E'/2.

    Examples
    --------
    >>> round(float(line_pressure(1e6, 30.0, 230.8e9)) / 1e9, 4)
    1.0498
    """
    return np.sqrt(load_per_length * rolling_curvature * modulus / (2.0 * np.pi))


def plane_strain_approach(load_per_length, half_width, roller_radius, ring_thickness, modulus):
    """Approach δ of a roller and a ring under a load per length, in plane strain [m].

    Parameters
    ----------
    load_per_length : array_like
        q [N/m], > 0.
    half_width : array_like
        Half-width b of the contact along rolling [m].
    roller_radius : float
        r [m]; the roller is pressed from both sides, and half of it belongs to one contact.
    ring_thickness : float
        Thickness t of the ring behind the raceway [m], much larger than b.
    modulus : float
        Plane-strain modulus E/(1 − ν²) of both bodies [Pa].

    Returns
    -------
    ndarray
        δ = q (1 − ν²)/(π E) [2 ln(4r/b) − 1 + 2 ln(2t/b) − ν/(1 − ν)] [m], for ν = 0.3.

    References
    ----------
    Johnson, Contact Mechanics (1985), section 5.6, eqs. (5.57) and (5.58) with half of a cylinder's
    compression.

    Examples
    --------
    >>> width = half_width(9.346e5, 35.3, 230.8e9)
    >>> round(1e6 * float(plane_strain_approach(9.346e5, width, 0.031, 0.036, 230.8e9)), 1)
    24.8
    """
    poisson = 0.3
    roller = 2.0 * np.log(4.0 * roller_radius / half_width) - 1.0
    lateral = poisson / (1.0 - poisson)
    ring = 2.0 * np.log(2.0 * ring_thickness / half_width) - lateral
    return load_per_length / (np.pi * modulus) * (roller + ring)


def plane_strain_law(
    roller_radius: float, ring_thickness: float, modulus: float
) -> tuple[float, float]:
    """Coefficient and exponent of q = c δ^n for one contact in plane strain.

    Parameters
    ----------
    roller_radius : float
        r [m]; the contact's curvature is taken as 1/r, which counts by its logarithm only.
    ring_thickness : float
        Thickness of the ring behind the raceway [m].
    modulus : float
        Effective modulus E' of steel on steel [Pa], equal to E/(1 − ν²).

    Returns
    -------
    coefficient, exponent : float
        c [N/m per m^n] and n [-], fitted to `plane_strain_approach` within 3 % between 10 and
        3000 N/mm.

    Examples
    --------
    >>> coefficient, exponent = plane_strain_law(0.031, 0.036, 230.8e9)
    >>> round(exponent, 3)
    1.099
    """
    load = np.geomspace(*_FITTED_LOADS, 40)
    width = half_width(load, 1.0 / roller_radius, modulus)
    approach = plane_strain_approach(load, width, roller_radius, ring_thickness, modulus)
    exponent, log_coefficient = np.polyfit(np.log(approach), np.log(load), 1)
    return float(np.exp(log_coefficient)), float(exponent)


def logarithmic_profile(station, roller_length: float, roller_diameter: float):
    """Drop of a roller's contour towards its ends, per contact [m].

    Parameters
    ----------
    station : array_like
        Coordinate ζ along the roller from its middle [m], |ζ| < L/2.
    roller_length : float
        Effective length L [m], at most 2.5 Dw.
    roller_diameter : float
        Dw [m].

    Returns
    -------
    ndarray
        P = 0.00035 Dw ln 1/(1 − (2ζ/L)²) [m].

    References
    ----------
    ISO/TS 16281:2008, section 5.4.

    Examples
    --------
    >>> round(1e6 * float(logarithmic_profile(0.8 * 0.107 / 2, 0.107, 0.062)), 2)
    22.17
    """
    relative = 2.0 * np.asarray(station) / roller_length
    return -profile_depth(roller_diameter) * np.log1p(-relative * relative)


def strip_places(roller_length: float, strips: int) -> np.ndarray:
    """Coordinates ζ of the middles of equal strips along a roller [m], shape (strips,).

    Examples
    --------
    >>> strip_places(0.1, 4).round(6).tolist()
    [-0.0375, -0.0125, 0.0125, 0.0375]
    """
    return roller_length * ((np.arange(strips) + 0.5) / strips - 0.5)
