"""Variables that a result may hold, with their dimensions, units and meaning."""

from __future__ import annotations

from macroslip.result import skew, surface_maps


def described(units: str, long_name: str) -> dict[str, str]:
    """Attributes of a variable."""
    return {"units": units, "long_name": long_name}


#: Counts of an integrator.
COUNTS = ("steps", "rejections", "force_evaluations")
_ROLLERS = ("row", "roller")
_INTERFACES = (*_ROLLERS, "interface")
_ORBITS = (*_ROLLERS, "orbit", "interface")
_ENTRIES = (*_ROLLERS, "orbit", "raceway")
_TRACES = (*_ROLLERS, "time")
#: Dimensions, units and meaning of every variable a result may have, by name, in their order.
VARIABLES: dict[str, tuple[tuple[str, ...], str, str]] = {
    "energy": (_INTERFACES, "J", "energy dissipated by friction in the window"),
    "rolling_energy": (_INTERFACES, "J", "energy dissipated by rolling resistance in the window, apart from the "
        "energy of friction"),
    "inlet_temperature": ((), "K", "temperature of the oil at the inlets of the contacts"),
    "orbit_energy": (_ORBITS, "J", "energy dissipated by friction in each complete orbit"),
    "peak_power": (_ORBITS, "W", "largest frictional power in each complete orbit"),
    "window_peak_power": (_INTERFACES, "W", "largest frictional power in the window, incomplete orbits included"),
    "peak_power_by_position": (("row", "interface", "position"), "W", "largest frictional power in the window by "
        "place on the orbit, over all rollers; where no orbit is complete"),
    "min_spin_ratio": (_ROLLERS, "1", "smallest ratio of spin to spin in pure rolling in the window, where the "
        "shaft turns at a tenth or more of its highest speed and the raceways pass at 1 mm/s or more"),
    "outside_film_range": (_INTERFACES, "1", "share of loaded time in which load or speed lay outside the film "
        "law's range"),
    "outside_asperity_range": (_INTERFACES, "1", "share of loaded time in which load lay outside the range of the law of "
        "asperities, where their share is bounded by that of the film ratio"),
    "mean_film_load": (_ROLLERS, "N", "mean load in the window that films of oil carry beside the rings' elastic load; "
        "the balance of the rings does not know it"),
    "status": (_ROLLERS, "1", "outcome of the integration"),
    **{name: (_ROLLERS, "1", f"number of {name.replace('_', ' ')} of the integrator") for name in COUNTS},
    "unbalanced_force": (_ROLLERS, "N", "largest force left unbalanced by an accepted implicit step"),
    "end_time": (_ROLLERS, "s", "time at which the integration ended"),
    "end_slip": (_ROLLERS, "m/s", "raceway slip at which the integration ended"),
    # Contacts with microslip or asperities.
    "mechanism_energy": ((*_INTERFACES, "mechanism"), "J", "energy in the window by what makes surfaces slide: "
        "slip of the middle, curvature, contact angle; they add up to the energy, and one may be negative"),
    "asperity_energy": (_INTERFACES, "J", "part of the energy in the window that asperities dissipate"),
    "station_energy": ((*_ROLLERS, "raceway", "station"), "J", "energy in the window dissipated at each station "
        "along the roller"),
    "flash_temperature": (_ORBITS, "K", "largest rise of surface temperature in a contact per orbit"),
    "power_density": (_ORBITS, "W/m2", "largest frictional power per contact area per orbit"),
    "slide_roll_ratio": (_ORBITS, "1", "largest local slip over entrainment speed per orbit"),
    "min_film_ratio": (_ORBITS, "1", "least ratio of film thickness to roughness, Lambda, per orbit"),
    "entries": ((*_ROLLERS, "orbit"), "1", "how often the rings begin to press the roller, per orbit"),
    "entry_slide_roll_ratio": (_ENTRIES, "1", "largest slide-roll ratio of the middle while entering, per orbit"),
    "entry_film_ratio": (_ENTRIES, "1", "least Lambda while entering, per orbit"),
    "entry_power_density": (_ENTRIES, "W/m2", "largest frictional power per contact area while entering, per "
        "orbit"),
    "entry_flash_temperature": (_ENTRIES, "K", "largest transient rise of surface temperature while entering, "
        "per orbit"),
    "quadrature_error": ((*_ROLLERS, "raceway"), "1", "relative error of the film's power by the quadrature in "
        "use, from a finer one at states of the run"),
    **surface_maps.VARIABLES,
    # Traces.
    "spin": (_TRACES, "rad/s", "spin about the roller's axis, relative to the orbiting frame"),
    "spin_pure": (_TRACES, "rad/s", "spin in pure rolling, relative to the orbiting frame"),
    "slip": (_TRACES, "m/s", "slip at the middle of either raceway contact, ring less roller"),
    "raceway_slip": ((*_TRACES, "raceway"), "m/s", "slip at the middle of a raceway contact"),
    "roller_load": (_TRACES, "N", "elastic load of the roller, without body forces"),
    "cage_force": (_TRACES, "N", "normal force of the cage on the roller, positive along the orbit"),
    "traction": ((*_TRACES, "interface"), "N", "traction on the roller in its spin equation (moment over "
        "radius), positive where it drives the spin up"),
    "power": ((*_TRACES, "interface"), "W", "frictional power"),
    "rolling_power": ((*_TRACES, "interface"), "W", "power of rolling resistance, apart from that of friction"),
    "film_thickness": ((*_TRACES, "interface"), "m", "central film thickness; NaN without load"),
    "skew_moment": ((*_TRACES, "raceway"), "N m", "skew moment about the contact normal, positive where traction along +x "
        "acts at +z'; with skew also that of the pressure on the turned ellipse"),
    **skew.VARIABLES,
}  # fmt: skip
#: Extremes of an orbit, and of entries into the load zone, in the order of `macroslip.measures.details.EXTREMES`.
ORBIT_EXTREMES = ("flash_temperature", "power_density", "slide_roll_ratio", "min_film_ratio")
ENTRY_EXTREMES = (
    "entry_flash_temperature",
    "entry_power_density",
    "entry_slide_roll_ratio",
    "entry_film_ratio",
)
#: Variables of a case's `contact_details`.
CONTACT_DETAILS = (
    "station_energy",
    *ORBIT_EXTREMES,
    "entries",
    *ENTRY_EXTREMES,
    "quadrature_error",
    *surface_maps.VARIABLES,
)
