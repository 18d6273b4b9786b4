"""Data of an interface that a film or traction law may use."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from macroslip.contact.hertz import HertzContact

if TYPE_CHECKING:
    from macroslip.lubricant import Lubricant


class Interface(NamedTuple):
    """One kind of contact of a roller: with the inner raceway, the outer raceway or the cage.

    Attributes
    ----------
    name : str
        `inner`, `outer` or `cage`.
    hertz : HertzContact
        Coefficients of semi-axes, pressure and approach.
    rolling_radius : float
        Relative radius of curvature in the plane of rolling R [m].
    modulus : float
        Effective modulus E' [Pa].
    roughness : float
        Composite RMS roughness [m].
    hardness : float
        Hardness of the softer surface [Pa].
    lubricant : Lubricant
        The lubricant in it.
    """

    name: str
    hertz: HertzContact
    rolling_radius: float
    modulus: float
    roughness: float
    hardness: float
    lubricant: Lubricant
