"""The opening of a study's page: how its runs ended, a lifetime, the largest values, in sentences and figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.page import Opening
from macroslip.report.pictures import OPENING_HEIGHT, OPENING_WIDTH, picture
from macroslip.report.result_opening import plot_by_result
from macroslip.report.study_figures import EXCEEDED, group_labels, groups, plot_exceedance, plot_lifetime
from macroslip.report.wording import three_digits
from macroslip.study.outcome import Outcome

if TYPE_CHECKING:
    from collections.abc import Callable

    import xarray as xr
    from matplotlib.axes import Axes

    from macroslip.report.pictures import Picture

#: Runs that a figure can name.
_MOST_NAMES = 16


def study_opening(study: xr.Dataset, life: xr.Dataset | None, curves: xr.Dataset | None) -> Opening:
    """The opening for a study.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`.
    life : xarray.Dataset or None
        From `lifetime_energy`, where wind speeds can be weighted.
    curves : xarray.Dataset or None
        From `exceedance`, where the results keep what it needs.
    """
    sentences, pictures = [_outcomes(study)], []
    group = next(iter(groups(life.bin_energy)), None) if life is not None else None
    if life is not None and group is not None:
        sentences.append(_lifetime(life, group) if len(groups(life.bin_energy)) == 1 else _lifetimes(life))
        pictures.append(_picture(lambda axes: plot_lifetime(axes, life, group), "Lifetime energy by wind speed"))
    group = next(iter(groups(curves.power_orbits)), None) if curves is not None else None
    if group is not None:
        for name, label in EXCEEDED.items():
            words = f"Orbits a year of a roller over the {label}"
            pictures.append(
                _picture(lambda axes, name=name, group=group: plot_exceedance(axes, curves, name, group), words)
            )
    for name, words in (
        ("energy_mean", "Rollers dissipate most, {0} J each,"),
        ("peak_power_max", "The largest frictional power is {0} W,"),
        ("lowest_spin_ratio", "The slowest roller falls to {0} of pure rolling,"),
    ):
        values = -study[name] if name == "lowest_spin_ratio" else study[name]
        if bool(values.notnull().any()):
            place = values.argmax(["case", "row"])
            value = float(study[name].isel(place))
            sentences.append(
                f"{words.format(three_digits(value))} {study.row[place['row']].item()} in {_run(study, int(place['case']))}."
            )
    names = {"energy_mean": "energy of a mean roller [J]", "peak_power_max": "largest frictional power [W]",
             "lowest_spin_ratio": "lowest spin / pure rolling [–]"}  # fmt: skip
    for name, label in names.items():
        if len(pictures) < 4 and bool(study[name].notnull().any()):
            pictures.append(
                _picture(lambda axes, name=name, label=label: _plot(axes, study, name, label), f"By run: {label}")
            )
    return Opening(tuple(sentences), tuple(pictures))


def _outcomes(study: xr.Dataset) -> str:
    counts = {one: int((study.outcome.values == str(one)).sum()) for one in Outcome}
    failed = counts[Outcome.FAILED] + counts[Outcome.ROLLERS_FAILED]
    runs = study.sizes["case"]
    if counts[Outcome.COMPLETED] == runs:
        return f"All {runs} runs completed."
    return (
        f"{counts[Outcome.COMPLETED]} of {runs} runs completed, {failed} FAILED, {counts[Outcome.MISSING]} are missing."
    )


def _lifetime(life: xr.Dataset, group: int) -> str:
    energy = life.lifetime_energy.isel(group=group)
    words = []
    for row in life.row.values.tolist():
        value = float(energy.sel(row=row))
        if not np.isfinite(value):
            words.append(f"an unknown energy {row} (some wind speed has no result)")
            continue
        parts = life.bin_energy.isel(group=group).sel(row=row)
        most = float(life.bin[int(np.nanargmax(parts.values))])
        words.append(f"{three_digits(1e-6 * value)} MJ {row} (most of it at {most:g} m/s)")
    return (
        f"In {life.attrs['years']:g} years a roller dissipates {' and '.join(words)}; the wind speeds of the study are "
        f"{100.0 * float(life.covered):.0f} % of all time."
    )


def _lifetimes(life: xr.Dataset) -> str:
    """Lifetime energies of several bearings, lubricants, models or values of parameters: the range, and the highest."""
    words = []
    for row in life.row.values.tolist():
        values = 1e-6 * life.lifetime_energy.sel(row=row).values
        if not np.isfinite(values).any():
            words.append(f"an unknown energy {row} (some wind speed has no result)")
            continue
        of = ", ".join(group_labels(life, int(np.nanargmax(values))))
        words.append(
            f"{three_digits(np.nanmin(values))} to {three_digits(np.nanmax(values))} MJ {row} (most with {of})"
        )
    return (
        f"In {life.attrs['years']:g} years a roller dissipates {' and '.join(words)}; the wind speeds of the study are "
        f"{100.0 * float(life.covered):.0f} % of all time."
    )


def _run(study: xr.Dataset, case: int) -> str:
    """What names a run: its loads, and those labels that differ in the study."""
    one = study.isel(case=case)
    labels = [
        str(one[name].item()).rpartition("/")[2]
        for name in ("loads", "bearing", "lubricant", "model")
        if name == "loads" or np.unique(study[name].values).size > 1
    ]
    return ", ".join(labels)


def _plot(axes: Axes, study: xr.Dataset, name: str, label: str) -> Axes:
    """The runs with the most extreme values, in the order of the study."""
    values = study[name].transpose("case", "row").values
    extreme = (-study[name].min("row") if name == "lowest_spin_ratio" else study[name].max("row")).values
    shown = np.sort(np.argsort(-np.nan_to_num(extreme, nan=-np.inf), kind="stable")[:_MOST_NAMES])
    names = [_run(study, int(case)) for case in shown]
    if len(set(names)) < len(names):
        # Variations of parameters have no names that fit; their runs have numbers.
        names = [f"run {int(case)}" for case in shown]
    plot_by_result(axes, names, study.row.values.tolist(), values[shown], label)
    if shown.size < study.sizes["case"]:
        axes.set_title(f"the {shown.size} most extreme of {study.sizes['case']} runs", fontsize=10, loc="left")
    return axes


def _picture(plot: Callable[[Axes], object], words: str) -> Picture:
    return picture(plot, words, width=OPENING_WIDTH, height=OPENING_HEIGHT, legend="above")
