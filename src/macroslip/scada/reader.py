"""Reader of ten-minute means: from files to one table in UTC and SI, with the rows that were dropped and why."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from macroslip.constants import HOUR
from macroslip.errors import InputError
from macroslip.input.messages import shown
from macroslip.scada.clock import Times, consecutive_times, hours_shown_twice, utc_times
from macroslip.scada.description import CONSECUTIVE, ScadaDescription
from macroslip.scada.filters import FILTERS, TURNING, dropped_by_filter, filtered, jumps
from macroslip.scada.plausibility import check_quantities, doubts
from macroslip.scada.table_files import files_of, pieces

#: Columns of `Scada.data` with numbers, and their units.
QUANTITIES = {
    "wind_speed": "m/s",
    "rotor_speed": "rad/s",
    "power": "W",
    "bearing_temperature": "K",
    "nacelle_temperature": "K",
    "ambient_temperature": "K",
}
#: Outcomes of a row, in the order of the messages.
FATES = ("no time", "repeated hour", "duplicate", *FILTERS, "kept", "jump", "absent")
#: Values that a message about a turbine lists.
_LISTED = 10
#: Share of a month without data from which on a note says so.
_MOST_MISSING = 0.3


@dataclass(frozen=True)
class Scada:
    """Ten-minute means of one turbine, in UTC and SI. Nothing in it is interpolated.

    `Scada.read` makes it from files.
    """

    #: What the files are.
    description: ScadaDescription
    #: A row for each time [UTC, start of the mean], ascending, each once: `wind_speed` [m/s],
    #: `rotor_speed` [rad/s], `power` [W], `bearing_temperature`, `nacelle_temperature` and
    #: `ambient_temperature` [K], all NaN in a row that a filter drops, and where the record has no
    #: such column; `status`, state of the turbine as text; `filter`, name of the filter that drops
    #: the row, or ""; `jump`, True where windows are parted from the row before.
    data: pd.DataFrame
    #: Rows by `month` (UTC, "2015-01"; "" where the time is not known), `filter` and `rows`: the
    #: filters, `no time`, `repeated hour`, `duplicate`, `kept`, of which `jump`, and `absent`, steps
    #: without a row.
    counts: pd.DataFrame
    #: Time that a row stands for [s].
    step: float
    #: What a reader of any result has to know, in sentences.
    notes: tuple[str, ...] = field(default=())

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Scada:
        """Read the means that a YAML file describes.

        Parameters
        ----------
        path : path
            YAML file; `macroslip scada init FILE` writes one. Relative paths in it start at its
            own folder.

        Returns
        -------
        Scada

        Raises
        ------
        InputError
            If the description is wrong, a file cannot be read, a column is missing, or values are
            not what the description calls them.
        """
        description = ScadaDescription.read(path)
        return read_scada(description, Path(path).parent)

    @property
    def turning(self) -> pd.Series:
        """True in rows in which the rotor turns: above 0.3 of its rated speed."""
        speed: pd.Series = self.data["rotor_speed"]  # pyright: ignore[reportAssignmentType]
        return speed > TURNING * self.description.rated.rotor_speed

    @property
    def hours(self) -> float:
        """Hours with data that no filter drops."""
        rows = float(self.kept.sum())
        return rows * self.step / HOUR

    @property
    def used_rows(self) -> pd.DataFrame:
        """Rows that no filter drops."""
        return self.data.loc[self.kept]

    @property
    def kept(self) -> pd.Series:
        """True in rows that no filter drops."""
        dropped_by: pd.Series = self.data["filter"]  # pyright: ignore[reportAssignmentType]
        return dropped_by == ""


class _Record(NamedTuple):
    """Rows as they stand in the files."""

    times: Times
    columns: dict[str, np.ndarray]  #: SI, by quantity
    state: np.ndarray | None


def read_scada(description: ScadaDescription, folder: Path) -> Scada:
    """Read the means of a description whose relative paths start at `folder`; as `Scada.read`."""
    record = _record(description, folder)
    check_quantities(record.columns, description)
    order, fates, notes = _order(record, description)
    utc = record.times.utc[order]
    columns = {name: values[order] for name, values in record.columns.items()}
    state = None
    if record.state is not None:
        state = record.state[order]
    seconds = utc.as_unit("s").asi8.astype(float)
    step = description.time.step
    first = filtered(columns, state, seconds, description)
    used = {}
    for name in QUANTITIES:
        used[name] = np.nan
        if name in columns:
            used[name] = np.where(first < 0, columns[name], np.nan)
    data = pd.DataFrame(used, index=utc.rename("time"))
    data["status"] = "" if state is None else state
    data["filter"] = pd.Categorical.from_codes(first + 1, ["", *FILTERS])
    data["jump"] = jumps(columns, seconds, step)
    for name, units in QUANTITIES.items():
        data[name].attrs["units"] = units
    notes += doubts(columns, description)
    counts = _counts(data, fates, step)
    notes += _missing_months(counts)
    return Scada(description, data, counts, step, tuple(notes))


def _record(description: ScadaDescription, folder: Path) -> _Record:
    """All rows of the turbine, in the order of the files."""
    measured = description.columns.measured
    status = description.columns.status
    clock = description.time
    rows = description.rows
    names = [column.column for column in measured.values()]
    names += [status.column] if status else []
    names += [clock.column] if clock.column else []
    names += [rows.column] if rows else []
    parts: list[pd.DataFrame] = []
    times: list[Times] = []
    others: set[str] = set()
    count = 0
    for path in files_of(description.files, folder):
        for piece in pieces(path, names, description.sheet):
            if rows is not None:
                labels = piece[rows.column].map(_label)
                listed = labels.unique()[:_LISTED]
                others |= set(listed)
                piece = piece[labels == rows.equals]
            if piece.empty:
                continue
            if clock.assume == CONSECUTIVE:
                times.append(consecutive_times(len(piece), count, clock.step))
            else:
                times.append(utc_times(piece[clock.column], clock, str(path)))
            count += len(piece)
            part = {}
            for name, column in measured.items():
                numbers = _numbers(piece[column.column])
                part[name] = column.si(numbers)
            if status is not None:
                states_of_piece = piece[status.column].map(_label)
                part["status"] = states_of_piece.to_numpy(dtype=object)
            parts.append(pd.DataFrame(part))
    if not parts:
        raise InputError(
            "no row of the files is one of the turbine" if rows else "the files have no rows",
            where="rows" if rows else "files",
            allowed=", ".join(sorted(others)[:_LISTED]),
        )
    whole = pd.concat(parts, ignore_index=True)
    values = {name: whole[name].to_numpy(dtype=float) for name in measured}
    states = None
    if status:
        states = whole["status"].to_numpy(dtype=object)
    return _Record(_joined(times), values, states)


def _joined(times: list[Times]) -> Times:
    """Times of pieces of a record, one after the other."""
    first, *others = times
    further = [part.utc for part in others]
    utc = first.utc.append(further)
    is_repeated = np.concatenate([part.is_repeated for part in times])
    has_offset = all(part.has_offset for part in times)
    return Times(utc, is_repeated, has_offset)


def _label(value: object) -> str:
    """A cell as text: 3.0 of a column with gaps is 3."""
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    return str(value).strip()


def _numbers(column: pd.Series) -> np.ndarray:
    """Numbers of a column; NaN where a cell is empty or no number."""
    numeric = pd.to_numeric(column, errors="coerce")
    return np.asarray(numeric, dtype=float)


def _order(
    record: _Record, description: ScadaDescription
) -> tuple[np.ndarray, list[tuple[str, str, int]], list[str]]:
    """Rows with a time of their own, in the order of time; outcomes of the others; notes."""
    utc = record.times.utc
    notes = []
    fates = {"repeated hour": record.times.is_repeated}
    fates["no time"] = np.asarray(utc.isna())
    is_placed = ~fates["no time"] & ~record.times.is_repeated
    order = np.flatnonzero(is_placed)
    rising = np.argsort(utc.asi8[order], kind="stable")
    order = order[rising]
    later = utc[order].duplicated(keep="first")
    is_copy = np.zeros(len(utc), dtype=bool)
    is_copy[order[later]] = True
    if description.time.zone is None and not record.times.has_offset:
        notes.append("The times tell no offset and no zone is given: they are taken for UTC.")
        twice = _repeated_hours(record, order, later, description.time.step)
        fates["repeated hour"] = fates["repeated hour"] | twice
        is_copy &= ~twice
    fates["duplicate"] = is_copy
    if description.time.assume == CONSECUTIVE:
        notes.append("The files have no time: their rows are taken to follow one another.")
    gone = np.any(list(fates.values()), axis=0)
    months = np.where(utc.isna(), "", _months(utc))
    left = order[~gone[order]]
    return left, _counted(months, fates), notes


def _counted(months: np.ndarray, fates: Mapping[str, np.ndarray]) -> list[tuple[str, str, int]]:
    """Month, outcome and number of rows, from the month of each row and the rows of an outcome."""
    return [
        (str(month), fate, int(count))
        for fate, rows in fates.items()
        for month, count in pd.Series(months[rows]).value_counts().items()
    ]


def _repeated_hours(
    record: _Record, order: np.ndarray, later: np.ndarray, step: float
) -> np.ndarray:
    """Rows in an hour that a record without zone shows twice, shape (rows,) of the files."""
    sorted_columns = [column[order] for column in record.columns.values()]
    values = np.column_stack(sorted_columns)
    differs = np.zeros(order.size, dtype=bool)
    has_changed = np.any(values[1:] != values[:-1], axis=1)
    differs[1:] = later[1:] & has_changed
    utc = record.times.utc
    repeated = np.zeros(len(utc), dtype=bool)
    repeated[order] = hours_shown_twice(utc[order], differs, step)
    return repeated


def _months(times: pd.DatetimeIndex) -> np.ndarray:
    """Month of every time, as `2024-01`."""
    months = times.tz_localize(None).to_numpy().astype("datetime64[M]")
    known, inverse = np.unique(months, return_inverse=True)
    return np.asarray([str(month) for month in known], dtype=object)[inverse]


def _counts(data: pd.DataFrame, fates: list[tuple[str, str, int]], step: float) -> pd.DataFrame:
    """Rows by month and outcome."""
    months = _months(data.index)
    kept = (data["filter"] == "").to_numpy()
    filter_of_row = data["filter"].cat.codes.to_numpy() - 1
    sorted_out = dict(dropped_by_filter(filter_of_row))
    sorted_out["kept"] = kept
    sorted_out["jump"] = kept & data["jump"].to_numpy()
    table = [*fates, *_counted(months, sorted_out)]
    first = data.index[0]
    last = data.index[-1]
    step_of_time = pd.Timedelta(seconds=step)
    steps = pd.date_range(first, last, freq=step_of_time)
    months_of_steps = pd.Series(_months(steps))
    expected = months_of_steps.value_counts()
    present = pd.Series(months).value_counts()
    absent = expected.sub(present, fill_value=0).clip(lower=0)
    for month, count in absent.items():
        if count > 0:
            table.append((str(month), "absent", int(count)))
    frame = pd.DataFrame(table, columns=["month", "filter", "rows"])
    frame["filter"] = pd.Categorical(frame["filter"], FATES, ordered=True)
    return frame.sort_values(["month", "filter"], ignore_index=True)


def _missing_months(counts: pd.DataFrame) -> list[str]:
    """Months of whose time more than `_MOST_MISSING` is without data, in a sentence."""
    table = rows_by_month(counts)
    expected = table.drop(columns=["jump", "duplicate", "no time"]).sum(axis=1)
    kept = table["kept"].to_numpy()
    missing = 1.0 - kept / expected.to_numpy()
    months = []
    for month, share in zip(table.index, missing.tolist(), strict=True):
        if share > _MOST_MISSING:
            months.append(f"{month} ({100.0 * share:.0f} %)")
    if not months:
        return []
    return [f"More than {100.0 * _MOST_MISSING:.0f} % is missing in {', '.join(months)}."]


def rows_by_month(counts: pd.DataFrame) -> pd.DataFrame:
    """Rows with a line for each month and a column for each of `FATES`."""
    dated = counts[counts["month"] != ""]
    table = dated.pivot_table(
        index="month", columns="filter", values="rows", aggfunc="sum", observed=False
    )
    every_fate = table.reindex(columns=list(FATES))
    return every_fate.fillna(0).astype(int)


def told_rows(scada: Scada) -> str:
    """Sentence on the rows that were read.

    Rows of the turbine, period, hours that are used.
    """
    first, last = scada.data.index[[0, -1]]
    span = f"{first:%Y-%m-%d} to {last:%Y-%m-%d}"
    name = "the turbine"
    if scada.description.turbine:
        name = shown(scada.description.turbine)
    kept = int(scada.kept.sum())
    percent = 100.0 * scada.turning.sum() / max(kept, 1)
    return (
        f"{len(scada.data)} rows of {name} from {span}; {kept} of them, {scada.hours:.0f} h, are "
        f"used, and the rotor turns in {percent:.0f} % of these."
    )
