"""Masjedi and Khonsari's central film thickness of a rough line contact."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.film.film_law import register

#: Ranges of the dimensionless groups in which the formula was fitted.
RANGES = {
    "load": (2e-5, 5e-4),
    "speed": (1e-12, 1e-10),
    "material": (2500.0, 7500.0),
    "roughness": (0.0, 5e-5),
    "hardness": (0.005, 0.03),
}
#: Logarithm of what a smooth surface adds to the film, as part of it: nothing, though still a number.
_NO_ROUGHNESS = -600.0
_LEAST_LOAD_CUBED, _MOST_LOAD_CUBED = (limit**3 for limit in RANGES["load"])


@jit
def masjedi_khonsari(load, speed, material, roughness, hardness):
    """Dimensionless central film thickness H = h/R of a rough line contact.

    H = 2.691 W^−0.135 U^0.705 G^0.556 (1 + 0.2 σ^1.222 V^0.223 W^−0.229 U^−0.748 G^−0.842)

    Parameters
    ----------
    load : float
        W = w/(E'R) with w the load per length, range 2e-5 to 5e-4.
    speed : float
        U = η0 u_e/(E'R), range 1e-12 to 1e-10.
    material : float
        G = α_p E', range 2500 to 7500.
    roughness : float
        σ = σ_rms/R, range 0 to 5e-5.
    hardness : float
        V = v/E', range 0.005 to 0.03.

    Returns
    -------
    float
        H [-].

    References
    ----------
    Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514.

    Examples
    --------
    >>> round(masjedi_khonsari(1e-4, 1e-11, 4846.0, 0.0, 0.03) * 1e5, 4)
    1.8365
    """
    smooth = 2.691 * load**-0.135 * speed**0.705 * material**0.556
    rough = 0.2 * roughness**1.222 * hardness**0.223 * load**-0.229 * speed**-0.748 * material**-0.842
    return smooth * (1.0 + rough)


class MasjediKhonsari(NamedTuple):
    """The formula for one interface: logarithms of what does not change, and the groups per unit load and speed."""

    log_smooth: float
    log_rough: float
    load_group: float
    speed_group: float


def prepare(interface: Interface) -> MasjediKhonsari:
    """The formula for an elliptical contact, through the equivalent line contact w = 3Q/(4a).

    Of all equivalent lengths only this keeps both the maximum pressure and the width along rolling.
    """
    radius, modulus, lubricant = interface.rolling_radius, interface.modulus, interface.lubricant
    load_group = 0.75 / interface.hertz.semi_axis_across / (modulus * radius)
    speed_group = lubricant.viscosity / (modulus * radius)
    material = lubricant.pressure_viscosity * modulus
    roughness = interface.roughness / radius
    hardness = interface.hardness / modulus
    smooth = 2.691 * load_group**-0.135 * speed_group**0.705 * material**0.556
    rough = 0.2 * roughness**1.222 * hardness**0.223 * load_group**-0.229 * speed_group**-0.748 * material**-0.842
    return MasjediKhonsari(
        math.log(radius * smooth), math.log(rough) if rough > 0.0 else _NO_ROUGHNESS, load_group, speed_group
    )


@jit_inline
def thickness(law, load, entrainment_speed):
    """H [m], ∂h/∂u_e [s] and ∂h/∂Q [m/N] at load Q [N] and u_e [m/s], both > 0, whether in range or not.

    Where roughness dominates, h hardly depends on speed and even falls with it, as U^−0.043.
    """
    log_load = math.log(load) * (2.0 / 3.0)
    log_speed = math.log(entrainment_speed)
    smooth = math.exp(law.log_smooth - 0.135 * log_load + 0.705 * log_speed)
    rough = math.exp(law.log_rough - 0.229 * log_load - 0.748 * log_speed)
    height = smooth * (1.0 + rough)
    share = rough / (1.0 + rough)
    by_speed = height / entrainment_speed * (0.705 - 0.748 * share)
    by_load = height / load * (2.0 / 3.0) * (-0.135 - 0.229 * share)
    return height, by_speed, by_load


@jit
def in_range(law, load, entrainment_speed):
    """Whether W and U are in `RANGES`; the groups that do not change with load and speed are not judged here."""
    # W goes with Q^(2/3); its cube needs no root.
    cube = law.load_group * law.load_group * law.load_group * load * load
    u = law.speed_group * entrainment_speed
    return _LEAST_LOAD_CUBED <= cube <= _MOST_LOAD_CUBED and 1e-12 <= u <= 1e-10


def range_notes(interface: Interface) -> list[str]:
    """The groups that load and speed do not change, where they are outside `RANGES`."""
    groups = {
        "material": interface.lubricant.pressure_viscosity * interface.modulus,
        "roughness": interface.roughness / interface.rolling_radius,
        "hardness": interface.hardness / interface.modulus,
    }
    outside = {name: value for name, value in groups.items() if not RANGES[name][0] <= value <= RANGES[name][1]}
    return [
        f"the {name} group {value:.4g} is outside {RANGES[name][0]:g} to {RANGES[name][1]:g}"
        for name, value in outside.items()
    ]


register(
    "masjedi-khonsari",
    MasjediKhonsari,
    reference="Masjedi and Khonsari, J. Tribol. 134 (2012) 011503, doi:10.1115/1.4005514",
    prepare=prepare,
    thickness=thickness,
    in_range=in_range,
    range_notes=range_notes,
    lanes=True,
)
