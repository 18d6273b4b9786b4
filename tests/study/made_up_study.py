"""A study of made-up rates over wind speed and temperature of the oil, as `open_study` gives it."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence

import numpy as np
import xarray as xr

#: Production at wind speeds [m/s], with two seeds at 8 m/s, and events.
LOADS = (("4", 4.0, ""), ("8a", 8.0, ""), ("8b", 8.0, ""), ("12", 12.0, ""))
EVENTS = (("start", 8.0, "start-8"), ("idle", 6.0, "idle-6"))
SECONDS = 100.0


def wear_rate(wind: float, celsius: float, number: int) -> float:
    """Wear [m/s] that doubles in about 4.4 K."""
    return 1e-15 * (1.0 + 0.1 * number) * np.exp(0.158 * (celsius - 35.0)) * (12.0 / wind) ** 2


def power(wind: float, celsius: float, number: int) -> float:
    """Power [W] of a roller, which falls by about 2.5 % a kelvin."""
    return 2.0 * (1.0 + 0.05 * number) * np.exp(-0.025 * (celsius - 35.0)) * (wind / 8.0)


def made_up_study(
    temperatures: Sequence[float] = (5.0, 15.0, 25.0, 35.0, 45.0),
    *,
    weights: dict | None = None,
    wear: Callable[[float, float, int], float] = wear_rate,
    clearances: Sequence[float] = (),
) -> xr.Dataset:
    """Runs of all loads at all temperatures [degC], and of all clearances [mm] if there are any."""
    runs = [
        (load, celsius, clearance, number)
        for number, load in enumerate((*LOADS, *EVENTS))
        for celsius in temperatures
        for clearance in clearances or (0.0,)
    ]
    winds = np.array([load[1] for load, *_ in runs])
    factor = np.array([[1.0, 0.3]])
    rates = np.array([wear(load[1], celsius, n) * (1 + c) for load, celsius, c, n in runs])
    powers = np.array([power(load[1], celsius, n) for load, celsius, _, n in runs])
    over_rows = ("case", "row")
    summary = {
        "energy_mean": (over_rows, SECONDS * powers[:, None] * factor, {"units": "J"}),
        "wear_rate": (over_rows, rates[:, None] * factor, {"units": "m/s"}),
        "entry_rate": (over_rows, np.full((len(runs), 2), 0.01) * winds[:, None]),
        "mixed_film_time": (over_rows, np.tile([[0.1, 0.0]], (len(runs), 1))),
        "peak_power_max": (over_rows, powers[:, None] * np.array([[3.0, 2.0]])),
        "window_length": ("case", np.full(len(runs), SECONDS)),
        "shaft_speed_mean": ("case", 0.14 * winds),
    }
    labels = {
        "loads": [load[0] for load, *_ in runs],
        "wind_speed": winds,
        "event": [load[2] for load, *_ in runs],
        "outcome": ["completed"] * len(runs),
        "lubricant.at": [celsius for _, celsius, *_ in runs],
    }
    labels |= {name: ["-"] * len(runs) for name in ("bearing", "lubricant", "model")}
    units = {"wind_speed": "m/s", "lubricant.at": "degC"}
    if clearances:
        labels["bearing.diametral_clearance"] = [clearance for _, _, clearance, _ in runs]
        units["bearing.diametral_clearance"] = "mm"
    coordinates = {}
    for name, values in labels.items():
        kind = None if name in units else object
        attributes = {"units": units.get(name, "1")}
        coordinates[name] = ("case", np.array(values, dtype=kind), attributes)
    content = {"variations": {"grid": {"lubricant.at": {"values": list(temperatures)}}}}
    if weights is not None:
        content["weights"] = weights
    return xr.Dataset(
        summary,
        coordinates | {"row": ["downwind", "upwind"], "case": np.arange(len(runs))},
        {"study": json.dumps(content), "title": "made up"},
    )
