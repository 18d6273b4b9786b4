"""Traction, film and oil of a roller's line contact, summed over strips across its axis.

The roller, tapered or cylindrical, is pressed on its raceway by q(ζ) = c (δ − P(ζ))^n per length,
with the logarithmic profile P, or P = 0 of a straight cylindrical roller; ζ counts from its middle
to its large end. It is taken as aligned with the ring: tilt moves load along the roller, on which
traction and film depend little. Both surfaces are cones with one apex, or cylinders, so that nothing
slides along the line but for the profile and for slip of the whole roller:

    v(ζ) = Δu (1 + ζ/A − P/(2r)) + u2 κ P(ζ)/2,

with A the distance of the apex, infinite for a cylinder, r the roller's radius at its middle and κ
the curvature sum there; the interface lies midway between roller and raceway. Each strip is a chord of pressure √(1 − x²/b²)
with film and asperities of its own load and speed. What its stress does to the roller's spin goes
with its radius, and what it does to the orbit with the radius of the ring there, both (1 + ζ/A).

Film laws and shares of asperities are those of ellipses, which take w = 3Q/(4a): a strip is given to
them as the ellipse whose w is its q.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.bearing.profile import LOGARITHMIC, profile_depth
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.compiled import jit
from macroslip.contact.chords import chord_stress_at, film_node
from macroslip.contact.hertz import HertzContact, effective_modulus
from macroslip.contact.laws import PreparedContact
from macroslip.contact.line import (
    PALMGREN_EXPONENT,
    half_width,
    line_pressure,
    palmgren_coefficient,
)
from macroslip.contact.line_approach import line_approaches, line_load
from macroslip.contact.line_rolling import raceway_curvatures
from macroslip.contact.patch import graded_rule
from macroslip.contact.rolling import LOG_SLICE, RollingNumbers, light_contact
from macroslip.contact.traction import ChordTable, chord_table

#: Load of a roller for which the ellipse stands that has the pressure, the width and the approach of
#: a line contact [N].
REFERENCE_LOAD = 1e5
#: Load per length for which that ellipse stands at a cylindrical roller of any size [N/m].
REFERENCE_LOAD_PER_LENGTH = 1e6
#: Nodes of each of the three pieces of a line between its ends and its stations of pure rolling.
_NODES, _WEIGHTS = graded_rule(12)
#: Iterations for a station of pure rolling; each is exact but for the taper.
_ITERATIONS = 4


class Strips(NamedTuple):
    """Geometry of a line contact."""

    length: float  #: L, effective [m]
    depth: float  #: d of the profile P = d ln 1/(1 − (2ζ/L)²) [m]; 0 of a straight roller
    coefficient: float  #: c of q = c (δ − P)^n, n = 10/9 [N/m^(1+n)]
    curvature: float  #: κ, sum of both bodies' curvatures in the plane of rolling [1/m]
    modulus: float  #: Effective modulus E' [Pa]
    radius: float  #: r at the roller's middle [m]
    #: 1/A [1/m], reciprocal of the distance of the apex along the roller's axis
    taper: float

    def profile(self, station):
        """Drop P of the contour at stations ζ [m]."""
        relative = 2.0 * np.asarray(station) / self.length
        square = np.minimum(relative * relative, 1.0 - 1e-15)
        return -self.depth * np.log1p(-square)

    def load_per_length(self, approach):
        """Load per length q [N/m] of a strip that is pressed by δ − P ≥ 0 [m]."""
        return self.coefficient * np.asarray(approach) ** PALMGREN_EXPONENT

    def reach(self, drop):
        """Station ζ ≥ 0 up to which the profile drops by less than P ≥ 0 [m]."""
        half = 0.5 * self.length
        if self.depth == 0.0:
            return half * np.greater(drop, 0.0)
        square = -np.expm1(-np.asarray(drop) / self.depth)
        return half * np.sqrt(square)


def strips_of(bearing: Bearing | TaperedBearing) -> tuple[Strips, Strips]:
    """Line contacts of a roller with inner and outer raceway.

    Parameters
    ----------
    bearing : Bearing or TaperedBearing
        Tapered, or cylindrical with a `roller_profile`.

    Returns
    -------
    inner, outer : Strips
    """
    depth = profile_depth(bearing.roller_diameter)
    if isinstance(bearing, TaperedBearing):
        row = tapered_geometry(bearing)
        curvatures = raceway_curvatures(row)
        radius = row.roller_radius
        taper = 1.0 / row.apex_distance
    else:
        curvatures = (
            geometry.inner_curvatures(bearing).rolling,
            geometry.outer_curvatures(bearing).rolling,
        )
        radius = geometry.roller_radius(bearing)
        taper = 0.0
        if bearing.roller_profile != LOGARITHMIC:
            depth = 0.0
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    inner, outer = (
        Strips(
            length=bearing.roller_length,
            depth=depth,
            coefficient=palmgren_coefficient(bearing.roller_length),
            curvature=curvature,
            modulus=modulus,
            radius=radius,
            taper=taper,
        )
        for curvature in curvatures
    )
    return inner, outer


def strip_approach(strips: Strips, load) -> np.ndarray:
    """Approach δ of an aligned roller [m] under loads Q [N], without profile; 0 where Q is not above 0.

    Examples
    --------
    >>> from macroslip.contact.line import palmgren_coefficient
    >>> line = Strips(0.107, 2.17e-5, palmgren_coefficient(0.107), 34.8, 230.8e9, 0.031, 1.23)
    >>> round(1e6 * float(strip_approach(line, 1e5)), 1)
    40.0
    """
    load = np.asarray(load, dtype=float)
    stiffness = strips.coefficient * strips.length
    # Of ring, roller and ring each contact takes half.
    both = line_approaches(stiffness, strips.depth, load.ravel())
    return 0.5 * both.reshape(load.shape)


def middle_load(strips: Strips, load) -> np.ndarray:
    """Load per length of the middle strip [N/m] under loads Q [N] of an aligned roller."""
    return strips.load_per_length(strip_approach(strips, load))


def equivalent_ellipse(strips: Strips, load: float = REFERENCE_LOAD) -> HertzContact:
    """Ellipse with the pressure, width and approach of a line contact at a load [N].

    It gives film laws, which take ellipses, the right load per length and pressure at every load.
    """
    approach = float(strip_approach(strips, load))
    largest = float(strips.load_per_length(approach))
    width = float(half_width(largest, strips.curvature, strips.modulus))
    pressure = float(line_pressure(largest, strips.curvature, strips.modulus))
    root = load ** (1.0 / 3.0)
    return HertzContact(
        semi_axis_across=0.75 * load / largest / root,
        semi_axis_along=width / root,
        pressure=pressure / root,
        approach=approach / root**2,
    )


def ellipse_load(hertz: HertzContact, per_length):
    """Load of the ellipse whose w = 3Q/(4a) is a load per length [N], at loads per length [N/m]."""
    return (per_length * hertz.semi_axis_across / 0.75) ** 1.5


def load_at_pressure(strips: Strips, pressure: float) -> float:
    """Load [N] at which an aligned roller's largest pressure is the given one [Pa].

    Examples
    --------
    >>> from macroslip.contact.line import palmgren_coefficient
    >>> line = Strips(0.107, 2.17e-5, palmgren_coefficient(0.107), 34.8, 230.8e9, 0.031, 1.23)
    >>> round(load_at_pressure(line, 1.637e9) / 1e3)
    174
    """
    curved_modulus = strips.curvature * strips.modulus
    per_length = 2.0 * math.pi * pressure**2 / curved_modulus
    approach = (per_length / strips.coefficient) ** (1.0 / PALMGREN_EXPONENT)
    stiffness = strips.coefficient * strips.length
    return float(line_load(stiffness, strips.depth, 2.0 * approach).load)


class StripTraction(NamedTuple):
    """Traction of a line contact in many states, arrays of one shape."""

    pull: np.ndarray  #: ∫τ (1 + ζ/A) dA [N], with the sign of the slip
    lag: np.ndarray  #: ∫τ P/(2r) dA [N]
    skew: np.ndarray  #: ∫τ ζ dA [N m]
    asperity_power: np.ndarray  #: Power that asperities dissipate [W]


class StripStates(NamedTuple):
    """Load, film and slip of strips, arrays of one shape."""

    per_length: np.ndarray  #: q, load per length [N/m]
    film: np.ndarray  #: Film thickness [m]
    share: np.ndarray  #: Asperities' share of the load [-]
    slip: np.ndarray  #: v, positive where the ring is faster [m/s]
    half_width: np.ndarray  #: b [m]
    pressure: np.ndarray  #: Largest pressure of the strip's chord [Pa]


@dataclass(frozen=True)
class PreparedStrips(PreparedContact):
    """The laws of a line contact of a roller with a raceway."""

    strips: Strips  #: Geometry of the line contact

    def _middle(self, load):
        """Load of the ellipse that stands for the middle strip under loads Q > 0 [N]."""
        return ellipse_load(self.interface.hertz, middle_load(self.strips, load))

    def film_thickness(self, load, entrainment_speed) -> np.ndarray:
        """Film thickness of the middle strip [m], at Q > 0 [N] and u_e [m/s]."""
        return super().film_thickness(self._middle(load), entrainment_speed)

    def film_in_range(self, load, entrainment_speed) -> np.ndarray:
        """Whether the film law is in its range at the middle strip."""
        return super().film_in_range(self._middle(load), entrainment_speed)

    def asperity_share(self, load, entrainment_speed, film_thickness) -> np.ndarray:
        """Share of the middle strip's load that asperities carry [-]."""
        return super().asperity_share(self._middle(load), entrainment_speed, film_thickness)

    def asperity_share_in_range(self, load) -> np.ndarray:
        """True where the law of asperities holds at the middle strip."""
        return super().asperity_share_in_range(self._middle(load))

    def tractions(self, load, ring_speed, slip) -> StripTraction:
        """Traction by the laws, at loads Q > 0 [N], u2 and Δu of either sign [m/s], of one shape."""
        reach, approach = self._reach(load)
        station, weight = self._stations(reach, ring_speed, slip)
        of_contact = (approach, np.asarray(ring_speed), np.asarray(slip))
        strip = self.strip_states(station, *(values[..., None, None] for values in of_contact))
        local = strip.slip
        stress = _stresses(
            chord_table(self.fluid),
            *(values.ravel() for values in (strip.pressure, strip.film, np.abs(local))),
        ).reshape(local.shape)
        carried = self.boundary_friction * strip.share * strip.per_length
        saturation = np.clip(local / self.full_slip, -1.0, 1.0)
        rough = carried * saturation * weight
        sheared = (1.0 - strip.share) * 2.0 * strip.half_width * stress
        force = sheared * np.copysign(weight, local) + rough
        growth, half_drop = self._cone_and_drop(station)
        axes = (-2, -1)
        return StripTraction(
            (force * growth).sum(axis=axes),
            (force * half_drop).sum(axis=axes),
            (force * station).sum(axis=axes),
            (rough * local).sum(axis=axes),
        )

    def _reach(self, load) -> tuple[np.ndarray, np.ndarray]:
        """Half of the length that touches, and approach [m]."""
        approach = strip_approach(self.strips, np.asarray(load, dtype=float))
        return self.strips.reach(approach), approach

    def strip_states(self, station, approach, ring_speed, slip) -> StripStates:
        """Load, film and slip of strips, of arrays that broadcast.

        Parameters
        ----------
        station : ndarray
            Stations ζ from the roller's middle to its large end [m].
        approach : ndarray
            Approach δ of roller and raceway without profile [m].
        ring_speed, slip : ndarray
            u2 and Δu of the roller's middle, of either sign [m/s].

        Returns
        -------
        StripStates
        """
        strips = self.strips
        growth, half_drop = self._cone_and_drop(station)
        pressed = np.maximum(approach - strips.profile(station), 1e-15)
        per_length = strips.load_per_length(pressed)
        entrainment = np.abs(ring_speed - 0.5 * slip) * growth
        ellipse = ellipse_load(self.interface.hertz, per_length)
        film = super().film_thickness(ellipse, entrainment)
        share = super().asperity_share(ellipse, np.maximum(entrainment, 1e-12), film)
        rolling = ring_speed * strips.curvature * strips.radius
        return StripStates(
            per_length=per_length,
            film=film,
            share=share,
            slip=slip * (growth - half_drop) + rolling * half_drop,
            half_width=half_width(per_length, strips.curvature, strips.modulus),
            pressure=line_pressure(per_length, strips.curvature, strips.modulus),
        )

    def _cone_and_drop(self, station) -> tuple[np.ndarray, np.ndarray]:
        """1 + ζ/A and P/(2r) at stations [-]; slip that is the same all over has neither."""
        if not self.shape.microslip:
            return np.ones(station.shape), np.zeros(station.shape)
        half_drop = 0.5 * self.strips.profile(station) / self.strips.radius
        return 1.0 + station * self.strips.taper, half_drop

    def _stations(self, reach, ring_speed, slip) -> tuple[np.ndarray, np.ndarray]:
        """Stations [m] and weights [m] of a quadrature that is graded towards pure rolling.

        Of shape (..., 3, nodes): the three pieces end at the ends of the contact and at the stations
        of pure rolling, where a film that grips turns its stress.
        """
        strips = self.strips
        edges = [-reach, np.zeros_like(reach), np.zeros_like(reach), reach]
        if self.shape.microslip:
            rolling = 0.5 * strips.curvature * np.asarray(ring_speed, dtype=float)
            ratio = np.asarray(slip) / np.where(rolling == 0.0, 1e-30, rolling)
            for corner, side in ((1, -1.0), (2, 1.0)):
                station = np.zeros_like(reach)
                for _ in range(_ITERATIONS):
                    growth = 1.0 + station * strips.taper
                    drop = np.maximum(-ratio * growth, 0.0)
                    station = side * np.minimum(strips.reach(drop), reach)
                edges[corner] = station
        corners = np.stack(edges, axis=-1)
        lengths = np.diff(corners, axis=-1)[..., None]
        return corners[..., :-1, None] + lengths * _NODES, lengths * _WEIGHTS

    def light(self, load, mean_speed) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Sliding per slip, rolling resistance and film of the volume flow, as `light_contact` has them.

        The elastic contact has the length that touches, with the middle strip's load for its film
        and the mean load for its resistance; where it is light it is a rigid roller with a crown.
        """
        load, mean_speed = np.broadcast_arrays(np.asarray(load, dtype=float), mean_speed)
        reach, approach = self._reach(load)
        middle = self.strips.load_per_length(approach)
        at_middle = self._slender(load, reach, middle, 0.0)
        conductance, _, film = light_contact(at_middle, load, mean_speed)
        mean = 0.5 * load / reach
        at_mean = self._slender(load, reach, mean, LOG_SLICE)
        _, resistance, _ = light_contact(at_mean, load, mean_speed)
        return conductance, resistance, film

    def _slender(self, load, reach, per_length, slice_of_ellipse: float) -> RollingNumbers:
        """Numbers of an ellipse with the length, load per length and area of the line contact."""
        numbers = self.rolling
        assert numbers is not None, "the laws have no rolling resistance"
        log_root = np.log(load) / 3.0
        interface = self.interface
        unit = interface.modulus * interface.rolling_radius
        log_doubled = math.log(2.0 * interface.lubricant.viscosity / unit)
        log_load = np.log(per_length / unit) - 0.5 * log_doubled - 2.0 * log_root
        log_scale = np.log(2.0 * reach * unit) + 0.75 * log_doubled - log_root
        width = half_width(per_length, self.strips.curvature, self.strips.modulus)
        return numbers._replace(
            log_load=log_load - slice_of_ellipse,
            log_scale=log_scale,
            across=reach * np.exp(-log_root),
            area=4.0 * reach * width * np.exp(-2.0 * log_root),
        )


@jit
def _stresses(chords: ChordTable, pressure, film, slip):
    """Mean stress along chords [Pa], arrays of one length."""
    stress = np.empty(pressure.size)
    for n in range(pressure.size):
        node = film_node(chords, film[n])
        stress[n] = chord_stress_at(chords, node, pressure[n], slip[n])
    return stress
