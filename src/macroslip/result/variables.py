"""The table of all variables of a result: dimensions, units, meaning, and when they are there."""

from __future__ import annotations

from macroslip.kinds import KINDS
from macroslip.variables import ALWAYS, Variable, VariableTable

#: When a variable is there.
NO_ORBIT = "where no orbit is complete"
AXIAL = "with two rows of rollers, whose loads follow from the load on the ring"
ASPERITIES = "with `laws: {asperities: masjedi-khonsari}`"
CURVED = "where slip may vary along the roller, or asperities touch"
DETAILS = "the same, unless `contact_details: false`"
TRACES = "with `traces`"
CURVED_TRACES = "with `traces`, where slip may vary along the roller, or asperities touch"
SKEW = "with `laws: {skew: quasi-static}`"
SKEW_TRACES = "with `laws: {skew: quasi-static}` and `traces`"
WHOLE = "with `dynamics: whole-bearing`"
WHOLE_TRACES = "with `dynamics: whole-bearing` and `traces`"

_ROWS = ("row",)
_ROLLERS = (*_ROWS, "roller")
_POSITIONS = (*_ROWS, "position")
_INTERFACES = (*_ROLLERS, "interface")
_RACEWAYS = (*_ROLLERS, "raceway")
_ORBITS = (*_ROLLERS, "orbit", "interface")
_ENTRIES = (*_ROLLERS, "orbit", "raceway")
_TRACES = (*_ROLLERS, "time")
_PLACES = (*_ROWS, "raceway", "angle", "station")
_CLASSES = (*_ROWS, "raceway", "film_class", "slip_class")


#: Every variable by name, in the order of a result: those that one kind of bearing has are last.
VARIABLES = VariableTable(
    "Results of `macroslip run` and `simulate`",
    (
        Variable("energy", _INTERFACES, "J", ALWAYS, "energy dissipated by friction in the window"),
        Variable(
            "rolling_energy",
            _INTERFACES,
            "J",
            ALWAYS,
            "energy dissipated by rolling resistance in the window, apart from the energy of friction",
        ),
        Variable(
            "inlet_temperature",
            (),
            "K",
            ALWAYS,
            "temperature of the oil at the inlets of the contacts",
        ),
        Variable(
            "orbit_energy",
            _ORBITS,
            "J",
            ALWAYS,
            "energy dissipated by friction in each complete orbit",
        ),
        Variable(
            "peak_power", _ORBITS, "W", ALWAYS, "largest frictional power in each complete orbit"
        ),
        Variable(
            "window_peak_power",
            _INTERFACES,
            "W",
            ALWAYS,
            "largest frictional power in the window, incomplete orbits included",
        ),
        Variable(
            "peak_power_by_position",
            ("row", "interface", "position"),
            "W",
            NO_ORBIT,
            "largest frictional power in the window by position on the orbit, over all rollers; "
            "where no orbit is complete",
        ),
        Variable(
            "min_spin_ratio",
            _ROLLERS,
            "1",
            ALWAYS,
            "smallest ratio of spin to spin in pure rolling in the window, where the shaft "
            "turns at a tenth or more of its highest speed and the raceways pass at 1 mm/s or "
            "more",
        ),
        Variable(
            "outside_film_range",
            _INTERFACES,
            "1",
            ALWAYS,
            "share of loaded time in which load or speed lay outside the film law's range",
        ),
        Variable(
            "outside_asperity_range",
            _INTERFACES,
            "1",
            ASPERITIES,
            "share of loaded time in which load lay outside the range of the law of "
            "asperities, where their share is bounded by that of the film ratio",
        ),
        Variable(
            "mean_film_load",
            _ROLLERS,
            "N",
            ALWAYS,
            "mean load in the window that films of oil carry beside the rings' elastic load; "
            "it is not part of the balance of the rings",
        ),
        Variable(
            "axial_travel",
            (),
            "m/h",
            AXIAL,
            "distance that the inner ring moves along Z0, back and forth, over the duration of the window",
        ),
        Variable(
            "thrust_reversals",
            (),
            "1/h",
            AXIAL,
            "changes of the sign of the axial load in the window over its duration, beyond a dead "
            "band of 0.1 % of the static load rating of ISO 76 to either side",
        ),
        Variable("status", _ROLLERS, "1", ALWAYS, "outcome of the integration"),
        Variable(
            "steps",
            _ROLLERS,
            "1",
            ALWAYS,
            "number of steps of the integrator; in a whole bearing of all rollers together",
        ),
        Variable(
            "rejections",
            _ROLLERS,
            "1",
            ALWAYS,
            "number of rejections of the integrator; in a whole bearing of all rollers together",
        ),
        Variable(
            "force_evaluations",
            _ROLLERS,
            "1",
            ALWAYS,
            "number of force evaluations of the integrator; in a whole bearing of all rollers together",
        ),
        Variable(
            "unbalanced_force",
            _ROLLERS,
            "N",
            ALWAYS,
            "largest force left unbalanced by an accepted implicit step",
        ),
        Variable("end_time", _ROLLERS, "s", ALWAYS, "time at which the integration ended"),
        Variable(
            "end_slip", _ROLLERS, "m/s", ALWAYS, "raceway slip at which the integration ended"
        ),
        Variable(
            "mechanism_energy",
            (*_INTERFACES, "mechanism"),
            "J",
            CURVED,
            "energy in the window by what makes surfaces slide: slip of the middle, "
            "curvature, contact angle; they add up to the energy, and one may be negative",
        ),
        Variable(
            "asperity_energy",
            _INTERFACES,
            "J",
            CURVED,
            "part of the energy in the window that asperities dissipate",
        ),
        Variable(
            "station_energy",
            (*_RACEWAYS, "station"),
            "J",
            DETAILS,
            "energy in the window dissipated at each station along the roller",
        ),
        Variable(
            "flash_temperature",
            _ORBITS,
            "K",
            DETAILS,
            "largest rise of surface temperature in a contact per orbit",
        ),
        Variable(
            "power_density",
            _ORBITS,
            "W/m2",
            DETAILS,
            "largest frictional power per contact area per orbit",
        ),
        Variable(
            "slide_roll_ratio",
            _ORBITS,
            "1",
            DETAILS,
            "largest local slip over entrainment speed per orbit",
        ),
        Variable(
            "min_film_ratio",
            _ORBITS,
            "1",
            DETAILS,
            "least ratio of film thickness to roughness, Lambda, per orbit",
        ),
        Variable(
            "entries",
            (*_ROLLERS, "orbit"),
            "1",
            DETAILS,
            "how often the rings begin to press the roller, per orbit",
        ),
        Variable(
            "entry_slide_roll_ratio",
            _ENTRIES,
            "1",
            DETAILS,
            "largest slide-roll ratio of the middle while entering, per orbit",
        ),
        Variable(
            "entry_film_ratio", _ENTRIES, "1", DETAILS, "least Lambda while entering, per orbit"
        ),
        Variable(
            "entry_power_density",
            _ENTRIES,
            "W/m2",
            DETAILS,
            "largest frictional power per contact area while entering, per orbit",
        ),
        Variable(
            "entry_flash_temperature",
            _ENTRIES,
            "K",
            DETAILS,
            "largest transient rise of surface temperature while entering, per orbit",
        ),
        Variable(
            "quadrature_error",
            _RACEWAYS,
            "1",
            DETAILS,
            "relative error of the film's power by the quadrature in use, from a finer one at "
            "states of the run",
        ),
        Variable(
            "surface_energy",
            (*_PLACES, "slip_sign", "film_regime"),
            "J",
            DETAILS,
            "energy in the window dissipated at each place of a raceway by all simulated "
            "rollers of the row, by the sign of local slip and by Lambda",
        ),
        Variable(
            "surface_power_density",
            _PLACES,
            "W/m2",
            DETAILS,
            "largest frictional power per area at each place of a raceway, mean over the "
            "width of the contact",
        ),
        Variable(
            "surface_asperity_energy",
            _PLACES,
            "J",
            DETAILS,
            "part of the energy at each place of a raceway that asperities dissipate, of all "
            "simulated rollers",
        ),
        Variable(
            "surface_work",
            _PLACES,
            "J",
            DETAILS,
            "pressure times slip over time and area at each place of a raceway, of all "
            "simulated rollers: the energy in the window that a coefficient of friction of 1 "
            "would dissipate",
        ),
        Variable(
            "surface_passes",
            ("row", "raceway", "angle"),
            "1",
            DETAILS,
            "passes of all simulated rollers over each sector of a raceway in the window, "
            "parts of a pass included",
        ),
        Variable(
            "working_load",
            ("row", "raceway"),
            "N",
            DETAILS,
            "mean load of the contacts, weighted by pressure times slip",
        ),
        Variable(
            "film_slip_time",
            _CLASSES,
            "s",
            DETAILS,
            "time under load by Lambda and by slide-roll ratio, times the part of the "
            "roller's length that has them, of all simulated rollers",
        ),
        Variable(
            "film_slip_passes",
            _CLASSES,
            "1",
            DETAILS,
            "passes over the ring by Lambda and slide-roll ratio, weighted alike",
        ),
        Variable(
            "spin",
            _TRACES,
            "rad/s",
            TRACES,
            "spin about the roller's axis, relative to the orbiting frame",
        ),
        Variable(
            "spin_pure",
            _TRACES,
            "rad/s",
            TRACES,
            "spin in pure rolling, relative to the orbiting frame",
        ),
        Variable(
            "slip",
            _TRACES,
            "m/s",
            TRACES,
            "slip at the middle of either raceway contact, ring less roller",
        ),
        Variable(
            "raceway_slip",
            (*_TRACES, "raceway"),
            "m/s",
            WHOLE_TRACES,
            "slip at the middle of a raceway contact",
        ),
        Variable(
            "roller_load", _TRACES, "N", TRACES, "elastic load of the roller, without body forces"
        ),
        Variable(
            "cage_force",
            _TRACES,
            "N",
            TRACES,
            "normal force of the cage on the roller, positive along the orbit",
        ),
        Variable(
            "traction",
            (*_TRACES, "interface"),
            "N",
            TRACES,
            "traction on the roller in its spin equation (moment over radius), positive where "
            "it drives the spin up",
        ),
        Variable("power", (*_TRACES, "interface"), "W", TRACES, "frictional power"),
        Variable(
            "rolling_power",
            (*_TRACES, "interface"),
            "W",
            TRACES,
            "power of rolling resistance, apart from that of friction",
        ),
        Variable(
            "film_thickness",
            (*_TRACES, "interface"),
            "m",
            TRACES,
            "central film thickness; NaN without load",
        ),
        Variable(
            "skew_moment",
            (*_TRACES, "raceway"),
            "N m",
            CURVED_TRACES,
            "skew moment about the contact normal, positive where traction along +x acts at "
            "+z'; with skew also that of the pressure on the turned ellipse",
        ),
        Variable(
            "skew_energy",
            _RACEWAYS,
            "J",
            SKEW,
            "energy in the window beyond that of a straight roller; it is part of the energy, "
            "and may be negative",
        ),
        Variable(
            "skew_residual",
            _ROLLERS,
            "N m",
            SKEW,
            "largest moment about the contact normal in the window that neither spar nor stop "
            "carries at the rest that was found",
        ),
        Variable(
            "stop_energy",
            _ROLLERS,
            "J",
            SKEW,
            "energy of friction at the two ends of spars that hold a roller at its stop in "
            "the window; part of the energy at the cage",
        ),
        Variable(
            "frictional_thrust",
            _ROWS,
            "N",
            SKEW,
            "mean axial force of a row's rollers on the inner ring by friction and turned "
            "normal force in the window, along +Z0",
        ),
        Variable(
            "skew_by_position",
            _POSITIONS,
            "rad",
            SKEW,
            "mean skew of pressed rollers in the window by position on the orbit",
        ),
        Variable(
            "axial_force_by_position",
            _POSITIONS,
            "N",
            SKEW,
            "mean axial force of a pressed roller on the inner ring in the window by "
            "position on the orbit, along +z'",
        ),
        Variable(
            "skew_power_by_position",
            _POSITIONS,
            "W",
            SKEW,
            "mean power of a pressed roller beyond that of a straight one in the window by "
            "position on the orbit",
        ),
        Variable(
            "skew_angle",
            _TRACES,
            "rad",
            SKEW_TRACES,
            "skew, turn of the roller's axis about +y'; NaN where the rings do not press it",
        ),
        Variable(
            "tilt",
            _TRACES,
            "rad",
            SKEW_TRACES,
            "tilt, turn of the roller's axis about +x; NaN where the rings do not press it",
        ),
        Variable(
            "axial_force",
            _TRACES,
            "N",
            SKEW_TRACES,
            "force on the inner ring by friction and turned normal force, along +z'",
        ),
        Variable(
            "stop_force",
            _TRACES,
            "N",
            SKEW_TRACES,
            "force of either end of the pocket on a roller at its stop",
        ),
        Variable(
            "pocket_impulse",
            (*_ROLLERS, "side"),
            "N s",
            WHOLE,
            "impulse of a spar on its roller in the window",
        ),
        Variable(
            "largest_pocket_force",
            (*_ROLLERS, "side"),
            "N",
            WHOLE,
            "largest force of a spar in the window",
        ),
        Variable(
            "pocket_contact_time",
            (*_ROLLERS, "side"),
            "s",
            WHOLE,
            "time in the window with force on the spar",
        ),
        Variable(
            "largest_force_by_position",
            _POSITIONS,
            "N",
            WHOLE,
            "largest force of a spar in the window by position on the orbit, over all rollers",
        ),
        Variable(
            "cage_slip",
            ("cage",),
            "1",
            WHOLE,
            "mean of the cage's speed over that of pure rolling, less one, in the window",
        ),
        Variable(
            "cage_slip_deviation",
            ("cage",),
            "1",
            WHOLE,
            "standard deviation of the cage's slip in the window",
        ),
        Variable(
            "book_momentum", ("book_time",), "N m s", WHOLE, "angular momentum of rollers and cages"
        ),
        Variable(
            "book_kinetic_energy", ("book_time",), "J", WHOLE, "kinetic energy of rollers and cages"
        ),
        Variable(
            "book_elastic_energy",
            ("book_time",),
            "J",
            WHOLE,
            "elastic energy of spars and radial stop",
        ),
        Variable(
            "book_inner_impulse",
            ("book_time",),
            "N m s",
            WHOLE,
            "angular impulse of the inner raceway since the first sample",
        ),
        Variable(
            "book_outer_impulse",
            ("book_time",),
            "N m s",
            WHOLE,
            "angular impulse of the outer raceway since the first sample",
        ),
        Variable(
            "book_body_impulse",
            ("book_time",),
            "N m s",
            WHOLE,
            "angular impulse of weight and drag of the rollers since the first sample",
        ),
        Variable(
            "book_guide_impulse",
            ("book_time",),
            "N m s",
            WHOLE,
            "angular impulse of the cages' guides since the first sample",
        ),
        Variable(
            "book_eccentric_impulse",
            ("book_time",),
            "N m s",
            WHOLE,
            "angular impulse of pushes on a cage off the axis since the first sample",
        ),
        Variable(
            "book_shaft_work",
            ("book_time",),
            "J",
            WHOLE,
            "work of the shaft since the first sample",
        ),
        Variable(
            "book_body_work",
            ("book_time",),
            "J",
            WHOLE,
            "work of weight and drag of the rollers since the first sample",
        ),
        Variable(
            "book_cage_weight_work",
            ("book_time",),
            "J",
            WHOLE,
            "work of the cages' weight since the first sample",
        ),
        Variable(
            "book_raceway_loss",
            ("book_time",),
            "J",
            WHOLE,
            "energy dissipated in the raceway contacts since the first sample",
        ),
        Variable(
            "book_friction_loss",
            ("book_time",),
            "J",
            WHOLE,
            "energy dissipated by friction in the pockets since the first sample",
        ),
        Variable(
            "book_guide_loss",
            ("book_time",),
            "J",
            WHOLE,
            "energy dissipated by the cages' guides since the first sample",
        ),
        Variable(
            "book_pocket_work",
            ("book_time",),
            "J",
            WHOLE,
            "energy into the pockets, stored or dissipated, since the first sample",
        ),
        Variable(
            "book_support_work",
            ("book_time",),
            "J",
            WHOLE,
            "energy into the radial stop, stored or dissipated, since the first sample",
        ),
        Variable(
            "momentum_residual",
            ("book_time",),
            "N m s",
            WHOLE,
            "change of angular momentum less the impulse of all torques",
        ),
        Variable(
            "energy_residual",
            ("book_time",),
            "J",
            WHOLE,
            "change of kinetic energy less work done and energy dissipated",
        ),
        Variable(
            "pocket_loss",
            ("book_time",),
            "J",
            WHOLE,
            "energy dissipated by impacts and squeeze films",
        ),
        Variable(
            "pocket_offset",
            _TRACES,
            "m",
            WHOLE_TRACES,
            "roller's distance ahead of the middle of its pocket",
        ),
        Variable(
            "orbit_speed_deviation",
            _TRACES,
            "rad/s",
            WHOLE_TRACES,
            "orbit speed less that of pure rolling",
        ),
        Variable(
            "spacing_deviation",
            _TRACES,
            "m",
            WHOLE_TRACES,
            "distance to the next roller ahead along the orbit, less the pitch",
        ),
        Variable("cage_speed", ("cage", "time"), "rad/s", WHOLE_TRACES, "speed of the cage"),
        Variable(
            "cage_lag",
            ("cage", "time"),
            "m",
            WHOLE_TRACES,
            "distance of the cage ahead of pure rolling, at the pitch radius",
        ),
        Variable(
            "cage_x", ("cage", "time"), "m", WHOLE_TRACES, "displacement of the cage along X0"
        ),
        Variable(
            "cage_y", ("cage", "time"), "m", WHOLE_TRACES, "displacement of the cage along Y0"
        ),
        Variable(
            "cage_torque",
            ("cage", "time"),
            "N m",
            WHOLE_TRACES,
            "torque of the rollers on the cage, positive along the orbit",
        ),
        *(own for kind in KINDS.values() for own in kind.variables),
    ),
)
#: Variables of a case's `contact_details`.
CONTACT_DETAILS = tuple(name for name, variable in VARIABLES.items() if variable.when == DETAILS)
#: Counts of an integrator, and their fields of an `Outcome`.
COUNTS = {"steps": "steps", "rejections": "rejections", "force_evaluations": "evaluations"}
#: Variables of the extremes of an orbit, and of entries into the load zone, by the names of
#: `macroslip.measures.extremes.EXTREMES`.
ORBIT_EXTREMES = {
    "flash_temperature": "flash_temperature",
    "power_density": "power_density",
    "slide_roll_ratio": "slide_roll_ratio",
    "film_ratio": "min_film_ratio",
}
ENTRY_EXTREMES = {extreme: f"entry_{extreme}" for extreme in ORBIT_EXTREMES}
