"""Asperities: their share of a contact's load, and their boundary friction.

A share is a function of an interface, of load Q [N], entrainment speed u_e [m/s] and film thickness
h [m] with all corrections, arrays above zero, and lies between 0 and 1.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.compiled import jit_inline
from macroslip.contact.film import RANGES, line_groups, loads_in_range
from macroslip.contact.interface import Interface

#: Works to cite for each share, by the names in case files.
REFERENCES = {
    "film-ratio": "Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369",
    "masjedi-khonsari": "Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514",
    "none": "",
}
#: Slip [m/s] from which on asperities slide fully; below it their friction is proportional to slip,
#: as they first yield elastically during their passage. Junctions of about a micrometre that cross
#: a contact 1 mm wide at 0.4 m/s are there at some 0.1 mm/s; an engineering estimate.
FULL_SLIP = 1e-4
#: Laws with a range of the load group W, outside of which the share by Λ bounds theirs.
BOUNDED = ("masjedi-khonsari",)
#: Factors of W inside the lower and the upper end of its range from which on the load ratio alone
#: counts, since tables cannot hold a step. Rollers pass the lower end in an instant; near the upper
#: one they wear, so there it is narrow.
_WITHIN_LEAST = 2.0
_WITHIN_MOST = 1.1

# Gauss-Legendre with four points, exact for the polynomials of degree 7 that occur between two
# corners.
_FAR = math.sqrt(3.0 / 7.0 + 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_NEAR = math.sqrt(3.0 / 7.0 - 2.0 / 7.0 * math.sqrt(6.0 / 5.0))
_FAR_WEIGHT = (18.0 - math.sqrt(30.0)) / 36.0
_NEAR_WEIGHT = (18.0 + math.sqrt(30.0)) / 36.0
_RULE = ((-_FAR, _FAR_WEIGHT), (-_NEAR, _NEAR_WEIGHT), (_NEAR, _NEAR_WEIGHT), (_FAR, _FAR_WEIGHT))
#: Stands for zero in a divisor.
_LEAST = 1e-300


def load_ratio(load, speed, material, roughness, hardness):
    """Share of the load that asperities carry in a rough line contact, not clamped.

    100 L_a = 0.005 W^−0.408 U^−0.088 G^0.103 ln(1 + 4470 σ^6.015 V^1.168 W^0.485 U^−3.741 G^−2.898)

    Parameters
    ----------
    load : array_like
        W = w/(E'R) with w the load per length [-], > 0.
    speed : array_like
        U = η0 u_e/(E'R) [-], > 0.
    material : array_like
        G = α_p E' [-], > 0.
    roughness : array_like
        σ = σ_rms/R [-], ≥ 0.
    hardness : array_like
        V = v/E' [-], > 0.

    Returns
    -------
    ndarray
        Share of the load [-]. It may exceed 1 far below the range of U, and is 0 where the surfaces
        are smooth.

    Notes
    -----
    The ranges of the fit are those of `macroslip.contact.film.masjedi_khonsari_thickness`.

    References
    ----------
    Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514.

    Examples
    --------
    >>> float(round(load_ratio(1e-4, 1e-11, 4846.0, 1e-5, 0.03), 6))
    0.054356
    """
    log_load = np.log(load)
    log_speed = np.log(speed)
    log_material = np.log(material)
    with np.errstate(divide="ignore"):
        of_surface = math.log(4470.0) + 6.015 * np.log(roughness) + 1.168 * np.log(hardness)
    exponent = of_surface + 0.485 * log_load - 3.741 * log_speed - 2.898 * log_material
    log_share = -0.408 * log_load - 0.088 * log_speed + 0.103 * log_material
    share = 5e-5 * np.exp(log_share)
    return share * np.logaddexp(0.0, exponent)


def film_ratio_share(film_ratio):
    """Share of the load that asperities carry by the film ratio, exp(−2.32 Λ^0.97).

    It is 1 at Λ = 0, 10 % at Λ = 0.99, 1 % at 2.03, 0.1 % at 3.08 [-]. Λ = h/σ_rms is ≥ 0, with
    σ_rms the composite RMS roughness.

    A fit to measured surfaces of rolling bearings (tag V).

    Wingertszahn et al., Lubricants 11 (2023) 369, doi:10.3390/lubricants11090369.

    Examples
    --------
    >>> float(round(film_ratio_share(1.0), 4))
    0.0983
    """
    return np.exp(-2.32 * np.power(film_ratio, 0.97))


def load_group(interface: Interface, load):
    """Load group W = w/(E'R) [-] of a contact taken as a line, w = 3Q/(4a), at loads Q > 0 [N].

    Examples
    --------
    >>> from macroslip import Bearing, Lubricant
    >>> from macroslip.contact.interface import interfaces
    >>> inner, outer, cage = interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
    >>> float(f"{load_group(inner, 30.0):.2g}")
    1.1e-06
    """
    return line_groups(interface).load * np.cbrt(load) ** 2


def load_is_in_range(interface: Interface, load):
    """True where W lies in the range of Masjedi and Khonsari's load ratio, 2e-5 to 5e-4."""
    lightest, heaviest = loads_in_range(line_groups(interface))
    return (lightest <= load) & (load <= heaviest)


def _load_ratio_weight(group):
    """Weight of the load ratio at W [-]: 0 outside its range, 1 well inside, smooth between."""
    least, most = np.log(RANGES["load"])
    above = (np.log(group) - least) / math.log(_WITHIN_LEAST)
    below = (most - np.log(group)) / math.log(_WITHIN_MOST)
    part = np.clip(np.minimum(above, below), 0.0, 1.0)
    return part**3 * (10.0 - 15.0 * part + 6.0 * part * part)


def asperity_share(name: str, interface: Interface, load, entrainment_speed, film_thickness):
    """Share of the load that asperities carry, 0 to 1 [-], by the law called `name`.

    Parameters
    ----------
    name : str
        A key of `REFERENCES`.
    interface : Interface
        The contact; its ellipse counts as a line, w = 3Q/(4a), as films have it.
    load : array_like
        Q > 0 [N].
    entrainment_speed : array_like
        u_e > 0 [m/s].
    film_thickness : array_like
        h > 0 [m], with all corrections.

    Returns
    -------
    ndarray
        `film-ratio`: exp(−2.32 Λ^0.97), Λ = h/σ_rms.
        `masjedi-khonsari`: their load ratio where W lies in its range, 2e-5 to 5e-4. Outside of it
        no more than `film-ratio` gives: light contacts are far below the range, where the load
        ratio hardly knows the film. From W = 2e-5 to 4e-5, and from 4.5e-4 to 5e-4, one passes over
        into the other.

    Notes
    -----
    The load ratio is used outside its range of U: it is small where the film is thick, and clamped
    to 1 where it exceeds that, at 20 kN on the base bearing's raceways below a third of the lowest
    U of its range. A cage's contact is below the range of W, and has none.

    References
    ----------
    Those of `REFERENCES`.

    Examples
    --------
    >>> from macroslip import Bearing, Lubricant
    >>> from macroslip.contact.interface import interfaces
    >>> inner, outer, cage = interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
    >>> float(round(asperity_share("masjedi-khonsari", inner, 5e4, 0.396, 1e-6), 5))
    0.00123
    >>> by_range, by_film = (
    ...     asperity_share(law, inner, 30.0, 0.15, 2.1e-6) for law in ("masjedi-khonsari", "film-ratio"))
    >>> f"{by_range:.1e}", bool(by_range == by_film)
    ('2.2e-07', True)
    """
    none = np.zeros(np.broadcast(load, entrainment_speed, film_thickness).shape)[()]
    if name == "none" or interface.roughness <= 0.0:
        return none
    by_film = film_ratio_share(np.asarray(film_thickness) / interface.roughness) + none
    if name == "film-ratio":
        return by_film
    groups = line_groups(interface)
    loads = load_group(interface, load)
    speeds = groups.speed * np.asarray(entrainment_speed)
    ratio = np.minimum(1.0, load_ratio(loads, speeds, *groups[2:]))
    bounded = np.minimum(ratio, by_film)
    return bounded + _load_ratio_weight(loads) * (ratio - bounded)


@jit_inline
def _passes(level, sliding, bend, spin, half):
    """Both stations within ±half at which v passes a level, in order [m].

    They are its extremum where v does not reach the level: a corner too many does no harm.
    """
    over_level = sliding - level
    inside = np.maximum(spin * spin - 4.0 * bend * over_level, 0.0)
    root = np.copysign(np.sqrt(inside), spin)
    larger = 0.5 * (spin + root)
    first = np.minimum(np.maximum(larger / bend, -half), half)
    smaller = over_level / (larger + _LEAST * (larger == 0.0))
    second = np.minimum(np.maximum(smaller, -half), half)
    return np.minimum(first, second), np.maximum(first, second)


def asperity_patch(scale, full_slip, across, half, sliding, bend, spin):
    """Exact friction of asperities over a contact with the slip v(ζ) = sliding + bend ζ² − spin ζ.

    Written so that it takes arrays with NumPy, and numbers where numba compiles it. Gives ∫τ dA
    [N], ∫τ ζ² dA [N m²], ∫τ ζ dA [N m] and ∫τ v dA [W], never negative.

    Parameters
    ----------
    scale : float or ndarray
        ¾ µ_b share Q/a, friction per length where asperities slide in the middle of the contact
        [N/m].
    full_slip : float
        Slip from which on asperities slide [m/s].
    across : float or ndarray
        Semi-axis a of the ellipse across rolling [m].
    half : float or ndarray
        Where the contact ends: a, or half the roller's length if that is less [m].
    sliding, bend, spin : float or ndarray
        Slip [m/s]: Δu, κ/(2R_d) [1/(m s)] and s [1/s].

    Notes
    -----
    Stress is µ_b share p min(|v|/v_b, 1) sign(v). With Hertz pressure each chord carries 3Q/(4a) (1
    − ζ²/a²) per length, so between the stations at which v passes −v_b and +v_b every integrand is
    a polynomial and the result exact.

    Examples
    --------
    >>> force, second, skew, power = asperity_patch(1500.0, 1e-4, 0.01, 0.01, 0.01, 0.0, 0.0)
    >>> round(float(force), 9), round(float(power), 9)
    (20.0, 0.2)
    """
    bend = bend + _LEAST * (bend == 0.0)
    low, high = _passes(full_slip, sliding, bend, spin, half)
    less, more = _passes(-full_slip, sliding, bend, spin, half)
    # The two in the middle, not yet in order.
    later = np.maximum(low, less)
    sooner = np.minimum(high, more)
    corners = (
        np.minimum(low, less),
        np.minimum(later, sooner),
        np.maximum(later, sooner),
        np.maximum(high, more),
        half,
    )
    force = 0.0 * scale
    second = 0.0 * scale
    skew = 0.0 * scale
    power = 0.0 * scale
    before = -half
    for after in corners:
        middle = 0.5 * (before + after)
        reach = 0.5 * (after - before)
        for node, weight in _RULE:
            station = middle + reach * node
            slip = sliding + station * (bend * station - spin)
            pressed = 1.0 - station * station / (across * across)
            saturation = np.minimum(np.maximum(slip / full_slip, -1.0), 1.0)
            part = scale * reach * weight * pressed
            part = part * saturation
            force = force + part
            second = second + part * station * station
            skew = skew + part * station
            power = power + part * slip
        before = after
    return force, second, skew, power
