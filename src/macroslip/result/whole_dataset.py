"""The result of a coupled simulation of the whole bearing, in the same schema as that of an imposed orbit, with more.

What is added: `cage` (both, or downwind and upwind), `side` of the pocket (front, rear), `position` on the orbit, and
`book_time`, at which the books of momentum and energy are closed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing.geometry import ROWS
from macroslip.integrate.status import Status
from macroslip.result.dataset import input_attributes, roller_coordinates, status_flags
from macroslip.result.variables import INTERFACES, VARIABLES
from macroslip.whole_bearing.books import energy_residual, momentum_residual, pocket_loss
from macroslip.whole_bearing.ledger import FLOWS, STOCKS
from macroslip.whole_bearing.record import CAGE_TRACES, TRACES, BearingRecord

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.case.case import Case
    from macroslip.ring.orbit import Motion
    from macroslip.whole_bearing.model import WholeBearing

#: Sides of a pocket: the spar ahead and the one behind.
SIDES = ("front", "rear")
_CITATION = "Alexander, SIAM J. Numer. Anal. 14 (1977) 1006, doi:10.1137/0714068"


class _Collector:
    """Variables with their dimensions, in rows and rollers."""

    def __init__(self, count: int, numbers: list[int], failed: bool):
        self.count, self.numbers, self.failed = count, numbers, failed
        self.data: dict[str, Any] = {}

    def put(self, name: str, dims: tuple[str, ...], values: Any, units: str, long_name: str, **attributes: Any) -> None:
        self.data[name] = (dims, values, {"units": units, "long_name": long_name, **attributes})

    def put_known(self, name: str, values: Any, **attributes: Any) -> None:
        """A variable that a result on imposed orbits has too, of the same meaning."""
        dims, units, long_name = VARIABLES[name]
        self.put(name, dims, values, units, long_name, **attributes)

    def by_roller(self, values: np.ndarray) -> np.ndarray:
        """(n, …) to (row, roller, …) for the chosen rollers; NaN after a failure."""
        found = np.array(values, dtype=float).reshape(len(ROWS), self.count, *values.shape[1:])[:, self.numbers]
        if self.failed:
            found[:] = np.nan
        return found


def whole_dataset(
    case: Case,
    bearing: WholeBearing,
    motion: Motion,
    status: int,
    record: BearingRecord,
    notes: dict[str, Any],
    *,
    curved: bool,
    drag_power: float,
) -> xr.Dataset:
    """Collect a record. Every variable has `units` and `long_name`."""
    import xarray as xr

    numbers = list(case.roller_numbers)
    out = _Collector(case.bearing.rollers_per_row, numbers, status != Status.COMPLETED)
    shape = (len(ROWS), len(numbers))
    _put_common(out, record, status, shape)
    _put_cage(out, record)
    _put_books(out, record)
    out.put_known("inlet_temperature", np.array(case.oil.inlet_temperature))
    if curved:
        for name in ("mechanism_energy", "asperity_energy"):
            out.put_known(name, out.by_roller(getattr(record, name)))
        if case.contact_details:
            _put_details(out, record)
    if case.traces is not None:
        _put_traces(out, record, bearing, motion, curved=curved)
    edges = record.edges
    case_end = float(motion.time[-1]) if case.window.end is None else float(case.window.end)
    cages = ["both"] if bearing.cages == 1 else list(ROWS)
    coordinates = roller_coordinates(case, edges, curved=curved)
    coordinates["start_angle"][-1]["long_name"] = "pocket's position at the first sample, from +X0 towards +Y0"
    coordinates |= {
        "cage": cages,
        "side": list(SIDES),
        "position": (
            "position", np.radians(2.5 + 5.0 * np.arange(72)), {"units": "rad", "long_name": "place on the orbit, from +X0"}
        ),
        "book_time": ("book_time", record.out_time, {"units": "s", "long_name": "time"}),
    }  # fmt: skip
    if case.traces is not None:
        coordinates["time"] = ("time", record.out_time, {"units": "s", "long_name": "time"})
    attributes = input_attributes(case, (float(edges[0]), case_end), notes, drag_power, [_CITATION])
    attributes |= {"title": f"{attributes['title']}, whole bearing", "dynamics": case.dynamics}
    return xr.Dataset(out.data, coordinates, attributes)


def _put_common(out: _Collector, record: BearingRecord, status: int, shape: tuple[int, int]) -> None:
    """Variables that a result on imposed orbits has too."""
    rollers = ("row", "roller")
    for name in ("energy", "rolling_energy", "orbit_energy", "peak_power"):
        out.put_known(name, out.by_roller(getattr(record, name)))
    ratio = out.by_roller(record.spin_ratio)
    about = "smallest ratio of spin to spin in pure rolling in the window"
    out.put("min_spin_ratio", rollers, np.where(np.isinf(ratio), np.nan, ratio), "1", about)
    with np.errstate(invalid="ignore", divide="ignore"):
        outside = record.outside_time / record.loaded_time
    out.put_known("outside_film_range", out.by_roller(outside))
    out.put_known("status", np.full(shape, status, dtype=np.int8), **status_flags())
    for position, name in enumerate(("steps", "rejections", "force_evaluations")):
        about = f"number of {name.replace('_', ' ')} of the integrator, of all rollers together"
        out.put(name, rollers, np.full(shape, record.count[position]), "1", about)
    out.put_known("unbalanced_force", np.full(shape, record.worst[0]))
    out.put_known("end_time", np.full(shape, record.end[0]))
    slip = record.end_slip.reshape(len(ROWS), -1)[:, out.numbers]
    out.put("end_slip", rollers, slip, "m/s", "mean slip at inner and outer raceway at which the integration ended")


def _put_details(out: _Collector, record: BearingRecord) -> None:
    """Where on contacts with microslip or asperities energy goes, as in a result on imposed orbits."""
    details = record.details
    with np.errstate(invalid="ignore", divide="ignore"):
        extreme = np.where(np.isinf(details.extreme), np.nan, details.extreme)
        error = np.where(
            details.quadrature[..., 0] > 0.0, details.quadrature[..., 1] / details.quadrature[..., 0], np.nan
        )
    values = {
        "station_energy": details.station_energy,
        "flash_temperature": extreme[..., 0],
        "power_density": extreme[..., 1],
        "slide_roll_ratio": extreme[..., 2],
        "min_film_ratio": extreme[..., 3],
        "quadrature_error": error,
    }
    for name, value in values.items():
        out.put_known(name, out.by_roller(value))
    for name, value in {
        "surface_energy": details.surface_energy,
        "surface_power_density": details.surface_density,
    }.items():
        out.put_known(name, np.full_like(value, np.nan) if out.failed else value)


def _put_cage(out: _Collector, record: BearingRecord) -> None:
    """Pockets and cages."""
    rollers = ("row", "roller")
    sided = (*rollers, "side")
    out.put(
        "pocket_impulse", sided, out.by_roller(record.impulse), "N s", "impulse of a spar on its roller in the window"
    )
    out.put(
        "largest_pocket_force", sided, out.by_roller(record.largest_push), "N", "largest force of a spar in the window"
    )
    out.put(
        "pocket_contact_time", sided, out.by_roller(record.push_time), "s", "time in the window with force on the spar"
    )
    places = record.largest_by_position.reshape(len(ROWS), out.count, -1).max(axis=1)
    about = "largest force of a spar in the window by place on the orbit, over all rollers"
    out.put("largest_force_by_position", ("row", "position"), places, "N", about)
    span, first, second = record.slip_square.T
    with np.errstate(invalid="ignore", divide="ignore"):
        mean, square = first / span, second / span
    out.put(
        "cage_slip", ("cage",), mean, "1", "mean of the cage's speed over that of pure rolling, less one, in the window"
    )
    deviation = np.sqrt(np.maximum(square - mean * mean, 0.0))
    out.put("cage_slip_deviation", ("cage",), deviation, "1", "standard deviation of the cage's slip in the window")


def _put_books(out: _Collector, record: BearingRecord) -> None:
    """Books of angular momentum and energy."""
    dims = ("book_time",)
    for k, name in enumerate(STOCKS):
        units = "N m s" if name == "momentum" else "J"
        out.put(f"book_{name}", dims, record.held[:, k], units, f"{name.replace('_', ' ')} of rollers and cages")
    for k, name in enumerate(FLOWS):
        units = "N m s" if name.endswith("impulse") else "J"
        out.put(f"book_{name}", dims, record.flows[:, k], units, f"{name.replace('_', ' ')} since the first sample")
    about = "change of angular momentum less the impulse of all torques"
    out.put("momentum_residual", dims, momentum_residual(record), "N m s", about)
    about = "change of kinetic energy less work done and energy dissipated"
    out.put("energy_residual", dims, energy_residual(record), "J", about)
    out.put("pocket_loss", dims, pocket_loss(record), "J", "energy dissipated by impacts and squeeze films")


def _put_traces(out: _Collector, record: BearingRecord, bearing: WholeBearing, motion: Motion, *, curved: bool) -> None:
    """Series of rollers and cages."""
    trace = dict(zip(TRACES, np.moveaxis(record.trace, -1, 0), strict=True))
    dims = ("row", "roller", "time")

    def channel(name: str) -> np.ndarray:
        return np.moveaxis(trace[name].reshape(record.out_time.size, len(ROWS), -1)[:, :, out.numbers], 0, -1)

    def stack(name: str, places: tuple[str, ...]) -> np.ndarray:
        return np.stack([channel(f"{name}_{place}") for place in places], axis=-1)

    speed = np.interp(record.out_time, motion.time, motion.shaft_speed)
    pure = -bearing.bodies[0].orbit_ratio * bearing.outer_radius * speed / bearing.radius
    slip = 0.5 * (channel("slip_inner") + channel("slip_outer"))
    out.put_known("spin", channel("spin"))
    out.put(
        "spin_pure",
        dims,
        np.broadcast_to(pure, slip.shape),
        "rad/s",
        "spin in pure rolling, on the orbit of pure rolling",
    )
    out.put("slip", dims, slip, "m/s", "mean slip of both raceway contacts, ring less roller")
    out.put(
        "raceway_slip",
        (*dims, "raceway"),
        stack("slip", INTERFACES[:2]),
        "m/s",
        "slip at the middle of a raceway contact",
    )
    out.put_known("roller_load", channel("roller_load"))
    about = "force of the spars on the roller, positive along the orbit"
    out.put("cage_force", dims, channel("cage_force"), "N", about)
    for name, series in (
        ("traction", "traction"),
        ("power", "power"),
        ("rolling_power", "rolling"),
        ("film_thickness", "film"),
    ):
        out.put_known(name, stack(series, INTERFACES))
    out.put("pocket_offset", dims, channel("pocket_offset"), "m", "roller's way ahead of the middle of its pocket")
    about = "orbit speed less that of pure rolling"
    out.put("orbit_speed_deviation", dims, channel("orbit_speed_deviation"), "rad/s", about)
    if curved:
        out.put_known("skew_moment", _skew_moments(bearing, channel, speed))
    whole = np.moveaxis(trace["pocket_offset"].reshape(record.out_time.size, len(ROWS), -1), 0, -1)
    ahead = (np.roll(whole, -1, axis=1) - whole)[:, out.numbers]
    out.put("spacing_deviation", dims, ahead, "m", "distance to the next roller ahead along the orbit, less the pitch")
    names = {
        "cage_speed": ("rad/s", "speed of the cage"),
        "cage_lag": ("m", "way of the cage at the pitch radius beyond that of pure rolling"),
        "cage_x": ("m", "displacement of the cage along X0"),
        "cage_y": ("m", "displacement of the cage along Y0"),
        "cage_torque": ("N m", "torque of the rollers on the cage, positive along the orbit"),
    }
    for k, name in enumerate(CAGE_TRACES):
        out.put(name, ("cage", "time"), record.cage_trace[:, :, k].T, *names[name])


def _skew_moments(bearing: WholeBearing, channel: Callable[[str], np.ndarray], speed: np.ndarray) -> np.ndarray:
    """Skew moments of both raceways [N m] from their power, which is −u2 sin α/R times them; NaN at standstill."""
    orbit = channel("orbit_speed_deviation") + bearing.bodies[0].orbit_ratio * speed
    found = []
    for name, ring, sign in (
        ("inner", (orbit - speed) * bearing.inner_radius, 1.0),
        ("outer", -orbit * bearing.outer_radius, -1.0),
    ):
        ratio = np.array([getattr(model, name).shape.spin_ratio for model in bearing.models])[:, None, None]
        # A contact without microslip has no skew moment at all.
        with np.errstate(invalid="ignore", divide="ignore"):
            moment = np.where(ratio == 0.0, 0.0, -channel(f"skew_power_{name}") / (ring * ratio))
        # A traction that drives the spin up acts along +x at the inner raceway, along −x at the outer one.
        found.append(sign * moment)
    return np.stack(found, axis=-1)
