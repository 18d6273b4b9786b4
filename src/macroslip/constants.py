"""Constants that several folders share."""

#: Acceleration of free fall [m/s²].
GRAVITY = 9.81

#: 0 °C [K], and hours of a mean year.
ZERO_CELSIUS, HOURS_A_YEAR = 273.15, 8766.0

#: Name under which a case chooses the traction built from viscosity, rheology, heating, microslip and asperities; no
#: traction law of one's own may have it.
MECHANISMS = "mechanisms"

#: Gap where inlets begin to be full [m] from which on they count as flooded.
FLOODED_GAP = 1.0
#: Part of the largest time of a history by which two of its times may differ and be the same one: some roundings [-].
TIME_ROUNDING = 1e-14
