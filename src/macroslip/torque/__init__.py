"""Friction torque of a whole bearing as handbooks estimate it, to compare the computed one with."""

from macroslip.torque.palmgren import PalmgrenTorque, palmgren_torque
from macroslip.torque.skf import SkfTorque, skf_torque
from macroslip.torque.skf_drag import OilBath

__all__ = ["OilBath", "PalmgrenTorque", "SkfTorque", "palmgren_torque", "skf_torque"]
