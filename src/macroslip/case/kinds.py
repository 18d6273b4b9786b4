"""What a case of a tapered roller bearing needs and cannot have, and what it alone can have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from macroslip.constants import MECHANISMS
from macroslip.errors import InputError
from macroslip.loads import HubLoads, RollerLoads
from macroslip.loads.statics import MOMENT_MOUNTS

if TYPE_CHECKING:
    from macroslip.case.case import Case

_WHOLE_BEARING = "whole-bearing"
_BALANCE = "balance"


def check_kind(case: Case) -> Iterator[InputError]:
    """Yield what the case of a tapered roller bearing, or of another one, cannot have."""
    if case.bearing.kind == "tapered":
        yield from _mechanisms(case)
        yield from _mount(case)
    else:
        yield from _of_tapered_bearings(case)


def _of_tapered_bearings(case: Case) -> Iterator[InputError]:
    """Yield keys that tapered roller bearings alone have."""
    kind = f"{case.bearing.name} is a {case.bearing.kind} roller bearing"
    if case.temperature_difference:
        yield InputError(
            f"{kind}, whose clearance temperature_difference does not change",
            where="temperature_difference",
            allowed="with a tapered roller bearing",
            remedy="Remove it: diametral_clearance of its file is that of the warm bearing, or set "
            "temperature: balance.",
        )
    if not isinstance(case.loads, HubLoads):
        return
    if case.drivetrain.mount in MOMENT_MOUNTS:
        yield InputError(
            f"{kind} and carries no moment, and drivetrain.mount is {case.drivetrain.mount}",
            where="drivetrain.mount",
            allowed="three-point or four-point",
            remedy="Choose a mount with two supports, or a tapered roller bearing.",
        )
    if case.drivetrain.gearbox_stiffness is not None:
        yield InputError(
            f"{kind}, beside which the gearbox's load does not depend on gearbox_stiffness",
            where="drivetrain.gearbox_stiffness",
            allowed="with a tapered roller bearing, which carries moments",
            remedy="Remove it.",
        )


def _mechanisms(case: Case) -> Iterator[InputError]:
    """Yield dynamics, laws and temperatures that are not computed for tapered roller bearings."""
    if case.dynamics == _WHOLE_BEARING:
        yield InputError(
            "rollers on free orbits are not computed for tapered roller bearings",
            where="dynamics",
            allowed="imposed-orbit",
            remedy="Set dynamics: imposed-orbit.",
        )
    if case.laws.skew != "none":
        yield InputError(
            "skew is computed for spherical rollers, which their raceways' spheres hold; the rib "
            "guides a tapered one",
            where="laws.skew",
            allowed="none, in a tapered roller bearing",
            remedy="Set laws.skew: none.",
        )
    if case.laws.traction != MECHANISMS:
        yield InputError(
            f"the traction law '{case.laws.traction}' is one of an elliptical contact, and a tapered "
            "roller touches along a line",
            where="laws.traction",
            allowed=f"{MECHANISMS}, in a tapered roller bearing",
            remedy=f"Set laws.traction: {MECHANISMS}.",
        )
    if case.temperature == _BALANCE:
        yield InputError(
            "the balance of heat is not computed for tapered roller bearings, whose preload hangs on "
            "the difference of their rings' temperatures",
            where="temperature",
            allowed="a temperature, with temperature_difference",
            remedy="Give the temperature of the oil, and how much warmer the inner ring is.",
        )


def _mount(case: Case) -> Iterator[InputError]:
    """Yield loads and mounts from which the moments on a tapered roller bearing do not follow."""
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
            f"{case.bearing.name} carries moments, so that what the gearbox takes of them hangs on "
            "the stiffness of its support, which is not given",
            where="drivetrain",
            allowed="mount: alone, two-bearings, or three-point with gearbox_stiffness",
            remedy="Write drivetrain: {mount: alone}, or give gearbox_stiffness, such as 100 MN/m.",
        )
