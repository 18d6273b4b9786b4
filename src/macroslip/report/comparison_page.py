"""The page that compares results, or the designs of a study."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report import bearing_figures as draw
from macroslip.report.page import Opening, Table, number, render, sections, words
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

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes

_TEMPLATE = "comparison.html"
_RANGE = "In brackets: 95 % range by the scatter of the wind that they have in common"
#: Inputs that a page names, letters of one, and designs that its heading names.
_MOST_INPUTS, _LENGTH, _MOST_NAMED = 40, 60, 4


def comparison_page(
    found: pd.DataFrame, results: Mapping[str, xr.Dataset] | None = None, *, title: str = ""
) -> str:
    """A page on what `macroslip.compare` gives, with curves of the results by name; HTML in one piece."""
    pictures = []
    for name, label in (
        ("orbit_energy", "energy of an orbit [J]"),
        ("peak_power", "largest power of an orbit [W]"),
    ):
        curves = {}
        for design, one in (results or {}).items():
            if name in one and one.sizes["orbit"]:
                every = (
                    one[name].sum("interface")
                    if name == "orbit_energy"
                    else one[name].max("interface")
                )
                curves[design] = np.sort(every.values.ravel())[::-1]
        if curves:
            about = f"Share of orbits whose {label.partition(' [')[0]} exceeds a value, every result on one scale"
            pictures.append(picture(_plot_exceeded, about, curves, label, **OPENING))
    numbers, inputs = comparison_tables(found)
    text = words(_TEMPLATE)
    opening = Opening(text.answer(found.attrs["ranking"], found.attrs["notes"]), pictures)
    bodies = {"side": text.shown(numbers)} | ({"inputs": text.shown(inputs)} if inputs.rows else {})
    if maps := _maps(results or {}):
        bodies["maps"] = text.maps(maps, any(" − " in one.words for one in maps))
    title = title or f"Comparison of {', '.join(found['design'].unique()[:_MOST_NAMED])}"
    return render(title, f"{found.attrs['about']}.", opening, sections(_TEMPLATE, bodies))


def _maps(results: Mapping[str, xr.Dataset]) -> list[Picture]:
    """Of every raceway its map in each result, on one scale, and what each has more than the first, on another."""
    from macroslip.result.surface_maps import energy_density

    rates = {}
    for name, one in results.items():
        if "surface_energy" in one:
            hours = (one.attrs["window_end"] - one.attrs["window_start"]) / 3600.0
            rates[name] = draw.raceways(energy_density(one) / (hours * one.sizes["roller"]))
    if len(rates) < 2:
        return []
    first = next(iter(rates))
    values, differences = {}, {}
    for raceway, start in rates[first].items():
        for name, one in rates.items():
            values[raceway, name] = one[raceway]
            # Rollers of another length have other places.
            if name != first and np.allclose(start.station, one[raceway].station):
                differences[raceway, f"{name} − {first}"] = one[raceway] - start.values
    drawn = {}
    for panels, difference in ((values, False), (differences, True)):
        named = {f"Map of the {raceway}: {name}": (one, "J/mm² in an hour", f"{raceway}\n{name}")
                 for (raceway, name), one in panels.items()}  # fmt: skip
        pictures = compared(
            functools.partial(draw.plot_map, difference=difference), named, width=3.2, height=2.6
        )
        drawn |= dict(zip(panels, pictures, strict=True))
    return [drawn[one] for raceway in rates[first] for one in drawn if one[0] == raceway]


def _plot_exceeded(axes: Axes, curves: Mapping[str, np.ndarray], label: str) -> Axes:
    for k, (name, values) in enumerate(curves.items()):
        share = 100.0 * (np.arange(values.size) + 1.0) / values.size
        axes.plot(
            values, share, label=name, color=f"C{k % 10}", linestyle=("-", "--", ":", "-.")[k % 4]
        )
    log_ticks(log_ticks(axes), "x")
    return finish(axes, label, "orbits above it [%]")


def comparison_tables(found: pd.DataFrame) -> list[Table]:
    """Headline numbers side by side, and inputs that differ."""
    names = list(dict.fromkeys(found["design"]))
    rows = []
    lines = [list(line) for line in found.itertuples(index=False)]
    # The designs of a quantity follow each other.
    for start in range(0, len(lines), len(names)):
        quantity, units, _, first, *_ = lines[start]
        here = lines[start : start + len(names)]
        factor, shown = scaled(max(abs(one[3]) for one in here), units)
        # Lives have their unit beside them: beyond 500 years they are written as such.
        write = (
            years
            if quantity.endswith("life")
            else lambda value, factor=factor: number(factor * value)
        )
        cells = [write(first)]
        for _, _, _, value, change, low, high in here[1:]:
            between = f" ({low:.3g} to {high:.3g})" if np.isfinite(low) else ""
            cells += [
                write(value),
                f"{round(change, 9):+.3g}{between}" if np.isfinite(change) else "–",
            ]
        rows.append((quantity if write is years else f"{quantity} [{shown}]", *cells))
    headings = ["", names[0]]
    for name in names[1:]:
        headings += [name, "difference [%]"]
    inputs = list(found.attrs["inputs"].items())
    shown = [
        (key, *(_short(values[name]) for name in names)) for key, values in inputs[:_MOST_INPUTS]
    ]
    more = f"; the first {_MOST_INPUTS} of {len(inputs)}" if len(inputs) > _MOST_INPUTS else ""
    return [
        Table(
            headings,
            rows,
            _RANGE if any("(" in cell for row in rows for cell in row[1:]) else "Headline numbers",
        ),
        Table(("input", *names), shown, f"Inputs that differ{more}"),
    ]


def _short(value: object) -> str:
    text = number(value, 6) if isinstance(value, float) else str(value)
    return text if len(text) <= _LENGTH else f"{text[: _LENGTH - 1]}…"
