"""The page on the heat of a main bearing: fit, rival models, and index over time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pandas as pd

from macroslip.printed import number
from macroslip.report import heat_figures as draw
from macroslip.report.page import Opening, Table, render, sections, words
from macroslip.report.style import OPENING, Picture, compared, picture
from macroslip.result.heat_balance import SPECIFIC_HEAT
from macroslip.scada.description import ScadaDescription
from macroslip.scada.heat import BearingHeat, fit_of
from macroslip.scada.heat_balance import PARAMETERS, HeatFit
from macroslip.scada.heat_index import FLAGGED, first_flag
from macroslip.scada.heat_models import FRICTION, FRICTION_ALONE, MEAN_TEMPERATURE

_TEMPLATE = "heat.html"
#: Standard errors of the blocks from which on a difference of residuals counts, and percent of the
#: residual from which on it is more than hardly.
_RESOLVED = 2.0
_CLEARLY = 2.0
#: What a reader has to know before any number.
_CAUTION = (
    "An index of heat is no alarm: sound turbines wander from 0.7 to 1.4 in two years, the neighbour "
    "as reference matters more than the model, and a regression without any physics flags a real "
    "crack as sharply. Lubrication cannot be read off one turbine: supply of oil, heat capacity and "
    "seals trade. In this model starvation cools."
)
#: Units in which constants are shown: factor and name.
_SHOWN = {"capacity": (1e-6, "MJ/K")}
_HEADINGS = ("model", "residual [K/h]", "constant", "value", "standard error", "unit")


def heat_page(heat: BearingHeat, description: ScadaDescription, study: str) -> str:
    """A page on what `bearing_heat` gives.

    Parameters
    ----------
    heat : BearingHeat
    description : ScadaDescription
    study : str
        Name of the study whose friction it is.

    Returns
    -------
    str
        HTML.
    """
    text = words(_TEMPLATE)
    over_sibling = heat.index["r_sibling"]
    has_sibling = bool(over_sibling.notna().any())
    bodies = {
        "fits": text.fits(fit_table(heat)),
        "residuals": text.residuals(_residual_pictures(heat)),
        "index": text.index(_index_pictures(heat, has_sibling), _months(heat), has_sibling),
        "limits": text.limits(),
    }
    if heat.notes:
        bodies["notes"] = text.notes(heat.notes)
    sentences = heat_sentences(heat, description)
    return render(
        f"Heat of the main bearing{f' of {description.turbine}' if description.turbine else ''}",
        f"{len(heat.windows)} windows of two hours, {int(heat.windows['reference'].sum())} of them "
        f"of the reference; friction of {study}.",
        Opening(text.answer(sentences, heat.marks), _opening_pictures(heat)),
        sections(_TEMPLATE, bodies),
    )


def heat_sentences(heat: BearingHeat, description: ScadaDescription) -> list[str]:
    """What no index can tell; whether computed friction explains the heat; its constants; its index."""
    return [
        _CAUTION,
        _worth(heat),
        f"{_constants(heat.chosen)}{_capacity(heat.chosen, description)} {_level()} "
        f"{_supplies(heat)}",
        _flags(heat),
    ]


def _worth(heat: BearingHeat) -> str:
    """Sentence on the residual of computed friction beside that of its rivals."""
    own = heat.chosen
    names = (FRICTION, FRICTION_ALONE, MEAN_TEMPERATURE)
    rivals = [fit for fit in heat.fits if fit.model.name not in names]
    best = min(rivals, key=lambda fit: fit.residual)
    difference = 100.0 * (own.residual / best.residual - 1.0)
    beside = (
        f"{own.residual:.3f} K/h are left beside {best.residual:.3f} of the best rival, "
        f"{best.model.name} ({difference:+.1f} %)"
    )
    scatter = block_scatter(heat, best)
    if abs(scatter) < _RESOLVED:
        verdict = f"The computed friction explains the heat no better than a rival: {beside}, "
        verdict += "which the scatter of three-day blocks does not resolve. "
        verdict += "Computed friction does not improve the fit."
    elif scatter < 0.0:
        verdict = f"The computed friction explains the heat worse than a rival: {beside}. "
        verdict += "Computed friction does not improve the fit."
    elif difference > -_CLEARLY:
        verdict = f"The computed friction explains the heat hardly better than a rival: {beside}."
    else:
        verdict = f"The computed friction explains the heat better than its rivals: {beside}."
    alone = fit_of(heat.fits, FRICTION_ALONE, own.model.supply)
    steady = fit_of(heat.fits, MEAN_TEMPERATURE, own.model.supply)
    return (
        f"{verdict} Without seals it leaves {alone.residual:.3f} K/h, and {steady.residual:.3f} "
        "with the friction at the mean temperature in place of that measured."
    )


def block_scatter(heat: BearingHeat, rival: HeatFit) -> float:
    """Excess of a rival's sum of squared residuals over the chosen fit's, in block standard errors.

    Parameters
    ----------
    heat : BearingHeat
    rival : HeatFit

    Returns
    -------
    float
        Mean over its standard error [-]; above 2 the chosen fit is better.
    """
    inside = heat.windows["reference"].to_numpy()
    more = (rival.residuals**2 - heat.chosen.residuals**2)[inside]
    block_of_window = heat.windows["block"].to_numpy()[inside]
    by_block = pd.Series(more).groupby(block_of_window)
    blocks = by_block.sum().to_numpy()
    error = blocks.std(ddof=1) / np.sqrt(blocks.size)
    return float(blocks.mean() / error)


def _constants(fit: HeatFit) -> str:
    values = fit.values
    errors = fit.errors
    losses = [values[name] for name in ("to_nacelle", "to_ambient") if name in values]
    loss = sum(losses)
    return (
        f"Heat capacity {1e-6 * values['capacity']:.2f} ± {1e-6 * errors['capacity']:.2f} MJ/K, "
        f"loss {loss:.3f} per hour, torque of seals {values['seal_torque']:.0f} ± "
        f"{errors['seal_torque']:.0f} N m."
    )


def _capacity(fit: HeatFit, description: ScadaDescription) -> str:
    """The heat capacity beside the mass of steel that is known to warm."""
    known = description.capacity
    if known is None:
        return (
            " No mass that warms with the bearing is given, and without it these are values of "
            "the fit, not of the bearing."
        )
    masses = known.range or (known.mass, known.mass)
    low, high = (1e-6 * SPECIFIC_HEAT * mass for mass in masses)
    fitted = 1e-6 * fit.values["capacity"]
    inside = low <= fitted <= high
    return (
        f" The given mass of steel has {low:.2f} to {high:.2f} MJ/K: the fitted capacity lies "
        f"{'inside' if inside else 'outside, so that this supply of oil is unlikely'}."
    )


def _level() -> str:
    """How the constants depend on the level of the computed friction."""
    return (
        "Capacity and seals stand in proportion to the level of the computed friction: with friction "
        "that is a quarter too low both come out a quarter too small, and nothing in the record "
        "shows it."
    )


def _supplies(heat: BearingHeat) -> str:
    own = [fit for fit in heat.fits if fit.model.name == FRICTION]
    if len(own) == 1:
        return "Other supplies of oil were not tried; one turbine could not tell them apart."
    residuals = ", ".join(
        f"{fit.model.supply} {fit.residual:.4f} K/h with {1e-6 * fit.values['capacity']:.2f} MJ/K"
        for fit in sorted(own, key=lambda fit: fit.residual)
    )
    return f"By supply of oil: {residuals}. One turbine cannot tell them apart."


def _flags(heat: BearingHeat) -> str:
    """When the index is flagged, which is no alarm."""
    days = _index_of_chosen(heat, "day")
    months = _index_of_chosen(heat, "month")["r"]
    flag = first_flag(days)
    crossing = (
        f"its cumulative sum passes {FLAGGED:g} on {flag:%Y-%m-%d}"
        if flag is not None
        else f"its cumulative sum stays below {FLAGGED:g}"
    )
    spread = ""
    if len(months):
        spread = f", by months {months.min():.2f} to {months.max():.2f}"
    over = ""
    if bool(days["r_sibling"].notna().any()):
        flag = first_flag(days, "cusum_sibling")
        over = " Over the sibling it " + (
            f"does on {flag:%Y-%m-%d}." if flag is not None else "does not."
        )
    return f"Index of the heat, 1 in the reference{spread}; {crossing}.{over}"


def _index_of_chosen(heat: BearingHeat, period: str) -> pd.DataFrame:
    """Index of the chosen model by `day`, `week` or `month`."""
    rows = heat.index_by(period)
    is_chosen = rows["model"] == heat.chosen.model.name
    return rows.loc[is_chosen]


def fit_table(heat: BearingHeat) -> Table:
    """Constants of all models, the least residual first."""
    rows = []
    for fit in sorted(heat.fits, key=lambda fit: fit.residual):
        for position, (name, value) in enumerate(fit.values.items()):
            unit_of_fit, constant = PARAMETERS[name]
            factor, unit = _SHOWN.get(name, (1.0, unit_of_fit))
            head = ("", "–")
            if position == 0:
                head = (fit.model.title, f"{fit.residual:.4f}")
            error = factor * fit.errors[name]
            shown = (number(factor * value, 3), number(error, 2))
            rows.append((*head, constant, *shown, unit))
    return Table(_HEADINGS, rows, "Constants of every model, fitted to the reference")


def _months(heat: BearingHeat) -> Table:
    """Index of every model by month."""
    months = heat.index_by("month")
    table = months.pivot_table("r", "start", "model", sort=False)
    rows = [
        (f"{pd.Timestamp(start):%Y-%m}", *(number(value, 3) for value in line))
        for start, line in zip(table.index, table.to_numpy(), strict=True)
    ]
    return Table(("month", *table.columns), rows, "Index of the heat by month")


def _opening_pictures(heat: BearingHeat) -> Sequence[Picture]:
    return [
        picture(
            draw.plot_root_mean_squares,
            "Root mean square of the residual of every model",
            heat,
            **OPENING,
        ),
        picture(draw.plot_index, "Weekly index of heat over time, every model", heat, **OPENING),
    ]


def _residual_pictures(heat: BearingHeat) -> Sequence[Picture]:
    panels = {
        f"Mean residual of the computed friction and of rivals over {over}": (heat, over)
        for over in draw.OVER
    }
    return compared(draw.plot_residuals, panels, legend="above")


def _index_pictures(heat: BearingHeat, has_sibling: bool) -> Sequence[Picture]:
    pictures = [picture(draw.plot_cusum, "Cumulative sum of the daily index", heat, legend="above")]
    if has_sibling:
        pictures += [
            picture(plot, f"{about} over the sibling's", heat, column, legend="above")
            for plot, about, column in (
                (draw.plot_index, "Weekly index", "r_sibling"),
                (draw.plot_cusum, "Cumulative sum of the daily index", "cusum_sibling"),
            )
        ]
    return pictures
