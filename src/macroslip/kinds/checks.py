"""Checks of a case that several kinds of bearings share: moments, heat, skew and traction."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from macroslip.constants import MECHANISMS
from macroslip.errors import InputError

if TYPE_CHECKING:
    from macroslip.kinds.read_case import ReadCase


def temperature_difference_without_preload(case: ReadCase) -> Iterator[InputError]:
    """Yield a temperature difference in a bearing whose preload does not depend on it."""
    if case.temperature_difference:
        yield InputError(
            f"{case.bearing.name} is a {case.bearing.kind} roller bearing, whose clearance "
            "temperature_difference does not change",
            where="temperature_difference",
            allowed="with a tapered roller bearing",
            remedy="Remove it: diametral_clearance of its file is that of the warm bearing, or set "
            "temperature: balance.",
        )


def moments_without_carrier(case: ReadCase) -> Iterator[InputError]:
    """Yield a mount whose shaft is held by the moments of a bearing that carries none."""
    from macroslip.loads import HubLoads
    from macroslip.loads.statics import MOMENT_MOUNTS

    if isinstance(case.loads, HubLoads) and case.drivetrain.mount in MOMENT_MOUNTS:
        yield InputError(
            f"{case.bearing.name} is a {case.bearing.kind} roller bearing and carries no moment, and "
            f"drivetrain.mount is {case.drivetrain.mount}",
            where="drivetrain.mount",
            allowed="three-point or four-point",
            remedy="Choose a mount with two supports, or a tapered roller bearing.",
        )


def skew_of_guided_rollers(case: ReadCase, guidance: str) -> Iterator[InputError]:
    """Yield skew in a kind of bearing whose rollers are guided otherwise than spherical ones."""
    if case.laws.skew != "none":
        yield InputError(
            f"skew is computed for spherical rollers, which their raceways' spheres hold; {guidance}",
            where="laws.skew",
            allowed=f"none, in a {case.bearing.kind} roller bearing",
            remedy="Set laws.skew: none.",
        )


def traction_along_line(
    case: ReadCase, roller: str, other_remedy: str = ""
) -> Iterator[InputError]:
    """Yield a traction law that line contacts do not have.

    Takes the roller in words, and what else than another law helps.
    """
    if case.laws.traction != MECHANISMS:
        yield InputError(
            f"the traction law '{case.laws.traction}' is one of an elliptical contact, and a "
            f"{roller} touches along a line",
            where="laws.traction",
            allowed=f"{MECHANISMS}, in a bearing whose rollers touch along lines",
            remedy=f"Set laws.traction: {MECHANISMS}{other_remedy}.",
        )
