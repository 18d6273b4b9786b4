"""Friction torque of a whole bearing: as computed from its contacts, and as handbooks estimate it."""

from macroslip.torque.comparison import TorqueHistory, torque_histories
from macroslip.torque.computed import computed_torque
from macroslip.torque.palmgren import PalmgrenTorque, palmgren_torque
from macroslip.torque.skf import SkfTorque, skf_torque
from macroslip.torque.skf_drag import OilBath

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
