"""Tables of a study for others: CSV or Parquet."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.files import write_durably
from macroslip.study.exceedance import exceedance, load_spectrum
from macroslip.study.lifetime import lifetime_energy, percentiles, worst
from macroslip.study.store import Outcome
from macroslip.study.weights import Weights

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

FORMATS = ("csv", "parquet")


def as_table(dataset: xr.Dataset, names: Sequence[str]) -> pd.DataFrame:
    """Variables of the same dimensions with all coordinates they have, one line a value; units are in the headings.

    Examples
    --------
    >>> import xarray as xr
    >>> one = xr.Dataset({"energy": ("row", [1.0, 2.0], {"units": "J"})}, {"row": ["downwind", "upwind"]})
    >>> list(as_table(one, ["energy"]).columns)
    ['row', 'energy [J]']
    """
    part = dataset[list(names)]
    frame = part.reset_coords().to_dataframe().reset_index()
    frame = frame.loc[:, [name for name in (*part.coords, *names) if name in frame]]
    units = {name: one.attrs.get("units", "1") for name, one in part.variables.items()}
    frame.columns = [name if units.get(name, "1") == "1" else f"{name} [{units[name]}]" for name in frame]
    return frame


def tables(
    study: xr.Dataset, weights: Weights | None, *, years: float = 20.0, field: str = "wind_speed", width: float = 2.0,
    by: Sequence[str] = (),
) -> dict[str, pd.DataFrame]:  # fmt: skip
    """All tables of a study by name; docs/studies.md lists their columns.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    weights : Weibull or Given, optional
        Without them there are `cases`, `failures`, `worst` and `percentiles`; with them also `lifetime`, `bins`,
        `exceedance`, where results keep its variables, and, if the study counts cycles, `cycles`.
    years, field, width, by
        As in `macroslip.study.lifetime.lifetime_energy`.
    """
    summary = study.drop_vars([name for name, one in study.variables.items() if not set(one.dims) <= {"case", "row"}])
    by_row = [name for name, one in summary.data_vars.items() if "row" in one.dims]
    found = {"cases": as_table(summary, [*by_row, *(name for name in summary.data_vars if name not in by_row)])}
    failed = summary.isel(case=np.flatnonzero(summary.outcome.values != str(Outcome.COMPLETED)))
    found["failures"] = failed.drop_vars([*failed.data_vars, "row"]).to_dataframe().reset_index()
    found["worst"] = as_table(worst(study), by_row)
    spread = percentiles(study, field=field, width=width, by=by)
    found["percentiles"] = as_table(spread, [name for name in spread.data_vars if name != "runs"])
    if weights is None:
        return found
    life = lifetime_energy(study, weights, years=years, field=field, width=width, by=by)
    found["lifetime"] = as_table(
        life.assign(covered=life.covered.broadcast_like(life.lifetime_energy)), ["lifetime_energy", "covered"]
    )
    found["bins"] = as_table(
        life.assign({name: life[name].broadcast_like(life.power) for name in _OF_BINS}),
        ["power", "bin_energy", *_OF_BINS],
    )
    if {"orbit_energy", "peak_power"} <= set(study.data_vars):
        curves = exceedance(study, weights, field=field, width=width, by=by)
        found["exceedance"] = as_table(curves, ["energy_orbits", "power_orbits"])
    if "load_cycles" in study:
        found["cycles"] = as_table(
            load_spectrum(study, weights, years=years, field=field, width=width, by=by), ["cycles"]
        )
    return found


_OF_BINS = ("probability", "runs", "left_out")


def write_tables(found: dict[str, pd.DataFrame], folder: Path, form: str) -> list[Path]:
    """Write tables, each to a file of its name in the folder, as `csv` or `parquet`; files of the same names are replaced."""
    import io

    written = []
    for name, frame in found.items():
        path = folder / f"{name}.{form}"
        if form == "csv":
            content = frame.map(_harmless).to_csv(index=False, lineterminator="\n").encode()
        else:
            buffer = io.BytesIO()
            frame.to_parquet(buffer, index=False)
            content = buffer.getvalue()
        write_durably(path, content)
        written.append(path)
    return written


def _harmless(value: Any) -> Any:
    """Text with an apostrophe in front where a spreadsheet would take it as a formula; else unchanged."""
    return f"'{value}" if isinstance(value, str) and value.startswith(("=", "+", "-", "@", "\t", "\r")) else value
