"""Tables of a study for others: CSV or Parquet."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import xarray as xr

from macroslip.storage.files import write_durably
from macroslip.study.aggregation import Aggregation
from macroslip.study.effects import effects
from macroslip.study.exceedance import exceedance, load_spectrum
from macroslip.study.labels import of_runs_and_rows, sampled_parameters
from macroslip.study.lifetime import lifetime_energy, percentiles, worst
from macroslip.study.reader import incomplete_runs
from macroslip.study.year import DESIGN_UNITS, EXPONENTS, LARGEST, LIVES, SUMS, designs, year

FORMATS = ("csv", "parquet")


def as_table(dataset: xr.Dataset, names: Sequence[str]) -> pd.DataFrame:
    """Variables with all their coordinates as a table, with units in the headings.

    It has one line for each value of the largest variable.

    Examples
    --------
    >>> dataset = xr.Dataset({"energy": ("row", [1.0, 2.0], {"units": "J"})}, {"row": ["downwind", "upwind"]})
    >>> list(as_table(dataset, ["energy"]).columns)
    ['row', 'energy [J]']
    """
    part = dataset[list(names)]
    broadcast = {name: variable.broadcast_like(part) for name, variable in part.items()}
    part = part.assign(broadcast)
    frame = part.reset_coords().to_dataframe().reset_index()
    columns = [name for name in (*part.coords, *names) if name in frame]
    frame = frame.loc[:, columns]
    frame.columns = [_heading(name, part[name].attrs.get("units", "1")) for name in columns]
    return frame


def _heading(name: str, unit: str) -> str:
    """Name of a column with its unit, if it has one."""
    return name if unit == "1" else f"{name} [{unit}]"


def tables(study: xr.Dataset, aggregation: Aggregation) -> dict[str, pd.DataFrame]:
    """All tables of a study by name; docs/studies.md lists their columns.

    Without weights there are `cases`, `failures`, `worst`, `percentiles`, `designs` and, of a
    sample, `effects`; with them also `year`, `lives`, `lifetime`, `bins`, `exceedance`, where
    results keep its variables, and, if the study counts cycles, `cycles`.
    """
    summary = of_runs_and_rows(study)
    by_row = []
    of_case = []
    for name, variable in summary.data_vars.items():
        if "row" in variable.dims:
            by_row.append(name)
        else:
            of_case.append(name)
    frames = {"cases": as_table(summary, [*by_row, *of_case])}
    failed = incomplete_runs(summary)
    without_numbers = failed.drop_vars([*failed.data_vars, "row"])
    frames["failures"] = without_numbers.to_dataframe().reset_index()
    frames["worst"] = as_table(worst(study), by_row)
    spread = percentiles(study, aggregation)
    quantities = [name for name in spread.data_vars if name != "runs"]
    frames["percentiles"] = as_table(spread, quantities)
    whole = year(study, aggregation)
    table_of_designs, _ = designs(whole)
    ranked = table_of_designs.dropna(axis="columns", how="all")
    headings = {name: _heading(name, unit) for name, unit in DESIGN_UNITS.items()}
    frames["designs"] = ranked.rename(columns=headings)
    if sampled_parameters(study):
        drivers = effects(study, aggregation)
        by_parameter = []
        for name, variable in drivers.items():
            if "parameter" in variable.dims:
                by_parameter.append(name)
        frames["effects"] = as_table(drivers, by_parameter)
    if aggregation.weights is None:
        return frames
    by_bin = ["hours", "runs", "energy", "per_hour", *LARGEST, *SUMS]
    frames["year"] = as_table(whole, [name for name in by_bin if name in whole])
    loads = [f"damage_equivalent_load_{exponent}" for exponent in EXPONENTS]
    frames["lives"] = as_table(whole, [*LIVES, *loads])
    life = lifetime_energy(study, aggregation)
    frames["lifetime"] = as_table(life, ["lifetime_energy", "covered"])
    frames["bins"] = as_table(life, ["power", "bin_energy", "probability", "runs", "left_out"])
    if {"orbit_energy", "peak_power"} <= set(study.data_vars):
        curves = exceedance(study, aggregation)
        frames["exceedance"] = as_table(curves, ["energy_orbits", "power_orbits"])
    if "load_cycles" in study:
        spectrum = load_spectrum(study, aggregation)
        frames["cycles"] = as_table(spectrum, ["cycles"])
    return frames


def write_tables(frames: dict[str, pd.DataFrame], folder: Path, form: str) -> list[Path]:
    """Write tables to files of their names in the folder, as `csv` or `parquet`.

    Files of the same names are replaced.
    """
    import io

    def harmless(value: Any) -> Any:
        # A spreadsheet would take such text as a formula.
        return (
            f"'{value}"
            if isinstance(value, str) and value.startswith(("=", "+", "-", "@", "\t", "\r"))
            else value
        )

    written = []
    for name, frame in frames.items():
        path = folder / f"{name}.{form}"
        if form == "csv":
            text = frame.map(harmless).to_csv(index=False, lineterminator="\n")
            content = text.encode()
        else:
            buffer = io.BytesIO()
            frame.to_parquet(buffer, index=False)
            content = buffer.getvalue()
        write_durably(path, content)
        written.append(path)
    return written
