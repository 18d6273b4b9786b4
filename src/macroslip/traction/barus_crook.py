"""The paper's traction law: a Newtonian Barus film with Crook's shear heating, integrated over the Hertz ellipse."""

from __future__ import annotations

import math
from typing import NamedTuple

from macroslip.compiled import jit, jit_inline
from macroslip.contact.interface import Interface
from macroslip.traction.patch_integral import patch_of
from macroslip.traction.traction_law import register_type

#: √B at which Crook's shear stress peaks (B = 2.2767).
_ROOT_HEATING_AT_PEAK = 1.5088


class BarusCrook(NamedTuple):
    """The law for one interface.

    Attributes
    ----------
    conductance : float
        2π a b η0 per Q^(2/3) [N^(1/3) s]: force per slip at unit film, without the patch integral.
    pressure_exponent : float
        P = α_p p0 per Q^(1/3) [N^(-1/3)].
    heating : float
        √(β η0/(8k)) [s/m], so that q0 = heating·|Δu|.
    """

    conductance: float
    pressure_exponent: float
    heating: float


def prepare(interface: Interface) -> BarusCrook:
    """The law for an interface of given Hertz coefficients and lubricant."""
    hertz, lubricant = interface.hertz, interface.lubricant
    area = 2.0 * math.pi * hertz.semi_axis_across * hertz.semi_axis_along
    heating = lubricant.temperature_viscosity * lubricant.viscosity / (8.0 * lubricant.thermal_conductivity)
    return BarusCrook(
        conductance=area * lubricant.viscosity,
        pressure_exponent=lubricant.pressure_viscosity * hertz.pressure,
        heating=math.sqrt(heating),
    )


@jit_inline
def traction(law, load, film_thickness, slip):
    """F [N], ∂F/∂Δu [N s/m], ∂F/∂h [N/m] and ∂F/∂Q [-] at Q > 0 [N], h > 0 [m] and Δu [m/s]; F has the sign of Δu."""
    # A power takes as long as both, and film formulas need the logarithm too.
    root_load = math.exp(math.log(load) * (1.0 / 3.0))
    exponent = law.pressure_exponent * root_load
    patch, by_log_slip, by_exponent = patch_of(exponent, law.heating * abs(slip))
    viscous = law.conductance * root_load * root_load / film_thickness
    force = viscous * patch * slip
    by_load = (2.0 / 3.0) * force / load + viscous * slip * by_exponent * exponent / (3.0 * load)
    return force, viscous * (patch + by_log_slip), -force / film_thickness, by_load


@jit
def rising_slip(law, load, film_thickness):
    """|Δu| [m/s] at which the middle of the contact, its hottest point, reaches the peak of Crook's stress."""
    return _ROOT_HEATING_AT_PEAK / law.heating * math.exp(-0.5 * law.pressure_exponent * load ** (1.0 / 3.0))


register_type(BarusCrook, traction=traction, rising_slip=rising_slip, lanes=True)
