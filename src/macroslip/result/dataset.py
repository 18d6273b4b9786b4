"""The result of a case as a labelled dataset.

Dimensions: `row` (downwind, upwind), `roller`, `interface` (inner, outer, cage), `orbit` (complete orbits in the window)
and, with traces, `time`. Contacts with microslip or asperities add `raceway` (inner, outer), `mechanism`,
`station`; their maps of the raceways add `angle`, `slip_sign` and `film_regime`. The whole bearing adds `cage` (both, or
downwind and upwind), `side` of the pocket (front, rear), `position` on the orbit, and `book_time`, at which the books of
momentum and energy are closed.
"""

from __future__ import annotations

import json
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

import macroslip
from macroslip.bearing.geometry import initial_angles, row_names
from macroslip.case.case import Case
from macroslip.case.parts import Radau
from macroslip.constants import ZERO_CELSIUS
from macroslip.contact.asperities import BOUNDED
from macroslip.contact.laws import references
from macroslip.imposed.run import Outcome
from macroslip.imposed.status import Status
from macroslip.loads.source_file import without_folders
from macroslip.measures.cage import SIDES, CageMeasures
from macroslip.measures.details import STATIONS
from macroslip.measures.roller import RollerMeasures, Wanted
from macroslip.measures.totals import INTERFACES, MECHANISMS, spin_ratio
from macroslip.result import skew, surface_maps
from macroslip.result.heat_balance import operating_rings
from macroslip.result.prepared import Prepared
from macroslip.result.variables import COUNTS, ENTRY_EXTREMES, ORBIT_EXTREMES, VARIABLES
from macroslip.roller.model import TableReport
from macroslip.whole.books import FLOWS, STOCKS, Books
from macroslip.whole.model import WholeBearing

#: Works that every result is based on.
CITATIONS = (
    "Hart et al., Dynamic modelling of slip in a wind turbine spherical roller main bearing",
    "Johnson, Contact Mechanics, Cambridge University Press (1985), doi:10.1017/CBO9781139171731",
)
_RADAU = "Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996), doi:10.1007/978-3-642-05221-7"
_SDIRK = "Alexander, SIAM J. Numer. Anal. 14 (1977) 1006, doi:10.1137/0714068"
_TIME = {"units": "s", "long_name": "time"}
#: Part of momentum and energy that may be missing in the books of a whole bearing without a word.
LARGEST_REST = 0.005
#: Part of what is dissipated that friction may seem to give back. What it gives is lost elsewhere, so rows are off by more.
_DRIVEN = 0.001
#: Energy [J] and impulse [N m s] of which no part is missed: those of a bearing at rest are rounding.
_SLIGHT = 1e-4


class Measured(NamedTuple):
    """Measures of a roller, and how its integration went."""

    measures: RollerMeasures
    outcome: Outcome


def to_dataset(
    ready: Prepared, wanted: Wanted, results: dict[tuple[str, int], Measured], tables: TableReport
) -> xr.Dataset:
    """Collect the measures of all rollers on imposed orbits, by row and number of the roller.

    Every variable has `units` and `long_name`; the attributes hold the full input, the version and the works cited.
    """
    method = [_RADAU] if isinstance(ready.case.integrator, Radau) else []
    return _dataset(ready, wanted, results, _attributes(ready, tables, method), {}, {})


def whole_dataset(
    ready: Prepared,
    wanted: Wanted,
    bearing: WholeBearing,
    outcome: Outcome,
    measures: dict[tuple[str, int], RollerMeasures],
    cages: CageMeasures,
    tables: TableReport,
) -> xr.Dataset:
    """Collect the measures of the whole bearing and its cages; parameters and result as for `to_dataset`."""
    results = {job: Measured(one, outcome) for job, one in measures.items()}
    attributes = _attributes(ready, tables, [_SDIRK]) | {"dynamics": ready.case.dynamics}
    attributes["title"] += ", whole bearing"
    if open_books := _open_books(cages.books):
        attributes["books_warning"] = open_books
    extra = _cage_variables(ready.case, bearing, outcome, cages)
    coordinates = {
        "cage": ["both"] if bearing.cages == 1 else list(row_names(ready.case.bearing)),
        "side": list(SIDES),
        "position": _positions(),
        "book_time": ("book_time", cages.books.times, _TIME),
    }
    found = _dataset(ready, wanted, results, attributes, extra, coordinates)
    for name in COUNTS:
        found[name].attrs["long_name"] += ", of all rollers together"
    found.start_angle.attrs["long_name"] = (
        "pocket's position at the first sample, from +X0 towards +Y0"
    )
    return found


def _open_books(books: Books) -> str:
    """A sentence where more of momentum or energy is missing than `LARGEST_REST`, or friction drives; empty otherwise.

    Energy is compared with what was dissipated by the end, momentum with the impulse of one kind that was largest.
    """
    flow = {name: np.abs(books.flows[:, k]) for k, name in enumerate(FLOWS)}
    spent = (
        sum(flow[name][-1] for name in ("raceway_loss", "friction_loss", "guide_loss"))
        + books.pocket_loss()[-1]
    )
    through = max(values.max() for name, values in flow.items() if name.endswith("_impulse"))
    found = []
    for what, rest, of, beside in (
        ("energy", books.energy_residual(), spent, "of what is dissipated"),
        (
            "angular momentum",
            books.momentum_residual(),
            through,
            "of what passes through the bearing",
        ),
    ):
        if (share := np.abs(rest).max() / max(of, _SLIGHT)) > LARGEST_REST:
            found.append(f"{what} to {100.0 * share:.2g} % {beside}")
    words = [f"the books close {' and '.join(found)}, where 0.5 % is good"] if found else []
    if (share := books.driven / max(spent, _SLIGHT)) > _DRIVEN:
        words.append(
            f"friction gave back {100.0 * share:.2g} % of what is dissipated, which it cannot"
        )
    remedy = "results may be off by several times that. Compute again with a smaller integrator.tolerance."
    return f"{'; '.join(words)}; {remedy}" if words else ""


def _dataset(
    ready: Prepared,
    wanted: Wanted,
    results: dict[tuple[str, int], Measured],
    attributes: dict[str, Any],
    extra: dict[str, Any],
    coordinates: dict[str, Any],
) -> xr.Dataset:
    case, curved = ready.case, ready.model.curved
    table = [
        [results[row, number] for number in case.roller_numbers] for row in row_names(case.bearing)
    ]
    values = _window_values(table)
    if case.laws.asperities not in BOUNDED:
        del values["outside_asperity_range"]
    if ready.edges.size == 1:
        sectors = np.array([[one.measures.sector_power for one in line] for line in table])
        sectors[_failed(table)] = np.nan
        values["peak_power_by_position"] = np.swapaxes(sectors.max(axis=1), 1, 2)
        coordinates = {"position": _positions()} | coordinates
    values["inlet_temperature"] = np.array(case.oil.inlet_temperature)
    if curved:
        values |= {name: _gathered(table, name) for name in ("mechanism_energy", "asperity_energy")}
    if wanted.details:
        values |= _contact_details(table)
    if case.laws.skew != "none":
        skews = [[one.measures.skew for one in line] for line in table]
        values |= skew.values(case, skews, _failed(table), ready.end - float(ready.edges[0]))
        coordinates = {"position": _positions()} | coordinates
    if case.traces is not None:
        # Up to where an integration ended its traces are kept: they show why.
        traced = [[one.measures.traces() for one in line] for line in table]
        names = [name for name in VARIABLES if name in traced[0][0]]
        names = [
            name
            for name in names
            if (name != "skew_moment" or curved) and (name != "raceway_slip" or extra)
        ]
        values |= {
            name: np.array([[one[name] for one in line] for line in traced]) for name in names
        }
        coordinates["time"] = ("time", ready.trace_time, _TIME)
    data = {
        name: (dims, values[name], {"units": units, "long_name": long_name})
        for name, (dims, units, long_name) in VARIABLES.items()
        if name in values
    }
    # Meanings of the numbers, in the form of the CF conventions.
    meanings = " ".join(one.name.lower() for one in Status)
    data["status"][-1].update(
        flag_values=np.array([int(one) for one in Status], dtype=np.int8), flag_meanings=meanings
    )
    known = roller_coordinates(case, ready.edges, curved=curved, raceways=curved or bool(extra))
    return xr.Dataset(data | extra, known | coordinates, attributes)


def _attributes(ready: Prepared, tables: TableReport, method: list[str]) -> dict[str, Any]:
    case = ready.case
    # What a reader of the result needs to make the same contacts.
    supplied = {"oil_gap": case.oil.oil_gap} if case.laws.asks_for_oil else {}
    under = f"{case.bearing.name} under {without_folders(case.loads.source)}"
    oil = f"{case.oil.name} at {case.oil.inlet_temperature - ZERO_CELSIUS:.3g} °C"
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
        "input": json.dumps(case.as_dict() | supplied, ensure_ascii=False),
        "citations": "\n".join([*CITATIONS, *references(case.laws), *method]),
    }


def _failed(table: list[list[Measured]]) -> np.ndarray:
    return np.array([[one.outcome.status != Status.COMPLETED for one in line] for line in table])


def _gathered(table: list[list[Measured]], name: str, of: str = "totals") -> np.ndarray:
    """One array of the totals or details over (row, roller, ...); NaN for rollers that failed."""
    values = np.array(
        [[getattr(getattr(one.measures, of), name) for one in line] for line in table], dtype=float
    )
    values[_failed(table)] = np.nan
    return values


def _window_values(table: list[list[Measured]]) -> dict[str, np.ndarray]:
    def outcome(name: str) -> np.ndarray:
        return np.array([[getattr(one.outcome, name) for one in line] for line in table])

    peaks = _gathered(table, "peak_power")
    times = np.array([[one.measures.law_times for one in line] for line in table])
    loads = np.array([[one.measures.totals.film_load for one in line] for line in table])
    ratio = np.array([[spin_ratio(one.measures.totals) for one in line] for line in table])
    failed = _failed(table)
    ratio[failed] = np.nan
    times[failed] = loads[failed] = np.nan
    with np.errstate(invalid="ignore", divide="ignore"):
        films = loads[:, :, 1] / loads[:, :, 0]
        outside = times[:, :, 1:] / times[:, :, :1]
    return {
        **{name: _gathered(table, name) for name in ("energy", "rolling_energy", "orbit_energy")},
        "peak_power": peaks[:, :, :-1],
        "window_peak_power": peaks.max(axis=2),
        "min_spin_ratio": ratio,
        "outside_film_range": outside[:, :, 0],
        "outside_asperity_range": outside[:, :, 1],
        "mean_film_load": films,
        "status": outcome("status").astype(np.int8),
        **{
            name: outcome(kept)
            for name, kept in zip(COUNTS, ("steps", "rejections", "evaluations"), strict=True)
        },
        "unbalanced_force": outcome("unbalanced"),
        "end_time": outcome("time"),
        "end_slip": np.array([[one.measures.end_slip for one in line] for line in table]),
    }


def _contact_details(table: list[list[Measured]]) -> dict[str, np.ndarray]:
    names = ("extreme", "entry_extreme", "quadrature", "station_energy", "entries")
    extreme, entry, quadrature, stations, entries = (
        _gathered(table, name, "details") for name in names
    )
    extreme[np.isinf(extreme)] = np.nan
    # Orbits in which no entry was looked at.
    entry[np.isinf(entry[..., -1])] = np.nan
    fine, off = np.moveaxis(quadrature, -1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.where(fine > 0.0, off / fine, np.nan)
    return {
        "station_energy": stations,
        **dict(zip(ORBIT_EXTREMES, np.moveaxis(extreme, -1, 0), strict=True)),
        "entries": entries,
        **dict(zip(ENTRY_EXTREMES, np.moveaxis(entry, -1, 0), strict=True)),
        "quadrature_error": error,
        **surface_maps.values(
            [[one.measures.details for one in line] for line in table], _failed(table)
        ),
    }


def _cage_variables(
    case: Case, bearing: WholeBearing, outcome: Outcome, cages: CageMeasures
) -> dict[str, Any]:
    data: dict[str, Any] = {}
    numbers, count = list(case.roller_numbers), case.bearing.rollers_per_row

    def put(name: str, dims: tuple[str, ...], values: Any, units: str, long_name: str) -> None:
        data[name] = (dims, values, {"units": units, "long_name": long_name})

    def by_roller(values: np.ndarray) -> np.ndarray:
        found = np.array(values, dtype=float).reshape(case.bearing.rows, count, *values.shape[1:])[
            :, numbers
        ]
        if outcome.status != Status.COMPLETED:
            found[:] = np.nan
        return found

    sided = ("row", "roller", "side")
    put(
        "pocket_impulse",
        sided,
        by_roller(cages.impulse),
        "N s",
        "impulse of a spar on its roller in the window",
    )
    put(
        "largest_pocket_force",
        sided,
        by_roller(cages.largest),
        "N",
        "largest force of a spar in the window",
    )
    put(
        "pocket_contact_time",
        sided,
        by_roller(cages.time),
        "s",
        "time in the window with force on the spar",
    )
    places = cages.largest_by_place.reshape(case.bearing.rows, count, -1).max(axis=1)
    about = "largest force of a spar in the window by place on the orbit, over all rollers"
    put("largest_force_by_position", ("row", "position"), places, "N", about)
    span, first, second = cages.slip.T
    with np.errstate(invalid="ignore", divide="ignore"):
        mean, square = first / span, second / span
        deviation = np.sqrt(np.maximum(square - mean * mean, 0.0))
    put(
        "cage_slip",
        ("cage",),
        mean,
        "1",
        "mean of the cage's speed over that of pure rolling, less one, in the window",
    )
    put(
        "cage_slip_deviation",
        ("cage",),
        deviation,
        "1",
        "standard deviation of the cage's slip in the window",
    )
    books, dims = cages.books, ("book_time",)
    for names, values, since in (
        (STOCKS, books.stocks, "of rollers and cages"),
        (FLOWS, books.flows, "since the first sample"),
    ):
        for name, one in zip(names, values.T, strict=True):
            units = "N m s" if name.endswith(("momentum", "impulse")) else "J"
            put(f"book_{name}", dims, one, units, f"{name.replace('_', ' ')} {since}")
    about = "change of angular momentum less the impulse of all torques"
    put("momentum_residual", dims, books.momentum_residual(), "N m s", about)
    about = "change of kinetic energy less work done and energy dissipated"
    put("energy_residual", dims, books.energy_residual(), "J", about)
    put(
        "pocket_loss",
        dims,
        books.pocket_loss(),
        "J",
        "energy dissipated by impacts and squeeze films",
    )
    if case.traces is None:
        return data
    traced = ("row", "roller", "time")

    def over_time(values: np.ndarray) -> np.ndarray:
        return np.moveaxis(
            values.reshape(len(values), case.bearing.rows, count)[:, :, numbers], 0, -1
        )

    put(
        "pocket_offset",
        traced,
        over_time(cages.offset),
        "m",
        "roller's way ahead of the middle of its pocket",
    )
    about = "orbit speed less that of pure rolling"
    put("orbit_speed_deviation", traced, over_time(cages.deviation), "rad/s", about)
    every = cages.offset.reshape(-1, case.bearing.rows, count)
    ahead = np.roll(every, -1, axis=2) - every
    about = "distance to the next roller ahead along the orbit, less the pitch"
    put("spacing_deviation", traced, over_time(ahead.reshape(len(ahead), -1)), "m", about)
    names = {
        "cage_speed": ("rad/s", "speed of the cage"),
        "cage_lag": ("m", "way of the cage at the pitch radius beyond that of pure rolling"),
        "cage_x": ("m", "displacement of the cage along X0"),
        "cage_y": ("m", "displacement of the cage along Y0"),
        "cage_torque": ("N m", "torque of the rollers on the cage, positive along the orbit"),
    }
    for k, (name, about) in enumerate(names.items()):
        put(name, ("cage", "time"), cages.traces[:, :, k].T, *about)
    return data


def _positions() -> tuple[str, np.ndarray, dict[str, str]]:
    places = np.radians(2.5 + 5.0 * np.arange(72))
    return "position", places, {"units": "rad", "long_name": "place on the orbit, from +X0"}


def roller_coordinates(
    case: Case, edges: np.ndarray, *, curved: bool, raceways: bool
) -> dict[str, Any]:
    """Rows, rollers, interfaces and orbits, and places and mechanisms where contacts distinguish them."""
    numbers = list(case.roller_numbers)
    angles = np.array(
        [
            initial_angles(row, case.bearing.rollers_per_row)[numbers]
            for row in row_names(case.bearing)
        ]
    )
    about = {"units": "rad", "long_name": "position at the first sample, from +X0 towards +Y0"}
    found: dict[str, Any] = {
        "row": list(row_names(case.bearing)),
        "roller": (
            "roller",
            numbers,
            {"units": "1", "long_name": "number of the roller in its row"},
        ),
        "interface": list(INTERFACES),
        "orbit": (
            "orbit",
            np.arange(edges.size - 1),
            {"units": "1", "long_name": "complete orbit in the window"},
        ),
        "orbit_start": ("orbit", edges[:-1], {"units": "s", "long_name": "start of the orbit"}),
        "orbit_end": ("orbit", edges[1:], {"units": "s", "long_name": "end of the orbit"}),
        "start_angle": (("row", "roller"), angles, about),
    }
    if raceways:
        found["raceway"] = list(INTERFACES[:2])
    if curved:
        found["mechanism"] = list(MECHANISMS)
    if curved and case.contact_details:
        middles = ((np.arange(STATIONS) + 0.5) / STATIONS - 0.5) * case.bearing.roller_length
        about = {"units": "m", "long_name": "place along the roller's axis z'"}
        found |= {"station": ("station", middles, about), **surface_maps.coordinates(case.bearing)}
    return found
