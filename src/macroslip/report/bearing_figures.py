"""The whole bearing: where on the orbit energy goes, films, the load zone over time, and how rollers differ.

Angles count from the bottom along the orbit; polar axes look downwind, so that rollers rise on the left.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.style import BLACK, GREY, INTERFACE, ROW, finish, log_ticks
from macroslip.report.wording import three_digits

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.projections.polar import PolarAxes

_ANGLE = "angle from the bottom, top at 180 [°]"


def plot_energy_over_orbit(axes: PolarAxes, energy: xr.DataArray, row: str) -> PolarAxes:
    """Energy per orbit and degree of a row at each interface, on polar axes that look downwind.

    Takes the array of `macroslip.result.orbit_profile.energy_over_orbit` [J/degree]; drawn in mJ/degree. An interface
    that never reaches a hundredth of the largest is left to the legend, which gives the energy per orbit of each.
    """
    one = energy.sel(row=row)
    width = 360.0 / one.sizes["angle"]
    theta = np.radians(np.concatenate([one.angle.values, one.angle.values[:1] + 360.0]))
    for interface in one.interface.values.tolist():
        values = 1e3 * one.sel(interface=interface).values
        label = f"{interface}: {three_digits(width * values.sum())} mJ per orbit"
        axes.plot(theta, np.append(values, values[0]), label=label, linewidth=1.6, **INTERFACE[interface])
    axes.set_theta_zero_location("S")
    axes.set_theta_direction(-1)
    axes.set_xticks(np.radians([0.0, 90.0, 180.0, 270.0]), ["bottom", "left", "top", "right"])
    axes.tick_params(axis="x", pad=1)
    axes.set_ylim(bottom=0.0)
    axes.tick_params(labelsize=9)
    axes.set_rlabel_position(45.0)
    largest = float(axes.get_ylim()[1])
    ticks = [largest * part for part in (0.25, 0.5, 0.75)]
    axes.set_yticks(ticks, [f"{value:.2g}" for value in ticks])
    axes.set_title(f"{row} row [mJ/°]", fontsize=10, loc="left", pad=12)
    return axes


def plot_film_over_orbit(axes: Axes, orbit: xr.Dataset, row: str) -> Axes:
    """Median film thickness of a row at each interface over the orbit, with the range of 5 to 95 %.

    Takes `film_thickness` [m] and `film_parameter` [1] over (row, interface, quantile, angle). The right axis shows the
    film parameter Λ, film thickness over composite roughness.
    """
    from matplotlib.ticker import LogLocator, NullFormatter

    one = orbit.film_thickness.sel(row=row)
    for interface in one.interface.values.tolist():
        values = 1e6 * one.sel(interface=interface)
        style = INTERFACE[interface]
        axes.fill_between(
            one.angle.values,
            values.isel(quantile=0),
            values.isel(quantile=-1),
            color=style["color"],
            alpha=0.18,
            linewidth=0.0,
        )
        axes.plot(one.angle.values, values.isel(quantile=1), label=interface, linewidth=1.6, **style)
    log_ticks(axes)
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks([0, 90, 180, 270, 360])
    per_micrometre = 1e-6 * float((orbit.film_parameter / orbit.film_thickness).median())
    there_and_back = (lambda h: np.multiply(h, per_micrometre), lambda x: np.divide(x, per_micrometre))
    right = axes.secondary_yaxis("right", functions=there_and_back)
    right.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    right.yaxis.set_major_formatter("{x:g}")
    right.yaxis.set_minor_formatter(NullFormatter())
    right.set_ylabel("film parameter Λ [–]")
    right.tick_params(labelsize=9)
    return finish(axes, _ANGLE, "film thickness [µm]", f"{row} row")


def plot_load_zone(axes: Axes, load: xr.DataArray, row: str) -> Axes:
    """Roller load of a row over angle and time as a heat map, darkest where there is no load, with the row's own scale.

    Takes the array of `macroslip.result.orbit_profile.load_zone` [N].
    """
    one = load.sel(row=row)
    largest = max(float(one.max()), 1.0)
    image = axes.imshow(
        1e-3 * one.values.T,
        origin="lower",
        aspect="auto",
        cmap="cividis",
        vmin=0.0,
        vmax=1e-3 * largest,
        extent=(float(one.time[0]), float(one.time[-1]), 0.0, 360.0),
        interpolation="nearest",
        rasterized=True,
    )
    axes.set_yticks([0, 90, 180, 270, 360])
    scale = axes.figure.colorbar(image, ax=axes, pad=0.02)
    scale.set_label("roller load [kN]")
    scale.ax.tick_params(labelsize=9)
    finish(axes, "time [s]", "angle from the bottom [°]", f"{row} row")
    axes.spines[["top", "right"]].set_visible(True)
    return axes


def plot_roller_spread(axes: Axes, energy: xr.DataArray, row: str) -> Axes:
    """Energy of every roller of a row over the mean of the row, by the number of the roller.

    Takes `energy` [J] of a result, over (row, roller, interface).
    """
    total = energy.sel(row=row).sum("interface", skipna=False)
    mean = float(total.mean())
    axes.axhline(1.0, color=GREY, linewidth=0.8)
    numbers = total.roller.values
    axes.plot(numbers, total.values / mean, markersize=5, **{**ROW[row], "linestyle": "none"})
    axes.set_xticks(numbers[:: max(1, numbers.size // 7)])
    axes.margins(y=0.25)
    axes.ticklabel_format(axis="y", useOffset=False)
    return finish(
        axes, "number of the roller [–]", "energy / mean of the row [–]", f"{row} row, mean {three_digits(mean)} J"
    )


def plot_outside_film_range(axes: Axes, share: xr.DataArray) -> Axes:
    """Share of loaded time outside the film formula's range, at each interface of both rows.

    Takes `outside_film_range` of a result [–]; bars are means over the rollers, whiskers smallest and largest.
    """
    rows = share.row.values.tolist()
    width = 0.8 / len(rows)
    places = np.arange(share.sizes["interface"])
    for k, row in enumerate(rows):
        one = share.sel(row=row)
        x = places + width * (k - 0.5 * (len(rows) - 1))
        # An interface that never carries load has no share.
        known = one.notnull().any("roller").values
        one = 1e2 * one.isel(interface=known)
        mean, low, high = (getattr(one, name)("roller").values for name in ("mean", "min", "max"))
        hatch = {"hatch": "///"} if k else {}
        axes.bar(x[known], mean, 0.9 * width, color=ROW[row]["color"], edgecolor="white", label=f"{row} row", **hatch)
        axes.errorbar(x[known], mean, yerr=[mean - low, high - mean], color=BLACK, linestyle="none", capsize=3)
        for place, value in zip(x[known], mean, strict=True):
            axes.annotate(
                f"{value:.3g}",
                (place, max(value, 0.0)),
                xytext=(0, 5),
                textcoords="offset points",
                ha="center",
                fontsize=9,
            )
    axes.set_xticks(places, share.interface.values.tolist())
    axes.set_ylim(0.0, 118.0)
    return finish(axes, "interface", "share of loaded time [%]")


def plot_energy_by_interface(axes: Axes, energy: xr.DataArray, title: str = "") -> Axes:
    """Energy of a mean roller of each row, stacked by interface, on a logarithmic axis of one bar an interface.

    Takes `energy` [J] of a result, over (row, roller, interface).
    """
    rows = energy.row.values.tolist()
    places = np.arange(energy.sizes["interface"])
    width = 0.8 / len(rows)
    for k, row in enumerate(rows):
        values = energy.sel(row=row).mean("roller").values
        x = places + width * (k - 0.5 * (len(rows) - 1))
        hatch = {"hatch": "///"} if k else {}
        axes.bar(x, values, 0.9 * width, color=ROW[row]["color"], edgecolor="white", label=f"{row} row", **hatch)
        for place, value in zip(x, values, strict=True):
            if value > 0.0:
                axes.annotate(
                    three_digits(value),
                    (place, value),
                    xytext=(0, 2),
                    textcoords="offset points",
                    ha="center",
                    fontsize=9,
                )
    if np.nanmax(energy.values, initial=0.0) > 0.0:
        axes.set_yscale("log")
        axes.margins(y=0.12)
    axes.set_xticks(places, energy.interface.values.tolist())
    axes.set_xlim(-0.6, places.size - 0.4)
    return finish(axes, "interface", "energy of a roller [J]", title)


def plot_peak_exceedance(axes: Axes, result: xr.Dataset) -> Axes:
    """Share of (roller, orbit) samples whose P_max exceeds a power, for both rows.

    Takes a result with complete orbits; samples of failed rollers are left out.
    """
    for row in result.row.values.tolist():
        peak = np.sort(result.peak_power.sel(row=row).max("interface", skipna=False).values.ravel())
        peak = peak[np.isfinite(peak)]
        if peak.size:
            style = {key: ROW[row][key] for key in ("color", "linestyle")}
            share = 1.0 - np.arange(peak.size) / peak.size
            axes.step(
                np.concatenate([[0.5 * peak[0]], peak]),
                np.concatenate([[1.0], share]),
                where="pre",
                label=f"{row} row",
                linewidth=1.6,
                **style,
            )
    axes.set_xscale("log")
    axes.set_yscale("log")
    return finish(axes, r"$P_\mathrm{max}$ of an orbit [W]", "share of orbits above [–]")


def plot_case_energies(axes: Axes, study: xr.Dataset) -> Axes:
    """Energy of each case of a study, mean over the rollers of both rows, with the range of the rollers.

    Takes a dataset with `energy` [J] over (case, row, roller, interface).
    """
    total = study.energy.sum("interface", skipna=False)
    places = np.arange(study.sizes["case"])
    for k, row in enumerate(study.row.values.tolist()):
        one = total.sel(row=row)
        mean = one.mean("roller", skipna=False).values
        bars = [mean - one.min("roller").values, one.max("roller").values - mean]
        axes.errorbar(
            places + 0.16 * (k - 0.5),
            mean,
            yerr=bars,
            linewidth=0.0,
            elinewidth=1.0,
            capsize=2.5,
            markersize=5,
            label=f"{row} row",
            color=ROW[row]["color"],
            marker=ROW[row]["marker"],
        )
    axes.set_xticks(places, [str(name) for name in study.case.values], rotation=90 if study.sizes["case"] > 8 else 0)
    axes.set_ylim(0.0, 1.08 * max(axes.get_ylim()[1], 1e-12))
    return finish(axes, "case", "energy of a roller [J]")


def plot_by_mechanism(axes: Axes, energy: xr.DataArray) -> Axes:
    """Energy of a mean roller of each row by mechanism.

    Takes an energy [J] over mechanism, row and anything else, which is averaged over rollers and cases and summed over
    the rest.
    """
    mean = energy.mean([name for name in ("roller", "case", "orbit") if name in energy.dims])
    mean = mean.sum([name for name in mean.dims if name not in ("row", "mechanism")])
    places = np.arange(mean.sizes["mechanism"])
    rows = mean.row.values.tolist()
    width = 0.8 / len(rows)
    for k, row in enumerate(rows):
        hatch = {"hatch": "///"} if k else {}
        axes.barh(
            places + width * k,
            mean.sel(row=row).values,
            0.9 * width,
            color=ROW[row]["color"],
            edgecolor="white",
            label=f"{row} row",
            **hatch,
        )
    axes.set_yticks(places + 0.5 * width * (len(rows) - 1), [str(name) for name in mean.mechanism.values])
    return finish(axes, f"energy of a roller [{energy.attrs.get('units', 'J')}]", "mechanism")


def plot_over_station(axes: Axes, values: xr.DataArray, title: str = "") -> Axes:
    """A quantity along the roller, mean over rollers and cases, summed over mechanisms and raceways, a line a row.

    Takes values over station and row.
    """
    mean = values.mean([name for name in ("roller", "case", "orbit", "time") if name in values.dims])
    mean = mean.sum([name for name in mean.dims if name not in ("row", "station")])
    for row in mean.row.values.tolist():
        axes.plot(mean.station.values, mean.sel(row=row).values, markersize=4, label=f"{row} row", **ROW[row])
    units = mean.station.attrs.get("units", "m")
    name = f"{values.name} [{values.attrs.get('units', '–')}]"
    return finish(axes, f"station along the roller [{units}]", name, title)
