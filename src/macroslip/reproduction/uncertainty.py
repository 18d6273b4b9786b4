"""Uncertainty of the study's results: a sample over the values that are estimates, all changed together."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from macroslip.reproduction.uncertain_value import UNITS, UncertainValue
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.study.outcome import Outcome
from macroslip.study.reader import open_study

if TYPE_CHECKING:
    import xarray as xr

#: Meaning of the variable `outcome`.
OUTCOMES = ("completed", "a roller failed", "refused")
_INTERFACES = ("inner", "outer", "cage")


def uncertainty(directory: Path) -> xr.Dataset:
    """The results of a study that runs a sample of values under several loads, after the base values.

    Parameters
    ----------
    directory : Path
        Folder of its results. The first point of the study has the base values.

    Returns
    -------
    xarray.Dataset
        Over (sample, case, row, interface): orbit_energy [J] per orbit, mean over rollers and orbits; over (sample,
        case, row): peak_power [W], mean over rollers and orbits of the largest power at any interface per orbit; over
        (sample, case): window_energy [J], both rows; torque [N m], sliding torque of both rows' contacts, mean over the
        turns of the shaft; and friction_power [W] of the whole bearing with rolling and drag. Over (sample, parameter):
        value, in the unit of the coordinate `unit`, of a choice its number; NaN for the base values. outcome over (sample): position in `OUTCOMES`; what did not complete is NaN, and `reason` gives the cause.
        Sample 0 are the base values, which are no part of the statistics.
    """
    import xarray as xr

    study = open_study(directory)
    names = list(dict.fromkeys(study.loads.values.tolist()))
    # All loads have the same points in the same order.
    parts = [study.isel(case=np.flatnonzero(study.loads.values == name)) for name in names]
    reasons = [_reason(names, [part.isel(case=k) for part in parts]) for k in range(parts[0].sizes["case"])]
    outcomes = np.array([outcome for outcome, _ in reasons], dtype=np.int8)

    def gathered(*variables: str) -> np.ndarray:
        """Values over (sample, case, ..., variable); NaN for samples that did not complete."""
        found = np.stack([np.stack([part[name].values for name in variables], axis=-1) for part in parts], axis=1)
        found[outcomes != 0] = np.nan
        return found

    def about(units: str, long_name: str) -> dict[str, str]:
        return {"units": units, "long_name": long_name}

    of_row = ("sample", "case", "row")
    values = np.stack([_of_sample(parts[0][one.key].values, one) for one in VALUES], axis=1)
    flags = {
        "flag_values": np.arange(len(OUTCOMES), dtype=np.int8),
        "flag_meanings": " ".join(one.replace(" ", "_") for one in OUTCOMES),
    }
    return xr.Dataset(
        {
            "orbit_energy": (
                (*of_row, "interface"),
                gathered(*(f"orbit_energy_{name}" for name in _INTERFACES)),
                about("J", "energy per orbit, mean over rollers and orbits"),
            ),
            "peak_power": (
                of_row,
                gathered("peak_power_mean")[..., 0],
                about("W", "largest power per orbit at any interface, mean over rollers and orbits"),
            ),
            "window_energy": (
                of_row[:2],
                gathered("energy_mean")[..., 0].sum(axis=-1),
                about("J", "energy in the window of a mean downwind and a mean upwind roller together"),
            ),
            "torque": (
                of_row[:2],
                gathered("contact_torque")[..., 0],
                about("N m", "sliding torque of all contacts, mean over the turns of the shaft"),
            ),
            "friction_power": (
                of_row[:2],
                gathered("friction_power")[..., 0],
                about("W", "sliding, rolling, cage and drag of the whole bearing, mean over the window"),
            ),
            "value": (("sample", "parameter"), values, about("1", "value set, in the unit of its parameter")),
            "outcome": ("sample", outcomes, about("1", "what became of the sample") | flags),
            "reason": ("sample", [reason for _, reason in reasons], about("1", "why it did not complete")),
        },
        {
            "sample": ("sample", np.arange(len(reasons)), about("1", "number; 0 are the base values")),
            "case": names,
            "row": study.row.values,
            "interface": list(_INTERFACES),
            "parameter": [one.name for one in VALUES],
            "unit": ("parameter", [one.unit for one in VALUES]),
            "wind_speed": ("case", [float(part.wind_speed[0]) for part in parts], about("m/s", "mean wind speed")),
        },
        {"title": study.attrs["title"]},
    )


def _of_sample(values: np.ndarray, one: UncertainValue) -> np.ndarray:
    """Values of the study file, which are in SI units, in the unit of their range; choices by number."""
    if one.choices:
        return np.array([one.choices.index(word) if word in one.choices else np.nan for word in values])
    return values - 273.15 if one.unit == "°C" else values / UNITS[one.unit][1]


def _reason(names: list[str], runs: list[xr.Dataset]) -> tuple[int, str]:
    """What became of a sample, as position in `OUTCOMES`, and why."""
    for name, run in zip(names, runs, strict=True):
        if not Outcome(run.outcome.item()).stored:
            return 2, f"bundled case {name}: {run.reason.item()}"
    failed = int(sum(float(run.failed_rollers.sum()) for run in runs))
    return (1, f"{failed} rollers failed") if failed else (0, "")
