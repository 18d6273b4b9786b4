"""Friction torque of the whole bearing from a simulation of all its rollers."""

from __future__ import annotations

import numpy as np
import xarray as xr

from macroslip.bearing import Bearing, geometry
from macroslip.errors import InputError
from macroslip.mechanics.loads import drag_power
from macroslip.result.run_input import run_input
from macroslip.roller.model import RollerModel
from macroslip.variables import ALWAYS, Variable, VariableTable

_CONTACTS = ("row", "interface", "time")
#: All variables of `computed_torque`.
TORQUE = VariableTable(
    "Friction torque of a bearing, `macroslip.torque.computed.computed_torque`",
    (
        Variable(
            "shaft_speed", ("time",), "rad/s", ALWAYS, "speed of the inner ring, with its sign"
        ),
        Variable(
            "torque",
            ("time",),
            "N m",
            ALWAYS,
            "friction torque of the bearing, against the rotation",
        ),
        Variable(
            "contact_torque", _CONTACTS, "N m", ALWAYS, "torque of the friction at the interface"
        ),
        Variable(
            "rolling_torque",
            _CONTACTS,
            "N m",
            ALWAYS,
            "torque of rolling resistance at the interface",
        ),
        Variable(
            "ring_torque",
            ("raceway", "time"),
            "N m",
            ALWAYS,
            "torque of the contacts on the ring, positive along the orbit",
        ),
        Variable(
            "drag_torque",
            ("time",),
            "N m",
            ALWAYS,
            "torque of the lubricant's drag on the rollers",
        ),
    ),
)


def computed_torque(result: xr.Dataset) -> xr.Dataset:
    """Torque with which friction in the contacts and drag of the lubricant hold the shaft.

    It is given at the times of the traces.

        T = (Σ P + Σ P_r + Σ P_drag)/Ω_in,    P_drag = F_d,x' r~ Ω

    The sums run over the rollers of both rows; P is the frictional power (33), ∫τ v dA in a contact
    with microslip and |F Δu| in one without, P_r the power of rolling resistance, F_d,x' the drag
    (24)-(26). It is the torque a drive has to supply for
    the dissipation of that moment. Kinetic energy of the rollers and the work of their weight,
    whose mean over an orbit vanishes, are left out, and so is what the model does not have:
    churning beyond the rollers' drag, hysteresis of the steel, seals.

    The same torque follows from the contacts' forces on the rings. A contact takes the power P +
    P_r; it gives the roller's spin −(F + F_r) u1 of what the ring spends, so that the tangential
    force on the ring is −(P + F u1)/u2 + F_r along its motion, F the traction and F_r = −P_r/(u1 +
    u2) the shear of rolling resistance. The push of the inclined pressure goes through the ring's
    axis. Of both rings and the rollers between them the torques balance: what the inner ring gets
    and the outer one does not is drag and what guides the cage.

    Over time: shaft_speed [rad/s], with its sign; torque [N m] against the rotation, not negative;
    contact_torque [N m] and rolling_torque [N m] over (row, interface, time), drag_torque [N m]
    over time: its parts; ring_torque [N m] over (raceway, time): torque of the contacts on inner
    and outer ring, positive along the orbit. NaN where the shaft is at rest, or from where a roller
    failed. The result has all rollers of both rows, with traces; InputError without.

    Examples
    --------
    >>> from macroslip import BearingLoads, Case, Traces, simulate
    >>> loads = BearingLoads.constant([0.0, -300e3, 100e3], 2.143, 2.0)
    >>> torque = computed_torque(simulate(Case(loads=loads, traces=Traces(step=1.0))))
    >>> print(f"{torque.drag_torque[-1]:.2f} N m of drag")
    2.91 N m of drag
    """
    if "power" not in result or "time" not in result.power.dims or not result.sizes["time"]:
        fault = "the result has no traces"
        raise InputError(
            fault,
            where="friction torque",
            remedy="Give the case traces, such as traces: {step: 0.05 s}.",
        )
    of_result = run_input(result)
    bearing = of_result.bearing
    models = of_result.models
    missing = bearing.rollers_per_row - result.sizes["roller"]
    if missing or len(models) < 2:
        fault = f"{missing} rollers of each row are missing" if missing else "a row is missing"
        allowed = "a result of all rollers of both rows"
        raise InputError(
            fault, where="friction torque", allowed=allowed, remedy="Simulate with rollers: all."
        )
    model = next(iter(models.values()))
    # Every roller has the same speed in pure rolling; a failed roller has NaN.
    by_roller = result.spin_pure.values.reshape(-1, result.sizes["time"])
    spins = np.nan_to_num(by_roller)
    fastest = np.abs(spins).max(axis=1)
    spin = spins[np.argmax(fastest)]
    orbital = -spin * model.radius / model.outer_radius
    shaft = orbital / model.orbit_ratio
    with np.errstate(divide="ignore"):
        per_speed = 1.0 / np.abs(shaft)
        per_power = np.where(shaft != 0.0, per_speed, np.nan)
    contacts = _per_speed(result.power, per_power)
    rolling = _per_speed(result.rolling_power, per_power)
    rollers = bearing.rows * bearing.rollers_per_row
    drag = rollers * drag_power(model.drag, bearing.pitch_radius, orbital) * per_power

    # Sums over rows and interfaces, the first two axes.
    torque_of_contacts = contacts.sum(axis=(0, 1))
    torque_of_rolling = rolling.sum(axis=(0, 1))
    values = {
        "shaft_speed": shaft,
        "torque": torque_of_contacts + torque_of_rolling + drag,
        "contact_torque": contacts,
        "rolling_torque": rolling,
        "ring_torque": _ring_torques(result, bearing, model),
        "drag_torque": drag,
    }
    known = {name: result.attrs[name] for name in ("model", "oil") if name in result.attrs}
    coordinates = {
        "time": result.time,
        "row": result.row,
        "interface": result.interface,
        "raceway": ["inner", "outer"],
    }
    return xr.Dataset(
        TORQUE.put(values),
        coordinates,
        {"title": f"Friction torque: {result.attrs['title']}", **known},
    )


def _per_speed(power: xr.DataArray, per_power: np.ndarray) -> np.ndarray:
    """Torque over (row, interface, time) of the power of all rollers."""
    of_rollers = power.sum("roller", skipna=False)
    total = of_rollers.transpose(*_CONTACTS).values * per_power
    # In the order of files, so that sums over a stored result give the same digits.
    return np.ascontiguousarray(total)


def _ring_torques(result: xr.Dataset, bearing: Bearing, model: RollerModel) -> np.ndarray:
    """Torque on inner and outer ring about +Z0 over (raceway, time)."""
    orbit = -result.spin_pure * model.radius / model.outer_radius
    shaft = orbit / model.orbit_ratio
    # In the whole bearing every roller has an orbit of its own.
    if "orbit_speed_deviation" in result:
        orbit = orbit + result.orbit_speed_deviation
    roller = (result.spin * model.radius).transpose("row", "roller", "time")
    torques = []
    # At a positive speed the ring turns back at the inner raceway, forth at the outer raceway.
    for name, arm, turning in (
        ("inner", -geometry.inner_contact_radius(bearing), shaft),
        ("outer", geometry.outer_contact_radius(bearing), 0.0),
    ):
        here = {"interface": name}
        ring = (arm * (turning - orbit)).transpose("row", "roller", "time")
        at_ring = result[["traction", "power", "rolling_power"]].sel(here, drop=True)
        at_ring = at_ring.transpose("row", "roller", "time")
        with np.errstate(invalid="ignore", divide="ignore"):
            power = at_ring.power + at_ring.traction * roller
            sliding = power / ring
            rolling = at_ring.rolling_power / (roller + ring)
            force = -sliding - rolling
        torques.append(arm * force.sum(("row", "roller"), skipna=False).values)
    return np.stack(torques)
