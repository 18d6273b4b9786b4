"""Constants that several folders share."""

import math

#: Acceleration of free fall [m/s²].
GRAVITY = 9.81

#: 0 °C [K].
ZERO_CELSIUS = 273.15

#: A revolution a minute [rad/s].
RPM = math.pi / 30.0
#: An hour [s].
HOUR = 3600.0
#: A mean year of 365.25 days [s].
YEAR = 365.25 * 86400.0
#: The same [h].
HOURS_A_YEAR = YEAR / HOUR

#: Kelvin by which temperatures of a record may lie outside those of a study's runs; values of the
#: nearest run hold there.
MOST_BEYOND = 5.0

#: Sectors into which maps divide the orbit of a roller and the circumference of a raceway, of 5°
#: each.
SECTORS = 72

#: Name under which a case chooses the traction built from viscosity, rheology, heating, microslip
#: and asperities; no traction law of one's own may have it.
MECHANISMS = "mechanisms"
#: Name under which a case chooses Kellström's friction at the raceways.
KELLSTROEM = "kellstroem"

#: Whether orbits of rollers are imposed, or rollers and cages move together.
IMPOSED_ORBIT = "imposed-orbit"
WHOLE_BEARING = "whole-bearing"
#: The word for a temperature of a case that follows from friction and the loss of heat.
BALANCE = "balance"

#: Gap where inlets begin to be full [m] from which on they count as flooded.
FLOODED_GAP = 1.0
#: Part of the largest time of a history by which two of its times may differ and be the same one:
#: some roundings [-].
TIME_ROUNDING = 1e-14
