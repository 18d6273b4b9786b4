"""Single-row cylindrical roller bearings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from macroslip.errors import InputError
from macroslip.kinds.checks import skew_of_guided_rollers, traction_along_line
from macroslip.kinds.untilted import UntiltedRing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from macroslip.bearing import Bearing
    from macroslip.kinds.read_case import ReadCase
    from macroslip.loads import BearingLoads

#: Axial part of a load that counts as none.
_NO_THRUST = 1e-9


class Cylindrical(UntiltedRing):
    """Single-row cylindrical roller bearings."""

    name = "cylindrical"
    replenishment_factor = 5.1
    carries_thrust = False

    def check(self, case: ReadCase) -> Iterator[InputError]:
        """Yield keys of other kinds; loads at the hub, thrust, skew and a second cage."""
        from macroslip.loads import BearingLoads

        yield from super().check(case)
        if not isinstance(case.loads, BearingLoads):
            yield InputError(
                f"{case.bearing.name} is a cylindrical roller bearing, and loads are given at the hub "
                "or for rollers of two rows",
                where="loads",
                allowed="the force on the bearing: loads.main_bearing or loads.bearing_file",
                remedy="Give the radial force on its inner ring over time, with the speed of its "
                "shaft.",
            )
        else:
            yield from _thrust(case.loads)
        yield from skew_of_guided_rollers(case, "a cylindrical one is held by flanges")
        if case.cage.arrangement != "one":
            yield InputError(
                f"arrangement is {case.cage.arrangement} in a bearing of one row",
                where="cage.arrangement",
                allowed="one",
                remedy="Remove it.",
            )
        if case.bearing.touches_along_line:
            roller = f"cylindrical roller with a {case.bearing.roller_profile} profile"
            crowned = ", or give the roller a roller_crown_radius"
            yield from traction_along_line(case, roller, crowned)

    def draw(self, axes: Axes, bearing: Bearing, colours: Mapping[str, str]) -> None:
        """As `Kind.draw`, by `macroslip.kinds.straight_section`."""
        from macroslip.kinds.straight_section import draw_straight_section

        draw_straight_section(axes, bearing)


def _thrust(loads: BearingLoads) -> Iterator[InputError]:
    """Yield an axial load, which rollers without contact angle do not carry."""
    axial = abs(loads.axial_load).max()
    largest = abs(loads.force).max()
    if axial > _NO_THRUST * largest:
        yield InputError(
            f"the load has an axial part of up to {axial:.4g} N, "
            "and rollers without contact angle carry none",
            where="loads",
            allowed="F_Z0 = 0 for a cylindrical roller bearing",
            remedy="Set it to 0: another bearing, or flanges that are not modelled, carry the "
            "thrust.",
        )
