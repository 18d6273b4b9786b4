"""Traction of a sheared film: rheology, shear heating, and stress along a chord of the contact.

Stress at one point. A rheology is written γ̇ = τ*(τ)/η with an equivalent Newtonian stress τ*, and
used in its inverse form τ = t(τ*). Across a thin film τ is constant, and shear dissipates τ τ*/η.
With η = η_s exp(−β ΔT) and walls at inlet temperature the heat balance k T'' = −τ τ*/η is Crook's
problem with τ τ* in place of τ², and has his solution: the profile is ΔT = (2/β) ln[cosh c/cosh(2c
y/h)], with c from

    τ Δu β h/(8k) = c tanh c,        τ* = (η_s Δu/h) 2c/sinh 2c,        τ = t(τ*).

The first means that all power leaves by conduction, the second that the shear rates add up to the
slip. The left of the first rises with c and what the others put into it falls, so there is exactly
one solution for every slip. In a Newtonian film τ = τ*, and sinh² c = B is Crook's heating number.
Stress rises with slip as long as c tanh c < 1, whatever the law t: that is as long as τ Δu < 8k/(β
h).

Stress along a chord. On the chord of the ellipse at station ζ, in the direction of rolling, the
Hertz pressure is p1 cos θ with x = b1 sin θ, and slip and film are the same all along it. Its
traction per length is 2 b1 q with q = ∫₀^{π/2} τ(p1 cos θ) cos θ dθ. q is tabulated once for an
oil.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.ndimage import map_coordinates

from macroslip.contact.mechanisms import Laws
from macroslip.contact.spline import axis, spline_coefficients
from macroslip.errors import InputError
from macroslip.lubricant import Lubricant
from macroslip.lubricant.temperature import ROELANDS_PRESSURE, roelands_index
from macroslip.storage.tables import stored, table_key

NEWTONIAN = 0
LIMITING_SHEAR = 1
EYRING = 2
#: Numbers of the rheologies by the names that case files use.
RHEOLOGIES = {"newtonian": NEWTONIAN, "limiting-shear": LIMITING_SHEAR, "eyring": EYRING}
#: Works to cite for each mechanism.
REFERENCES = {
    "barus": "Barus, Am. J. Sci. 45 (1893) 87",
    "roelands": "Roelands, thesis, Delft (1966)",
    "limiting-shear": "Bair and Winer, J. Lubr. Technol. 101 (1979) 258, doi:10.1115/1.3453342",
    "eyring": "Johnson and Tevaarwerk, Proc. R. Soc. A 356 (1977) 215, doi:10.1098/rspa.1977.0129",
    "heating": "Crook, Phil. Trans. R. Soc. A 254 (1961) 237, doi:10.1098/rsta.1961.0014",
}

#: Largest logarithm of viscosity [Pa s] at which slip and stress are numbers still.
_HIGHEST_LOG_VISCOSITY = 600.0
#: Pressure by which Barus' exponent is scaled [Pa]; any will do.
_BARUS_PRESSURE = 1e8
#: Heat times stress below which heating is a small correction, taken to first order.
_SMALL = 1e-7
#: Highest and lowest pressure of the chord table [Pa]; pressures beyond are treated as these.
HIGHEST_PRESSURE = 4e9
LOWEST_PRESSURE = 10.0
_THINNEST = 2e-8
_THICKEST = 4e-4
_FASTEST = 5.0
# A thick film of the largest Eyring stress heats by 1e-3 at exp(-10) of its characteristic slip
# already.
LOWEST_LOG_SLIP = -12.0
#: Pressures, and spacing of slips and of films in their logarithms. Eyring's stress has no corner
#: at a limit: with a third of the nodes, interpolated stress is off by a tenth of the error with
#: limiting shear.
_GRIDS = {NEWTONIAN: (80, 0.3, 0.35), LIMITING_SHEAR: (80, 0.3, 0.35), EYRING: (56, 0.45, 0.5)}
#: Slip [m/s] from which on the chord table is continued in a straight line: in light contacts it
#: reaches a million times further. That is seven nodes and more beyond the slips that are looked
#: up, and the influence of a change on a spline falls to a quarter with each node.
_CONTINUED = 150.0
#: Bounds and spacing of both coordinates of the local stress, and its relative error beyond which
#: it is solved for.
_BOUNDS = ((-14.0, 8.0), (-22.0, 8.0))
_SPACING = 0.1
_LARGEST_ERROR = 1e-6


def limited_stress(rheology: int, viscous_stress, characteristic_stress):
    """Shear stress τ [Pa] of a film whose Newtonian stress would be τ* = η γ̇.

    `NEWTONIAN`: τ = τ*. `LIMITING_SHEAR` (Bair and Winer): τ = τ_L [1 − exp(−τ*/τ_L)]. `EYRING`: τ
    = τ_E asinh(τ*/τ_E). Of τ* ≥ 0, and τ_L or τ_E > 0 [Pa].

    Bair and Winer, J. Lubr. Technol. 101 (1979) 258, doi:10.1115/1.3453342; Eyring's law for
    traction: Johnson and Tevaarwerk, Proc. R. Soc. A 356 (1977) 215, doi:10.1098/rspa.1977.0129.

    Examples
    --------
    >>> float(round(limited_stress(LIMITING_SHEAR, 2.0e7, 4.0e7), 6))
    15738773.611495
    >>> float(round(limited_stress(EYRING, 3.3e6, 3.3e6), 6))
    2908532.837164
    """
    if rheology == NEWTONIAN:
        return viscous_stress + 0.0 * characteristic_stress
    ratio = viscous_stress / characteristic_stress
    if rheology == LIMITING_SHEAR:
        return characteristic_stress * -np.expm1(-ratio)
    return characteristic_stress * np.arcsinh(ratio)


def _elasticity(rheology: int, ratio):
    """D ln τ/d ln τ* of `limited_stress` at τ*/τ_L > 0, between 0 and 1."""
    if rheology == LIMITING_SHEAR:
        return ratio / np.expm1(np.minimum(ratio, 700.0))
    root = np.sqrt(1.0 + ratio * ratio)
    return ratio / (root * np.arcsinh(ratio))


def heated_shear(rheology: int, viscous_stress, characteristic_stress, heat):
    """Shear stress of a film of limited stress that is heated by its own shear.

    It is the exact solution of the module's docstring. The mid-film temperature rise is
    (2/β) ln cosh c.

    Parameters
    ----------
    rheology : int
        As in `limited_stress`.
    viscous_stress : array_like
        η_s |Δu|/h [Pa], ≥ 0, with the viscosity at wall temperature.
    characteristic_stress : array_like
        Limiting or Eyring stress at wall temperature [Pa], > 0.
    heat : array_like
        β h |Δu|/(8k) [1/Pa], ≥ 0; 0 without heating.

    Returns
    -------
    ndarray or float
        τ [Pa], ≥ 0.

    Notes
    -----
    Valid as long as conduction across the film is the only way for heat to leave.

    References
    ----------
    Crook (1961), doi:10.1098/rsta.1961.0014, for the Newtonian case.

    Examples
    --------
    >>> float(round(heated_shear(LIMITING_SHEAR, 1e8, 5e7, 2e-8) / 5e7, 6))
    0.691124
    """
    viscous, limit, heat = np.broadcast_arrays(
        *(
            np.asarray(values, dtype=float)
            for values in (viscous_stress, characteristic_stress, heat)
        )
    )
    stress = np.array(limited_stress(rheology, viscous, limit))
    power = heat * stress
    if rheology == NEWTONIAN:
        c = np.arcsinh(np.sqrt(power))
        series = 1.0 - power * (2.0 / 3.0)
        return np.where(c < 1e-4, stress * series, stress * _thinning(c))[()]
    hot = power >= _SMALL
    slight = (power > 0.0) & ~hot
    elasticity = _elasticity(rheology, viscous[slight] / limit[slight])
    stress[slight] *= 1.0 - (2.0 / 3.0) * power[slight] * elasticity
    if hot.any():
        hot_limit = limit[hot]
        ratio = viscous[hot] / hot_limit
        stress[hot] = _hot_stress(rheology, ratio, heat[hot] * hot_limit) * hot_limit
    return stress[()]


def _thinning(c):
    """2c/sinh 2c [-], by which heating lowers the mean viscosity of the film."""
    # Beyond 340 the stress is nothing, but its logarithm has to exist.
    decay = np.exp(-2.0 * np.minimum(c, 340.0))
    series = 1.0 - c * c * (2.0 / 3.0)
    whole = 4.0 * c * decay / np.maximum(1.0 - decay * decay, 1e-4)
    return np.where(c < 1e-3, series, whole)


def _hot_stress(rheology: int, ratio: np.ndarray, heat: np.ndarray) -> np.ndarray:
    """Stress over τ_L with shear heating, from c tanh c = heat · t(ratio 2c/sinh 2c).

    Newton's method, kept in a bracket.
    """
    power = heat * limited_stress(rheology, ratio, 1.0)
    # Neither more than without thinning by heat, nor more than in a Newtonian film.
    not_thinned = np.sqrt(power) * np.sqrt(1.0 + power)
    newtonian = np.arcsinh(np.sqrt(heat) * np.sqrt(ratio))
    high = np.minimum(not_thinned, newtonian)
    low = np.zeros_like(high)
    c = high.copy()
    left = np.arange(c.size)
    for _ in range(60):
        at = c[left]
        stress = ratio[left]
        warm = heat[left]
        decay = np.exp(-2.0 * at)
        square = decay * decay
        tangent = (1.0 - decay) / (1.0 + decay)
        spread = 2.0 * at * (1.0 + square) / (1.0 - square) - 1.0
        thinned = stress * _thinning(at)
        put_in = warm * limited_stress(rheology, thinned, 1.0)
        residual = at * tangent - put_in
        above = residual > 0.0
        upper = np.where(above, at, high[left])
        lower = np.where(above, low[left], at)
        high[left] = upper
        low[left] = lower
        elasticity = _elasticity(rheology, np.maximum(thinned, 1e-300))
        slope = tangent + at * (1.0 - tangent * tangent) + put_in * elasticity * spread / at
        following = at - residual / slope
        inside = (lower <= following) & (following <= upper)
        following = np.where(inside, following, 0.5 * (lower + upper))
        c[left] = following
        # Newton's next change would be of the order of this one squared.
        left = left[np.abs(following - at) > 1e-6 * following]
        if left.size == 0:
            break
    return limited_stress(rheology, ratio * _thinning(c), 1.0)


class Fluid(NamedTuple):
    """Properties of a lubricant that set the shear stress of its film."""

    rheology: int  #: See `limited_stress`
    viscosity: float  #: η0 at inlet temperature and ambient pressure [Pa s]
    #: Factor e in ln η = ln η0 + e [(1 + p/p_r)^z − 1] [-]
    exponent: float
    index: float  #: z [-]; 1 for Barus' law
    reference_pressure: float  #: p_r [Pa]
    #: γ = τ_L/p [-] for limiting shear, τ_E [Pa] for Eyring; 1 for a Newtonian film
    characteristic: float
    heating: float  #: β/(8k) [m/W]; 0 without shear heating


def prepare_fluid(laws: Laws, lubricant: Lubricant) -> Fluid:
    """The sheared film of a lubricant under the chosen mechanisms.

    Raises InputError if its viscosity is too low for Roelands' law, or rises beyond all numbers
    with pressure.
    """
    if laws.viscosity == "roelands":
        index = roelands_index(lubricant.viscosity, lubricant.pressure_viscosity)
        exponent = math.log(lubricant.viscosity) + 9.67
        pressure = ROELANDS_PRESSURE
    else:
        index = 1.0
        exponent = lubricant.pressure_viscosity * _BARUS_PRESSURE
        pressure = _BARUS_PRESSURE
    rheology = RHEOLOGIES[laws.rheology]
    characteristic = {
        NEWTONIAN: 1.0,
        LIMITING_SHEAR: lubricant.limiting_shear,
        EYRING: lubricant.eyring_stress,
    }
    heating = 0.0
    if laws.heating:
        heating = lubricant.temperature_viscosity / (8.0 * lubricant.thermal_conductivity)
    fluid = Fluid(
        rheology, lubricant.viscosity, exponent, index, pressure, characteristic[rheology], heating
    )
    highest = float(log_viscosity(fluid, HIGHEST_PRESSURE))
    if highest > _HIGHEST_LOG_VISCOSITY:
        raise InputError(
            f"viscosity rises to 1e{highest / math.log(10.0):.0f} Pa s at {HIGHEST_PRESSURE / 1e9:g} GPa, "
            f"with a pressure-viscosity coefficient of {1e9 * lubricant.pressure_viscosity:g} 1/GPa",
            where="lubricant, pressure_viscosity",
            allowed=f"up to 1e{_HIGHEST_LOG_VISCOSITY / math.log(10.0):.0f} Pa s; oils have 10 to 50 1/GPa",
            remedy="Look at the number and its unit.",
        )
    return fluid


def log_viscosity(fluid: Fluid, pressure):
    """Ln η [ln(Pa s)] at pressures [Pa].

    Examples
    --------
    >>> fluid = Fluid(0, 0.54, 2.1, 1.0, 1e8, 1.0, 0.0)     # Barus, 21 1/GPa
    >>> float(round(log_viscosity(fluid, 1e9), 6))
    20.383814
    """
    relative = 1.0 + np.asarray(pressure) / fluid.reference_pressure
    rise = np.power(relative, fluid.index) - 1.0
    return math.log(fluid.viscosity) + fluid.exponent * rise


def characteristic_stress(fluid: Fluid, pressure):
    """Limiting or Eyring stress [Pa] at pressures [Pa]; not used by a Newtonian film."""
    if fluid.rheology == LIMITING_SHEAR:
        return fluid.characteristic * np.asarray(pressure)
    return np.full(np.shape(pressure), fluid.characteristic)[()]


def characteristic_slip(fluid: Fluid, log_eta, pressure, film_thickness):
    """Slip at which limited stress, or in a Newtonian film shear heating, begins to have an effect.

    Parameters
    ----------
    fluid : Fluid
        The sheared film.
    log_eta : array_like
        ln η at the pressure [ln(Pa s)].
    pressure : array_like
        p [Pa], > 0.
    film_thickness : array_like
        h [m], > 0.

    Returns
    -------
    ndarray or float
        Slip [m/s], > 0.
    """
    if fluid.rheology == NEWTONIAN:
        heating = max(fluid.heating, 1e-30)
        return np.exp(-0.5 * log_eta) / math.sqrt(heating) + 0.0 * film_thickness
    return film_thickness * characteristic_stress(fluid, pressure) * np.exp(-log_eta)


# Cos θ and weights of ∫₀^{π/2} f(cos θ) cos θ dθ by Gauss and Legendre.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(18)
_COSINES = np.cos(0.25 * np.pi * (_NODES + 1.0))
_WEIGHTS = 0.25 * np.pi * _WEIGHTS * _COSINES


def chord_stress(fluid: Fluid, pressure, film_thickness, slip):
    """Mean shear stress q along a chord of the contact by quadrature.

    Parameters
    ----------
    fluid : Fluid
        The sheared film.
    pressure : array_like
        Largest pressure on the chord p1 [Pa], > 0.
    film_thickness : array_like
        h [m], > 0.
    slip : array_like
        |Δu| [m/s], ≥ 0.

    Returns
    -------
    ndarray or float
        q [Pa], ≥ 0.

    Notes
    -----
    Relative error of the 18 nodes below 1e-4 up to 2 GPa and 1e-3 up to 4 GPa with Roelands'
    viscosity; with Barus' and a limiting stress, 5e-4 up to 1 GPa and 1e-2 up to 2 GPa.

    Examples
    --------
    >>> full = Fluid(LIMITING_SHEAR, 0.54, 2.1, 1.0, 1e8, 0.04, 0.0)
    >>> float(round(chord_stress(full, 1e9, 5e-7, 1.0) / (0.04 * 1e9 * math.pi / 4), 4))
    0.9999
    """
    pressure, film, slip = (
        np.asarray(values, dtype=float)[..., None] for values in (pressure, film_thickness, slip)
    )
    local = pressure * _COSINES
    viscous = np.exp(log_viscosity(fluid, local)) * slip / film
    heat = fluid.heating * film * slip
    limit = characteristic_stress(fluid, local)
    stress = heated_shear(fluid.rheology, viscous, limit, heat)
    return stress @ _WEIGHTS


class _LocalStress(NamedTuple):
    """Local stress ln(τ/τ_L) of a limited, self-heated film.

    The coordinates are ln(η_s Δu/(h τ_L)) and ln(β h Δu τ_L/(8k)).

    It depends on these two numbers only, so that one table serves all oils.
    """

    coefficients: np.ndarray  #: Shape (viscous + 2, heat + 2). Of the spline.
    #: Shape of the cells. Whether its error in the middle of the cell is within `_LARGEST_ERROR`.
    good: np.ndarray


@lru_cache(maxsize=2)
def _local_stress(rheology: int) -> _LocalStress:
    viscous, heat = (axis(*bounds, _SPACING) for bounds in _BOUNDS)

    def solved(first: np.ndarray, second: np.ndarray) -> np.ndarray:
        ratio = np.exp(first)[:, None]
        heating = np.exp(second)
        return np.log(heated_shear(rheology, ratio, 1.0, heating))

    coefficients = spline_coefficients(solved(viscous.nodes, heat.nodes), 2)
    # A spline has one coefficient before its first node.
    middles = np.meshgrid(
        *(np.arange(coordinate.cells) + 1.5 for coordinate in (viscous, heat)), indexing="ij"
    )
    tabulated = map_coordinates(coefficients, middles, order=3, prefilter=False)
    off = np.abs(tabulated - solved(viscous.middles, heat.middles))
    return _LocalStress(coefficients, off <= _LARGEST_ERROR)


def _log_local_stress(rheology: int, viscous: np.ndarray, heat: np.ndarray) -> np.ndarray:
    """ln(τ/τ_L) at both coordinates of `_LocalStress`, from its table where that is good."""
    table = _local_stress(rheology)
    known = np.ones(viscous.shape, dtype=bool)
    positions = []
    cells = []
    for coordinate, (low, _), size in zip((viscous, heat), _BOUNDS, table.good.shape, strict=True):
        position = (coordinate - low) / _SPACING
        known &= (position >= 0.0) & (position < size)
        positions.append(position)
        cells.append(np.clip(position, 0.0, size - 1.0).astype(int))
    known &= table.good[tuple(cells)]
    logarithm = np.empty(viscous.shape)
    # A spline has one coefficient before its first node.
    nodes = [position[known] + 1.0 for position in positions]
    logarithm[known] = map_coordinates(
        table.coefficients, nodes, order=3, prefilter=False, mode="nearest"
    )
    unknown = ~known
    ratio = np.exp(viscous[unknown])
    heating = np.exp(heat[unknown])
    logarithm[unknown] = np.log(heated_shear(rheology, ratio, 1.0, heating))
    return logarithm


def local_stress(fluid: Fluid, pressure, log_film, log_slip):
    """Shear stress at points of a film, from the table that all oils share.

    Where the table is not good enough the stress is solved for.

    Parameters
    ----------
    fluid : Fluid
        The sheared film.
    pressure : array_like
        p [Pa], > 0.
    log_film : array_like
        ln h of the film thickness [m].
    log_slip : array_like
        ln |Δu| of the slip [m/s].

    Returns
    -------
    ndarray or float
        τ [Pa], > 0.

    Examples
    --------
    >>> oil = Fluid(EYRING, 0.54, 9.05, 0.43, 1.96e8, 6.7e6, 0.056 / (8 * 0.125))
    >>> float(round(local_stress(oil, 1e9, math.log(1e-6), math.log(1e-3)) / 6.7e6, 4))
    1.9348
    """
    log_eta = log_viscosity(fluid, pressure)
    if fluid.rheology == NEWTONIAN or fluid.heating == 0.0:
        slip = np.exp(log_slip)
        viscous = np.exp(log_eta - log_film) * slip
        heat = fluid.heating * np.exp(log_film) * slip
        limit = characteristic_stress(fluid, pressure)
        return heated_shear(fluid.rheology, viscous, limit, heat)
    log_limit = np.log(characteristic_stress(fluid, pressure))
    log_ratio = log_slip - log_film + (log_eta - log_limit)
    log_heat = math.log(fluid.heating) + log_slip + log_film + log_limit
    log_ratio, log_heat = np.broadcast_arrays(log_ratio, log_heat)
    log_stress = _log_local_stress(fluid.rheology, log_ratio, log_heat)
    return np.exp(log_stress + log_limit)


class ChordTable(NamedTuple):
    """Spline of ln q over pressure, film thickness and slip.

    The coordinates are p1^¼, the logarithm of film thickness and that of slip over
    `characteristic_slip`.

    Below the first slip a film is Newtonian and cool, and stress is proportional to slip. The
    spline is twice continuously differentiable. One table serves all contacts of an oil; compiled
    functions look it up (`macroslip.contact.patch`).
    """

    fluid: Fluid  #: The sheared film
    shape: tuple[int, int, int]  #: Of the coefficients, over pressures, films and slips
    coefficients: np.ndarray  #: Flat
    log_viscosities: np.ndarray  #: Shape (pressures + 2,). Of the spline of ln η.
    per_root: float  #: Cells per p1^¼ [Pa^-¼]
    per_log_slip: float  #: Cells per logarithm of slip [-]
    per_log_film: float  #: Cells per ln h [-]
    lowest_film: float  #: ln h of the first node


@lru_cache(maxsize=16)
def chord_table(fluid: Fluid | None) -> ChordTable:
    """Table of the chord stress of a fluid; empty without one.

    It is made in half a second of CPU time and kept, in memory and on disk.

    With limiting shear and Roelands' viscosity the relative error of the interpolated stress is
    below 1e-3 (in 99 of 100 places 1e-4) up to 2 GPa and 0.05 m/s in films of 0.1 to 2 µm, and from
    1 kPa to 30 MPa in any film. Where a contact above 1 GPa skids at 0.4 m/s and limited stress
    gives way to heating it reaches 1 %, in less than one place in a hundred; with Barus' viscosity,
    4 %. In films beyond 10 µm under more than 30 MPa or slips beyond 0.6 m/s it may be several per
    cent. With Eyring's law it is 5e-4 at most (3e-5) up to 0.05 m/s, and 2e-3 beyond, for
    viscosities of 0.05 to 1.5 Pa s. The limiting stress itself is never exceeded.
    """
    if fluid is None:
        nothing = Fluid(NEWTONIAN, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0)
        empty = np.zeros(64)
        # As tables from store are: compiled functions take both alike.
        empty.flags.writeable = False
        return ChordTable(nothing, (4, 4, 4), empty, np.zeros(4), 1.0, 1.0, 1.0, 0.0)
    count, slip_spacing, film_spacing = _GRIDS[fluid.rheology]
    roots = np.linspace(0.0, HIGHEST_PRESSURE**0.25, count)
    thickest = math.log(_THICKEST) + film_spacing
    films = np.arange(math.log(_THINNEST), thickest, film_spacing)
    pressures = np.maximum(roots**4, LOWEST_PRESSURE)
    log_eta = log_viscosity(fluid, pressures)
    slip_units = characteristic_slip(fluid, log_eta, pressures, math.exp(films[0]))
    slowest = slip_units[1:].min()
    fastest = math.log(_FASTEST / slowest) + slip_spacing
    # A spline needs five nodes, even where stress is proportional to slip all through: Newtonian,
    # without heating.
    fifth = LOWEST_LOG_SLIP + 4.5 * slip_spacing
    highest = max(fastest, fifth)
    slips = np.arange(LOWEST_LOG_SLIP, highest, slip_spacing)

    def make() -> list[np.ndarray]:
        values = np.stack([_chord_values(fluid, pressure, slips, films) for pressure in pressures])
        return [spline_coefficients(values, 3)]

    (coefficients,) = stored(table_key("chord stress", fluid, pressures, slips, films), make)
    log_viscosities = spline_coefficients(log_eta, 1)
    numbers = (1.0 / float(roots[1]), 1.0 / slip_spacing, 1.0 / film_spacing, float(films[0]))
    return ChordTable(fluid, coefficients.shape, coefficients.ravel(), log_viscosities, *numbers)


def _chord_values(
    fluid: Fluid, pressure: float, slips: np.ndarray, films: np.ndarray
) -> np.ndarray:
    """Ln of the stress over its unit at one pressure [Pa], shape (films, slips), of logarithms."""
    log_eta = log_viscosity(fluid, pressure)
    film = np.exp(films)
    scale = characteristic_slip(fluid, log_eta, pressure, film)
    log_slip = np.log(scale)[:, None] + slips
    solved = log_slip <= math.log(_CONTINUED)
    solved[:, :2] = True
    values = np.zeros(solved.shape)
    where_film = np.nonzero(solved)[0]
    slip = log_slip[solved]
    log_film = films[where_film]
    along_chord = local_stress(fluid, pressure * _COSINES, log_film[:, None], slip[:, None])
    stress = along_chord @ _WEIGHTS
    if fluid.rheology == NEWTONIAN:
        unit = np.exp(log_eta) * scale / film
    else:
        unit = characteristic_stress(fluid, pressure)
    log_unit = np.broadcast_to(np.log(unit), film.shape)
    values[solved] = np.log(stress) - log_unit[where_film]
    # Beyond, a straight line through the last two that were solved for.
    last = solved.sum(axis=1)[:, None] - 1
    end = np.take_along_axis(values, last, axis=1)
    before = np.take_along_axis(values, last - 1, axis=1)
    beyond = np.arange(slips.size) - last
    return np.where(solved, values, end + beyond * (end - before))
