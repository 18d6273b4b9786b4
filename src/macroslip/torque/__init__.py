"""Friction torque of a whole bearing: computed from its contacts, and by handbooks."""

from macroslip.torque.computed import computed_torque
from macroslip.torque.handbooks import (
    OilBath,
    PalmgrenTorque,
    SkfTorque,
    TorqueHistory,
    palmgren_torque,
    skf_torque,
    torque_histories,
)

__all__ = [
    "OilBath",
    "PalmgrenTorque",
    "SkfTorque",
    "TorqueHistory",
    "computed_torque",
    "palmgren_torque",
    "skf_torque",
    "torque_histories",
]
