"""Laws of the rolling resistance of one contact, chosen by name, and their numbers for one interface.

`macroslip.rolling.resistance` has the equations.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from macroslip.contact.interface import Interface
from macroslip.errors import InputError
from macroslip.rolling import biboulet_houpert, goksem_hargreaves
from macroslip.rolling.biboulet_houpert import starvation_factor
from macroslip.rolling.elastic_line import InletFilm, WholeFilm
from macroslip.rolling.gap import Gap, GapShape, prepare_gap
from macroslip.rolling.martin import ROLLING_AT_GAP, starved_martin

#: What `rolling:` may be, and what to cite for it.
REFERENCES = {
    "none": "",
    "inlet": f"{goksem_hargreaves.REFERENCE}; {biboulet_houpert.REFERENCE}",
    "whole-film": "full solutions of the line contact, benchmarks/line_contact.py",
}
_ELASTIC = {"inlet": InletFilm(), "whole-film": WholeFilm()}


class NoRolling(NamedTuple):
    """A contact without rolling resistance."""


class Rolling(NamedTuple):
    """Rolling resistance of one contact.

    Attributes
    ----------
    elastic : InletFilm or WholeFilm
        What counts of an elastic film.
    gap : Gap
        The rigid gap, with its fullness.
    viscosity : float
        η0 [Pa s].
    log_load : float
        ln M of the middle slice at 1 N and 1 m/s; M goes with Q^(2/3) u^(−½).
    log_material : float
        ln L at 1 m/s; L goes with u^¼.
    log_film : float
        ln of R (2U)^½ at 1 m/s [ln m].
    log_scale : float
        ln of 2a E' R (2U)^¾ at 1 N and 1 m/s [ln N]; it goes with Q^(1/3) u^¾.
    loading : float
        Thermal loading parameter η0 β u²/k at 1 m/s [s²/m²]; 0 leaves heating out.
    log_starvation : float
        ln of the factor of a starved inlet.
    beside : float
        2 · 4.601 φ η0 √(2 R_x R_y) [N s/m], less where the inlet is starved.
    double_lateral : float
        2 R_y [m].
    half_length : float
        l/2 [m].
    across : float
        a per Q^(1/3) [m/N^(1/3)].
    area : float
        π a b per Q^(2/3) [m²/N^(2/3)].
    share_1, share_2 : float
        R/R_1 of the roller and R/R_2 of its counterpart; their sum is 1.
    """

    elastic: Any
    gap: Gap
    viscosity: float
    log_load: float
    log_material: float
    log_film: float
    log_scale: float
    loading: float
    log_starvation: float
    beside: float
    double_lateral: float
    half_length: float
    across: float
    area: float
    share_1: float
    share_2: float


def prepare_rolling(
    name: str,
    interface: Interface,
    shape: GapShape,
    roller_radius: float,
    *,
    fullness: float = 1.0,
    inlet_film: float = math.inf,
    heating: bool = True,
) -> NoRolling | Rolling:
    """Rolling resistance of a contact.

    Parameters
    ----------
    name : str
        `none`, `inlet` (as published: the inlet alone) or `whole-film` (inlet and exit).
    interface : Interface
    shape : GapShape
        Geometry of the gap.
    roller_radius : float
        [m].
    fullness : float
        Share of the length over which the gap of a light contact holds oil, see `gap`.
    inlet_film : float
        S, the gap where the inlet begins to be full over the film, > 1; infinite where flooded. The elastic contact
        takes Biboulet and Houpert's factor, the rigid one `martin.starved_martin`.
    heating : bool
        Whether the elastic inlet is heated by its shear.

    Raises
    ------
    InputError
        If there is no such law, or a value is out of range.
    """
    if name not in REFERENCES:
        raise InputError(
            f"there is no rolling law '{name}'",
            where="laws.rolling",
            allowed=", ".join(REFERENCES),
            remedy="Choose one of these",
        )
    if name == "none":
        return NoRolling()
    radius, modulus, oil = interface.rolling_radius, interface.modulus, interface.lubricant
    across = interface.hertz.semi_axis_across
    doubled = 2.0 * oil.viscosity / (modulus * radius)
    return Rolling(
        elastic=_ELASTIC[name],
        gap=prepare_gap(shape, fullness, inlet_film),
        viscosity=oil.viscosity,
        log_load=math.log(0.75 / across / (modulus * radius)) - 0.5 * math.log(doubled),
        log_material=math.log(oil.pressure_viscosity * modulus) + 0.25 * math.log(doubled),
        log_film=math.log(radius) + 0.5 * math.log(doubled),
        log_scale=math.log(2.0 * across * modulus * radius) + 0.75 * math.log(doubled),
        loading=oil.viscosity * oil.temperature_viscosity / oil.thermal_conductivity if heating else 0.0,
        log_starvation=math.log(float(starvation_factor(inlet_film))),
        beside=2.0
        * ROLLING_AT_GAP
        * fullness
        * starved_martin(inlet_film)[1]
        * oil.viscosity
        * math.sqrt(2.0 * shape.rolling_radius * shape.lateral_radius),
        double_lateral=2.0 * shape.lateral_radius,
        half_length=0.5 * shape.length,
        across=across,
        area=math.pi * across * interface.hertz.semi_axis_along,
        share_1=radius / roller_radius,
        share_2=1.0 - radius / roller_radius,
    )
