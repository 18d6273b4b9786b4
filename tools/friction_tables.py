"""Friction of the base turbine's main bearing, for synthetic years, and how it grows with speed.

python -m tools.friction_tables FOLDER     # a quarter of an hour; the studies are kept in FOLDER

The table of torques is written into the package, `scada/base_turbine_friction.csv`; the exponents
of speed are printed for `scada/speed_exponents.py`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from macroslip import HubLoads, open_study, run_study
from macroslip.scada.speed_exponents import TEMPERATURES
from macroslip.scada.synthetic import BASE_TURBINE
from macroslip.study.friction import friction_table
from macroslip.study.study_file import study_of

SUPPLIES = ["skf", "flooded", 0.7, 0.5]
#: Histories over wind speed, and those over speed of the rotor with the length that is simulated
#: [s].
HISTORIES = ["4B", "6B", "8B", "10B", "12B", "16B", "24B"]
AT_OTHER_SPEEDS = ["6B", "12B"]
_LENGTH = 90.0
#: Speed over the history's own.
SPEEDS = (0.5, 1.0)


def friction_study(
    histories: list[str] = HISTORIES, supplies: list[Any] = SUPPLIES
) -> Mapping[str, Any]:
    """The study of the table as plain data."""
    return {
        "title": "Friction of the base turbine's main bearing over temperature and supply of oil",
        "case": {"rollers": [0, 14], "laws": {"model": "physical"}, "loads": {"end": "120 s"}},
        "loads": {"bundled": histories},
        "keep": ["energy"],
        "variations": {"grid": _grid(supplies)},
    }


def _grid(supplies: list[Any]) -> dict[str, Any]:
    return {
        "oil_supply": {"values": supplies},
        "lubricant.at": {"values": list(TEMPERATURES), "unit": "degC"},
    }


def speed_study(folder: Path) -> Mapping[str, Any]:
    """The study of speeds as plain data, its histories written into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in AT_OTHER_SPEEDS:
        history = HubLoads.bundled(name).window(0.0, _LENGTH)
        for factor in SPEEDS:
            table = pd.DataFrame(
                {"time_s": history.time, "shaft_speed_rad_s": factor * history.shaft_speed}
            )
            table[["fx_N", "fy_N", "fz_N"]] = history.force
            table[["mx_Nm", "my_Nm", "mz_Nm"]] = history.moment
            table.to_csv(folder / f"{name.rstrip('B')}mps_{factor:g}.csv", index=False)
    return {
        "title": "Friction of the base turbine's main bearing over the speed of the rotor",
        "case": {"rollers": [0, 14], "laws": {"model": "physical"}},
        "loads": {"files": "{wind_speed:g}mps_{factor:g}.csv"},
        "keep": ["energy"],
        "variations": {"grid": _grid(SUPPLIES)},
    }


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
    run_study(study_of(friction_study()), table, resume=table.exists())
    friction_table(table).write_csv(BASE_TURBINE)
    print(f"written: {BASE_TURBINE}")
    histories = folder / "histories"
    study = study_of(speed_study(histories), histories)
    speeds = folder / "speeds"
    run_study(study, speeds, resume=speeds.exists())
    print(exponents(speeds).round(2).to_string())


if __name__ == "__main__":
    main(Path(sys.argv[1]))
