"""Checks of a case of a tapered roller bearing: dynamics, skew, heat, loads and mount."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from macroslip.constants import BALANCE, WHOLE_BEARING
from macroslip.errors import InputError
from macroslip.kinds.checks import skew_of_guided_rollers

if TYPE_CHECKING:
    from macroslip.kinds.read_case import ReadCase


def mechanisms(case: ReadCase) -> Iterator[InputError]:
    """Yield dynamics, skew and a balance of heat, which are not computed.

    Parameters
    ----------
    case : ReadCase
    """
    if case.dynamics == WHOLE_BEARING:
        yield InputError(
            "rollers on free orbits are not computed for tapered roller bearings",
            where="dynamics",
            allowed="imposed-orbit",
            remedy="Set dynamics: imposed-orbit.",
        )
    yield from skew_of_guided_rollers(case, "the rib guides a tapered one")
    if case.temperature == BALANCE:
        yield InputError(
            "the balance of heat is not computed for tapered roller bearings, whose preload depends on "
            "the difference of their rings' temperatures",
            where="temperature",
            allowed="a temperature, with temperature_difference",
            remedy="Give the temperature of the oil, and how much warmer the inner ring is.",
        )


def mount(case: ReadCase) -> Iterator[InputError]:
    """Yield loads and mounts from which the moments on the bearing do not follow.

    Parameters
    ----------
    case : ReadCase
    """
    from macroslip.loads import HubLoads, RollerLoads

    if isinstance(case.loads, RollerLoads):
        yield InputError(
            "loads of the rollers are given, and a tapered roller bearing finds them by the balance "
            "of its ring, the rib and the preload",
            where="loads.roller_loads",
            allowed="loads at the hub, or the force on the bearing",
            remedy="Give loads at the hub.",
        )
    if not isinstance(case.loads, HubLoads):
        return
    if case.drivetrain.mount == "four-point":
        yield InputError(
            "two main bearings of which one is a tapered roller bearing are not computed: they share "
            "moments by their stiffness",
            where="drivetrain.mount",
            allowed="alone, two-bearings, or three-point with gearbox_stiffness",
            remedy="Choose one of these mounts, or give the force on the bearing.",
        )
    if case.drivetrain.mount == "three-point" and case.drivetrain.gearbox_stiffness is None:
        yield InputError(
            f"{case.bearing.name} carries moments, so that what the gearbox takes of them depends on "
            "the stiffness of its support, which is not given",
            where="drivetrain",
            allowed="mount: alone, two-bearings, or three-point with gearbox_stiffness",
            remedy="Write drivetrain: {mount: alone}, or give gearbox_stiffness, such as 100 MN/m.",
        )
