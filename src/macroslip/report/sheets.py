"""Tables of results, comparisons and studies as the sheets of a workbook.

Every table has its units in the header, and the last one is the input with its origin.
"""

from __future__ import annotations

import json
from collections.abc import Hashable, Mapping, Sequence
from typing import Any

import pandas as pd
import xarray as xr

from macroslip.input.record import TAGS
from macroslip.machine import machine
from macroslip.report.result_numbers import row_numbers
from macroslip.result.run_input import leaves, stored_settings
from macroslip.study.export import as_table

#: Name of the last sheet.
ORIGIN = "input and origin"
#: Dimensions of series over time and of maps, which stay in the netCDF file.
_LARGE = frozenset({"time", "angle", "station", "book_time"})
_IN_FILE = "Series over time and maps of the raceways are in the netCDF file of the result."
#: Headings of the numbers of a row, by their names in `row_numbers`.
_OF_ROW = {
    "name": "row",
    "energy": "mean energy of a roller [J]",
    "least": "least energy of a roller [J]",
    "most": "largest energy of a roller [J]",
    "peak": "largest power of a roller [W]",
    "typical": "median of the largest powers of orbits [W]",
    "spin": "lowest spin over pure rolling [1]",
    "outside": "loaded time outside the film formula's range [%]",
    "failed": "failed rollers",
    "rollers": "rollers",
}
_ORIGIN_COLUMNS = ["of", "key", "value", "unit", "from", "note"]
_SI = "SI"


def result_sheets(
    result: xr.Dataset, sentences: Sequence[str], criteria: Sequence[Mapping[str, Any]]
) -> dict[str, pd.DataFrame]:
    """Tables of a result.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    sentences : sequence of str
        Its answer, from `macroslip.report.answer`.
    criteria : sequence of mappings
        Lines of `macroslip.result.damage.lines`.

    Returns
    -------
    dict
        Tables by the names of their sheets: the answer, the numbers of each row of rollers, the
        criteria of damage, the numbers of the bearing, a table for all that a result holds over
        the same dimensions, except series over time and maps, and last the input.
    """
    rows = pd.DataFrame(row_numbers(result)).loc[:, list(_OF_ROW)]
    rows = rows.set_axis(list(_OF_ROW.values()), axis="columns")
    sheets = {
        "answer": pd.DataFrame({"answer": list(sentences)}),
        "rows": rows,
        "criteria": pd.DataFrame(list(criteria)),
        "bearing": _scalars(result),
    }
    for dims, names in _by_dimensions(result).items():
        if dims and not _LARGE & set(dims):
            sheets[" ".join(map(str, dims))] = as_table(result, names)
    filled = {name: table for name, table in sheets.items() if not table.empty}
    return filled | {ORIGIN: origin_sheet({"": result}, [_IN_FILE])}


def _by_dimensions(result: xr.Dataset) -> dict[tuple[Hashable, ...], list[str]]:
    """Names of the variables of a result by their dimensions."""
    names: dict[tuple[Hashable, ...], list[str]] = {}
    for name, variable in result.data_vars.items():
        names.setdefault(variable.dims, []).append(str(name))
    return names


def _scalars(result: xr.Dataset) -> pd.DataFrame:
    """Numbers without dimension, one a column."""
    names = _by_dimensions(result).get((), [])
    units = {name: result[name].attrs.get("units", "1") for name in names}
    numbers = {f"{name} [{units[name]}]": float(result[name]) for name in names}
    return pd.DataFrame([numbers])


def damage_sheets(
    criteria: xr.Dataset, lines: Sequence[Mapping[str, Any]], result: xr.Dataset
) -> dict[str, pd.DataFrame]:
    """Criteria of damage with what they are made from, by names of sheets; last the input."""
    sheets = {"criteria": pd.DataFrame(list(lines))}
    # Coordinates without dimension are references, which the criteria have.
    rates = criteria.drop_vars(
        [name for name, coordinate in criteria.coords.items() if not coordinate.dims]
    )
    for dims, names in _by_dimensions(rates).items():
        if dims and "criterion" not in dims and not _LARGE & set(dims):
            sheets[" ".join(map(str, dims))] = as_table(rates, names)
    missing = criteria.attrs["not_kept"].splitlines()
    return sheets | {ORIGIN: origin_sheet({"": result}, missing)}


def comparison_sheets(
    comparison: pd.DataFrame, datasets: Mapping[str, xr.Dataset]
) -> dict[str, pd.DataFrame]:
    """A comparison: designs with their numbers, differences, inputs that differ, notes.

    Parameters
    ----------
    comparison : pandas.DataFrame
        From `macroslip.compare`.
    datasets : mapping
        The results by name, or the study, for the last sheet.

    Returns
    -------
    dict
        Tables by the names of their sheets.
    """
    heading = comparison["quantity"] + " [" + comparison["units"] + "]"
    headed = comparison.assign(heading=heading)
    designs = headed.pivot(index="design", columns="heading", values="value")
    # In the order of the comparison.
    designs = designs.loc[comparison["design"].unique(), heading.unique()].reset_index()
    differences = comparison.drop(columns=["units", "value"]).dropna(subset="difference [%]")
    inputs = []
    for key, values in comparison.attrs["inputs"].items():
        inputs.append({"input": key, **values})
    criteria = []
    for name, lines in comparison.attrs.get("criteria", {}).items():
        criteria += [{"design": name} | line for line in lines]
    notes = [comparison.attrs["about"], comparison.attrs["ranking"], *comparison.attrs["notes"]]
    sheets = {
        "designs": designs,
        "differences": differences,
        "criteria": pd.DataFrame(criteria),
        "inputs that differ": pd.DataFrame(inputs),
        "notes": pd.DataFrame({"note": [note for note in notes if note]}),
    }
    filled = {name: table for name, table in sheets.items() if not table.empty}
    return filled | {ORIGIN: origin_sheet(datasets)}


def origin_sheet(
    datasets: Mapping[str, xr.Dataset],
    notes: Sequence[str] = (),
    choices: Mapping[str, Any] | None = None,
) -> pd.DataFrame:
    """Program, machine and input of results or studies by name, a line a value.

    Parameters
    ----------
    datasets : mapping
        Results or studies.
    notes : sequence of str
        Sentences on the workbook.
    choices : mapping, optional
        Options of the command that made the tables.

    Returns
    -------
    pandas.DataFrame
        Columns of, key, value, unit, from, note. Values that the case states without a unit are in
        SI units.
    """
    lines = [("", "note", note, "", "", "") for note in notes]
    lines += [
        ("", f"this file: {key}", value, "", "", "")
        for key, value in machine().items()
        if value is not None
    ]
    lines += [
        ("", f"option: {key}", str(value), "", "", "") for key, value in (choices or {}).items()
    ]
    for name, dataset in datasets.items():
        lines.append((name, "computed by", dataset.attrs.get("source", "not given"), "", "", ""))
        inputs = leaves(stored_settings(dataset))
        lines += [(name, key, *_input_cells(leaf)) for key, leaf in inputs]
        cited = dataset.attrs.get("citations", "").splitlines()
        lines += [(name, "cites", citation, "", "", "") for citation in dict.fromkeys(cited)]
    return pd.DataFrame(lines, columns=_ORIGIN_COLUMNS)


def _input_cells(leaf: Any) -> tuple[Any, str, str, str]:
    """Value, unit, origin and note of an input.

    Examples
    --------
    >>> _input_cells(2), _input_cells([0, 7])
    ((2, 'SI', '', ''), ('[0, 7]', '', '', ''))
    """
    if isinstance(leaf, Mapping):
        tag = str(leaf["tag"])
        unit = str(leaf.get("unit", "1"))
        return leaf["value"], unit, TAGS.get(tag, tag), str(leaf.get("note", ""))
    if isinstance(leaf, int | float) and not isinstance(leaf, bool):
        return leaf, _SI, "", ""
    if leaf is None:
        return "none", "", "", ""
    text = leaf if isinstance(leaf, str) else json.dumps(leaf, ensure_ascii=False)
    return text, "", "", ""
