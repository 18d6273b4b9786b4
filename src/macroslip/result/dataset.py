"""The result of a case as a labelled dataset.

Dimensions: `row` (downwind, upwind), `roller`, `interface` (inner, outer, cage), `orbit` (complete
orbits in the window) and, with traces, `time`. Contacts with microslip or asperities add `raceway`
(inner, outer), `mechanism`, `station`; their maps of the raceways add `angle`, `slip_sign` and
`film_regime`. The whole bearing adds `cage` (both, or downwind and upwind), `side` of the pocket
(front, rear), `position` on the orbit, and `book_time`, at which the books of momentum and energy
are closed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

import macroslip
from macroslip.bearing.geometry import initial_angles, row_names
from macroslip.bearing.load_ratings import static_load_rating_of
from macroslip.case.case import WHOLE_BEARING, Case
from macroslip.case.parts import Radau
from macroslip.constants import SECTORS, ZERO_CELSIUS
from macroslip.contact.asperities import BOUNDED
from macroslip.contact.laws import references
from macroslip.imposed.run import Outcome
from macroslip.imposed.status import Status
from macroslip.kinds import KINDS, kind_of
from macroslip.loads import BearingLoads
from macroslip.loads.source_file import without_folders
from macroslip.measures.along import STATIONS
from macroslip.measures.cage import SIDES, CageMeasures
from macroslip.measures.extremes import EXTREMES
from macroslip.measures.quadrature import quadrature_energies
from macroslip.measures.roller import RollerMeasures, Wanted
from macroslip.measures.totals import INTERFACES, MECHANISMS, spin_ratio
from macroslip.result import skew, surface_maps
from macroslip.result.cage_variables import cage_values, open_books
from macroslip.result.heat_balance import operating_rings
from macroslip.result.prepared import Prepared
from macroslip.result.run_input import attribute_of_input
from macroslip.result.variables import (
    ASPERITIES,
    COUNTS,
    CURVED_TRACES,
    ENTRY_EXTREMES,
    ORBIT_EXTREMES,
    VARIABLES,
    WHOLE_TRACES,
)
from macroslip.ring.axial import reversal_rate, travel_rate
from macroslip.roller.model import TableReport
from macroslip.variables import described
from macroslip.whole.model import WholeBearing

#: Works that every result is based on.
CITATIONS = (
    "Hart et al., Dynamic modelling of slip in a wind turbine spherical roller main bearing",
    "Johnson, Contact Mechanics, Cambridge University Press (1985), doi:10.1017/CBO9781139171731",
)
_RADAU = (
    "Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996), "
    "doi:10.1007/978-3-642-05221-7"
)
_SDIRK = "Alexander, SIAM J. Numer. Anal. 14 (1977) 1006, doi:10.1137/0714068"
_TIME = described("s", "time")
#: Axial load over the static load rating up to which its sign does not count [-]. A twentieth of
#: the radial load of the base bearing; a thrust that is smaller hardly moves the ring.
_DEAD_BAND = 1e-3


class Measured(NamedTuple):
    """Measures of a roller, and how its integration went."""

    measures: RollerMeasures
    outcome: Outcome


#: Measures of all rollers by row and number.
Table = list[list[Measured]]


def to_dataset(
    ready: Prepared, wanted: Wanted, results: dict[tuple[str, int], Measured], tables: TableReport
) -> xr.Dataset:
    """Collect the measures of all rollers on imposed orbits, by row and number of the roller.

    Parameters
    ----------
    ready : Prepared
        The case made ready.
    wanted : Wanted
        Measures that were wanted.
    results : dict
        Measures and outcome of every roller by row and number.
    tables : TableReport
        Of the tables of the contacts.

    Returns
    -------
    xarray.Dataset
        Every variable has `units` and `long_name`; the attributes hold the full input, the version
        and the works cited.
    """
    method = []
    if isinstance(ready.case.integrator, Radau):
        method = [_RADAU]
    table = _by_row(ready.case, results)
    values = _values(ready, wanted, table)
    coordinates = _coordinates(ready)
    return _dataset(values, coordinates, _attributes(ready, tables, method))


def whole_dataset(
    ready: Prepared,
    wanted: Wanted,
    bearing: WholeBearing,
    outcome: Outcome,
    measures: dict[tuple[str, int], RollerMeasures],
    cages: CageMeasures,
    tables: TableReport,
) -> xr.Dataset:
    """Collect the measures of the whole bearing and its cages.

    Parameters
    ----------
    ready, wanted, tables
        As for `to_dataset`.
    bearing : WholeBearing
        The bearing as it was integrated.
    outcome : Outcome
        How the integration of all rollers together went.
    measures : dict
        Measures of every roller by row and number.
    cages : CageMeasures
        Measures of cages and pockets, and the books.

    Returns
    -------
    xarray.Dataset
        As of `to_dataset`.
    """
    case = ready.case
    measured = {job: Measured(roller, outcome) for job, roller in measures.items()}
    table = _by_row(case, measured)
    values = _values(ready, wanted, table) | cage_values(case, outcome, cages)
    coordinates = _coordinates(ready) | {
        "cage": ["both"] if bearing.cages == 1 else list(row_names(case.bearing)),
        "side": list(SIDES),
        "position": _positions(),
        "book_time": ("book_time", cages.books.times, _TIME),
    }
    attributes = _attributes(ready, tables, [_SDIRK]) | {"dynamics": case.dynamics}
    attributes["title"] += ", whole bearing"
    if warning := open_books(cages.books):
        attributes["books_warning"] = warning
    result = _dataset(values, coordinates, attributes)
    result.start_angle.attrs["long_name"] = (
        "pocket's position at the first sample, from +X0 towards +Y0"
    )
    return result


def _dataset(
    values: dict[str, Any], coordinates: dict[str, Any], attributes: dict[str, Any]
) -> xr.Dataset:
    data = VARIABLES.put(values)
    # Meanings of the numbers, in the form of the CF conventions.
    data["status"][-1].update(
        flag_values=np.array([int(status) for status in Status], dtype=np.int8),
        flag_meanings=" ".join(status.name.lower() for status in Status),
    )
    return xr.Dataset(data, coordinates, attributes)


def _by_row(case: Case, results: dict[tuple[str, int], Measured]) -> Table:
    rows = row_names(case.bearing)
    lines = []
    for row in rows:
        lines.append([results[row, number] for number in case.roller_numbers])
    return lines


def _values(ready: Prepared, wanted: Wanted, table: Table) -> dict[str, Any]:
    """Values by name of all variables that the case has, but for those of cages."""
    case = ready.case
    curved = ready.model.curved
    left_out = set()
    if case.dynamics != WHOLE_BEARING:
        left_out.add(WHOLE_TRACES)
    if case.laws.asperities not in BOUNDED:
        left_out.add(ASPERITIES)
    if not curved:
        left_out.add(CURVED_TRACES)
    values = _window_values(table)
    values["inlet_temperature"] = np.array(case.oil.inlet_temperature)
    values |= axial_values(ready)
    window = (float(ready.edges[0]), ready.end)
    kind = kind_of(case.bearing)
    values |= kind.values(case, ready.balance, window, _gathered(table, "rib"))
    if ready.edges.size == 1:
        values["peak_power_by_position"] = _peaks_by_position(table)
    if curved:
        for name in ("mechanism_energy", "asperity_energy"):
            values[name] = _gathered(table, name)
    if wanted.details:
        values |= _contact_details(table)
    if case.laws.skew != "none":
        skews = [[roller.measures.skew for roller in line] for line in table]
        length = window[1] - window[0]
        values |= skew.values(case, skews, _failed(table), length)
    if case.traces is not None:
        # Up to where an integration ended its traces are kept: they show why.
        values |= _traces(table)
    others = [other for other in KINDS.values() if other is not kind]
    foreign = {variable.name for other in others for variable in other.variables}
    return {
        name: array
        for name, array in values.items()
        if name not in foreign and VARIABLES[name].when not in left_out
    }


def axial_values(ready: Prepared) -> dict[str, np.ndarray]:
    """Axial travel of the inner ring and reversals of the thrust in the window.

    There are none where roller loads are given, which know no ring, and in a bearing that carries no
    thrust.
    """
    case = ready.case
    knows_ring = isinstance(case.ring_loads, BearingLoads)
    carries_thrust = knows_ring and kind_of(case.bearing).carries_thrust
    if not carries_thrust:
        return {}
    start = float(ready.edges[0])
    motion = ready.motion
    loads = case.ring_loads
    band = _DEAD_BAND * static_load_rating_of(case.bearing)
    travelled = travel_rate(motion.time, motion.displacement[:, 2], start, ready.end)
    reversals = reversal_rate(loads.time, loads.axial_load, band, start, ready.end)
    return {"axial_travel": np.array(travelled), "thrust_reversals": np.array(reversals)}


def _each(table: Table, number: Callable[[Any], Any]) -> np.ndarray:
    """A number or an array of every roller, over (row, roller, ...)."""
    numbers = [[number(roller) for roller in line] for line in table]
    return np.array(numbers)


def _traces(table: Table) -> dict[str, np.ndarray]:
    rollers = [[roller.measures.traces() for roller in line] for line in table]
    stacked = {}
    for name in rollers[0][0]:
        by_roller = [[traces[name] for traces in line] for line in rollers]
        stacked[name] = np.array(by_roller)
    return stacked


def _peaks_by_position(table: Table) -> np.ndarray:
    """Largest power of all rollers over row, interface and position on the orbit [W]."""
    sectors = _each(table, lambda roller: roller.measures.sector_power)
    sectors[_failed(table)] = np.nan
    return np.swapaxes(sectors.max(axis=1), 1, 2)


def _coordinates(ready: Prepared) -> dict[str, Any]:
    """Coordinates of the dimensions that the case has, but for those of cages."""
    case = ready.case
    curved = ready.model.curved
    raceways = curved or case.dynamics == WHOLE_BEARING
    coordinates = roller_coordinates(case, ready.edges, curved=curved, raceways=raceways)
    coordinates |= kind_of(case.bearing).coordinates(case)
    if ready.edges.size == 1 or case.laws.skew != "none":
        coordinates["position"] = _positions()
    if case.traces is not None:
        coordinates["time"] = ("time", ready.trace_time, _TIME)
    return coordinates


def _attributes(ready: Prepared, tables: TableReport, method: list[str]) -> dict[str, Any]:
    case = ready.case
    # What a reader of the result needs to make the same contacts.
    supplied = {}
    if case.laws.asks_for_oil:
        supplied = {"oil_gap": case.oil.oil_gap}
    under = f"{case.bearing.name} under {without_folders(case.loads.source)}"
    celsius = case.oil.inlet_temperature - ZERO_CELSIUS
    oil = f"{case.oil.name} at {celsius:.3g} °C"
    return {
        "title": f"Roller slip of {under}, model {case.laws.name}, {oil}",
        "source": f"macroslip {macroslip.__version__}",
        "model": case.laws.name,
        "oil": oil,
        "window_start": float(ready.edges[0]),
        "window_end": ready.end,
        **ready.notes(tables),
        **operating_rings(case),
        "rollers_per_row": case.bearing.rollers_per_row,
        "drag_power": ready.drag_power(),
        "input": attribute_of_input(case.as_dict() | supplied, case.bearing, ready.models),
        "citations": "\n".join([*CITATIONS, *references(case.laws), *method]),
    }


def _failed(table: Table) -> np.ndarray:
    return _each(table, lambda roller: roller.outcome.status != Status.COMPLETED)


def _gathered(table: Table, name: str, of: str = "totals") -> np.ndarray:
    """One array of the totals or details over (row, roller, ...); NaN for rollers that failed."""

    def value(roller: Measured) -> Any:
        record = getattr(roller.measures, of)
        return getattr(record, name)

    values = _each(table, value)
    values = values.astype(float)
    values[_failed(table)] = np.nan
    return values


def _window_values(table: Table) -> dict[str, Any]:
    def outcome(name: str) -> np.ndarray:
        return _each(table, lambda roller: getattr(roller.outcome, name))

    peaks = _gathered(table, "peak_power")
    times = _each(table, lambda roller: roller.measures.law_times)
    loads = _each(table, lambda roller: roller.measures.totals.film_load)
    ratio = _each(table, lambda roller: spin_ratio(roller.measures.totals))
    failed = _failed(table)
    for values in (ratio, times, loads):
        values[failed] = np.nan
    with np.errstate(invalid="ignore", divide="ignore"):
        film_load = loads[:, :, 1]
        films = film_load / loads[:, :, 0]
        loaded_time = times[:, :, :1]
        outside = times[:, :, 1:] / loaded_time
    return {
        **{name: _gathered(table, name) for name in ("energy", "rolling_energy", "orbit_energy")},
        "peak_power": peaks[:, :, :-1],
        "window_peak_power": peaks.max(axis=2),
        "min_spin_ratio": ratio,
        "outside_film_range": outside[:, :, 0],
        "outside_asperity_range": outside[:, :, 1],
        "mean_film_load": films,
        "status": outcome("status").astype(np.int8),
        **{name: outcome(field) for name, field in COUNTS.items()},
        "unbalanced_force": outcome("unbalanced"),
        "end_time": outcome("time"),
        "end_slip": _each(table, lambda roller: roller.measures.end_slip),
    }


def _contact_details(table: Table) -> dict[str, np.ndarray]:
    extreme = _gathered(table, "extreme", "details")
    entry = _gathered(table, "entry_extreme", "details")
    extreme[np.isinf(extreme)] = np.nan
    # Orbits in which no entry was looked at.
    thinnest = entry[..., EXTREMES.index("film_ratio")]
    entry[np.isinf(thinnest)] = np.nan
    details = [[roller.measures.details for roller in line] for line in table]
    return {
        "station_energy": _gathered(table, "station_energy", "details"),
        **{name: extreme[..., EXTREMES.index(measure)] for measure, name in ORBIT_EXTREMES.items()},
        "entries": _gathered(table, "entries", "details"),
        **{name: entry[..., EXTREMES.index(measure)] for measure, name in ENTRY_EXTREMES.items()},
        "quadrature_error": _quadrature_error(table),
        **surface_maps.values(details, _failed(table)),
    }


def _quadrature_error(table: Table) -> np.ndarray:
    """Relative error of the films' power by the quadrature in use, over (row, roller, raceway)."""
    energies = []
    for line in table:
        row = line[0].measures.row
        samples = [roller.measures.checked for roller in line]
        energies.append(quadrature_energies(row.model.laws, row.contacts, samples))
    fine, off = np.moveaxis(np.array(energies), -1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.where(fine > 0.0, off / fine, np.nan)
    error[_failed(table)] = np.nan
    return error


def _positions() -> tuple[str, np.ndarray, dict[str, str]]:
    sector = 2.0 * np.pi / SECTORS
    middles = (np.arange(SECTORS) + 0.5) * sector
    return "position", middles, described("rad", "place on the orbit, from +X0")


def roller_coordinates(
    case: Case, edges: np.ndarray, *, curved: bool, raceways: bool
) -> dict[str, Any]:
    """Rows, rollers, interfaces and orbits; places and mechanisms where contacts have them.

    Parameters
    ----------
    case : Case
    edges : ndarray, shape (orbits + 1,)
        Start of the window and ends of its complete orbits [s].
    curved : bool
        True if slip may vary along the roller, or asperities touch.
    raceways : bool
        True if variables distinguish raceways.

    Returns
    -------
    dict
        Coordinates as xarray takes them.
    """
    numbers = list(case.roller_numbers)
    rows = row_names(case.bearing)
    angles = []
    for row in rows:
        every = initial_angles(row, case.bearing.rollers_per_row)
        angles.append(every[numbers])
    about_angle = described("rad", "position at the first sample, from +X0 towards +Y0")
    coordinates: dict[str, Any] = {
        "row": list(rows),
        "roller": ("roller", numbers, described("1", "number of the roller in its row")),
        "interface": list(INTERFACES),
        "orbit": (
            "orbit",
            np.arange(edges.size - 1),
            described("1", "complete orbit in the window"),
        ),
        "orbit_start": ("orbit", edges[:-1], described("s", "start of the orbit")),
        "orbit_end": ("orbit", edges[1:], described("s", "end of the orbit")),
        "start_angle": (("row", "roller"), np.array(angles), about_angle),
    }
    if raceways:
        coordinates["raceway"] = list(INTERFACES[:2])
    if curved:
        coordinates["mechanism"] = list(MECHANISMS)
    if curved and case.contact_details:
        parts = (np.arange(STATIONS) + 0.5) / STATIONS
        middles = (parts - 0.5) * case.bearing.roller_length
        axis = kind_of(case.bearing).station_axis
        about_station = described("m", f"place along {axis}")
        coordinates["station"] = ("station", middles, about_station)
        coordinates |= surface_maps.coordinates(case.bearing)
    return coordinates
