"""Frictional power of a roller's contacts, and the part of it that asperities dissipate."""

from __future__ import annotations

from typing import Any, NamedTuple

from numba import types
from numba.extending import overload

from macroslip.compiled import jit_part
from macroslip.roller.contact_force import CurvedContact, is_curved


class PowerRule(NamedTuple):
    """How the power of a raceway contact follows from its forces: P = Δu F + u2 (curvature lag − spin skew).

    Attributes
    ----------
    microslip : bool
        Without it P = |Δu F|.
    curvature : float
        [-].
    spin : float
        [1/m].
    """

    microslip: bool
    curvature: float
    spin: float


def power_rule(contact: Any) -> PowerRule:
    """The rule of a PlainContact or CurvedContact."""
    return _rule_of(contact.shape) if isinstance(contact, CurvedContact) else PowerRule(False, 0.0, 0.0)


@jit_part
def _rule_of(shape):
    return PowerRule(shape.microslip, shape.curvature_ratio * shape.roller_radius, shape.spin_ratio)


@jit_part
def raceway_power(rule, slip, ring_speed, force, detail):
    """Frictional power of a raceway contact (33) [W]."""
    if not rule.microslip:
        return abs(slip * force)
    return slip * force + ring_speed * (rule.curvature * detail.lag - rule.spin * detail.skew)


def friction_power(contact, slip, ring_speed, spin_force, detail):
    """Frictional power of a contact ∫τ v dA [W] (33): |F Δu| where slip does not vary, else with microslip's part."""
    if detail is None:
        return abs(spin_force * slip)
    return raceway_power(_rule_of(contact.shape), slip, ring_speed, spin_force, detail)


def asperity_power(detail):
    """Part of a contact's frictional power that asperities dissipate [W]; zero for a plain contact."""
    return 0.0 if detail is None else detail.asperity_power


@overload(asperity_power)
def _asperity_power(detail):
    if isinstance(detail, types.NoneType):
        return lambda detail: 0.0
    return lambda detail: detail.asperity_power


@overload(friction_power)
def _friction_power(contact, slip, ring_speed, spin_force, detail):
    if is_curved(contact):
        return lambda contact, slip, ring_speed, spin_force, detail: raceway_power(
            _rule_of(contact.shape), slip, ring_speed, spin_force, detail
        )
    return lambda contact, slip, ring_speed, spin_force, detail: abs(spin_force * slip)
