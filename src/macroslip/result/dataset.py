"""The result of a case as a labelled dataset.

Dimensions: `row` (downwind, upwind), `roller`, `interface` (inner, outer, cage), `orbit` (complete orbits in the window)
and, with traces, `time`. Contacts with microslip or asperities add `raceway` (inner, outer), `mechanism`,
`station`; their maps of the raceways add `angle`, `slip_sign` and `film_regime`.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

import macroslip
from macroslip.bearing.geometry import ROWS, initial_angles
from macroslip.case.parts import Radau
from macroslip.integrate.detail import MECHANISMS
from macroslip.integrate.record import COUNTS, TRACES, RollerRecord
from macroslip.integrate.status import Status
from macroslip.integrate.surface import STATIONS
from macroslip.loads.source_file import without_folders
from macroslip.result import surface_maps
from macroslip.result.variables import INTERFACES, VARIABLES
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.contacts import references

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case
    from macroslip.roller.model import RollerModel

#: Works that every result is based on.
CITATIONS = (
    "Hart et al., Dynamic modelling of slip in a wind turbine spherical roller main bearing",
    "Johnson, Contact Mechanics, Cambridge University Press (1985), doi:10.1017/CBO9781139171731",
)
_RADAU = "Hairer and Wanner, Solving Ordinary Differential Equations II, Springer (1996), doi:10.1007/978-3-642-05221-7"


def to_dataset(
    case: Case,
    model: RollerModel,
    edges: np.ndarray,
    end: float,
    results: dict[tuple[str, int], tuple[int, RollerRecord]],
    notes: dict[str, Any],
    drag_power: float,
) -> xr.Dataset:
    """Collect the records of all rollers.

    Parameters
    ----------
    case : Case
    model : RollerModel
        Of either row.
    edges : ndarray, shape (orbits + 1,)
        Start of the window and ends of its complete orbits [s].
    end : float
        End of the window [s].
    results : dict
        Status and record by row and roller number.
    notes : dict
        Attributes of the result on its accuracy, by name.
    drag_power : float
        Mean power of the lubricant's drag on all rollers of both rows in the window [W].

    Returns
    -------
    xarray.Dataset
        Every variable has `units` and `long_name`; the attributes hold the full input, the version and the works cited.
    """
    import xarray as xr

    status = np.array([[results[row, number][0] for number in case.roller_numbers] for row in ROWS], dtype=np.int8)
    records = [[results[row, number][1] for number in case.roller_numbers] for row in ROWS]
    failed = status != Status.COMPLETED
    curved = isinstance(model.inner, CurvedContact)
    values = _window_values(records, failed) | {"status": status} | _of_integrator(records)
    values["inlet_temperature"] = np.array(case.oil.inlet_temperature)
    if curved:
        values |= _of_contacts(records, failed)
        if case.contact_details:
            values |= _contact_details(records, failed)
    if case.traces is not None:
        # Up to where an integration ended its traces are kept: they show why.
        values |= _traces(np.array([[record.trace for record in line] for line in records]), model, curved=curved)
    data = {
        name: (dims, values[name], {"units": units, "long_name": long_name})
        for name, (dims, units, long_name) in VARIABLES.items()
        if name in values
    }
    data["status"][-1].update(status_flags())
    coordinates = roller_coordinates(case, edges, curved=curved)
    if case.traces is not None:
        coordinates["time"] = ("time", records[0][0].trace_time, {"units": "s", "long_name": "time"})
    method = [_RADAU] if isinstance(case.integrator, Radau) else []
    attributes = input_attributes(case, (float(edges[0]), end), notes, drag_power, method)
    return xr.Dataset(data, coordinates, attributes)


def status_flags() -> dict[str, Any]:
    """What the numbers of `status` mean, as CF conventions have it."""
    return {
        "flag_values": np.array([int(one) for one in Status], dtype=np.int8),
        "flag_meanings": " ".join(one.name.lower() for one in Status),
    }


def input_attributes(
    case: Case, window: tuple[float, float], notes: dict[str, Any], drag_power: float, method: list[str]
) -> dict[str, Any]:
    """Attributes of a result: its window [s], the full input, the version and the works cited, the integrator's last.

    Parameters are those of `to_dataset`, but for `method`, the works on the integrator.
    """
    return {
        "title": f"Roller slip of {case.bearing.name} under {without_folders(case.loads.source)}",
        "source": f"macroslip {macroslip.__version__}",
        "model": case.laws.name,
        "window_start": window[0],
        "window_end": window[1],
        **notes,
        "rollers_per_row": case.bearing.rollers_per_row,
        "drag_power": drag_power,
        "input": json.dumps(case.as_dict(), ensure_ascii=False),
        "citations": "\n".join([*CITATIONS, *references(case.laws), *method]),
    }


def _gathered(records: list[list[RollerRecord]], failed: np.ndarray, name: str) -> np.ndarray:
    """One array of every record over (row, roller, ...); NaN for rollers that failed."""
    values = np.array([[getattr(record, name) for record in line] for line in records], dtype=float)
    values[failed] = np.nan
    return values


def _window_values(records: list[list[RollerRecord]], failed: np.ndarray) -> dict[str, np.ndarray]:
    """Energies, powers and shares of time in the window."""
    ratio = _gathered(records, failed, "spin_ratio")[..., 0]
    with np.errstate(invalid="ignore", divide="ignore"):
        outside = _gathered(records, failed, "outside_time") / _gathered(records, failed, "loaded_time")
    return {
        **{
            name: _gathered(records, failed, name)
            for name in ("energy", "rolling_energy", "orbit_energy", "peak_power")
        },
        "min_spin_ratio": np.where(np.isinf(ratio), np.nan, ratio),
        "outside_film_range": outside,
    }


def _of_integrator(records: list[list[RollerRecord]]) -> dict[str, np.ndarray]:
    """What the integrator did, also of rollers that failed."""
    counts = np.array([[record.count for record in line] for line in records])
    ended = np.array([[record.end for record in line] for line in records])
    return {
        **{name: counts[..., position] for position, name in enumerate(COUNTS)},
        "unbalanced_force": np.array([[record.worst[0] for record in line] for line in records]),
        "end_time": ended[..., 0],
        "end_slip": ended[..., 1],
    }


def _of_contacts(records: list[list[RollerRecord]], failed: np.ndarray) -> dict[str, np.ndarray]:
    """Variables of contacts with microslip or asperities only."""
    return {name: _gathered(records, failed, name) for name in ("mechanism_energy", "asperity_energy")}


def _contact_details(records: list[list[RollerRecord]], failed: np.ndarray) -> dict[str, np.ndarray]:
    """Where on such contacts energy goes, how hot and how densely."""
    extreme = _gathered(records, failed, "extreme")
    with np.errstate(invalid="ignore"):
        extreme[np.isinf(extreme)] = np.nan
    fine, off = np.moveaxis(_gathered(records, failed, "quadrature"), -1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.where(fine > 0.0, off / fine, np.nan)
    names = ("flash_temperature", "power_density", "slide_roll_ratio", "min_film_ratio")
    return {
        "station_energy": _gathered(records, failed, "station_energy"),
        **{name: extreme[..., position] for position, name in enumerate(names)},
        "quadrature_error": error,
        **surface_maps.values(records, failed),
    }


def _traces(trace: np.ndarray, model: RollerModel, *, curved: bool) -> dict[str, np.ndarray]:
    """Turn raw channels into the traces of a result."""
    channel = dict(zip(TRACES, np.moveaxis(trace, -1, 0), strict=True))

    def stack(name: str, places: tuple[str, ...]) -> np.ndarray:
        return np.stack([channel[f"{name}_{place}"] for place in places], axis=-1)

    found = {
        "spin": (channel["ring_speed"] - channel["slip"]) / model.radius,
        "spin_pure": channel["ring_speed"] / model.radius,
        "slip": channel["slip"],
        "roller_load": channel["roller_load"],
        "cage_force": channel["cage_load"],
        "traction": stack("force", INTERFACES),
        "power": stack("power", INTERFACES),
        "rolling_power": stack("rolling", INTERFACES),
        "film_thickness": stack("film", INTERFACES),
    }
    return found | {"skew_moment": stack("skew", INTERFACES[:2])} if curved else found


def roller_coordinates(case: Case, edges: np.ndarray, *, curved: bool) -> dict[str, Any]:
    """Rows, rollers, interfaces and orbits, and places and mechanisms where contacts distinguish them."""
    numbers = list(case.roller_numbers)
    angles = np.array([initial_angles(row, case.bearing.rollers_per_row)[numbers] for row in ROWS])
    about = {"units": "rad", "long_name": "position at the first sample, from +X0 towards +Y0"}
    found: dict[str, Any] = {
        "row": list(ROWS),
        "roller": ("roller", numbers, {"units": "1", "long_name": "number of the roller in its row"}),
        "interface": list(INTERFACES),
        "orbit": ("orbit", np.arange(edges.size - 1), {"units": "1", "long_name": "complete orbit in the window"}),
        "orbit_start": ("orbit", edges[:-1], {"units": "s", "long_name": "start of the orbit"}),
        "orbit_end": ("orbit", edges[1:], {"units": "s", "long_name": "end of the orbit"}),
        "start_angle": (("row", "roller"), angles, about),
    }
    return found | _contact_coordinates(case) if curved else found


def _contact_coordinates(case: Case) -> dict[str, Any]:
    """Places and mechanisms that contacts with microslip or asperities distinguish."""
    named = {"mechanism": list(MECHANISMS), "raceway": list(INTERFACES[:2])}
    if not case.contact_details:
        return named
    bearing = case.bearing
    edges_along = np.linspace(-0.5, 0.5, STATIONS + 1) * bearing.roller_length
    middles = 0.5 * (edges_along[1:] + edges_along[:-1])
    return {
        **named,
        "station": ("station", middles, {"units": "m", "long_name": "place along the roller's axis z'"}),
        **surface_maps.coordinates(bearing),
    }
