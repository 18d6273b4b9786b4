"""Input section of the cage, and deviations of the rollers' positions and diameters."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.errors import InputError
from macroslip.input.fields import Choice, Flag, Quantity, Whole
from macroslip.input.section import input_section
from macroslip.input.units import ANGLE, FORCE, INVERSE_SPEED, LENGTH, MASS

#: Contact of a roller with a spar: with an oil film or dry.
IMPACTS = ("squeeze-film", "dry")
#: One cage for both rows, or one a row.
ARRANGEMENTS = ("one", "per-row")
#: Whether a cage is free to move off the bearing's axis.
AXES = ("free", "pinned")
#: Skew guidance of a pocket; whether spars align rollers.
GUIDANCES = ("conforming-pocket", "straight-bars", "guide-ring", "none")
ALIGNMENTS = ("spar", "none")
#: Keys that only cases with skew take.
SKEW_KEYS = ("guidance", "skew_play", "alignment")
#: Guidance of the cage by rollers or a ring's land; keys of such a land.
GUIDED_BY = ("rollers", "inner-ring", "outer-ring")
_LAND = ("land_diameter", "land_width", "land_clearance")
#: Damping of dry contacts by default [s/m].
_DAMPING = 50.0
#: Where rollers are in their pockets at the start.
OFFSETS = ("centred", "random")


@input_section(
    "cage", "the cage, with dynamics: whole-bearing, and its guidance of rollers that skew"
)
class Cage:
    """The cage of a coupled simulation. Defaults are engineering estimates for the base bearing.

    Parameters
    ----------
    gap : float
        Diametral play of a roller in its pocket [m], ≥ 0: free way along the orbit between the two
        spars.
    impact : "squeeze-film" or "dry"
        Whether oil between roller and spar resists their approach, or they meet dry.
    damping : float
        D of the dry contact [s/m], K δ^1.5 (1 + D δ'); larger takes more energy from an impact.
    arrangement : "one" or "per-row"
        One cage for both rows, or two that turn on their own.
    mass : float
        Mass of the cage [kg], of both together where each row has its own. It is a thin ring at the
        pitch radius.
    weight : bool
        Whether the cage's weight acts. It rests on the rollers at either side, through two
        translations of the cage.
    axis : "free" or "pinned", optional
        Whether the cage's axis moves by these translations, or a frictionless guide holds it in the
        middle. None: free, but pinned where `weight` is false.
    guide_friction : float
        Friction force at the pitch radius that brakes each cage [N]; zero for a cage that only
        rollers guide.
    guided_by : "rollers", "inner-ring" or "outer-ring"
        What holds the cage in the middle. A ring's land shears the oil between it and the cage as
        Petroff's concentric bearing does, and drives or brakes the cage by it; the land stops the
        cage after half its clearance.
    land_diameter, land_width, land_clearance : float, optional
        Diameter of that land, width of both lands together, and diametral clearance between land
        and cage [m].
    offsets : "centred" or "random"
        Rollers start in the middle of their pockets, or anywhere in them with equal probability.
    diameter_scatter : float
        Standard deviation of the roller diameters [m].
    seed : int
        Of the random offsets and diameters.
    guidance : "conforming-pocket", "straight-bars", "guide-ring" or "none"
        What stops skew: spars that follow the outer raceway's contour, straight ones, a guide ring
        beside straight spars, or nothing up to 60 mrad.
    skew_play : float, optional
        Largest skew either way [rad]; None: from `gap`, the roller's length and its contour. A
        guide ring needs it.
    alignment : "spar" or "none"
        Whether a spar that presses on a roller straightens it.

    Raises
    ------
    InputError
        A value out of its range.

    Examples
    --------
    >>> Cage(gap=2e-4).impact
    'squeeze-film'
    """

    gap: Annotated[
        float, Quantity("play of a roller between the two spars of its pocket", LENGTH, 0.0, 0.1)
    ] = 0.5e-3
    impact: Annotated[
        str, Choice("contact of roller and spar, with an oil film or dry", lambda: IMPACTS)
    ] = "squeeze-film"
    damping: Annotated[
        float, Quantity("D of the dry contact K δ^1.5 (1 + D δ')", INVERSE_SPEED, 0.0, 1e6)
    ] = _DAMPING
    arrangement: Annotated[
        str, Choice("one cage for both rows, or one a row", lambda: ARRANGEMENTS)
    ] = "one"
    mass: Annotated[
        float,
        Quantity(
            "mass of the cage, or of both together", MASS, 1e-3, 1e5,
            remedy="A cage without mass has no speed of its own; 35 to 60 kg are likely for the base bearing.",
        ),
    ] = 50.0  # fmt: skip
    weight: Annotated[bool, Flag("weight of the cage")] = True
    axis: Annotated[str | None, Choice("whether the cage's axis moves", lambda: AXES)] = None
    guide_friction: Annotated[
        float, Quantity("force at the pitch radius that brakes each cage", FORCE, 0.0, 1e6)
    ] = 0.0
    guided_by: Annotated[str, Choice("radial guidance of the cage", lambda: GUIDED_BY)] = "rollers"
    land_diameter: Annotated[
        float | None, Quantity("diameter of the land that guides", LENGTH, 1e-3, 10.0)
    ] = None
    land_width: Annotated[
        float | None, Quantity("width of both lands together", LENGTH, 1e-4, 1.0)
    ] = None
    land_clearance: Annotated[
        float | None, Quantity("diametral clearance between land and cage", LENGTH, 1e-6, 0.1)
    ] = None
    offsets: Annotated[str, Choice("where rollers start in their pockets", lambda: OFFSETS)] = (
        "centred"
    )
    diameter_scatter: Annotated[
        float, Quantity("standard deviation of the roller diameters", LENGTH, 0.0, 1e-4)
    ] = 0.0
    seed: Annotated[int, Whole("seed of the random offsets and diameters")] = 1
    guidance: Annotated[str, Choice("skew guidance of a pocket", lambda: GUIDANCES)] = (
        "conforming-pocket"
    )
    skew_play: Annotated[
        float | None,
        Quantity("largest skew; without it, from gap, length and contour", ANGLE, 0.0, 0.06),
    ] = None
    alignment: Annotated[str, Choice("whether spars align rollers", lambda: ALIGNMENTS)] = "spar"

    def __post_init__(self) -> None:
        if self.guidance == "guide-ring" and self.skew_play is None:
            raise InputError(
                "guidance is guide-ring, and its skew_play is not given",
                where="skew_play",
                allowed="the largest skew, such as 5 mrad, with guidance: guide-ring",
                remedy="It is the axial play of the guide ring over the length that guides a roller.",
            )
        if self.impact != "dry" and self.damping != _DAMPING:
            raise InputError(
                f"damping is {self.damping:g} s/m, and a squeeze film has none",
                allowed="with impact: dry",
                remedy="Set impact: dry, or remove damping.",
            )
        land_keys = [name for name in _LAND if getattr(self, name) is not None]
        if self.guided_by == "rollers" and land_keys:
            raise InputError(
                f"{' and '.join(land_keys)} {'describes' if len(land_keys) == 1 else 'describe'} a ring's land, and rollers guide the cage",
                where=land_keys[0],
                allowed="with guided_by: inner-ring or outer-ring",
                remedy=f"Set guided_by, or remove {' and '.join(land_keys)}.",
            )
        if self.guided_by != "rollers" and len(land_keys) < len(_LAND):
            missing = [name for name in _LAND if name not in land_keys]
            raise InputError(
                f"the {self.guided_by} guides the cage, and {' and '.join(missing)} {'is' if len(missing) == 1 else 'are'} "
                "not given",
                where=missing[0],
                allowed="a length for each",
                remedy="Add them: the oil film between land and cage follows from them.",
            )

    def land_drag(self, pitch_radius: float, viscosity: float) -> float:
        """Drag coefficient of the oil film at a ring's land by Petroff's law [N s/m].

        4 π η R³ b/(c r~²), with c the diametral clearance: Petroff's shear η ΔΩ R/(c/2) on 2πRb.

        Parameters
        ----------
        pitch_radius : float
            r~ [m].
        viscosity : float
            η of the oil [Pa s].

        Returns
        -------
        float
            Force at the pitch radius over the difference of speeds there [N s/m], zero where
            rollers guide.

        Examples
        --------
        >>> led = Cage(guided_by="outer-ring", land_diameter=0.25, land_width=0.02, land_clearance=1e-3)
        >>> round(led.land_drag(0.1125, 0.1), 3)
        3.879
        """
        if self.land_diameter is None or self.land_width is None or self.land_clearance is None:
            return 0.0
        radius = 0.5 * self.land_diameter
        return (
            4.0
            * math.pi
            * viscosity
            * radius**3
            * self.land_width
            / (self.land_clearance * pitch_radius**2)
        )

    def check_fit(self, bearing: Bearing) -> None:
        """Refuse pockets that do not fit between the rollers.

        Raises
        ------
        InputError
            If rollers, play and spars need more than the circumference.
        """
        half_pitch = math.pi / bearing.rollers_per_row
        spacing = 2.0 * bearing.pitch_radius * math.sin(half_pitch)
        if self.gap >= spacing - bearing.roller_diameter:
            raise InputError(
                f"the gap is {self.gap * 1e3:.4g} mm, and {bearing.rollers_per_row} rollers a row leave "
                f"{(spacing - bearing.roller_diameter) * 1e3:.4g} mm between neighbours, so pockets would overlap",
                where="cage.gap",
                allowed="less than the distance between neighbouring rollers",
                remedy="Check the gap and the bearing's rollers_per_row, roller_diameter and pitch_radius.",
            )

    def start_offsets(self, count: int) -> np.ndarray:
        """Offsets of `count` rollers in their pockets at the start [m]."""
        if self.offsets == "centred":
            return np.zeros(count)
        generator = np.random.default_rng([self.seed, 0])
        return generator.uniform(-0.5 * self.gap, 0.5 * self.gap, count)

    def diameter_deviations(self, rows: int, count: int) -> np.ndarray:
        """Deviations of roller diameters from the mean of their row [m], shape (rows, count)."""
        if self.diameter_scatter == 0.0:
            return np.zeros((rows, count))
        drawn = np.random.default_rng([self.seed, 1]).normal(
            0.0, self.diameter_scatter, (rows, count)
        )
        return drawn - drawn.mean(axis=1, keepdims=True)


def inner_radii(bearing: Bearing, diameter_deviation: np.ndarray) -> np.ndarray:
    """Effective inner contact radius r~_in of rollers whose diameter deviates [m].

    A thicker roller touches the outer raceway's sphere at the same point, has its centre further in
    and touches an inner ring of smaller radius; pure rolling then has
    δΩ/Ω = −(r cos α/r~_in)(r~_out/r~) δr/r, −0.11 δr/r for the base bearing. The model gives the
    roller the inner contact radius that turns it at this orbit speed and leaves all else.

    Examples
    --------
    >>> from macroslip.bearing import Bearing
    >>> base = Bearing.read("skf-240-600-bc")
    >>> nominal, thick = inner_radii(base, np.array([0.0, 70e-6]))
    >>> round(float((thick - nominal) / nominal / 1e-3), 3)
    -0.111
    """
    inner = geometry.inner_contact_radius(bearing)
    outer = geometry.outer_contact_radius(bearing)
    slope = math.cos(bearing.contact_angle) / inner * outer / bearing.pitch_radius
    return inner * (1.0 - slope * 0.5 * diameter_deviation)
