"""Friction of the base turbine's main bearing, for synthetic years, and how it grows with speed.

python -m tools.friction_tables FOLDER     # a quarter of an hour; the studies are kept in FOLDER

The table of torques is written into the package, `scada/base_turbine_friction.csv`; the exponents
of speed are printed for `scada/speed_exponents.py`.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from macroslip import HubLoads, open_study, run_study
from macroslip.scada.speed_exponents import TEMPERATURES
from macroslip.scada.synthetic import BASE_TURBINE
from macroslip.study.friction import friction_table
from macroslip.study.study_file import Study, study_of

SUPPLIES = ["skf", "flooded", 0.7, 0.5]
#: Histories over wind speed, and those over speed of the rotor.
HISTORIES = ("4B", "6B", "8B", "10B", "12B", "18B", "24B")
AT_OTHER_SPEEDS = ("6B", "12B")
#: Speed over the history's own.
SPEEDS = (0.5, 1.0)


def write_history(history: HubLoads, path: Path, factor: float) -> None:
    """Write a history as a table, its speed times a factor."""
    table = pd.DataFrame(
        {"time_s": history.time, "shaft_speed_rad_s": factor * history.shaft_speed}
    )
    table[["fx_N", "fy_N", "fz_N"]] = history.force
    table[["mx_Nm", "my_Nm", "mz_Nm"]] = history.moment
    table.to_csv(path, index=False)


def friction_study(
    histories: Sequence[str] = HISTORIES, supplies: Sequence[Any] = SUPPLIES
) -> Study:
    """The study of the table, of whole histories.

    Minutes of a history do not stand for it: two of 6B that have its mean speed and thrust have
    0.88 of its torque.
    """
    title = "Friction of the base turbine's main bearing over temperature and supply of oil"
    return _study(title, {"bundled": list(histories)}, supplies, Path())


def speed_study(folder: Path) -> Study:
    """The study over the speed of the rotor, its histories written into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in AT_OTHER_SPEEDS:
        for factor in SPEEDS:
            path = folder / f"{name.rstrip('B')}mps_{factor:g}.csv"
            write_history(HubLoads.bundled(name), path, factor)
    title = "Friction of the base turbine's main bearing over the speed of the rotor"
    return _study(title, {"files": "{wind_speed:g}mps_{factor:g}.csv"}, SUPPLIES, folder)


def _study(title: str, loads: dict[str, Any], supplies: Sequence[Any], folder: Path) -> Study:
    oil = {"values": list(TEMPERATURES), "unit": "degC"}
    content = {
        "title": title,
        "case": {"rollers": [0], "laws": {"model": "physical"}},
        "loads": loads,
        "keep": ["energy"],
        "variations": {
            "grid": {"oil_supply": {"values": list(supplies)}, "lubricant.at": oil},
        },
    }
    return study_of(content, folder)


def exponents(folder: Path) -> pd.DataFrame:
    """Exponent e of M ∝ n^e over supply (rows) and temperature [degC], mean over the histories."""
    study = open_study(folder)
    runs = pd.DataFrame(
        {
            "supply": study.oil_supply.values.astype(str),
            "oil": study["lubricant.at"].values.astype(float),
            "wind": study.wind_speed.values,
            "factor": study.factor.values,
            "torque": study.friction_power.values / study.shaft_speed_mean.values,
        }
    )
    torque = runs.pivot_table("torque", ["supply", "oil", "wind"], "factor")
    slow, own = SPEEDS
    exponent = np.log(torque[own] / torque[slow]) / np.log(own / slow)
    return exponent.groupby(["supply", "oil"]).mean().unstack("oil")


def main(folder: Path) -> None:
    """Run both studies, as far as they are not there, write the table and print the exponents."""
    table = folder / "friction"
    run_study(friction_study(), table, resume=table.exists())
    friction_table(table).write_csv(BASE_TURBINE)
    print(f"written: {BASE_TURBINE}", flush=True)
    speeds = folder / "speeds"
    run_study(speed_study(folder / "histories"), speeds, resume=speeds.exists())
    print(exponents(speeds).round(2).to_string())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
