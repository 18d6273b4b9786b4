"""The laws of a tapered roller's contacts: raceways by strips, the rib, and the cage."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.hertz import effective_modulus, elliptical_contact
from macroslip.contact.interface import ContactShape
from macroslip.contact.laws import LOWEST_ENTRAINMENT_SPEED, PreparedContact, PreparedLaws
from macroslip.contact.line_laws import raceway_by_strips, sheared_film
from macroslip.contact.mechanisms import Laws
from macroslip.contact.rib import chittenden_thickness, rib_asperity_share
from macroslip.contact.strips import REFERENCE_LOAD, strips_of
from macroslip.lubricant import Lubricant


@dataclass(frozen=True)
class PreparedRib(PreparedContact):
    """The laws of a roller's large end on the rib of the inner ring, which slip alike all over."""

    lateral_radius: float  #: Relative radius of curvature across rolling [m]
    oil_supply: float  #: Film over the film with a full inlet [-]

    def film_thickness(self, load, entrainment_speed) -> np.ndarray:
        """Film thickness [m] at F > 0 [N] and the mean speed of both surfaces [m/s]."""
        interface = self.interface
        return self.oil_supply * chittenden_thickness(
            load,
            np.maximum(entrainment_speed, LOWEST_ENTRAINMENT_SPEED),
            interface.rolling_radius,
            self.lateral_radius,
            interface.modulus,
            interface.lubricant,
        )

    def asperity_share(self, load, entrainment_speed, film_thickness) -> np.ndarray:
        """Share of the load that asperities carry [-]; none with laws without asperities."""
        film = np.asarray(film_thickness)
        if self.asperity_name == "none":
            return np.zeros(film.shape)
        return rib_asperity_share(film / self.interface.roughness)

    @property
    def own_sources(self) -> str:
        """The laws of the rib are the program's own."""
        return ""


def tapered_laws(
    ellipses: PreparedLaws, laws: Laws, bearing: TaperedBearing, lubricant: Lubricant
) -> PreparedLaws:
    """Laws of raceways, cage and rib, from those of a roller with a crown in place of its profile.

    Parameters
    ----------
    ellipses : PreparedLaws
        Laws of the contacts as ellipses, whose choices of film, oil and asperities are kept.
    laws : Laws
        The chosen mechanisms.
    bearing : TaperedBearing
    lubricant : Lubricant
        With its `oil_gap`.

    Returns
    -------
    PreparedLaws
        With a rib. No contact has a closed form: the paper's film is sheared strip by strip.
    """
    sheared = sheared_film(laws, lubricant)
    inner, outer = (
        raceway_by_strips(law, strips, laws, sheared, REFERENCE_LOAD)
        for law, strips in zip((ellipses.inner, ellipses.outer), strips_of(bearing), strict=True)
    )
    rib = _rib(ellipses.inner, bearing, sheared)
    return PreparedLaws(inner, outer, replace(ellipses.cage, **sheared), rib)


def _rib(law: PreparedContact, bearing: TaperedBearing, sheared: dict[str, Any]) -> PreparedRib:
    """Laws of the rib, whose film and asperities are its own."""
    row = tapered_geometry(bearing)
    modulus = effective_modulus(*(bearing.youngs_modulus, bearing.poisson_ratio) * 2)
    interface = law.interface._replace(
        name="rib",
        hertz=elliptical_contact(row.rib_rolling_curvature, row.rib_lateral_curvature, modulus),
        rolling_radius=1.0 / row.rib_rolling_curvature,
        roughness=bearing.rib_roughness,
    )
    return law.as_kind(
        PreparedRib,
        **sheared,
        name="rib",
        interface=interface,
        shape=ContactShape(False, math.inf, math.inf, math.inf, 0.0, 0.0),
        # It tells tables of different ribs apart.
        film_name=f"chittenden {bearing.rib_oil_supply!r} {row.rib_lateral_curvature!r}",
        oil_gap=math.inf,
        thermal_loading=0.0,
        rolling=None,
        lateral_radius=1.0 / row.rib_lateral_curvature,
        oil_supply=bearing.rib_oil_supply,
    )
