"""A record of a few days, written in any way a test asks for."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from macroslip.scada import Scada

DESCRIPTION = """\
turbine: T1
files: [{files}]
time: {{column: time{time}}}
columns:
  wind_speed: {{column: wind, unit: m/s}}
  rotor_speed: {{column: rotor, unit: r/min}}
  power: {{column: power, unit: kW}}
  bearing_temperature: {{column: bearing, unit: {unit}}}
  nacelle_temperature: {{column: nacelle, unit: {unit}}}
  ambient_temperature: {{column: ambient, unit: {unit}}}
rated: {{rotor_speed: 17 r/min, power: 1500 kW}}
{more}
"""


def record(rows: int = 1008, seed: int = 3) -> pd.DataFrame:
    """Made-up means: wind that wanders, and temperatures that follow, in tenths of a degree."""
    random = np.random.default_rng(seed)
    wind = 8.0 + 4.0 * np.sin(np.arange(rows) / 60.0) + random.normal(0.0, 0.6, rows)
    turning = wind > 4.5
    ambient = 8.0 + 4.0 * np.sin(np.arange(rows) / 144.0 * 2.0 * np.pi)
    return pd.DataFrame(
        {
            "time": pd.date_range("2024-03-25", periods=rows, freq="10min", tz="UTC"),
            "wind": wind.clip(0.1).round(2),
            "rotor": np.where(turning, (1.6 * wind).clip(8.0, 17.0), 0.2).round(2),
            "power": np.where(turning, (1.5 * wind**3).clip(10.0, 1500.0), -5.0).round(1),
            "bearing": (ambient + 16.0 + random.normal(0.0, 0.2, rows)).round(1),
            "nacelle": (ambient + 8.0 + random.normal(0.0, 0.2, rows)).round(1),
            "ambient": (ambient + random.normal(0.0, 0.2, rows)).round(1),
        }
    )


@pytest.fixture
def read(tmp_path: Path) -> Callable[..., Scada]:
    """A function that writes a record with its description, and reads both."""

    def made(
        table: pd.DataFrame,
        *,
        time: str = "",
        unit: str = "degC",
        more: str = "",
        form: str = "%Y-%m-%dT%H:%M:%S%z",
    ) -> Scada:
        text = table.assign(time=table["time"].dt.strftime(form))
        text.to_csv(tmp_path / "record.csv", index=False)
        path = tmp_path / "scada.yaml"
        path.write_text(DESCRIPTION.format(files="record.csv", time=time, unit=unit, more=more))
        return Scada.read(path)

    return made
