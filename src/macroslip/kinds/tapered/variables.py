"""Variables of a result that tapered roller bearings alone have."""

from __future__ import annotations

from macroslip.variables import Variable

#: When they are there.
_TAPERED = "in a tapered roller bearing"
_TAPERED_ASPERITIES = "in a tapered roller bearing, with a law of asperities"
_TAPERED_TRACES = "in a tapered roller bearing, with `traces`"

_BY_ROW = ("row",)
_BY_ROLLER = ("row", "roller")
_BY_ORBIT = ("row", "roller", "orbit")
_BY_TIME = ("row", "roller", "time")

#: In the order of a result.
VARIABLES = (
    Variable(
        "rib_energy",
        _BY_ROLLER,
        "J",
        _TAPERED,
        "energy dissipated by friction at the rib in the window, beside the energy by interface",
    ),
    Variable(
        "rib_asperity_energy",
        _BY_ROLLER,
        "J",
        _TAPERED,
        "part of the energy at the rib in the window that asperities dissipate",
    ),
    Variable(
        "rib_orbit_energy",
        _BY_ORBIT,
        "J",
        _TAPERED,
        "energy dissipated by friction at the rib in each complete orbit",
    ),
    Variable(
        "rib_peak_power",
        _BY_ORBIT,
        "W",
        _TAPERED,
        "largest frictional power at the rib in each complete orbit",
    ),
    Variable(
        "largest_rib_force",
        _BY_ROW,
        "N",
        _TAPERED,
        "largest force of the rib on a roller in the window",
    ),
    Variable(
        "rib_pressure",
        _BY_ROW,
        "Pa",
        _TAPERED,
        "largest Hertzian pressure at the ribs in the window",
    ),
    Variable(
        "rib_pressure_speed",
        _BY_ROW,
        "W/m2",
        _TAPERED,
        "largest pressure at the ribs times sliding speed in pure rolling, in the window",
    ),
    Variable(
        "rib_pass_energy",
        _BY_ROW,
        "J/m2",
        _TAPERED,
        "largest pressure times slip that a place of the rib gets in a pass, in the window",
    ),
    Variable(
        "rib_flash_temperature",
        _BY_ROW,
        "K",
        _TAPERED,
        "largest flash temperature at the ribs in the window, in pure rolling",
    ),
    Variable(
        "rib_asperity_work",
        (*_BY_ROW, "rib_surface"),
        "W/m2",
        _TAPERED_ASPERITIES,
        "asperities' pressure times slip per time, mean over the window: depth of wear a second "
        "over k",
    ),
    Variable(
        "min_rib_film_ratio",
        _BY_ROW,
        "1",
        _TAPERED,
        "least ratio of film thickness to roughness at the ribs in the window, in pure rolling",
    ),
    Variable(
        "rollers_below_grip",
        _BY_ROW,
        "1",
        _TAPERED,
        "mean number of rollers in the window whose load is below that of grip",
    ),
    Variable(
        "grip_load",
        (),
        "N",
        _TAPERED,
        "load from which on a raceway drives a roller with less than 1 % of slip, at the mean speed",
    ),
    Variable(
        "least_roller_load", _BY_ROW, "N", _TAPERED, "least elastic load of a roller in the window"
    ),
    Variable("largest_tilt", (), "rad", _TAPERED, "largest tilt of the inner ring in the window"),
    Variable(
        "preload",
        (),
        "m",
        _TAPERED,
        "axial interference of both rows with the temperature difference; negative is play",
    ),
    Variable(
        "preload_change",
        (),
        "m",
        _TAPERED,
        "change of the preload by the temperature difference",
    ),
    Variable(
        "rib_friction",
        _BY_TIME,
        "N",
        _TAPERED_TRACES,
        "friction of the rib on the roller, positive where it drives the spin up",
    ),
    Variable("rib_power", _BY_TIME, "W", _TAPERED_TRACES, "frictional power at the rib"),
)
