"""The page that compares results, or the designs of a study."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.constants import HOUR
from macroslip.printed import number
from macroslip.report import bearing_figures as draw
from macroslip.report.page import Opening, Table, render, sections, words
from macroslip.report.ranking import ranking_sentences
from macroslip.report.result_numbers import usual_units
from macroslip.report.style import (
    OPENING,
    Picture,
    compared,
    finish,
    log_ticks,
    picture,
    scaled,
    years,
)
from macroslip.result.run_input import window_length

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

_TEMPLATE = "comparison.html"
_RANGE = "In brackets: 95 % range by the scatter of the wind that they have in common"
#: Inputs that a page names, letters of one, and designs that its heading names.
_MOST_INPUTS = 40
_LENGTH = 60
_MOST_NAMED = 4


def comparison_page(
    comparison: pd.DataFrame, results: Mapping[str, xr.Dataset] | None = None, *, title: str = ""
) -> str:
    """A page on what `macroslip.compare` gives, with curves of the results by name."""
    results = results or {}
    text = words(_TEMPLATE)
    numbers, criteria, inputs = comparison_tables(comparison)
    bodies = {"side": text.shown(numbers)}
    if criteria.rows:
        pictures = _criteria_pictures(comparison)
        bodies["damage"] = text.criteria(criteria, pictures)
    if inputs.rows:
        bodies["inputs"] = text.shown(inputs)
    maps, have_differences = _maps(results)
    if maps:
        bodies["maps"] = text.maps(maps, have_differences)
    return render(
        title or f"Comparison of {_listed(comparison['design'].unique()[:_MOST_NAMED].tolist())}",
        f"{comparison.attrs['about']}.",
        Opening(
            text.answer(ranking_sentences(comparison), comparison.attrs["notes"]),
            _exceedances(results),
        ),
        sections(_TEMPLATE, bodies),
    )


def _listed(names: list[str]) -> str:
    """Names as a list in a sentence."""
    *others, last = names
    most = ", ".join(others)
    return " and ".join(filter(None, (most, last)))


def _criteria_pictures(comparison: pd.DataFrame) -> list[Picture]:
    """Criteria of damage of every result, value over reference."""
    by_name = comparison.attrs["criteria"]
    count = len({line["title"] for lines in by_name.values() for line in lines})
    about = "Criteria of damage of every result: value over reference with what it is known to"
    height_of_criterion = 0.25 + 0.1 * len(by_name)
    height = 0.9 + count * height_of_criterion
    return [picture(draw.plot_criteria_side_by_side, about, by_name, height=height, legend="above")]


def _exceedances(results: Mapping[str, xr.Dataset]) -> list[Picture]:
    """How many orbits exceed an energy, and a power, a curve for each result with orbits."""
    values = {
        "energy of an orbit [J]": {
            name: result.orbit_energy.sum("interface")
            for name, result in results.items()
            if "orbit_energy" in result and result.sizes["orbit"]
        },
        "largest power of an orbit [W]": {
            name: result.peak_power.max("interface")
            for name, result in results.items()
            if "peak_power" in result and result.sizes["orbit"]
        },
    }
    return [
        picture(
            _plot_exceeded,
            f"Share of orbits beyond a value: {label}, every result on one scale",
            {
                name: np.sort(of_orbits.values.ravel())[::-1]
                for name, of_orbits in of_results.items()
            },
            label,
            **OPENING,
        )
        for label, of_results in values.items()
        if of_results
    ]


def _maps(results: Mapping[str, xr.Dataset]) -> tuple[list[Picture], bool]:
    """Maps of every raceway in each result on one scale, and differences on another.

    With them, whether there are such differences.
    """
    from macroslip.result.surface_maps import energy_density

    rates = {}
    for name, result in results.items():
        if "surface_energy" in result:
            hours = window_length(result) / HOUR
            roller_hours = hours * result.sizes["roller"]
            density = energy_density(result) / roller_hours
            rates[name] = draw.raceways(density)
    if len(rates) < 2:
        return [], False
    values = {}
    differences = {}
    first = next(iter(rates))
    for raceway, start in rates[first].items():
        for name, maps in rates.items():
            values[raceway, name] = maps[raceway]
            # Rollers of another length have other stations.
            if name != first and np.allclose(start.station, maps[raceway].station):
                # Angles of different maps may differ in the last bit.
                difference = maps[raceway] - start.values
                differences[raceway, f"{name} − {first}"] = difference
    drawn = _drawn_maps(values) | _drawn_maps(differences, difference=True)
    pictures = []
    for raceway in rates[first]:
        pictures += [drawn[key] for key in drawn if key[0] == raceway]
    return pictures, bool(differences)


def _drawn_maps(
    maps: Mapping[tuple[str, str], xr.DataArray], *, difference: bool = False
) -> dict[tuple[str, str], Picture]:
    """Maps of raceways on one scale, by raceway and name."""
    panels = {
        f"Map of the {raceway}: {name}": (values, "J/mm² in an hour", f"{raceway}\n{name}")
        for (raceway, name), values in maps.items()
    }
    plot = functools.partial(draw.plot_map, difference=difference)
    pictures = compared(plot, panels, width=3.2, height=2.6)
    return dict(zip(maps, pictures, strict=True))


def _plot_exceeded(axes: Axes, curves: Mapping[str, np.ndarray], label: str) -> Axes:
    """Share of orbits that exceed a value, a curve for each result's falling values."""
    for k, (name, values) in enumerate(curves.items()):
        count = np.arange(values.size) + 1.0
        share = 100.0 * count / values.size
        dashes = ("-", "--", ":", "-.")[k % 4]
        axes.plot(values, share, label=name, color=f"C{k % 10}", linestyle=dashes)
    log_ticks(log_ticks(axes), "x")
    return finish(axes, label, "orbits above it [%]")


def comparison_tables(comparison: pd.DataFrame) -> list[Table]:
    """Headline numbers side by side, criteria of damage alike, and inputs that differ."""
    names = list(dict.fromkeys(comparison["design"]))
    rows = [
        _line(quantity, designs) for quantity, designs in comparison.groupby("quantity", sort=False)
    ]
    has_ranges = bool(np.isfinite(comparison["low [%]"]).any())
    headings = ["", names[0]]
    for name in names[1:]:
        headings += [name, "difference [%]"]
    inputs = comparison.attrs["inputs"]
    shown = []
    for key, values in itertools.islice(inputs.items(), _MOST_INPUTS):
        cells = [_short(values[name]) for name in names]
        shown.append((key, *cells))
    more = ""
    if len(inputs) > _MOST_INPUTS:
        more = f"; the first {_MOST_INPUTS} of {len(inputs)}"
    return [
        Table(headings, rows, _RANGE if has_ranges else "Headline numbers"),
        _criteria_table(comparison.attrs.get("criteria", {})),
        Table(("input", *names), shown, f"Inputs that differ{more}"),
    ]


def _criteria_table(by_name: Mapping[str, list[dict[str, Any]]]) -> Table:
    """Value of every criterion in each result, with value over reference in brackets."""
    cells: dict[str, dict[str, str]] = {}
    for name, lines in by_name.items():
        for line in lines:
            ratio = ""
            if np.isfinite(line["ratio"]):
                ratio = f" ({number(line['ratio'], 2)})"
            value = usual_units(line["value"], line["unit"]) + ratio
            cells.setdefault(line["title"], {})[name] = value
    rows = []
    for title, of in cells.items():
        values = [of.get(name, "–") for name in by_name]
        rows.append((title, *values))
    caption = "Criteria of damage; in brackets: value over reference"
    return Table(("criterion", *by_name), rows, caption)


def _line(quantity: str, designs: pd.DataFrame) -> tuple[str, ...]:
    """A quantity of every design, and its difference from the first."""
    largest = designs["value"].abs().max()
    units_of_quantity = designs["units"].iloc[0]
    factor, units = scaled(largest, units_of_quantity)
    is_life = quantity.endswith("life")
    cells = []
    for value, change, low, high in designs[
        ["value", "difference [%]", "low [%]", "high [%]"]
    ].itertuples(index=False):
        cells.append(years(value) if is_life else number(factor * value))
        interval = ""
        if np.isfinite(low):
            interval = f" ({low:.3g} to {high:.3g})"
        difference = "–"
        if np.isfinite(change):
            difference = f"{round(change, 9):+.3g}{interval}"
        cells.append(difference)
    # The first design has no difference; lives have their unit beside them.
    heading = quantity if is_life else f"{quantity} [{units}]"
    return (heading, cells[0], *cells[2:])


def _short(value: object) -> str:
    text = str(value)
    if isinstance(value, float):
        text = number(value, 6)
    if len(text) <= _LENGTH:
        return text
    return f"{text[: _LENGTH - 1]}…"
