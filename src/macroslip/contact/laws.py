"""The laws of a roller's three contacts, from the choice of mechanisms.

They give values on arrays, from which tables are made.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple, TypeVar

import numpy as np

from macroslip.bearing import Bearing, geometry
from macroslip.constants import FLOODED_GAP, KELLSTROEM, MECHANISMS
from macroslip.contact import asperities, film, kellstroem, rolling, traction
from macroslip.contact.closed_form import BarusCrook, barus_crook_traction, prepare_barus_crook
from macroslip.contact.flash import effusivity
from macroslip.contact.gap import GapShape
from macroslip.contact.interface import ContactShape, Interface, contact_shape, interfaces
from macroslip.contact.kellstroem import SaturatingFriction
from macroslip.contact.mechanisms import Laws, check_lubricant
from macroslip.contact.patch import patch_of, patch_tractions
from macroslip.contact.registry import FILM_LAWS, LEAST_SLIP, TRACTION_LAWS
from macroslip.contact.rolling import RollingNumbers, at_oil_gap, prepare_rolling
from macroslip.contact.starvation import film_factor_at_gap
from macroslip.contact.traction import Fluid, chord_table, prepare_fluid
from macroslip.lubricant import Lubricant

#: Entrainment speed below which a film is that at this speed [m/s].
LOWEST_ENTRAINMENT_SPEED = 1e-6
#: Largest gap between a roller and the spar that pushes it [m]: half of a diametral clearance of
#: 0.5 mm, an engineering estimate; 0.2 to 1 mm is usual.
POCKET_GAP = 0.25e-3
#: Largest S of a cage's contact: a spar ends where its gap is 5 to 10 times the least, an
#: engineering estimate.
_SPAR_END = 7.0
#: A subclass of `PreparedContact`.
Kind = TypeVar("Kind", bound="PreparedContact")


@dataclass(frozen=True)
class PreparedContact:
    """One contact with the laws chosen by `Laws`, and the numbers of its bearing and oil.

    Examples
    --------
    >>> bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    >>> inner = prepare(Laws.physical(), bearing, oil, axial_sign=1).inner
    >>> film = inner.film_thickness(2e4, 0.4)
    >>> round(1e6 * float(film), 3), round(float(inner.asperity_share(2e4, 0.4, film)), 5)
    (1.308, 0.00113)
    >>> round(float(inner.uniform_traction(2e4, film, 1e-2)), 2)
    356.35
    >>> bool(inner.film_in_range(2e4, 0.4)), bool(inner.asperity_share_in_range(2e4))
    (True, True)
    """

    name: str  #: `inner`, `outer` or `cage`
    interface: Interface  #: Its bodies and Hertz coefficients
    shape: ContactShape  #: Its geometry along the roller
    film_name: str  #: Name of the film law
    #: Gap where the inlet begins to be full [m], which thins the film; infinite where flooded
    oil_gap: float
    #: Thermal loading of the inlet at 1 m/s [s²/m²]; 0 leaves inlet heating out
    thermal_loading: float
    #: The sheared film; None for the paper's closed form and for a traction law of one's own
    fluid: Fluid | None
    closed_form: BarusCrook | None  #: The paper's traction
    friction: SaturatingFriction | None  #: Kellström's, of a raceway that has it
    #: `mechanisms`, `kellstroem` or the name of a registered traction law
    traction_name: str
    #: Law for the share of the load that asperities carry; `none` at a cage whose roller floats
    asperity_name: str
    boundary_friction: float  #: µ_b [-]; 0 without asperities
    full_slip: float  #: Slip from which on asperities slide [m/s]
    effusivity: float  #: Of the steel [J/(m² K √s)]; NaN where unknown
    rolling: RollingNumbers | None  #: Rolling resistance
    #: Whether the contact needs more than one force per slip: asperities, or a film that is summed
    #: over the patch.
    curved: bool

    def film_thickness(self, load, entrainment_speed) -> np.ndarray:
        """Film thickness with starvation and inlet heating.

        Parameters
        ----------
        load : array_like
            Q > 0 [N].
        entrainment_speed : array_like
            u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`.

        Returns
        -------
        ndarray
            h [m], of the broadcast shape.
        """
        speed = np.maximum(entrainment_speed, LOWEST_ENTRAINMENT_SPEED)
        height = FILM_LAWS.named(self.film_name)(self.interface, load, speed)
        if self.thermal_loading:
            height = height * film.inlet_heating_factor(self.thermal_loading * speed * speed)
        return (
            height * film_factor_at_gap(self.oil_gap, height)
            if math.isfinite(self.oil_gap)
            else height
        )

    @property
    def inlet_gap(self) -> float:
        """Smaller of the gaps from which on the inlet of film and rolling resistance is full [m].

        Returns
        -------
        float
            Gap [m]; infinite where the inlet is flooded.
        """
        return self.oil_gap if self.rolling is None else min(self.oil_gap, self.rolling.oil_gap)

    def at_gap(self, oil_gap: float) -> PreparedContact:
        """The same contact with inlets full from another gap on, where they are not flooded.

        Parameters
        ----------
        oil_gap : float
            Gap [m].

        Returns
        -------
        PreparedContact
        """
        rolling = self.rolling
        if rolling is not None and math.isfinite(rolling.oil_gap):
            rolling = at_oil_gap(rolling, oil_gap)
        film = oil_gap if math.isfinite(self.oil_gap) else math.inf
        return replace(self, oil_gap=film, rolling=rolling)

    def as_kind(self, kind: type[Kind], **changes: Any) -> Kind:
        """Copy converted to another `PreparedContact` subclass.

        Parameters
        ----------
        kind : type
            The subclass.
        **changes
            Values of fields that differ, and those of fields that the subclass adds.

        Returns
        -------
        PreparedContact
            An object of that class.
        """
        values = {member.name: getattr(self, member.name) for member in fields(PreparedContact)}
        return kind(**(values | changes))

    def film_in_range(self, load, entrainment_speed) -> np.ndarray:
        """True where the film law, without its corrections, is in its range.

        Parameters
        ----------
        load : array_like
            Q > 0 [N].
        entrainment_speed : array_like
            u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`.

        Returns
        -------
        ndarray of bool
        """
        speed = np.maximum(entrainment_speed, LOWEST_ENTRAINMENT_SPEED)
        return FILM_LAWS.named(self.film_name).inside(self.interface, load, speed)

    def asperity_share(self, load, entrainment_speed, film_thickness) -> np.ndarray:
        """Share of the load that asperities carry.

        Parameters
        ----------
        load : array_like
            Q > 0 [N].
        entrainment_speed : array_like
            u_e [m/s], floored at `LOWEST_ENTRAINMENT_SPEED`.
        film_thickness : array_like
            h > 0 [m].

        Returns
        -------
        ndarray
            Share [-], 0 to 1.
        """
        speed = np.maximum(entrainment_speed, LOWEST_ENTRAINMENT_SPEED)
        return asperities.asperity_share(
            self.asperity_name, self.interface, load, speed, film_thickness
        )

    def asperity_share_in_range(self, load) -> np.ndarray:
        """True where the law of asperities is in its range.

        Outside of it the share by the film ratio Λ bounds the law's.

        Parameters
        ----------
        load : array_like
            Q > 0 [N].

        Returns
        -------
        ndarray of bool
        """
        if self.asperity_name in asperities.BOUNDED:
            return asperities.load_is_in_range(self.interface, load)
        return np.ones(np.shape(load), dtype=bool)

    def uniform_traction(self, load, film_thickness, slip) -> np.ndarray:
        """Traction of the film under a slip that is the same all over the contact.

        Kellström's friction has no film: see `macroslip.contact.kellstroem.saturating_patch`. The
        contact ellipse is cut off at the roller's ends.

        Parameters
        ----------
        load : array_like
            Q > 0 [N].
        film_thickness : array_like
            h > 0 [m].
        slip : array_like
            Δu [m/s].

        Returns
        -------
        ndarray
            F [N], with the sign of the slip.
        """
        if self.closed_form is not None:
            return barus_crook_traction(self.closed_form, load, film_thickness, slip)
        if self.fluid is not None:
            patch = patch_of(self)._replace(microslip=False)
            pull = patch_tractions(
                patch, chord_table(self.fluid), load, film_thickness, 0.0, 0.0, slip
            )[..., 0]
            return np.where(np.equal(slip, 0.0), 0.0, pull)[()]
        size = np.maximum(np.abs(slip), LEAST_SLIP)
        return TRACTION_LAWS.named(self.traction_name)(
            self.interface, load, film_thickness, size
        ) * (slip / size)

    @property
    def own_sources(self) -> str:
        """Source text of the user's own laws in this contact, a key of tables made from them.

        Returns
        -------
        str
            Empty without such a law.
        """
        own = (
            TRACTION_LAWS.named(self.traction_name).source
            if self.traction_name not in (MECHANISMS, KELLSTROEM)
            else ""
        )
        return FILM_LAWS.named(self.film_name).source + own


class PreparedLaws(NamedTuple):
    """A roller's contacts with the laws chosen by `Laws`, and the numbers of its bearing and oil.

    Three contacts of every roller, and the rib of a tapered one.
    """

    inner: PreparedContact  #: Of the inner raceway
    outer: PreparedContact  #: Of the outer raceway
    cage: PreparedContact  #: Of the cage
    rib: PreparedContact | None = None  #: Of a tapered roller's rib


def prepare(laws: Laws, bearing: Bearing, lubricant: Lubricant, axial_sign: int) -> PreparedLaws:
    """Laws of the three contacts of a roller, from the choice of mechanisms.

    Parameters
    ----------
    laws : Laws
        The chosen mechanisms.
    bearing : Bearing
        Its dimensions and materials.
    lubricant : Lubricant
        With its `oil_gap`, from which on inlets are full.
    axial_sign : int
        +1 for the downwind row and −1 for the upwind row.

    Returns
    -------
    PreparedLaws
        The laws of the contacts with inner raceway, outer raceway and cage.

    Raises
    ------
    InputError
        For a law that does not exist, values the lubricant lacks, or curvatures that do not make a
        Hertz contact.

    Examples
    --------
    >>> found = prepare(Laws.paper(), Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1)
    >>> height = found.inner.film_thickness(2e4, 0.4)
    >>> float(round(1e6 * height, 3)), float(round(found.inner.uniform_traction(2e4, height, 1e-4), 2))
    (1.324, 7379.33)
    """
    check_lubricant(laws, lubricant)
    FILM_LAWS.named(laws.film)
    is_own = laws.traction not in (MECHANISMS, KELLSTROEM)
    if is_own:
        TRACTION_LAWS.named(laws.traction)
    oil_gap = lubricant.oil_gap if lubricant.oil_gap < FLOODED_GAP else math.inf
    sheared = not is_own and not laws.is_closed_form
    fluid = prepare_fluid(laws, lubricant) if sheared else None
    known = bearing.thermal_conductivity is not None and bearing.specific_heat is not None
    steel = (
        float(effusivity(bearing.thermal_conductivity, bearing.density, bearing.specific_heat))
        if known
        else math.nan
    )
    curvatures = (
        geometry.inner_curvatures(bearing),
        geometry.outer_curvatures(bearing),
        geometry.cage_curvatures(bearing),
    )
    is_rough = laws.asperities != "none"
    contacts = []
    for interface, curved in zip(interfaces(bearing, lubricant), curvatures, strict=True):
        is_cage = interface.name == "cage"
        friction = _raceway_friction(laws, interface.name)
        closed_form = None
        if laws.is_closed_form:
            closed_form = prepare_barus_crook(interface, heated=laws.heating)
        rolling = prepare_rolling(
            laws.rolling,
            interface,
            GapShape(1.0 / curved.rolling, 1.0 / curved.lateral, bearing.roller_length),
            geometry.roller_radius(bearing),
            oil_gap=oil_gap,
            widest_inlet=_SPAR_END if is_cage else math.inf,
            heating=laws.inlet_heating,
        )
        # The film of a roller in its pocket is tens of micrometres thick: no asperity touches.
        floats = is_cage and laws.rolling != "none"
        contacts.append(
            PreparedContact(
                name=interface.name,
                interface=interface,
                shape=contact_shape(bearing, interface, axial_sign, microslip=laws.microslip),
                film_name=laws.film,
                oil_gap=oil_gap if laws.starvation else math.inf,
                thermal_loading=film.thermal_loading(lubricant) if laws.inlet_heating else 0.0,
                fluid=fluid if friction is None else None,
                closed_form=closed_form,
                friction=friction,
                # The film of the cage stays one that is sheared.
                traction_name=MECHANISMS if is_cage and not is_own else laws.traction,
                asperity_name="none" if floats else laws.asperities,
                boundary_friction=lubricant.boundary_friction if is_rough else 0.0,
                full_slip=asperities.FULL_SLIP,
                effusivity=steel,
                rolling=rolling,
                curved=is_rough or sheared,
            )
        )
    if bearing.kind == "tapered":
        from macroslip.contact.tapered import tapered_laws

        return tapered_laws(PreparedLaws(*contacts), laws, bearing, lubricant)
    if bearing.touches_along_line:
        from macroslip.contact.line_laws import cylindrical_laws

        return cylindrical_laws(PreparedLaws(*contacts), laws, bearing, lubricant)
    return PreparedLaws(*contacts)


def _raceway_friction(laws: Laws, interface: str) -> SaturatingFriction | None:
    """Kellström's friction of an interface; None at the cage, and with another traction."""
    if laws.traction != KELLSTROEM or interface == "cage":
        return None
    limit = laws.traction_limit_inner if interface == "inner" else laws.traction_limit_outer
    return SaturatingFriction(limit, laws.traction_saturation)


def references(laws: Laws) -> list[str]:
    """Works to cite for the chosen mechanisms.

    Parameters
    ----------
    laws : Laws

    Returns
    -------
    list of str
        Author, journal, year and DOI of each.

    Examples
    --------
    >>> len(references(Laws.paper()))
    3
    """
    works = [FILM_LAWS.named(laws.film).reference]
    if laws.inlet_heating:
        works.append(film.INLET_HEATING_REFERENCE)
    if laws.traction == KELLSTROEM:
        works.append(kellstroem.REFERENCE)
    elif laws.traction != MECHANISMS:
        works.append(TRACTION_LAWS.named(laws.traction).reference)
    else:
        chosen = (laws.viscosity, laws.rheology, "heating" if laws.heating else "")
        works += [traction.REFERENCES[name] for name in chosen if name in traction.REFERENCES]
    if laws.asperities != "none":
        works.append(asperities.REFERENCES[laws.asperities])
    if laws.rolling != "none":
        works.append(rolling.REFERENCES[laws.rolling])
    return works
