"""Checks of a case against its kind of bearing: loads, mount, laws and dynamics."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from macroslip.case.parts import BALANCE, WHOLE_BEARING
from macroslip.constants import MECHANISMS
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, HubLoads, RollerLoads
from macroslip.loads.statics import MOMENT_MOUNTS

if TYPE_CHECKING:
    from macroslip.case.case import Case

#: Highest speed of a shaft on spherical roller bearings [rad/s].
_FASTEST_ROTOR = 100.0
#: Axial part of a load that counts as none.
_NO_THRUST = 1e-9


def check_kind(case: Case) -> Iterator[InputError]:
    """Yield what a case with its kind of bearing cannot have.

    Parameters
    ----------
    case : Case

    Yields
    ------
    InputError
        Speeds beyond any rotor's on spherical roller bearings; loads at the hub, thrust, skew and a
        second cage in cylindrical ones; dynamics, laws and mounts that are not computed for tapered
        ones; and in the others keys that tapered ones alone have.
    """
    if case.bearing.kind == "tapered":
        yield from _mechanisms(case)
        yield from _traction_along_line(case)
        yield from _mount(case)
        return
    yield from _of_tapered_bearings(case)
    if case.bearing.kind == "spherical":
        yield from _fastest(case)
    else:
        yield from _of_one_row(case)
    if case.bearing.touches_along_line:
        yield from _traction_along_line(case)


def _fastest(case: Case) -> Iterator[InputError]:
    """Yield a speed that no rotor on a spherical roller bearing has."""
    fastest = float(np.abs(case.loads.shaft_speed).max())
    if fastest > _FASTEST_ROTOR:
        yield InputError(
            f"the shaft turns at up to {fastest:.4g} rad/s, beyond any rotor",
            where="loads",
            allowed=f"up to {_FASTEST_ROTOR:g} rad/s on a double-row spherical roller bearing",
            remedy="Check the unit. Is it in rpm, or the speed of the generator?",
        )


def _of_one_row(case: Case) -> Iterator[InputError]:
    """Yield loads, skew and cages that a cylindrical roller bearing, of one row, cannot have."""
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
        yield from _no_thrust(case.loads)
    yield from _no_skew(case, "a cylindrical one is held by flanges")
    if case.cage.arrangement != "one":
        yield InputError(
            f"arrangement is {case.cage.arrangement} in a bearing of one row",
            where="cage.arrangement",
            allowed="one",
            remedy="Remove it.",
        )


def _no_thrust(loads: BearingLoads) -> Iterator[InputError]:
    """Yield an axial load, which rollers without contact angle do not carry."""
    axial = np.abs(loads.axial_load).max()
    largest = np.abs(loads.force).max()
    if axial > _NO_THRUST * largest:
        yield InputError(
            f"the load has an axial part of up to {axial:.4g} N, "
            "and rollers without contact angle carry none",
            where="loads",
            allowed="F_Z0 = 0 for a cylindrical roller bearing",
            remedy="Set it to 0: another bearing, or flanges that are not modelled, carry the "
            "thrust.",
        )


def _no_skew(case: Case, guidance: str) -> Iterator[InputError]:
    """Yield skew in a kind of bearing whose rollers are guided otherwise than spherical ones."""
    if case.laws.skew != "none":
        yield InputError(
            f"skew is computed for spherical rollers, which their raceways' spheres hold; {guidance}",
            where="laws.skew",
            allowed=f"none, in a {case.bearing.kind} roller bearing",
            remedy="Set laws.skew: none.",
        )


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
    if isinstance(case.loads, HubLoads) and case.drivetrain.mount in MOMENT_MOUNTS:
        yield InputError(
            f"{kind} and carries no moment, and drivetrain.mount is {case.drivetrain.mount}",
            where="drivetrain.mount",
            allowed="three-point or four-point",
            remedy="Choose a mount with two supports, or a tapered roller bearing.",
        )


def _mechanisms(case: Case) -> Iterator[InputError]:
    """Yield dynamics, laws and temperatures that are not computed for tapered roller bearings."""
    if case.dynamics == WHOLE_BEARING:
        yield InputError(
            "rollers on free orbits are not computed for tapered roller bearings",
            where="dynamics",
            allowed="imposed-orbit",
            remedy="Set dynamics: imposed-orbit.",
        )
    yield from _no_skew(case, "the rib guides a tapered one")
    if case.temperature == BALANCE:
        yield InputError(
            "the balance of heat is not computed for tapered roller bearings, whose preload hangs on "
            "the difference of their rings' temperatures",
            where="temperature",
            allowed="a temperature, with temperature_difference",
            remedy="Give the temperature of the oil, and how much warmer the inner ring is.",
        )


def _traction_along_line(case: Case) -> Iterator[InputError]:
    """Yield a traction law that line contacts do not have."""
    if case.laws.traction != MECHANISMS:
        kind = case.bearing.kind
        shape = "" if kind == "tapered" else f" with a {case.bearing.roller_profile} profile"
        crowned = "" if kind == "tapered" else ", or give the roller a roller_crown_radius"
        yield InputError(
            f"the traction law '{case.laws.traction}' is one of an elliptical contact, and a {kind} "
            f"roller{shape} touches along a line",
            where="laws.traction",
            allowed=f"{MECHANISMS}, in a bearing whose rollers touch along lines",
            remedy=f"Set laws.traction: {MECHANISMS}{crowned}.",
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
