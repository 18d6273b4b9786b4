"""The opening of a page on results: the answer in five sentences and four figures."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.report import bearing_figures as draw
from macroslip.report.page import Opening
from macroslip.report.pictures import OPENING_HEIGHT, OPENING_WIDTH, Picture, picture
from macroslip.report.style import ROW, finish
from macroslip.report.wording import three_digits

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

#: Letters of a result's name that fit under a figure.
_NAME_LENGTH = 16


def result_opening(result: xr.Dataset, profile: Mapping[str, xr.Dataset] | None) -> Opening:
    """The opening for one result.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    profile : mapping or None
        From `orbit_profile`; None without traces.
    """
    failed = bool((result.status != 0).any())
    sentences = [f"{status_sentence([result])} {_energies(result)}" if failed else _energies(result)]
    if "peak_power" in result and bool(result.peak_power.notnull().any()):
        sentences.append(_peaks(result))
    if "min_spin_ratio" in result:
        sentences.append(_spins(result))
    sentences += [_sure(result), *([] if failed else [status_sentence([result])])]
    pictures = [
        _picture(
            lambda axes: draw.plot_energy_by_interface(axes, result.energy), "Energy of a mean roller by interface"
        )
    ]
    if "peak_power" in result and np.nanmax(result.peak_power.values, initial=0.0) > 0.0:
        words = "Share of orbits whose largest power exceeds a value"
        pictures.append(_picture(lambda axes: draw.plot_peak_exceedance(axes, result), words))
    pictures += _orbit_pictures(result, profile) if profile else _roller_pictures(result)
    return Opening(tuple(sentences), tuple(pictures))


def results_opening(results: Mapping[str, xr.Dataset]) -> Opening:
    """The opening for several results, one of them a case of a study too."""
    names, rows = list(results), next(iter(results.values())).row.values.tolist()
    quantities = (
        ("energy of a mean roller [J]", _mean_energy, "dissipates most, {0} J a roller", np.nanmax),
        ("largest frictional power [W]", _largest_power, "has the largest frictional power, {0} W", np.nanmax),
        ("lowest spin / pure rolling [–]", _lowest_spin, "slows most, to {0} of pure rolling", np.nanmin),
        ("loaded time outside film range [%]", _outside_range, "", np.nanmax),
    )
    sentences = [f"{status_sentence(results.values())} {len(results)} results are compared here."]
    pictures = []
    for label, take, words, extreme in quantities:
        values = np.array([[take(one, row) for row in rows] for one in results.values()])
        if not np.isfinite(values).any():
            continue
        pictures.append(
            _picture(
                lambda axes, values=values, label=label: plot_by_result(axes, names, rows, values, label),
                f"By result and row: {label}",
            )
        )
        if words:
            place, row = np.argwhere(values == extreme(values))[0]
            sentences.append(f"The {rows[row]} row of {names[place]} {words.format(three_digits(values[place, row]))}.")
    return Opening(tuple(sentences), tuple(pictures))


def status_sentence(results: Any) -> str:
    """How many rollers of some datasets failed."""
    total = sum(int(one.status.size) for one in results)
    failed = sum(int((one.status != 0).sum()) for one in results)
    if failed:
        return f"{failed} of {total} rollers FAILED; every mean they enter is missing."
    return f"All {total} rollers completed."


def plot_by_result(axes: Axes, names: list[str], rows: list[str], values: np.ndarray, label: str) -> Axes:
    """A value of every result and row, over the results.

    Takes values over (result, row); one that is missing is left out.
    """
    places = np.arange(len(names))
    for k, row in enumerate(rows):
        style = {**ROW.get(row, {}), "linestyle": "none"}
        axes.plot(places + 0.16 * (k - 0.5), values[:, k], markersize=5, label=f"{row} row", **style)
    shown = [name if len(name) <= _NAME_LENGTH else f"{name[: _NAME_LENGTH - 1]}…" for name in names]
    upright = len(names) > 4 or sum(map(len, shown)) > 32
    axes.set_xticks(places, shown, rotation=90 if upright else 0)
    axes.set_xlim(-0.5, len(names) - 0.5)
    axes.set_ylim(0.0, 1.08 * max(float(np.nanmax(values, initial=0.0)), 1e-12))
    return finish(axes, "", label)


def _orbit_pictures(result: xr.Dataset, profile: Mapping[str, xr.Dataset]) -> list[Picture]:
    """Where on the orbit the row with more energy spends it, and the load zone of the row with more load."""
    total = result.energy.sum(("interface", "roller"))
    spends = str(total.row[int(np.argmax(total.values))].item())
    load = profile["load_zone"].roller_load
    carries = str(load.row[int(np.argmax(load.mean(("angle", "time")).values))].item())
    over_orbit = profile["orbit"].energy_over_orbit
    return [
        picture(
            lambda axes: draw.plot_energy_over_orbit(axes, over_orbit, spends),
            f"Polar plot of the energy of the {spends} row over the orbit, by interface",
            width=OPENING_WIDTH,
            height=1.15 * OPENING_HEIGHT,
            polar=True,
            legend="below",
        ),
        _picture(
            lambda axes: draw.plot_load_zone(axes, load, carries),
            f"Heat map of the roller load of the {carries} row over angle and time",
            legend="",
        ),
    ]


def _roller_pictures(result: xr.Dataset) -> list[Picture]:
    """Energy of every roller of the rows that dissipate any."""
    return [
        _picture(
            lambda axes, row=row: draw.plot_roller_spread(axes, result.energy, row),
            f"Energy of each roller of the {row} row over the mean of the row",
            legend="",
        )
        for row in result.row.values.tolist()
        if float(result.energy.sel(row=row).sum()) > 0.0
    ]


def _picture(plot: Callable[[Axes], object], words: str, legend: str = "above") -> Picture:
    return picture(plot, words, width=OPENING_WIDTH, height=OPENING_HEIGHT, legend=legend)


def _energies(result: xr.Dataset) -> str:
    words = []
    for row in result.row.values.tolist():
        one = result.energy.sel(row=row).mean("roller", skipna=False)
        total = float(one.sum("interface", skipna=False))
        if not np.isfinite(total):
            words.append(f"an unknown energy {row}")
            continue
        most = str(one.interface.values[int(np.argmax(one.values))])
        share = f" ({100.0 * float(one.max()) / total:.3g} % of it at {_at(most)})" if total > 0.0 else ""
        words.append(f"{three_digits(total)} J {row}{share}")
    if "window_end" not in result.attrs:
        return f"A roller dissipates {' and '.join(words)}."
    length = float(result.attrs["window_end"]) - float(result.attrs["window_start"])
    return f"In {length:.4g} s a roller dissipates {' and '.join(words)}."


def _peaks(result: xr.Dataset) -> str:
    peak = result.peak_power
    place = peak.where(peak == peak.max(), drop=True).isel(row=0, interface=0)
    interface = str(place.interface.item())
    samples = peak.max("interface")
    medians = [
        f"{three_digits(float(samples.sel(row=row).median()))} W {row}"
        for row in result.row.values.tolist()
        if bool(samples.sel(row=row).notnull().any())
    ]
    return (
        f"The largest frictional power is {three_digits(float(peak.max()))} W, at {_at(interface)} of a "
        f"roller of the {place.row.item()} row; the largest of an orbit is {' and '.join(medians)} in the median."
    )


def _spins(result: xr.Dataset) -> str:
    spins, loaded = [], []
    for row in result.row.values.tolist():
        lowest = float(result.min_spin_ratio.sel(row=row).min())
        spins.append(
            f"{three_digits(lowest)} of pure rolling {row}" if np.isfinite(lowest) else f"an unknown spin {row}"
        )
        if "roller_load" in result:
            load = result.roller_load.sel(row=row)
            loaded.append(f"{100.0 * float((load > 0.0).mean()):.3g} % {row}")
    share = f"; rollers carry load for {' and '.join(loaded)} of the time" if loaded else ""
    return f"The slowest rollers fall to {' and '.join(spins)}{share}."


def _sure(result: xr.Dataset) -> str:
    """What the numbers rest on: films outside their formula's range, and estimated values."""
    words = []
    if "outside_film_range" in result:
        share = 100.0 * result.outside_film_range.sel(interface=["inner", "outer"]).mean("roller").max("interface")
        parts = [f"{float(share.sel(row=row)):.3g} % {row}" for row in share.row.values if share.sel(row=row) >= 0.0]
        if parts:
            words.append(
                f"films of the raceways are outside their formula's range for {' and '.join(parts)} of the loaded time"
            )
    given = json.loads(result.attrs.get("input", "{}"))
    tags = [
        entry.get("tag")
        for part in ("bearing", "lubricant")
        for entry in given.get(part, {}).values()
        if isinstance(entry, dict)
    ]
    if tags:
        words.append(f"{tags.count('E')} of {len(tags)} values of bearing and lubricant are engineering estimates")
    return _sentence("; ".join(words)) if words else "What the numbers rest on is at the end of the page."


def _at(interface: str) -> str:
    return "the cage" if interface == "cage" else f"the {interface} raceway"


def _sentence(words: str) -> str:
    return f"{words[0].upper()}{words[1:]}."


def _mean_energy(result: xr.Dataset, row: str) -> float:
    return float(result.energy.sel(row=row).sum("interface", skipna=False).mean("roller", skipna=False))


def _largest_power(result: xr.Dataset, row: str) -> float:
    peak = result.get("peak_power", result.get("peak_power_max"))
    return float(peak.sel(row=row).max()) if peak is not None and peak.size else np.nan


def _lowest_spin(result: xr.Dataset, row: str) -> float:
    return float(result.min_spin_ratio.sel(row=row).min()) if "min_spin_ratio" in result else np.nan


def _outside_range(result: xr.Dataset, row: str) -> float:
    return 100.0 * float(result.outside_film_range.sel(row=row).max()) if "outside_film_range" in result else np.nan
