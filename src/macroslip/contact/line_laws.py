"""The laws of raceways that rollers touch along a line, in place of those of ellipses."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from macroslip.bearing import Bearing
from macroslip.contact.gap import GapShape
from macroslip.contact.interface import ContactShape
from macroslip.contact.laws import PreparedContact, PreparedLaws
from macroslip.contact.mechanisms import Laws
from macroslip.contact.rolling import prepare_rolling
from macroslip.contact.strips import (
    REFERENCE_LOAD_PER_LENGTH,
    PreparedStrips,
    Strips,
    equivalent_ellipse,
    strips_of,
)
from macroslip.contact.traction import prepare_fluid
from macroslip.lubricant import Lubricant

#: Drop at the ends of the crown that a straight roller has in the gap beside its contact [m]: far
#: below every film.
_NO_DROP = 1e-9


def cylindrical_laws(
    ellipses: PreparedLaws, laws: Laws, bearing: Bearing, lubricant: Lubricant
) -> PreparedLaws:
    """Laws of raceways and cage of a cylindrical roller that touches along a line.

    Parameters
    ----------
    ellipses : PreparedLaws
        Laws of the contacts as ellipses, whose choices of film, oil and asperities are kept; that of
        the cage stays an ellipse.
    laws : Laws
        The chosen mechanisms.
    bearing : Bearing
        With a `roller_profile`.
    lubricant : Lubricant
        With its `oil_gap`.

    Returns
    -------
    PreparedLaws
        No contact has a closed form: the paper's film is sheared strip by strip.
    """
    sheared = sheared_film(laws, lubricant)
    load = REFERENCE_LOAD_PER_LENGTH * bearing.roller_length
    inner, outer = (
        raceway_by_strips(law, strips, laws, sheared, load)
        for law, strips in zip((ellipses.inner, ellipses.outer), strips_of(bearing), strict=True)
    )
    return PreparedLaws(inner, outer, replace(ellipses.cage, **sheared))


def sheared_film(laws: Laws, lubricant: Lubricant) -> dict[str, Any]:
    """Fields of `PreparedContact` for a film that is sheared, without a closed form."""
    return {"fluid": prepare_fluid(laws, lubricant), "closed_form": None}


def raceway_by_strips(
    law: PreparedContact, strips: Strips, laws: Laws, sheared: dict[str, Any], load: float
) -> PreparedStrips:
    """Laws of a raceway by strips.

    Parameters
    ----------
    law : PreparedContact
        Of the contact as an ellipse.
    strips : Strips
    laws : Laws
        The chosen mechanisms.
    sheared : dict
        Of `sheared_film`.
    load : float
        Load of a roller for which an ellipse stands for the line in film laws [N].

    Returns
    -------
    PreparedStrips
    """
    curvature = strips.curvature
    # In the gap beside the contact the profile is the crown that it has at the roller's middle.
    crown = strips.length**2 / (8.0 * (strips.depth or _NO_DROP))
    interface = law.interface._replace(
        hertz=equivalent_ellipse(strips, load), rolling_radius=1.0 / curvature
    )
    shape = ContactShape(
        microslip=laws.microslip,
        contour_radius=2.0 * crown,
        roller_radius=strips.radius,
        half_length=0.5 * strips.length,
        curvature_ratio=curvature,
        # One apex for roller and ring takes the contact angle's slip out.
        spin_ratio=0.0,
    )
    rolling = prepare_rolling(
        laws.rolling,
        interface,
        GapShape(1.0 / curvature, crown, strips.length),
        strips.radius,
        oil_gap=interface.lubricant.oil_gap if law.rolling is None else law.rolling.oil_gap,
        heating=laws.inlet_heating,
    )
    return law.as_kind(
        PreparedStrips,
        interface=interface,
        shape=shape,
        rolling=rolling,
        strips=strips,
        **sheared,
    )
