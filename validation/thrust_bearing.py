"""Friction torque of a cylindrical roller thrust bearing, from the program's own contact.

The washers turn at Ω and stand, the cage turns at Ω/2. At both washers a roller rolls with u = Ω R/2, and away from its
middle slips with v(ζ) = (Ω/2) ζ, whatever the oil: the geometry imposes it. With P the power of sliding in one contact and
F_R the rolling resistance of each surface the torque is (2 Z P + 4 Z F_R u)/Ω.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from macroslip import Lubricant
from macroslip.contact.asperities import FULL_SLIP, asperity_share
from macroslip.contact.film import inlet_heating_factor, masjedi_khonsari_moes, thermal_loading
from macroslip.contact.hertz import HertzContact, effective_modulus, elliptical_contact
from macroslip.contact.interface import Interface
from macroslip.contact.rolling import inlet_heating_of_rolling, line_rolling
from macroslip.contact.traction import Fluid, chord_stress

STEEL = effective_modulus(210e9, 0.3, 210e9, 0.3)
#: Share of the middle slice's load that stands for an ellipse, see `macroslip.contact.rolling`.
_SLICE = math.pi**2 / 16.0
_PLACES, _WEIGHTS = (0.5 * gauss for gauss in np.polynomial.legendre.leggauss(24))
_PLACES = _PLACES + 0.5


class ThrustBearing(NamedTuple):
    """A cylindrical roller thrust bearing in SI units.

    Attributes
    ----------
    rollers : int
        Z.
    length, diameter : float
        Of a roller, where it carries [m].
    pitch_radius : float
        R [m].
    crowned : bool
        Whether the contact is an ellipse that just reaches the roller's ends, or straight with one pressure all along.
    roughness : float
        Composite RMS roughness [m].
    boundary_friction : float
        µ_b [-].
    """

    rollers: int
    length: float
    diameter: float
    pitch_radius: float
    crowned: bool
    roughness: float
    boundary_friction: float


class Torque(NamedTuple):
    """Parts of a friction torque [N m]."""

    sliding: float
    rolling: float

    @property
    def total(self) -> float:
        """Sum of both."""
        return self.sliding + self.rolling


def interface_of(bearing: ThrustBearing, load: float, oil: Lubricant) -> Interface:
    """Contact of one roller under its load [N]; the coefficients of a straight one hold at this load alone."""
    radius, half, root = 0.5 * bearing.diameter, 0.5 * bearing.length, load ** (1.0 / 3.0)
    if bearing.crowned:

        def reach(log_curvature: float) -> float:
            hertz = elliptical_contact(1.0 / radius, math.exp(log_curvature), STEEL)
            return math.log(hertz.semi_axis_across * root / half)

        hertz = elliptical_contact(1.0 / radius, math.exp(brentq(reach, -16.0, 4.0)), STEEL)
    else:
        per_length = load / bearing.length
        along = math.sqrt(8.0 * per_length * radius / (math.pi * STEEL))
        pressure = 2.0 * per_length / (math.pi * along)
        # The program takes 3Q/(4a) for the load per length.
        hertz = HertzContact(0.75 * bearing.length / root, along / root, pressure / root, math.nan)
    return Interface("washer", hertz, radius, STEEL, bearing.roughness, 7e9, oil)


def friction_torque(
    bearing: ThrustBearing,
    oil: Lubricant,
    fluid: Fluid,
    thrust: float,
    speed: float,
    rolling: str = "whole-film",
) -> Torque:
    """Friction torque of the bearing.

    Parameters
    ----------
    bearing : ThrustBearing
    oil : Lubricant
        At its temperature; the inlets are flooded, and heated by their shear.
    fluid : Fluid
        Its sheared film, from `macroslip.contact.traction.prepare_fluid`.
    thrust : float
        [N].
    speed : float
        Ω [rad/s], above zero.
    rolling : str
        Law of rolling resistance, `whole-film` or `inlet`.
    """
    load = thrust / bearing.rollers
    contact = interface_of(bearing, load, oil)
    half, mean_speed = 0.5 * bearing.length, 0.5 * speed * bearing.pitch_radius
    root, radius = load ** (1.0 / 3.0), contact.rolling_radius
    warming = thermal_loading(contact.lubricant) * mean_speed**2
    film = float(masjedi_khonsari_moes(contact, load, mean_speed) * inlet_heating_factor(warming))
    share = float(asperity_share("masjedi-khonsari", contact, load, mean_speed, film))

    profile = np.sqrt(1.0 - _PLACES**2) if bearing.crowned else np.ones_like(_PLACES)
    slip = 0.5 * speed * half * _PLACES
    stress = chord_stress(fluid, contact.hertz.pressure * root * profile, film, slip)
    sheared = (
        4.0 * half * contact.hertz.semi_axis_along * root * _WEIGHTS @ (profile * stress * slip)
    )
    per_length = (1.5 if bearing.crowned else 1.0) * load / bearing.length * profile**2
    rubbed = 2.0 * half * _WEIGHTS @ (per_length * slip * np.minimum(slip / FULL_SLIP, 1.0))
    power = (1.0 - share) * sheared + share * bearing.boundary_friction * rubbed

    doubled = 2.0 * oil.viscosity * mean_speed / (STEEL * radius)
    middle = (1.5 * _SLICE if bearing.crowned else 1.0) * load / bearing.length
    groups = (
        middle / (STEEL * radius * math.sqrt(doubled)),
        oil.pressure_viscosity * STEEL * doubled**0.25,
    )
    resistance = (
        bearing.length * STEEL * radius * doubled**0.75 * float(line_rolling(rolling, *groups))
    )
    resistance *= float(inlet_heating_of_rolling(warming))
    count = bearing.rollers
    return Torque(2.0 * count * power / speed, 4.0 * count * resistance * mean_speed / speed)


class Published(NamedTuple):
    """The SKF form of a thrust bearing's torque in the catalogue's units.

    Attributes
    ----------
    bore, outside : float
        [mm].
    rolling, rolling_diameter, rolling_load : float
        R1 and the powers of d_m and F_a.
    sliding, sliding_diameter, sliding_load : float
        S1 and its powers.
    type_factor : float
        K_Z.
    """

    bore: float
    outside: float
    rolling: float
    rolling_diameter: float
    rolling_load: float
    sliding: float
    sliding_diameter: float
    sliding_load: float
    type_factor: float

    def sliding_of_unit(self, thrust: float) -> float:
        """G_sl, torque of sliding with a coefficient of one [N m]."""
        return (
            1e-3
            * self.sliding
            * (0.5 * (self.bore + self.outside)) ** self.sliding_diameter
            * thrust**self.sliding_load
        )

    def torque(
        self, boundary: float, film: float, viscosity: float, thrust: float, turns: float
    ) -> Torque:
        """What was measured, rebuilt: φ_ish φ_rs M_rr + G_sl [φ_bl µ_bl + (1 − φ_bl) µ_EHL].

        ν in mm²/s, thrust in N, speed in r/min; low oil bath. The torque that was measured is the sum, which does not
        depend on how the authors divided it.
        """
        middle, flow = 0.5 * (self.bore + self.outside), viscosity * turns
        heating = 1.0 / (1.0 + 1.84e-9 * (turns * middle) ** 1.28 * viscosity**0.64)
        shape = (self.bore + self.outside) * math.sqrt(
            self.type_factor / (2.0 * (self.outside - self.bore))
        )
        rolling = (
            self.rolling * middle**self.rolling_diameter * thrust**self.rolling_load * flow**0.6
        )
        share = math.exp(-2.6e-8 * flow**1.4 * middle)
        sliding = self.sliding_of_unit(thrust) * (share * boundary + (1.0 - share) * film)
        return Torque(sliding, 1e-3 * heating * math.exp(-3e-8 * flow * shape) * rolling)


#: Constants of the SKF model, tag V: cylindrical roller thrust bearings and ball thrust bearings.
ROLLER_81107 = Published(35.0, 52.0, 2.25e-6, 2.38, 0.31, 0.154, 0.62, 1.0, 4.4)
BALL_51107 = Published(35.0, 52.0, 1.03e-6, 1.83, 0.54, 1.6e-2, 0.05, 4.0 / 3.0, 3.8)
