"""Starvation and inlet shear heating: factors on the film thickness of any law."""

from __future__ import annotations

from typing import Any, NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.errors import InputError
from macroslip.film import film_law as film_law

#: What to cite where inlet shear heating was used.
INLET_HEATING_REFERENCE = (
    "inlet shear heating in pure rolling as in Greenwood and Kauzlarich, J. Lubr. Technol. 95 (1973) 417, "
    "doi:10.1115/1.3451844"
)


@jit
def inlet_heating_factor(loading):
    """Film thickness over isothermal film thickness in pure rolling, φ_T = 1/(1 + 0.1 L^0.64).

    Oil that the narrowing inlet turns back is sheared, warms up and thins.

    Parameters
    ----------
    loading : float
        Thermal loading parameter L = η0 β u_e²/k, ≥ 0, with β the temperature coefficient of viscosity and k the
        conductivity of the oil.

    Returns
    -------
    float
        φ_T [-], above 0, at most 1.

    Notes
    -----
    A fit for line contacts of oils, quoted from the literature from memory (tag R); slip, which heats the inlet more,
    is left out, as is the small effect of load. Flooded inlet: in a starved one less oil turns back.

    References
    ----------
    The effect: Greenwood and Kauzlarich, J. Lubr. Technol. 95 (1973) 417, doi:10.1115/1.3451844.

    Examples
    --------
    >>> round(inlet_heating_factor(1.0), 6)
    0.909091
    """
    return 1.0 / (1.0 + 0.1 * loading**0.64)


class CorrectedFilm(NamedTuple):
    """A film law with factors on its thickness: h = starvation φ_T(u_e) h_base.

    Attributes
    ----------
    base : NamedTuple
        Any film law, prepared for the interface; not another `CorrectedFilm`, which kernels cannot nest.
    starvation : float
        Film thickness over that of a flooded contact [-], 0 to 1.
    loading : float
        L of `inlet_heating_factor` at 1 m/s [s²/m²]; 0 leaves heating out.
    """

    base: Any
    starvation: float
    loading: float


@jit_inline
def thickness(law, load, entrainment_speed):
    """H [m], ∂h/∂u_e [s] and ∂h/∂Q [m/N] at load Q [N] and u_e [m/s], both > 0."""
    height, by_speed, by_load = film_law.film_thickness(law.base, load, entrainment_speed)
    factor = law.starvation
    by_log_speed = 0.0
    if law.loading > 0.0:
        heating = inlet_heating_factor(law.loading * entrainment_speed * entrainment_speed)
        factor *= heating
        by_log_speed = -1.28 * (1.0 - heating)
    return factor * height, factor * (by_speed + by_log_speed * height / entrainment_speed), factor * by_load


@jit
def in_range(law, load, entrainment_speed):
    """Whether the law without the factors is in its range."""
    return film_law.film_in_range(law.base, load, entrainment_speed)


film_law.register_type(CorrectedFilm, thickness=thickness, in_range=in_range)


def prepare_film(name: str, interface: Interface, *, starvation: float = 1.0, inlet_heating: bool = False) -> Any:
    """The film law called `name`, prepared for an interface, with the chosen factors.

    Parameters
    ----------
    name : str
        Name of a registered law, the user's own among them. What is outside its range whatever load and speed,
        `film_range_notes`, goes by this name and does not change.
    interface : Interface
    starvation : float
        Film thickness over that of a flooded contact [-], above 0 and at most 1.
    inlet_heating : bool
        Whether shear in the inlet thins the film.

    Returns
    -------
    NamedTuple
        The law itself where nothing is to be corrected, so that its kernels stay what they are; else `CorrectedFilm`.

    Raises
    ------
    InputError
        If there is no such law, or the starvation factor is outside its range.

    Examples
    --------
    >>> from macroslip import Bearing, Lubricant
    >>> from macroslip.roller.model import interfaces
    >>> inner, outer, cage = interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
    >>> starved = prepare_film("masjedi-khonsari", inner, starvation=0.7, inlet_heating=True)
    >>> flooded = prepare_film("masjedi-khonsari", inner)
    >>> height = film_law.film_thickness(starved, 2e4, 0.4)[0]
    >>> round(height / film_law.film_thickness(flooded, 2e4, 0.4)[0], 4)
    0.6914
    """
    if not 0.0 < starvation <= 1.0:
        raise InputError(
            f"the starvation factor is {starvation!r}",
            where="starvation",
            allowed="a number above 0 and at most 1",
            remedy="It is film thickness over that of a flooded contact; 1 means flooded",
        )
    base = film_law.prepare(name, interface)
    if starvation == 1.0 and not inlet_heating:
        return base
    oil = interface.lubricant
    loading = oil.viscosity * oil.temperature_viscosity / oil.thermal_conductivity if inlet_heating else 0.0
    return CorrectedFilm(base, float(starvation), loading)
