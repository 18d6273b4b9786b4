"""The page on a year at the winds and temperatures of a turbine."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.printed import number
from macroslip.report.page import Opening, Table, render, sections, words
from macroslip.report.real_year_figures import (
    plot_over_fixed,
    plot_over_wind_and_temperature,
)
from macroslip.report.style import Picture, picture, scaled
from macroslip.result.criteria import OF_NUMBER, SUMMED
from macroslip.study.real_year import ENERGY_COLUMN, OFFSET, sum_column
from macroslip.study.year import DESIGN_COLUMNS

if TYPE_CHECKING:
    import pandas as pd

    from macroslip.study.real_year import RealYear

_TEMPLATE = "real_year.html"
#: Numbers of a table that have the quantity's unit.
_AMOUNTS = ("real", "at_mean", "fixed", "oil_cooler", "oil_warmer")
#: What is shared out over wind speed and temperature, and its name.
_SHARED = {
    "share": "time",
    ENERGY_COLUMN: "energy",
    **{sum_column(yearly): yearly.noun for yearly in SUMMED},
}
#: Columns whose maps are in the opening.
_FIRST = tuple(sum_column(yearly) for yearly in SUMMED if yearly.leads)


def verdict(real_year: RealYear) -> list[str]:
    """The main findings, in sentences.

    How much the mean temperature decides, and how much the place of the sensor.
    """
    table = real_year.table
    first_design = table["design"].iloc[0]
    first = table[table["design"] == first_design]
    of = first.set_index("quantity")
    temperatures = (
        f"The oil is at {real_year.mean_production:.1f} °C in the mean while the rotor turns, "
        f"{real_year.mean_standing:.1f} °C while it stands."
    )
    energy = of.loc["energy"]
    oil = f"{temperatures} Energy is {energy['real_over_fixed']:.2f} of that at 35 °C."
    sentences = []
    limits = []
    for yearly in SUMMED:
        is_known = yearly.name in of.index and np.isfinite(of.loc[yearly.name, "real"])
        if not yearly.leads or not is_known:
            continue
        line = of.loc[yearly.name]
        noun = yearly.noun
        alone = line["at_mean"] / line["fixed"]
        warmer = line["oil_warmer"] / line["real"]
        cooler = line["real"] / line["oil_cooler"]
        ends = warmer, cooler
        sentences.append(
            f"{noun.capitalize()} is {line['real_over_fixed']:.2g} of that at 35 °C: the mean "
            f"temperature alone makes it {alone:.2g}, and how temperature and wind go together "
            f"changes that by a factor of {line['real_over_at_mean']:.2f}. {OFFSET:g} K between "
            f"sensor and oil, which nobody measures, change {noun} by a factor of "
            f"{min(ends):.2g} to {max(ends):.2g}."
        )
        limits.append(
            f"{noun.capitalize()} itself is known to a factor of {line['factor']:g} "
            f"({OF_NUMBER[yearly.name].reason}), which is the same in all these years: ratios are "
            "surer than values."
        )
    return [*sentences, oil, *limits]


def real_year_page(real_year: RealYear) -> str:
    """A page on what `macroslip.real_year` gives: HTML in one piece."""
    text = words(_TEMPLATE)
    designs = list(dict.fromkeys(real_year.table["design"]))
    first = designs[0]
    bins = real_year.bins
    of_first = bins[bins["design"] == first]
    bodies = {
        "numbers": text.numbers(_table(real_year.table)),
        "where": text.where(_maps(of_first, tuple(_SHARED)), _coarse(of_first)),
        "how": text.how(),
    }
    table = real_year.table[real_year.table["design"] == first]
    opening = Opening(
        text.answer(verdict(real_year), real_year.notes),
        [
            picture(plot_over_fixed, "A year over one at 35 °C", table, legend="below"),
            *_maps(of_first, _FIRST),
        ],
    )
    of_designs = ""
    if len(designs) > 1:
        of_designs = f"; {len(designs)} designs, pictures of {first}"
    subtitle = f"{real_year.source}{of_designs}."
    return render("A real year", subtitle, opening, sections(_TEMPLATE, bodies))


def _maps(bins: pd.DataFrame, columns: tuple[str, ...]) -> list[Picture]:
    """Columns of `_SHARED` over wind speed and temperature of the oil, as far as they are known."""
    turning = bins[bins["state"] == "turning"]
    return [
        picture(
            plot_over_wind_and_temperature,
            f"{_SHARED[column].capitalize()} over wind speed and temperature of the oil",
            turning,
            column,
            _SHARED[column],
        )
        for column in columns
        if _is_known(turning, column)
    ]


def _is_known(turning: pd.DataFrame, column: str) -> bool:
    values = turning[column].to_numpy()
    return bool(np.nansum(values) > 0.0)


def _table(table: pd.DataFrame) -> Table:
    """The numbers of every design."""
    several = len(set(table["design"])) > 1
    rows = []
    for line in table.to_dict("records"):
        name = DESIGN_COLUMNS[line["quantity"]].meaning
        factor, units = scaled(line["fixed"], line["unit"])
        unit = f" [{units}]" if units != "1" else ""
        head = f"{name}{unit}"
        if several:
            head = f"{line['design']}: {head}"
        amounts = {key: factor * line[key] for key in _AMOUNTS}
        keys = ("real", "at_mean", "fixed", "real_over_fixed", "oil_cooler", "oil_warmer")
        numbers = line | amounts
        cells = [number(numbers[key], 3) for key in (*keys, "seeds [%]", "factor")]
        rows.append((head, *cells))
    headings = ("", "real", "at the mean", "at 35 °C", "real over 35 °C")
    headings += ("oil 5 K cooler", "oil 5 K warmer", "seeds [%]", "known to a factor")
    return Table(headings, rows, "A year")


def _coarse(bins: pd.DataFrame) -> Table:
    """Shares of production's time, energy and damage by wind speed."""
    turning = bins[bins["state"] == "turning"]
    columns = [column for column in _SHARED if _is_known(turning, column)]
    sums = turning.groupby("wind_speed [m/s]")[columns].sum()
    of_winds = np.array(sums, dtype=float)
    percent = 100.0 * of_winds / of_winds.sum(axis=0)
    rows = []
    for wind, shares in zip(sums.index, percent, strict=True):
        cells = [number(share, 3) for share in shares]
        rows.append((f"{wind:g}", *cells))
    headings_of_shares = [f"{_SHARED[column]} [%]" for column in columns]
    headings = ("wind speed [m/s]", *headings_of_shares)
    return Table(headings, rows, "Shares of production")
