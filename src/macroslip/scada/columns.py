"""Column names of public turbine exports, by quantity.

Names are patterns over the name in lower case without its unit. Where the names come from:

* La Haute Borne, four Senvion MM82, ENGIE's open data: `Ws_avg`, `Rs_avg`, `P_avg`, `Rbt_avg`,
  `Yt_avg`, `Ot_avg`, `Date_time`, `Wind_turbine_name`.
* Senvion MM92 and MM82, wind farms Kelmarsh and Penmanshiel (C. Plumley, Zenodo,
  doi:10.5281/zenodo.5841834 and doi:10.5281/zenodo.5946808): `Rotor bearing temp (°C)`,
  `Nacelle ambient temperature (°C)`. Which bearings their `Front` and `Rear bearing temperature`
  are is not said, so that they are not taken.
* Siemens SWT-2.3, wind farm Hill of Towie (Zenodo, doi:10.5281/zenodo.14870023): `wtc_AcWindSp_mean`,
  `wtc_MainSRpm_mean`, `wtc_ActPower_mean`, `wtc_MainBTmp_mean`, `wtc_NacelTmp_mean`,
  `wtc_AmbieTmp_mean`.
* Vestas, EDP's open data: `Amb_WindSpeed_Avg`, `Rtr_RPM_Avg`, `Grd_Prod_Pwr_Avg`, `Nac_Temp_Avg`,
  `Amb_Temp_Avg`. These files have no main bearing.
* Enercon, a coastal turbine in the south of Ireland (K. Leahy and others, 2016): `WEC: ava.
  windspeed`, `WEC: ava. Rotation`, `WEC: ava. Power`, `Front bearing temp.`, `Rear bearing temp.`,
  `Nacelle temp.`, `Ambient temp.`
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

#: Patterns by quantity, the surest first. Whole names, in lower case.
PATTERNS: Mapping[str, Sequence[str]] = {
    "time": (
        r"date_time|timestamp|time_?stamp(_startformat)?|pctimestamp|date and time|datetime",
        r"time|date|zeit|datum",
    ),
    "turbine": (r"wind_turbine_name|turbine_id|turbine_?name|stationid|asset_id|wtg|turbine",),
    "wind_speed": (
        r"ws_avg|wtc_acwindsp_mean|amb_windspeed_avg|wec: ava\. windspeed|wind speed",
        r"(av[ae]?\.? |mean |avg )?wind[ _]?speed([ _](avg|mean))?|wind_mps|v_wind",
    ),
    "rotor_speed": (
        r"rs_avg|wtc_mainsrpm_mean|rtr_rpm_avg|wec: ava\. rotation|rotor speed",
        r"rotor_(rpm|speed)([ _](avg|mean))?|rotor[ _]speed.*",
    ),
    "power": (
        r"p_avg|wtc_actpower_mean|grd_prod_pwr_avg|wec: ava\. power|power",
        r"active[ _]power([ _](avg|mean))?|power_?kw|(avg |mean )?power([ _](avg|mean))?",
    ),
    "bearing_temperature": (
        r"rbt_avg|rotor bearing temp(erature)?|wtc_mainbtmp_mean|main[ _]bearing[ _]temp.*",
        r"front bearing temp\.|rear bearing temp\.|bearing_?(temperature|degc|temp)",
    ),
    "nacelle_temperature": (
        r"yt_avg|nacelle temp(erature|\.)|wtc_naceltmp_mean|nac_temp_avg",
        r"nacelle_?(temperature|degc|temp).*",
    ),
    "ambient_temperature": (
        r"ot_avg|nacelle ambient temperature|wtc_ambietmp_mean|amb_temp_avg|ambient temp\.",
        r"(ambient|outside|outdoor)[ _]?(temperature|degc|temp).*",
    ),
}
#: Units as headings write them.
_UNITS = {
    "m/s": "m/s", "mps": "m/s", "km/h": "km/h", "rpm": "r/min", "r/min": "r/min", "1/min": "r/min",
    "u/min": "r/min", "rad/s": "rad/s", "w": "W", "kw": "kW", "mw": "MW", "°c": "degC",
    "degc": "degC", "c": "degC", "℃": "degC", "°f": "degF", "degf": "degF", "f": "degF", "k": "K",
}  # fmt: skip
_IN_BRACKETS = re.compile(r"\s*[(\[]\s*(?P<unit>[^()\[\]]*?)\s*[)\]]\s*$")
_BEHIND = re.compile(r"[ _](?P<unit>mps|rpm|kW|MW|W|degC|degF|K|C|F)$")


def unit_of(name: str) -> str:
    """Unit in the name of a column; empty if it has none that is known.

    Examples
    --------
    >>> unit_of("Power (kW)"), unit_of("rotor_rpm"), unit_of("Ws_avg")
    ('kW', 'r/min', '')
    """
    match = _IN_BRACKETS.search(name) or _BEHIND.search(name)
    if not match:
        return ""
    unit = match["unit"].lower()
    return _UNITS.get(unit, "")


def recognized(names: Iterable[str]) -> dict[str, str]:
    """The column of each quantity by the names of common exports, as far as there is one.

    Examples
    --------
    >>> recognized(["Date_time", "Ws_avg", "Ws_min", "Rbt_avg"])
    {'time': 'Date_time', 'wind_speed': 'Ws_avg', 'bearing_temperature': 'Rbt_avg'}
    """
    bare = {}
    for name in names:
        without_unit = _IN_BRACKETS.sub("", name)
        bare[name] = without_unit.strip().lower()
    columns: dict[str, str] = {}
    for quantity, patterns in PATTERNS.items():
        for pattern in patterns:
            fits = [name for name, own in bare.items() if re.fullmatch(pattern, own)]
            if fits:
                columns[quantity] = fits[0]
                break
    return columns
