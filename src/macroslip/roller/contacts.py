"""From the choice of mechanisms to the contacts of a roller: each law prepared for each interface."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from macroslip.bearing import geometry
from macroslip.constants import MECHANISMS
from macroslip.contact.flash_temperature import effusivity
from macroslip.contact.hertz import series_stiffness
from macroslip.contact.shape import ContactShape, common_contour_radius, slipless
from macroslip.errors import InputError
from macroslip.film import asperity_load
from macroslip.film import film_law as film_law
from macroslip.film.correction import INLET_HEATING_REFERENCE, prepare_film
from macroslip.lubricant.temperature import ROELANDS_PRESSURE, roelands_index
from macroslip.roller.contact_force import CurvedContact, PlainContact
from macroslip.roller.films import Films, NoFilms
from macroslip.roller.plane_table import no_plane_table
from macroslip.roller.play_table import no_play_table
from macroslip.roller.raceway_table import no_raceway_table
from macroslip.rolling import rolling_law
from macroslip.rolling.gap import GapShape
from macroslip.traction import traction_law as traction_law
from macroslip.traction.asperity_friction import AsperityFriction
from macroslip.traction.barus_crook import prepare as prepare_barus_crook
from macroslip.traction.chord import Fluid, log_viscosity
from macroslip.traction.chord_table import HIGHEST_PRESSURE, chord_table
from macroslip.traction.film_shear_law import FilmShear
from macroslip.traction.rheology import EYRING, LIMITING_SHEAR, RHEOLOGIES

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.contact.interface import Interface
    from macroslip.lubricant import Lubricant
    from macroslip.mechanisms import Laws

#: Slip [m/s] from which on asperities slide fully. Junctions of about a micrometre that cross a contact 1 mm wide at
#: 0.4 m/s are there at some 0.1 mm/s; an engineering estimate.
_FULL_SLIP = 1e-4
#: Largest logarithm of viscosity [Pa s] at which slip and stress are numbers still.
_HIGHEST_LOG_VISCOSITY = 600.0
#: Pressure by which Barus' exponent is scaled [Pa]; any will do.
_BARUS_PRESSURE = 1e8
#: Largest gap between a roller and the spar that pushes it [m]: half of a diametral clearance of 0.5 mm, an engineering
#: estimate; 0.2 to 1 mm is usual.
_POCKET_GAP = 0.25e-3
#: Largest inlet film of a cage's contact: a spar ends where its gap is 5 to 10 times the least, an engineering estimate.
_POCKET_INLET = 7.0
#: What to cite for each mechanism.
_REFERENCES = {
    "barus": "Barus, Am. J. Sci. 45 (1893) 87",
    "roelands": "Roelands, thesis, Delft (1966)",
    "limiting-shear": "Bair and Winer, J. Lubr. Technol. 101 (1979) 258, doi:10.1115/1.3453342",
    "eyring": "Johnson and Tevaarwerk, Proc. R. Soc. A 356 (1977) 215, doi:10.1098/rspa.1977.0129",
    "heating": "Crook, Phil. Trans. R. Soc. A 254 (1961) 237, doi:10.1098/rsta.1961.0014",
}


def check_lubricant(laws: Laws, lubricant: Lubricant) -> None:
    """Refuse a lubricant that lacks a value the chosen mechanisms need.

    Raises
    ------
    InputError
        Naming the values and the mechanisms.
    """
    needed = {
        "starvation": "starvation" if laws.starvation else "",
        "limiting_shear": "limiting shear" if laws.rheology == "limiting-shear" else "",
        "eyring_stress": "Eyring's rheology" if laws.rheology == "eyring" else "",
        "boundary_friction": "asperity friction" if laws.asperities != "none" else "",
        "fullness": "rolling resistance" if laws.rolling != "none" else "",
        "inlet_film": "rolling resistance" if laws.rolling != "none" else "",
    }
    keys = [key for key, mechanism in needed.items() if mechanism and getattr(lubricant, key) is None]
    if keys:
        lubricant.require(*keys, purpose=" and ".join(dict.fromkeys(needed[key] for key in keys)))


def fluid(laws: Laws, lubricant: Lubricant) -> Fluid:
    """The sheared film of a lubricant under the chosen mechanisms.

    Raises
    ------
    InputError
        If its viscosity is too low for Roelands' law, or rises beyond all numbers with pressure.
    """
    if laws.viscosity == "roelands":
        index = roelands_index(lubricant.viscosity, lubricant.pressure_viscosity)
        exponent, pressure = math.log(lubricant.viscosity) + 9.67, ROELANDS_PRESSURE
    else:
        index, exponent, pressure = 1.0, lubricant.pressure_viscosity * _BARUS_PRESSURE, _BARUS_PRESSURE
    rheology = RHEOLOGIES[laws.rheology]
    characteristic = 1.0
    if rheology == LIMITING_SHEAR:
        characteristic = lubricant.limiting_shear
    elif rheology == EYRING:
        characteristic = lubricant.eyring_stress
    heating = lubricant.temperature_viscosity / (8.0 * lubricant.thermal_conductivity) if laws.heating else 0.0
    found = Fluid(
        rheology=rheology,
        viscosity=lubricant.viscosity,
        exponent=exponent,
        index=index,
        reference_pressure=pressure,
        characteristic=characteristic,
        heating=heating,
    )
    highest, _ = log_viscosity(found, HIGHEST_PRESSURE)
    if highest > _HIGHEST_LOG_VISCOSITY:
        raise InputError(
            f"viscosity rises to 1e{highest / math.log(10.0):.0f} Pa s at {HIGHEST_PRESSURE / 1e9:g} GPa, "
            f"with a pressure-viscosity coefficient of {1e9 * lubricant.pressure_viscosity:g} 1/GPa",
            where="lubricant, pressure_viscosity",
            allowed=f"up to 1e{_HIGHEST_LOG_VISCOSITY / math.log(10.0):.0f} Pa s; oils have 10 to 50 1/GPa",
            remedy="Look at the number and its unit.",
        )
    return found


def contact_shape(bearing: Bearing, interface: Interface, axial_sign: int, *, microslip: bool) -> ContactShape:
    """How slip varies over an interface; on the cage's contact it is the same all over.

    The sign of ζ is that of the roller's axis z'. With z' = z cos α − y sin α (s = +1) the ring's surface at the station ζ
    is ζ sin α nearer to the bearing axis, which gives v the term +s (Ω_in − Ω) sin α ζ; ζ counted the other way round
    turns its sign, and that of the skew moment, and nothing else.
    """
    half_length = 0.5 * bearing.roller_length
    if not microslip or interface.name == "cage":
        return slipless(half_length)
    roller = geometry.roller_contour_radius(bearing)
    inner = interface.name == "inner"
    raceway = geometry.inner_raceway_contour_radius(bearing) if inner else bearing.outer_raceway_radius
    place = geometry.inner_contact_radius(bearing) if inner else geometry.outer_contact_radius(bearing)
    return ContactShape(
        microslip=True,
        contour_radius=common_contour_radius(roller, raceway),
        roller_radius=geometry.roller_radius(bearing),
        half_length=half_length,
        curvature_ratio=1.0 / interface.rolling_radius,
        spin_ratio=axial_sign * math.sin(bearing.contact_angle) / place,
    )


def prepare_contact(
    laws: Laws, bearing: Bearing, lubricant: Lubricant, interface: Interface, axial_sign: int
) -> PlainContact | CurvedContact:
    """The contact of one interface.

    Parameters
    ----------
    laws : Laws
    bearing : Bearing
    lubricant : Lubricant
    interface : Interface
    axial_sign : int
        +1 for the downwind row, −1 for the upwind row.

    Returns
    -------
    PlainContact or CurvedContact
        Plain where no chosen mechanism needs more, so that the paper's kernels contain nothing else.

    Raises
    ------
    InputError
        For a law that does not exist, or values the lubricant lacks.
    """
    check_lubricant(laws, lubricant)
    starvation = lubricant.starvation if laws.starvation else 1.0
    film = prepare_film(laws.film, interface, starvation=starvation, inlet_heating=laws.inlet_heating)
    hertz = interface.hertz
    if laws.traction != MECHANISMS:
        traction = traction_law.prepare(laws.traction, interface)
    elif laws.is_closed_form:
        traction = prepare_barus_crook(interface)
    else:
        table = chord_table(fluid(laws, lubricant))
        traction = FilmShear(table, hertz.semi_axis_across, hertz.semi_axis_along, hertz.pressure)
    if laws.asperities == "none" and not isinstance(traction, FilmShear):
        return PlainContact(film, traction)
    friction = 0.0
    # The film of a roller in its pocket is that of `films`, of tens of micrometres: no asperity touches.
    floating = interface.name == "cage" and laws.rolling != "none"
    if laws.asperities != "none":
        friction = lubricant.boundary_friction
    known = bearing.thermal_conductivity is not None and bearing.specific_heat is not None
    steel = effusivity(bearing.thermal_conductivity, bearing.density, bearing.specific_heat) if known else math.nan
    return CurvedContact(
        film=film,
        traction=traction,
        asperity_load=asperity_load.prepare("none" if floating else laws.asperities, interface),
        asperity_friction=AsperityFriction(friction, _FULL_SLIP, hertz.semi_axis_across),
        shape=contact_shape(bearing, interface, axial_sign, microslip=laws.microslip),
        semi_axis_across=hertz.semi_axis_across,
        semi_axis_along=hertz.semi_axis_along,
        effusivity_1=steel,
        effusivity_2=steel,
        roughness=interface.roughness,
        table=no_plane_table() if interface.name == "cage" else no_raceway_table(),
    )


def prepare_films(
    laws: Laws, bearing: Bearing, lubricant: Lubricant, found: tuple[Interface, Interface, Interface]
) -> Films | NoFilms:
    """The oil around a roller.

    Parameters
    ----------
    laws : Laws
    bearing : Bearing
    lubricant : Lubricant
    found : tuple of three Interface
        Inner, outer and cage.

    Returns
    -------
    Films or NoFilms

    Raises
    ------
    InputError
        For a law that does not exist, or values the lubricant lacks or has out of range.
    """
    if laws.rolling == "none":
        return NoFilms()
    radius = geometry.roller_radius(bearing)
    curvatures = (
        geometry.inner_curvatures(bearing),
        geometry.outer_curvatures(bearing),
        geometry.cage_curvatures(bearing),
    )
    prepared = []
    for interface, curvature in zip(found, curvatures, strict=True):
        inlet = lubricant.inlet_film
        prepared.append(
            rolling_law.prepare_rolling(
                laws.rolling,
                interface,
                GapShape(1.0 / curvature.rolling, 1.0 / curvature.lateral, bearing.roller_length),
                radius,
                fullness=lubricant.fullness,
                inlet_film=min(inlet, _POCKET_INLET) if interface.name == "cage" else inlet,
                heating=laws.inlet_heating,
            )
        )
    return Films(
        *prepared,
        stiffness=series_stiffness(found[0].hertz, found[1].hertz),
        pocket_gap=_POCKET_GAP,
        inner_table=no_plane_table(),
        outer_table=no_plane_table(),
        cage_table=no_plane_table(),
        play_table=no_play_table(),
        faded_load=math.inf,
        faded_speed=0.0,
    )


def references(laws: Laws) -> list[str]:
    """What to cite for the chosen mechanisms."""
    found = [film_law.reference(laws.film)]
    if laws.inlet_heating:
        found.append(INLET_HEATING_REFERENCE)
    if laws.traction != MECHANISMS:
        found.append(traction_law.reference(laws.traction))
    else:
        found += [_REFERENCES[name] for name in (laws.viscosity, laws.rheology) if name in _REFERENCES]
        found += [_REFERENCES["heating"]] if laws.heating else []
    if laws.asperities != "none":
        found.append(asperity_load.reference(laws.asperities))
    if laws.rolling != "none":
        found.append(rolling_law.REFERENCES[laws.rolling])
    return found
