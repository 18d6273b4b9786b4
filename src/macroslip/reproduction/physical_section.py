"""The study under models with microslip: what changes, what estimated values leave open, and the friction torque."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.page import Block, Paragraph, Pictures, Points, Section, Table
from macroslip.report.pictures import picture
from macroslip.report.style import log_ticks
from macroslip.report.wording import three_digits
from macroslip.reproduction import mechanism_figures as draw
from macroslip.reproduction import uncertainty_figures
from macroslip.reproduction.dissipation import dissipation, knows_mechanisms
from macroslip.reproduction.model_run import TORQUE_WINDOW, bearing_torques
from macroslip.reproduction.torque_figures import plot_torque
from macroslip.reproduction.uncertain_values import VALUES
from macroslip.reproduction.uncertainty_summary import (
    DRIVER_LEVEL,
    drivers,
    robust,
    sample_size,
    strongest,
)

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.model_run import ModelRun


def physical_sections(runs: Mapping[str, ModelRun]) -> list[Section]:
    """Sections on the models together, on uncertainty where a model has a sample, and on the friction torque."""
    found = []
    inside = {name: run for name, run in runs.items() if knows_mechanisms(run.study)}
    if inside:
        found.append(_models(runs, inside))
    summaries = {name: run.uncertainty for name, run in runs.items() if run.uncertainty is not None}
    if summaries:
        blocks = [block for name, summary in summaries.items() for block in _uncertainty(name, summary)]
        gist = "all estimated values drawn together from their ranges: what follows, and what drives it"
        found.append(Section("uncertainty", "What the estimated values leave open", tuple(blocks), gist))
    return [*found, _torque(runs)]


def _models(runs: Mapping[str, ModelRun], inside: Mapping[str, ModelRun]) -> Section:
    numbers = {name: run.numbers for name, run in runs.items()}
    jobs = (
        ("both_rows_normalised", "energy, both rows, over that in 12C [–]", False),
        ("energy_ratio", "energy, downwind / upwind [–]", True),
        ("peak_power_mean", "mean largest power of an orbit [W]", True),
        ("peak_power_ratio", "mean largest power, downwind / upwind [–]", True),
    )
    pictures = [
        picture(
            lambda axes, name=name, label=label, log=log: draw.plot_models(
                log_ticks(axes) if log else axes, numbers, name, label
            ),
            f"Over wind speed, each model: {label}",
            legend="above",
        )
        for name, label, log in jobs
    ]
    blocks: list[Block] = [
        Pictures(tuple(pictures), "Figures 4 and 5 under the models: mean and range of the turbulence classes.")
    ]
    for name, run in inside.items():
        parts = dissipation(run.study)
        shown = [
            picture(
                lambda axes, row=row, parts=parts: draw.plot_parts(axes, parts.part_energy, row),
                f"Energy per orbit by interface and mechanism, {row} row",
                legend="below",
                height=4.2,
            )
            for row in run.study.row.values.tolist()
        ]
        shown.append(
            picture(
                lambda axes, parts=parts: draw.plot_stations(
                    axes, parts.station_energy, "downwind", draw.shown_cases(parts)
                ),
                "Energy along the roller, downwind row",
                legend="below",
                height=4.2,
            )
        )
        blocks += [
            Pictures(tuple(shown), f"Energy per orbit of a mean roller under {name}, by what makes surfaces slide."),
            _part_table(parts, name),
        ]
    gist = "figures 4 and 5 under both models; energy by interface, mechanism and place along the roller"
    return Section("mechanisms", "What dissipates inside the contacts", tuple(blocks), gist)


def _part_table(parts: xr.Dataset, name: str) -> Table:
    speeds = np.unique(parts.wind_speed.values)
    rows = []
    for row in parts.row.values.tolist():
        for part in parts.part.values.tolist():
            mean = parts.part_energy.sel(row=row, part=part).groupby("wind_speed").mean(skipna=False)
            rows.append((row, part, *(f"{value:.3g}" for value in mean.values)))
        share = 100.0 * parts.asperity_share.sel(row=row).groupby("wind_speed").mean(skipna=False)
        rows.append((row, "of it at asperities [%]", *(f"{value:.2g}" for value in share.values)))
    return Table(
        ("row", "part", *(f"{speed:g} m/s [J]" for speed in speeds)),
        tuple(rows),
        f"Energy per orbit of a mean roller under {name}, mean of the turbulence classes",
    )


def _uncertainty(name: str, summary: xr.Dataset) -> list[Block]:
    rows = []
    for k, quantity in enumerate(summary.quantity.values.tolist()):
        one = summary.isel(quantity=k)
        unit = "" if str(one.units.values) == "1" else f" [{one.units.values}]"
        named = ", ".join(f"{parameter} ({value:+.2f})" for parameter, value in drivers(summary, quantity))
        indices = ", ".join(
            f"{parameter} {first:.2f} ({total:.2f})" for parameter, first, total in strongest(summary, quantity)
        )
        cells = (three_digits(float(value)) for value in (one.base, *one.range.sel(quantile=[0.5, 0.05, 0.95]).values))
        known = f"{float(one.explained):.2f}" if np.isfinite(one.explained) else "–"
        rows.append((f"{quantity}{unit}", *cells, named or "none", indices or "none", known))
    trends = tuple(
        f"{trend[0].upper()}{trend[1:]}: {word}, {100.0 * float(share):.0f} % of the samples; "
        f"base values: {'yes' if base else 'no'}."
        for (trend, word), share, base in zip(
            robust(summary), summary.trend_share.values, summary.trend_base.values, strict=True
        )
    )
    ranges = tuple((one.name, one.range_text, one.tag, one.reason) for one in VALUES)
    return [
        Paragraph(
            f"Model {name}: all values below, and the law of shear, drawn together from their ranges by a scrambled Sobol sequence "
            f"with a fixed seed; cases {', '.join(summary.case.values.tolist())}. {sample_size(summary)}."
        ),
        Pictures(
            (
                picture(
                    lambda axes: uncertainty_figures.plot_ranges(axes, summary),
                    "Range of each result over its base",
                    width=5.6,
                    height=5.6,
                ),
                picture(
                    lambda axes: uncertainty_figures.plot_correlations(axes, summary),
                    "Rank correlation of each result with each value",
                    width=6.4,
                    height=5.6,
                ),
                picture(
                    lambda axes: uncertainty_figures.plot_indices(axes, summary),
                    "Sobol' indices of each result",
                    width=6.4,
                    height=5.6,
                ),
            ),
            "Lines: 5 to 95 % of the samples; bar across: median. Squares, in the order of the lines: rank "
            f"correlations, filled where they are no chance (p < {DRIVER_LEVEL:g}), and Sobol' indices of the logarithm: "
            "the square is the total index, the filled part that of first order, and the number on the right the part of "
            "the variance that the polynomial behind the indices predicts for samples it was not fitted to.",
        ),
        Table(
            (
                "result",
                "base",
                "median",
                "5 %",
                "95 %",
                "driven by (rank correlation)",
                "Sobol' index of first order (total)",
                "predicted",
            ),
            tuple(rows),
            "Results over the sample",
        ),
        Paragraph(
            "A statement is robust if every sample shows it, and robustly not so if none does. Indices are those of a "
            "sparse polynomial of second degree fitted to the sample; the variance that it does not predict is "
            "unexplained."
        ),
        Points(trends),
        Table(("value", "range", "tag", "why"), ranges, "What was varied"),
    ]


def _torque(runs: Mapping[str, ModelRun]) -> Section:
    histories = bearing_torques(runs)
    start, end = TORQUE_WINDOW
    rows = tuple(
        (name, *(f"{value:.3g}" for value in (np.nanmean(one.torque), np.nanmin(one.torque), np.nanmax(one.torque))))
        for name, one in histories.items()
    )
    blocks: tuple[Block, ...] = (
        Paragraph(
            "Friction torque of the whole bearing in case 14B: dissipated power and drag of all 56 rollers over shaft "
            "speed, beside handbook estimates. The paper's model has no rolling resistance of the oil, which is most of "
            "SKF's torque; the physical one has, and how much depends on how full the inlets are. Neither has churning "
            "beyond drag. SKF's sliding part is what to compare microslip with."
        ),
        Pictures(
            (
                picture(
                    lambda axes: plot_torque(axes, histories, start, end),
                    "Friction torque over time",
                    legend="below",
                    width=6.4,
                    height=4.2,
                    wide=True,
                ),
            ),
            f"From {start:g} to {end:g} s.",
        ),
        Table(("friction torque", "mean [N m]", "least [N m]", "most [N m]"), rows, "Over all 600 s"),
    )
    return Section("torque", "Friction torque of the bearing", blocks, "computed, beside handbook estimates")
