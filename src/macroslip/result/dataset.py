"""The result of a case as a labelled dataset.

Dimensions: `row` (downwind, upwind), `roller`, `interface` (inner, outer, cage), `orbit` (complete orbits in the window)
and, where traces were asked for, `time`. Contacts with microslip or asperities add `raceway` (inner, outer), `mechanism`
and `station`.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

import macroslip
from macroslip.bearing.frames import ROWS, initial_angles
from macroslip.case.case import Radau
from macroslip.integrate.detail import MECHANISMS, STATIONS
from macroslip.integrate.record import COUNTS, TRACES, Record
from macroslip.integrate.status import Status
from macroslip.roller.contact_force import CurvedContact
from macroslip.roller.contacts import references

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case
    from macroslip.roller.model import RollerModel

INTERFACES = ("inner", "outer", "cage")
#: Works every result rests on.
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
    results: dict[tuple[str, int], tuple[int, Record]],
    film_range_notes: list[str],
    truncated_share: float,
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
    film_range_notes : list of str
        What lies outside the film law's range whatever the load.
    truncated_share : float
        Largest share of a roller's load that lies beyond its ends [-].
    drag_power : float
        Mean power of the lubricant's drag on all rollers of both rows in the window [W].

    Returns
    -------
    xarray.Dataset
        Every variable has `units` and `long_name`; the attributes hold the full input, the version and the works cited.
    """
    import xarray as xr

    numbers = case.roller_numbers
    grid = [[results[row, number] for number in numbers] for row in ROWS]
    status = np.array([[code for code, _ in line] for line in grid], dtype=np.int8)
    failed = status != Status.COMPLETED

    def gather(name: str) -> np.ndarray:
        values = np.array([[getattr(record, name) for _, record in line] for line in grid], dtype=float)
        values[failed] = np.nan
        return values

    data: dict[str, Any] = {}

    def put(
        name: str, dims: tuple[str, ...], values: np.ndarray, units: str, long_name: str, **attributes: Any
    ) -> None:
        data[name] = (dims, values, {"units": units, "long_name": long_name, **attributes})

    rollers = ("row", "roller")
    put("energy", (*rollers, "interface"), gather("energy"), "J", "energy dissipated by friction in the window")
    put(
        "inlet_temperature",
        (),
        np.array(case.oil.inlet_temperature),
        "K",
        "temperature of the oil at the inlets of the contacts",
    )
    put(
        "rolling_energy",
        (*rollers, "interface"),
        gather("rolling_energy"),
        "J",
        "energy dissipated by rolling resistance in the window, apart from the energy of friction",
    )
    put(
        "orbit_energy",
        (*rollers, "orbit", "interface"),
        gather("orbit_energy"),
        "J",
        "energy dissipated by friction in each complete orbit",
    )
    put(
        "peak_power",
        (*rollers, "orbit", "interface"),
        gather("peak_power"),
        "W",
        "largest frictional power in each complete orbit",
    )
    ratio = gather("spin_ratio")[..., 0]
    put(
        "min_spin_ratio",
        rollers,
        np.where(np.isinf(ratio), np.nan, ratio),
        "1",
        "smallest ratio of spin to spin in pure rolling in the window, where the shaft turns at a tenth or more of its "
        "highest speed",
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        outside = gather("outside_time") / gather("loaded_time")
    put(
        "outside_film_range",
        (*rollers, "interface"),
        outside,
        "1",
        "share of loaded time in which load or speed lay outside the film law's range",
    )
    put(
        "status",
        rollers,
        status,
        "1",
        "outcome of the integration",
        flag_values=np.array([int(s) for s in Status], dtype=np.int8),
        flag_meanings=" ".join(s.name.lower() for s in Status),
    )
    for position, name in enumerate(COUNTS):
        counts = np.array([[record.count[position] for _, record in line] for line in grid])
        put(name, rollers, counts, "1", f"number of {name.replace('_', ' ')} of the integrator")
    worst = np.array([[record.worst[0] for _, record in line] for line in grid])
    put("unbalanced_force", rollers, worst, "N", "largest force left unbalanced by an accepted implicit step")
    ended = np.array([[record.end for _, record in line] for line in grid])
    put("end_time", rollers, ended[..., 0], "s", "time at which the integration ended")
    put("end_slip", rollers, ended[..., 1], "m/s", "raceway slip at which the integration ended")
    curved = isinstance(model.inner, CurvedContact)
    if curved:
        _put_detail(put, gather, rollers)
    if case.traces is not None:
        # Up to where an integration ended its traces are kept: they show why.
        trace = np.array([[record.trace for _, record in line] for line in grid])
        _put_traces(put, trace, model, rollers, curved=curved)

    coordinates: dict[str, Any] = {
        "row": list(ROWS),
        "roller": ("roller", list(numbers), {"units": "1", "long_name": "number of the roller in its row"}),
        "interface": list(INTERFACES),
        "orbit": ("orbit", np.arange(edges.size - 1), {"units": "1", "long_name": "complete orbit in the window"}),
        "orbit_start": ("orbit", edges[:-1], {"units": "s", "long_name": "start of the orbit"}),
        "orbit_end": ("orbit", edges[1:], {"units": "s", "long_name": "end of the orbit"}),
        "start_angle": (
            rollers,
            np.array([initial_angles(row, case.bearing.rollers_per_row)[list(numbers)] for row in ROWS]),
            {"units": "rad", "long_name": "position at the first sample, from +X0 towards +Y0"},
        ),
    }
    if curved:
        edges_along = np.linspace(-0.5, 0.5, STATIONS + 1) * case.bearing.roller_length
        coordinates["mechanism"] = list(MECHANISMS)
        middles = 0.5 * (edges_along[1:] + edges_along[:-1])
        coordinates["station"] = ("station", middles, {"units": "m", "long_name": "place along the roller's axis z'"})
        coordinates["raceway"] = list(INTERFACES[:2])
    if case.traces is not None:
        time = grid[0][0][1].trace_time
        coordinates["time"] = ("time", time, {"units": "s", "long_name": "time"})
    citations = [*CITATIONS, *references(case.laws)]
    attributes = {
        "title": f"Roller slip of {case.bearing.name} under {case.loads.source}",
        "source": f"macroslip {macroslip.__version__}",
        "model": case.laws.name,
        "window_start": float(edges[0]),
        "window_end": end,
        "film_range_notes": "\n".join(film_range_notes),
        "truncated_share": truncated_share,
        "rollers_per_row": case.bearing.rollers_per_row,
        "drag_power": drag_power,
        "input": json.dumps(case.as_dict(), ensure_ascii=False),
        "citations": "\n".join([*citations, _RADAU] if isinstance(case.integrator, Radau) else citations),
    }
    return xr.Dataset(data, coordinates, attributes)


def _put_detail(put: Any, gather: Any, rollers: tuple[str, ...]) -> None:
    """What only contacts with microslip or asperities know."""
    put(
        "mechanism_energy",
        (*rollers, "interface", "mechanism"),
        gather("mechanism_energy"),
        "J",
        "energy in the window by what makes surfaces slide: slip of the middle, curvature, contact angle; they add up to "
        "the energy, and one may be negative",
    )
    put(
        "asperity_energy",
        (*rollers, "interface"),
        gather("asperity_energy"),
        "J",
        "part of the energy in the window that asperities dissipate",
    )
    put(
        "station_energy",
        (*rollers, "raceway", "station"),
        gather("station_energy"),
        "J",
        "energy in the window dissipated at each station along the roller",
    )
    extreme = gather("extreme")
    dims = (*rollers, "orbit", "interface")
    with np.errstate(invalid="ignore"):
        extreme[np.isinf(extreme)] = np.nan
    put("flash_temperature", dims, extreme[..., 0], "K", "largest rise of surface temperature in a contact per orbit")
    put("power_density", dims, extreme[..., 1], "W/m2", "largest frictional power per contact area per orbit")
    put("slide_roll_ratio", dims, extreme[..., 2], "1", "largest local slip over entrainment speed per orbit")
    put("min_film_ratio", dims, extreme[..., 3], "1", "least ratio of film thickness to roughness, Lambda, per orbit")
    fine, off = np.moveaxis(gather("quadrature"), -1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        error = np.where(fine > 0.0, off / fine, np.nan)
    put(
        "quadrature_error",
        (*rollers, "raceway"),
        error,
        "1",
        "relative error of the film's power by the quadrature in use, from a finer one at states of the run",
    )


def _put_traces(put: Any, trace: np.ndarray, model: RollerModel, rollers: tuple[str, ...], *, curved: bool) -> None:
    """Turn raw channels into the traces users know."""
    channel = dict(zip(TRACES, np.moveaxis(trace, -1, 0), strict=True))
    slip, ring_speed, radius = channel["slip"], channel["ring_speed"], model.radius
    dims = (*rollers, "time")

    def stack(name: str, places: tuple[str, ...]) -> np.ndarray:
        return np.stack([channel[f"{name}_{place}"] for place in places], axis=-1)

    put(
        "spin",
        dims,
        (ring_speed - slip) / radius,
        "rad/s",
        "spin about the roller's axis, relative to the orbiting frame",
    )
    put("spin_pure", dims, ring_speed / radius, "rad/s", "spin in pure rolling, relative to the orbiting frame")
    put("slip", dims, slip, "m/s", "slip at the middle of either raceway contact, ring less roller")
    put("roller_load", dims, channel["roller_load"], "N", "elastic load of the roller, without body forces")
    put(
        "cage_force",
        dims,
        channel["cage_load"],
        "N",
        "normal force of the cage on the roller, positive along the orbit",
    )
    put(
        "traction",
        (*dims, "interface"),
        stack("force", INTERFACES),
        "N",
        "traction on the roller in its spin equation (moment over radius), positive where it drives the spin up",
    )
    put("power", (*dims, "interface"), stack("power", INTERFACES), "W", "frictional power")
    put(
        "rolling_power",
        (*dims, "interface"),
        stack("rolling", INTERFACES),
        "W",
        "power of rolling resistance, apart from that of friction",
    )
    put(
        "film_thickness",
        (*dims, "interface"),
        stack("film", INTERFACES),
        "m",
        "central film thickness; NaN without load",
    )
    if curved:
        long_name = "skew moment about the contact normal, positive where traction along +x acts at +z'"
        put("skew_moment", (*dims, "raceway"), stack("skew", INTERFACES[:2]), "N m", long_name)
