"""A raceway contact whose slip has two components, as that of a skewed roller.

Forces and moments are integrals over the ellipse.

Axes and signs are those of `docs/frames.md`: x against the travel of a positive orbit, y' along the
contact normal outward, z' along the roller. The side k is −1 at the inner and +1 at the outer
raceway. The roller's axis is e = z' + ψ x − θ y', with the skew ψ about +y' and the tilt θ about
+x; its middle lies at δ along z'. A point of the contact has the station ζ along the roller,
counted from the roller's middle, and ξ along x. With the curvatures of the raceway κ_z along and
κ_x across, > 0 where it is hollow, and those of the gap C11 = 1/r − κ_x, C22 = 1/R_roller − κ_z:

* The middle of the ellipse lies at ζ_c = [−kθ + κ_z(δ + k r θ)]/C22. Its long axis is ξ = ε ζ with
  ε = ψ − (κ_z − κ_x) ψ/(C11 − C22): it turns less than the roller where the raceway is no sphere.
* Both surfaces lie half way between their contours: h = ζ²/(2 R_d) + C22 (ζ_c ζ/2 − ζ_c²/4) below
  the roller's largest radius, and h_w = h + k θ ζ below the raceway's middle.
* Slip, ring less roller, against −k x (as `slip` is counted) and along z', with Ω_r the ring's
  speed in the orbiting frame, ω the spin and s the row's axial sign:

      v = Δu + ω h − Ω_r cos α h_w − k s Ω_r sin α (ζ + δ + k r θ),
      w = −k ω ψ (r − h) − (s Ω_r sin α + ω θ) ξ.

Traction has the direction of slip, and its stress is that of the shear law at |(v, w)|.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.contact.asperities import FULL_SLIP
from macroslip.contact.interface import common_contour_radius
from macroslip.contact.kellstroem import SaturatingFriction, saturating_stress
from macroslip.contact.laws import PreparedContact
from macroslip.contact.patch import graded_rule
from macroslip.contact.traction import Fluid, local_stress

#: Stress [Pa] of a contact over pressure [Pa], film thickness [m], slip [m/s] and mean surface speed
#: [m/s], arrays above zero.
Shear = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]

_NODES, _WEIGHTS = graded_rule(10)
#: Cosines and sines of the places along a chord, and weights of ∫ sin²φ f dφ (Gauss and Chebyshev).
_ANGLES = np.pi * np.arange(1, 11) / 11.0
_COSINES = np.cos(_ANGLES)
_SINES = np.sin(_ANGLES)
_CHORD_WEIGHTS = np.pi / 11.0 * _SINES
#: Slip and pressure that stand for none [m/s], [Pa].
_NO_SLIP = 1e-30
_NO_PRESSURE = 1.0


class SkewedContact(NamedTuple):
    """A raceway contact of a roller that may be skewed."""

    laws: PreparedContact  #: For film and asperities
    shear: Shear  #: The stress, see `Shear`
    #: Slide-roll ratio at which the stress has a corner [-]; 0 if it has none.
    corner: float
    side: int  #: k, +1 at the outer and −1 at the inner raceway
    roller_radius: float  #: r [m]
    roller_contour: float  #: R_roller [m]
    raceway_radius: float  #: Distance of the contact from the bearing axis r~_k [m]
    half_length: float  #: Half the roller's length [m]
    along: float  #: κ_z of the raceway [1/m]
    across: float  #: κ_x of the raceway [1/m]
    sine: float  #: s sin α [-]
    cosine: float  #: cos α [-]

    @property
    def lateral(self) -> float:
        """C22 of the gap [1/m]."""
        return 1.0 / self.roller_contour - self.along

    @property
    def turn(self) -> float:
        """Angle by which the ellipse turns in the roller's frame, over the skew [-].

        It is 0 on a sphere.
        """
        rolling = 1.0 / self.roller_radius - self.across
        return -(self.along - self.across) / (rolling - self.lateral)

    def middle(self, tilt, shift):
        """ζ_c [m] at θ [rad] and δ [m]."""
        return (
            -self.side * tilt + self.along * (shift + self.side * self.roller_radius * tilt)
        ) / self.lateral


class Resultants(NamedTuple):
    """Forces and moments of a contact on the roller."""

    #: Moment of the tractions about the roller's axis over r [N]; positive where it drives the spin
    #: up.
    turning: np.ndarray
    pull: np.ndarray  #: Force of the tractions along −k x [N], with the sign of the slip
    axial: np.ndarray  #: Force of the tractions along z' [N]
    moment: np.ndarray  #: Moment of the tractions about +y' [N m]
    pressure_moment: np.ndarray  #: Moment of the pressure on the turned ellipse about +y' [N m]
    power: np.ndarray  #: Frictional power, ∫ τ·v dA [W]
    asperity_power: np.ndarray  #: Part of that power by asperities [W]
    ring_torque: np.ndarray  #: Torque of the tractions on the ring about Z0 [N m]


class SlipLines(NamedTuple):
    """Slip on the long axis of the ellipse, as polynomials of the station ζ.

    It is v0 + v1 ζ + v2 ζ² in rolling and w0 + w1 ζ + w2 ζ² along the roller. At ξ off that axis w
    is `per_xi` times ξ more.
    """

    v0: np.ndarray  #: [m/s]
    v1: np.ndarray  #: [1/s]
    v2: np.ndarray  #: [1/(m s)]
    w0: np.ndarray  #: [m/s]
    w1: np.ndarray  #: [1/s]
    w2: np.ndarray  #: [1/(m s)]
    per_xi: np.ndarray  #: [1/s]


def film_shear(fluid: Fluid) -> Shear:
    """The stress of a fluid's film."""
    return lambda pressure, film, slip, speed: local_stress(
        fluid, pressure, np.log(film), np.log(slip)
    )


def constant_friction(coefficient: float) -> Shear:
    """Shear stress in proportion to pressure, whatever film and slip.

    It is a reference, not a law of a lubricated contact.
    """
    return lambda pressure, film, slip, speed: coefficient * pressure + 0.0 * film * slip


def saturating_shear(friction: SaturatingFriction) -> Shear:
    """Kellström's friction, whatever the film."""
    return lambda pressure, film, slip, speed: saturating_stress(friction, pressure, slip, speed)


def skewed_contact(
    laws: PreparedContact, bearing: Bearing, axial_sign: int, shear: Shear | None = None
) -> SkewedContact:
    """Raceway contact of a roller that may be skewed.

    Parameters
    ----------
    laws : PreparedContact
        Laws of the inner or the outer raceway, with a sheared film or Kellström's friction.
    bearing : Bearing
        Its dimensions.
    axial_sign : int
        +1 for the downwind and −1 for the upwind row.
    shear : Shear, optional
        Stress without a corner in place of that of the laws.

    Returns
    -------
    SkewedContact
        Geometry and laws of the contact.

    Raises
    ------
    ValueError
        If there is neither a sheared film, nor Kellström's friction, nor `shear`.
    """
    inner = laws.name == "inner"
    side = -1 if inner else 1
    contact_radius = (
        geometry.inner_contact_radius(bearing) if inner else geometry.outer_contact_radius(bearing)
    )
    contour = (
        geometry.inner_raceway_contour_radius(bearing) if inner else bearing.outer_raceway_radius
    )
    corner = 0.0
    if shear is None and laws.friction is not None:
        shear = saturating_shear(laws.friction)
        corner = laws.friction.slide_roll_ratio
    elif shear is None:
        if laws.fluid is None:
            raise ValueError("a skewed contact needs the stress of a sheared film")
        shear = film_shear(laws.fluid)
    cosine = float(np.cos(bearing.contact_angle))
    return SkewedContact(
        laws, shear, corner, side, geometry.roller_radius(bearing), geometry.roller_contour_radius(bearing), contact_radius,
        0.5 * bearing.roller_length, 1.0 / contour, side * cosine / contact_radius,
        axial_sign * float(np.sin(bearing.contact_angle)), cosine,
    )  # fmt: skip


def slip_lines(contact: SkewedContact, ring_speed, slip, skew, shift, tilt) -> SlipLines:
    """Slip along the long axis of the contact ellipse, as polynomials of the station.

    Parameters
    ----------
    contact : SkewedContact
        The contact.
    ring_speed, slip : ndarray
        u2 and Δu at the middle of the roller [m/s].
    skew : ndarray
        ψ [rad].
    shift : ndarray
        ζ_c [m].
    tilt : ndarray
        θ [rad].

    Returns
    -------
    SlipLines
        Coefficients, of the shape to which the arguments broadcast.
    """
    k = contact.side
    r = contact.roller_radius
    spin = (ring_speed - slip) / r
    ring = k * ring_speed / contact.raceway_radius
    rim = 1.0 / common_contour_radius(contact.roller_contour, 1.0 / contact.along)
    offset = contact.lateral * shift
    aside = (offset + k * tilt) / contact.along  # δ + k r θ
    fall = spin - ring * contact.cosine
    turned = k * spin * skew
    per_xi = -(contact.sine * ring + spin * tilt)
    lean = contact.cosine * tilt + contact.sine
    sagitta = 0.25 * offset * shift
    return SlipLines(
        v0=slip - fall * sagitta - k * contact.sine * ring * aside,
        v1=0.5 * fall * offset - k * ring * lean,
        v2=0.5 * fall * rim,
        w0=-turned * (r + sagitta),
        w1=0.5 * turned * offset + per_xi * skew * (1.0 + contact.turn),
        w2=0.5 * turned * rim,
        per_xi=per_xi,
    )


def resultants(contact: SkewedContact, load, ring_speed, slip, skew, shift, tilt) -> Resultants:
    """Forces, moments and power of a contact by quadrature over its ellipse.

    The ellipse ends at the roller's ends. It is divided where v vanishes, and where the stress has
    a corner, and graded towards these lines, with 30 chords of 10 points each, 70 with a corner;
    against twice as many of either the net moments of both raceways are off by what
    `tests/contact/test_skewed.py` bounds. Film and asperities share the area as in
    `macroslip.contact.patch`.

    Parameters
    ----------
    contact : SkewedContact
        The contact.
    load : array_like
        Q [N], > 0.
    ring_speed, slip : array_like
        u2 ≠ 0 and Δu at the middle of the roller [m/s].
    skew : array_like
        ψ [rad].
    shift : array_like
        ζ_c [m].
    tilt : array_like
        θ [rad].

    Returns
    -------
    Resultants
        Arrays of the shape to which the arguments broadcast.

    Examples
    --------
    >>> from macroslip import Bearing, Laws, Lubricant
    >>> from macroslip.contact.laws import prepare
    >>> bearing = Bearing.read("skf-240-600-bc")
    >>> laws = prepare(Laws.physical(), bearing, Lubricant.read("vg460-pao"), 1)
    >>> rigid = skewed_contact(laws.outer, bearing, 1, constant_friction(0.05))
    >>> found = resultants(rigid, 5e4, -0.4, 0.0, 1.0, 0.0, 0.0)    # so far askew that all friction is axial
    >>> float(round(abs(found.axial) / 2500.0, 2))
    1.0
    """
    states = np.broadcast_arrays(
        *(np.asarray(values, dtype=float) for values in (load, ring_speed, slip, skew, shift, tilt))
    )
    shape = states[0].shape
    load, ring_speed, slip, skew, shift, tilt = (values.reshape(-1, 1, 1) for values in states)
    k = contact.side
    r = contact.roller_radius
    mean_speed = np.abs(ring_speed - 0.5 * slip)
    points = _points(
        contact,
        load,
        slip_lines(contact, ring_speed, slip, skew, shift, tilt),
        shift,
        mean_speed,
    )
    station = points.station
    turned = contact.turn * skew * station
    xi = points.chord + skew * station + turned
    speed = np.maximum(np.hypot(points.v, points.w), _NO_SLIP)
    film, rough = _stresses(
        contact, load, mean_speed, np.maximum(points.pressure, _NO_PRESSURE), speed
    )
    stress = film + rough
    part = stress * points.area / speed
    along = part * points.v
    axial = part * points.w
    moment = (along + axial * k * skew) * (r - points.drop) + axial * tilt * xi
    inclination = (1.0 / contact.roller_contour - 1.0 / r) * (points.chord + turned)

    def total(values: np.ndarray) -> np.ndarray:
        """Sum over the points of the contact, in the shape of the states."""
        return values.sum(axis=(1, 2)).reshape(shape)[()]

    return Resultants(
        turning=total(moment / r),
        pull=total(along),
        axial=total(axial),
        moment=total(-k * along * (station + k * r * tilt) - axial * xi),
        pressure_moment=total(points.area * points.pressure * inclination * station),
        power=total(stress * points.area * speed),
        asperity_power=total(rough * points.area * speed),
        ring_torque=total(
            -k * along * _distance(contact, points, tilt, shift) + axial * contact.sine * xi
        ),
    )


def _distance(contact: SkewedContact, points: _Points, tilt, shift) -> np.ndarray:
    """Distance of points of the contact from the bearing's axis [m]."""
    k = contact.side
    aside = (contact.lateral * shift + k * tilt) / contact.along  # δ + k r θ
    return (
        contact.raceway_radius
        - k * contact.cosine * (points.drop + k * tilt * points.station)
        - contact.sine * (points.station + aside)
    )


class _Points(NamedTuple):
    """Points of quadrature over a contact, arrays over states, chords and points of a chord."""

    station: np.ndarray  #: ζ [m]
    drop: np.ndarray  #: h [m]
    chord: np.ndarray  #: ξ from the long axis of the ellipse [m]
    area: np.ndarray  #: Weights [m²]
    pressure: np.ndarray  #: Hertzian pressure [Pa]
    v: np.ndarray  #: Slip in rolling [m/s]
    w: np.ndarray  #: Slip along the roller [m/s]


def _points(contact: SkewedContact, load, lines: SlipLines, shift, mean_speed) -> _Points:
    """Points of the ellipse at Q [N] and a mean speed [m/s], its middle at ζ_c = `shift` [m]."""
    hertz = contact.laws.interface.hertz
    root = np.cbrt(load)
    across = hertz.semi_axis_across * root
    width = hertz.semi_axis_along * root
    rim = 1.0 / common_contour_radius(contact.roller_contour, 1.0 / contact.along)
    offset = contact.lateral * shift
    station, weight = _chords(contact, across, shift, lines, contact.corner * mean_speed)
    height = np.sqrt(np.maximum(1.0 - ((station - shift) / across) ** 2, 0.0))
    chord = width * height * _COSINES
    v = lines.v0 + station * (lines.v1 + lines.v2 * station)
    w = lines.w0 + station * (lines.w1 + lines.w2 * station) + lines.per_xi * chord
    return _Points(
        station=station,
        drop=0.5 * rim * station**2 + offset * (0.5 * station - 0.25 * shift),
        chord=chord,
        area=weight * width * height * _CHORD_WEIGHTS,
        pressure=hertz.pressure * root * height * _SINES,
        v=np.broadcast_to(v, w.shape),
        w=w,
    )


def _chords(
    contact: SkewedContact, across, shift, lines: SlipLines, corner_slip
) -> tuple[np.ndarray, np.ndarray]:
    """Stations of the chords and their weights [m], graded towards the lines that divide them.

    These are the lines of pure rolling, the ends, and, with a corner of the stress at the slip
    `corner_slip` [m/s], those where v and w in the middle of the contact reach it together.
    """
    low, high = (
        np.maximum(shift - across, -contact.half_length),
        np.minimum(shift + across, contact.half_length),
    )
    levels = [0.0]
    if contact.corner:
        along = lines.w0 + shift * (lines.w1 + lines.w2 * shift)
        corner = np.sqrt(np.maximum(corner_slip**2 - along**2, 0.0))
        levels = [0.0, -corner, corner]
    places = [_crossings(lines, level) for level in levels]
    inner = np.sort(
        np.concatenate([crossing for pair in places for crossing in pair], axis=1), axis=1
    )
    edges = np.concatenate([low, np.clip(inner, low, high), high], axis=1)
    length = np.diff(edges, axis=1)
    station = (edges[:, :-1] + length * _NODES).reshape(len(edges), -1, 1)
    return station, (length * _WEIGHTS).reshape(station.shape)


def _crossings(lines: SlipLines, level) -> list[np.ndarray]:
    """Both stations at which v passes a level [m]; where it does not, its extremum twice."""
    constant = lines.v0 - level
    linear = lines.v1
    square = lines.v2
    inside = linear * linear - 4.0 * square * constant
    larger = -0.5 * (linear + np.copysign(np.sqrt(np.maximum(inside, 0.0)), linear))
    with np.errstate(divide="ignore", invalid="ignore"):
        places = [
            np.where(inside > 0.0, root, -0.5 * linear / square)
            for root in (larger / square, constant / larger)
        ]
    return [np.nan_to_num(root) for root in places]


def _stresses(
    contact: SkewedContact, load, entrainment, pressure, speed
) -> tuple[np.ndarray, np.ndarray]:
    laws = contact.laws
    film = laws.film_thickness(load, entrainment)
    share = laws.asperity_share(load, entrainment, film)
    rough = laws.boundary_friction * share * pressure * np.minimum(speed / FULL_SLIP, 1.0)
    return (1.0 - share) * contact.shear(pressure, film, speed, entrainment), rough
