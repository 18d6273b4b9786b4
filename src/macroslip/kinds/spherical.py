"""Double-row spherical roller bearings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from macroslip.errors import InputError
from macroslip.input.units import LENGTH
from macroslip.kinds.makers_page import (
    AXIAL_FACTOR_E,
    BEARING_MASS,
    BORE,
    DYNAMIC_RATING,
    FATIGUE_LIMIT,
    OUTSIDE,
    STATIC_RATING,
    WIDTH,
    PageOption,
)
from macroslip.kinds.untilted import UntiltedRing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from macroslip.bearing import Bearing
    from macroslip.bearing.sampled import Estimated
    from macroslip.kinds.read_case import ReadCase

#: Highest speed of a shaft on spherical roller bearings [rad/s].
_FASTEST_ROTOR = 100.0


class Spherical(UntiltedRing):
    """Double-row spherical roller bearings."""

    name = "spherical"
    replenishment_factor = 5.5
    aligns_itself = True
    carries_rotors_only = True
    page = (
        BORE,
        OUTSIDE,
        WIDTH,
        STATIC_RATING,
        AXIAL_FACTOR_E,
        PageOption(
            "shoulder", "shoulder", "Shoulder diameter of the outer ring D1: '828 mm'.", LENGTH
        ),
        PageOption("groove", "groove", "Width of the lubrication groove b: '56.5 mm'.", LENGTH),
        DYNAMIC_RATING,
        FATIGUE_LIMIT,
        PageOption("y1", "axial_factor_y1", "Axial factor Y1."),
        PageOption("y2", "axial_factor_y2", "Axial factor Y2."),
        PageOption("y0", "axial_factor_y0", "Static axial factor Y0."),
        BEARING_MASS,
        PageOption(
            "bpfo", "bpfo", "Overrolling frequency of the outer ring, per turn of the shaft."
        ),
        PageOption(
            "bpfi", "bpfi", "Overrolling frequency of the inner ring, per turn of the shaft."
        ),
    )
    needed_of_page = ("bore", "outside", "width", "c0", "e")

    def check(self, case: ReadCase) -> Iterator[InputError]:
        """Yield keys of bearings that carry moments, and a speed that no rotor has."""
        yield from super().check(case)
        fastest = float(abs(case.loads.shaft_speed).max())
        if fastest > _FASTEST_ROTOR:
            yield InputError(
                f"the shaft turns at up to {fastest:.4g} rad/s, beyond any rotor",
                where="loads",
                allowed=f"up to {_FASTEST_ROTOR:g} rad/s on a double-row spherical roller bearing",
                remedy="Check the unit. Is it in rpm, or the speed of the generator?",
            )

    def estimate(
        self, page: dict[str, Any], name: str, title: str, seed: int
    ) -> Estimated[Bearing]:
        """As `Kind.estimate`, by `macroslip.bearing.estimate`.

        Parameters
        ----------
        page : dict
            Values in SI by the names of fields of `page`.
        name, title : str
            Of the bearing.
        seed : int
            Of the random numbers.
        """
        from macroslip.bearing.estimate import MakersPage, estimate_bearing

        return estimate_bearing(MakersPage(**page), name, title, seed=seed)

    def about_estimated_rating(self, ratio: float | None) -> str:
        """Sentence on C by ISO 281 beside the published one."""
        if ratio is not None:
            return (
                f"C by ISO 281 from these dimensions is {ratio:.3f} of the published one; "
                "within one family of bearings that scatters by 1 to 2 %."
            )
        return (
            "C is that of these dimensions, and lives are 0.5 to 0.9 of those by a maker's; "
            "give it by --c."
        )

    def draw(self, axes: Axes, bearing: Bearing, colours: Mapping[str, str]) -> None:
        """As `Kind.draw`, by `macroslip.kinds.section`."""
        from macroslip.kinds.section import draw_section

        draw_section(axes, bearing)
