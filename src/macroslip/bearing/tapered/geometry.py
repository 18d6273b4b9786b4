"""Geometry and kinematics of a tapered roller bearing: apex, cones, rib contact and sliding speeds.

The axes of all rollers of a row, and the lines along which they touch the rings, meet in one point
of the bearing's axis, the apex. A row has the sign s = ±1 of the direction ±Z0 of the thrust that
it carries; the apex and the small ends of its rollers point to s Z0. The coordinate ζ [m] counts
along a roller's axis from its middle towards its large end. Rollers are cones of half-angle β, the
roller's axis has the angle α to the bearing's axis, the raceway of the outer ring α_o = α + β and
that of the inner ring α_i = α − β.

The large end of a roller is a sphere about a point of its axis, and runs on the rib of the inner
ring, a cone that is normal to the sphere in the middle of their contact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from macroslip.bearing.tapered.bearing import TaperedBearing


@dataclass(frozen=True)
class TaperedGeometry:
    """Angles, radii and lengths of a row of tapered rollers, alike in both rows.

    Angles are in rad, lengths in m.
    """

    outer_angle: float  #: α_o, half-angle of the outer ring's raceway
    axis_angle: float  #: α, angle of the roller's axis to the bearing's axis
    inner_angle: float  #: α_i, half-angle of the inner ring's raceway
    half_cone_angle: float  #: β, half-angle of the roller
    apex_distance: float  #: A, from the roller's middle to the apex along the roller's axis
    roller_radius: float  #: r at the roller's middle
    roller_length: float  #: L, effective
    pitch_radius: float  #: R̃, from the bearing's axis to the roller's middle
    inner_radius: float  #: R_i, from the bearing's axis to the inner contact's middle
    outer_radius: float  #: R_o, from the bearing's axis to the outer contact's middle
    sphere_radius: float  #: R_s, of the roller's large end
    sphere_distance: float  #: A_s, from the apex to the centre of that sphere
    rib_angle: (
        float  #: ε, of the rib contact as seen from the sphere's centre, to the roller's axis
    )
    rib_contact_height: float  #: h_f, of the rib contact above the line of the inner raceway
    rib_radius_on_roller: float  #: ρ_P, from the roller's axis to the rib contact
    rib_station: float  #: ζ_P of the rib contact along the roller's axis
    rib_radius: float  #: R_P, from the bearing's axis to the rib contact

    @property
    def rib_rolling_curvature(self) -> float:
        """Sum of the curvatures of sphere and rib in the plane of rolling [1/m]."""
        rib = math.sin(self.axis_angle - self.rib_angle) / self.rib_radius
        return 1.0 / self.sphere_radius - rib

    @property
    def rib_lateral_curvature(self) -> float:
        """Sum of the curvatures of sphere and rib across the plane of rolling [1/m]."""
        return 1.0 / self.sphere_radius

    @property
    def load_centre(self) -> float:
        """Distance of the load centre from the roller's middle along the bearing's axis [m].

        The normal of the outer raceway at the roller's middle meets the bearing's axis there, on
        the side away from the apex.
        """
        slant = self.apex_distance / math.cos(self.half_cone_angle)
        along_axis = self.apex_distance * math.cos(self.axis_angle)
        return slant / math.cos(self.outer_angle) - along_axis

    @property
    def rib_share(self) -> float:
        """Load of the rib over that of the outer raceway [-], sin 2β/cos(ε − β).

        The three contacts of a roller press along lines whose directions do not change with its
        load, so that their loads have fixed ratios.
        """
        opening = math.cos(self.rib_angle - self.half_cone_angle)
        return math.sin(2.0 * self.half_cone_angle) / opening

    @property
    def orbit_ratio(self) -> float:
        """Orbital speed of the rollers over the speed of the inner ring in pure rolling [-]."""
        inner = math.sin(self.inner_angle)
        return inner / (inner + math.sin(self.outer_angle))

    @property
    def spin_ratio(self) -> float:
        """Spin of a roller in the frame of the cage over the speed of the inner ring [-]."""
        outer = math.sin(self.outer_angle)
        return self.orbit_ratio * outer / math.sin(self.half_cone_angle)

    @property
    def inner_rolling_ratio(self) -> float:
        """Turning rate of a roller relative to the inner ring over the speed of that ring [-].

        It turns about their common line through the apex.
        """
        cone_angle = 2.0 * self.half_cone_angle
        return math.sin(self.outer_angle) / math.sin(cone_angle)

    def radius_at(self, station):
        """Radius of the roller [m] at ζ [m], (A + ζ) tan β."""
        from_apex = self.apex_distance + station
        return from_apex * math.tan(self.half_cone_angle)

    def surface_speed(self, shaft_speed, station=0.0):
        """Speed of the roller's surface past the contacts in pure rolling [m/s], at ζ [m].

        Parameters
        ----------
        shaft_speed : array_like
            Speed of the inner ring Ω_in [rad/s], not negative.
        station : array_like, optional
            Coordinate ζ [m] along the roller's axis.
        """
        return self.spin_ratio * shaft_speed * self.radius_at(station)

    def rib_sliding_speed(self, shaft_speed):
        """Sliding speed at the rib in pure rolling [m/s], w_i h_f.

        Roller and inner ring turn about their common line, from which the rib contact is h_f away.

        Parameters
        ----------
        shaft_speed : array_like
            Speed of the inner ring Ω_in [rad/s], not negative.
        """
        return self.inner_rolling_ratio * shaft_speed * self.rib_contact_height

    def rib_entrainment_speed(self, shaft_speed):
        """Mean speed of both surfaces at the rib relative to their contact [m/s].

        The roller's end passes it at |ω_rel| ρ_P, the rib at (Ω_in − Ω) R_P.

        Parameters
        ----------
        shaft_speed : array_like
            Speed of the inner ring Ω_in [rad/s], not negative.
        """
        roller = self.spin_ratio * shaft_speed * self.rib_radius_on_roller
        rib = (1.0 - self.orbit_ratio) * shaft_speed * self.rib_radius
        return 0.5 * (roller + rib)

    def preload_per_kelvin(self, expansion: float, row_offset: float, arrangement: str) -> float:
        """Change of the axial preload when inner ring and rollers are 1 K warmer [m/K].

        It is twice the growth of the apex's distance from the mid-plane, 2 a_T (A cos α ∓ c), with
        − in O and + in X arrangement, and nothing where both apexes meet in the mid-plane.

        Parameters
        ----------
        expansion : float
            Thermal expansion a_T of the steel [1/K].
        row_offset : float
            Axial distance c of the rollers' middles from the mid-plane [m].
        arrangement : {"O", "X"}
            Whether the rollers' large ends face each other in the mid-plane (X) or not (O).
        """
        to_apex = self.apex_distance * math.cos(self.axis_angle)
        from_middle = to_apex - row_offset if arrangement == "O" else to_apex + row_offset
        return 2.0 * expansion * from_middle


def half_cone_angle(roller_diameter: float, pitch_diameter: float, outer_angle: float) -> float:
    """Half-angle β of the roller [rad] with which all lines of contact meet in one apex.

    It is the root of tan β = (Dw/Dpw) sin(α_o − β).

    Parameters
    ----------
    roller_diameter : float
        Dw at the roller's middle [m], above 0.
    pitch_diameter : float
        Dpw at the roller's middle [m], above Dw.
    outer_angle : float
        Half-angle of the outer ring's raceway α_o [rad], above 0 and below π/2.

    Returns
    -------
    float
        β [rad].

    Examples
    --------
    >>> round(math.degrees(half_cone_angle(0.062, 0.768, math.radians(30.40))), 4)
    2.1857
    """
    # With t = tan β and k = Dw/Dpw the equation is t √(1 + t²) = k (sin α_o − t cos α_o): a few
    # Newton steps from the small-angle solution reach rounding.
    ratio = roller_diameter / pitch_diameter
    sine = math.sin(outer_angle)
    cosine = math.cos(outer_angle)
    tangent = ratio * sine / (1.0 + ratio * cosine)
    for _ in range(20):
        root = math.sqrt(1.0 + tangent * tangent)
        mismatch = tangent * root - ratio * (sine - tangent * cosine)
        slope = root + tangent * tangent / root + ratio * cosine
        tangent -= mismatch / slope
    return math.atan(tangent)


def cone(roller_diameter: float, pitch_diameter: float, outer_angle: float) -> tuple[float, float]:
    """Half-angle β of the roller [rad], and distance A of its middle from the apex [m].

    Arguments are those of `half_cone_angle`; A = Dpw/(2 sin(α_o − β)).

    Examples
    --------
    >>> _, apex = cone(0.062, 0.768, math.radians(30.40))
    >>> round(apex, 5)
    0.81223
    """
    beta = half_cone_angle(roller_diameter, pitch_diameter, outer_angle)
    apex = pitch_diameter / 2.0 / math.sin(outer_angle - beta)
    return beta, apex


def tapered_geometry(bearing: TaperedBearing) -> TaperedGeometry:
    """Geometry of a row of rollers from a bearing's data.

    Parameters
    ----------
    bearing : TaperedBearing
        Its cup angle, roller and pitch diameter, length of the rollers and rib.

    Returns
    -------
    TaperedGeometry

    Notes
    -----
    With β of `half_cone_angle`, R̃ = Dpw/2 and α = α_o − β the apex lies A = R̃/sin α from the
    roller's middle. The large end lies A_e = A + L/2 from it, its sphere has R_s = `rib_sphere_ratio`
    A_e and the centre A_s = A_e − R_s from the apex. The rib contact, h_f above the line of the inner
    raceway, is seen from that centre at ε to the roller's axis, sin(ε − β) = (A_s sin β − h_f)/R_s.
    So ρ_P = R_s sin ε, ζ_P = A_s + R_s cos ε − A and R_P = R̃ + ζ_P sin α − ρ_P cos α.

    Examples
    --------
    >>> from macroslip.bearing.tapered import TaperedBearing
    >>> row = tapered_geometry(TaperedBearing.read("tdo-main-bearing"))
    >>> round(1e3 * row.apex_distance, 2), round(1e3 * row.rib_radius_on_roller, 2)
    (812.23, 28.02)
    >>> round(row.orbit_ratio, 6), round(row.inner_rolling_ratio, 4)
    (0.464431, 6.639)
    """
    radius = bearing.roller_diameter / 2.0
    beta, apex = cone(bearing.roller_diameter, 2.0 * bearing.pitch_radius, bearing.outer_angle)
    alpha = bearing.outer_angle - beta
    end = apex + bearing.roller_length / 2.0
    sphere = bearing.rib_sphere_ratio * end
    centre = end - sphere
    lift_height = centre * math.sin(beta) - bearing.rib_contact_height
    lift = math.asin(lift_height / sphere)
    epsilon = beta + lift
    on_roller = sphere * math.sin(epsilon)
    station = centre + sphere * math.cos(epsilon) - apex
    from_axis = bearing.pitch_radius + station * math.sin(alpha)
    rib_radius = from_axis - on_roller * math.cos(alpha)
    across = radius * math.cos(alpha)
    return TaperedGeometry(
        outer_angle=bearing.outer_angle,
        axis_angle=alpha,
        inner_angle=alpha - beta,
        half_cone_angle=beta,
        apex_distance=apex,
        roller_radius=radius,
        roller_length=bearing.roller_length,
        pitch_radius=bearing.pitch_radius,
        inner_radius=bearing.pitch_radius - across,
        outer_radius=bearing.pitch_radius + across,
        sphere_radius=sphere,
        sphere_distance=centre,
        rib_angle=epsilon,
        rib_contact_height=bearing.rib_contact_height,
        rib_radius_on_roller=on_roller,
        rib_station=station,
        rib_radius=rib_radius,
    )
