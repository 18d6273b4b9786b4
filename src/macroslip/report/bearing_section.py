"""All rollers of a result: the moving bearing, where energy goes, films, load zone and spread."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report import bearing_figures as draw
from macroslip.report.bearing_view import scene_data
from macroslip.report.page import Block, Paragraph, Pictures, Section, View
from macroslip.report.pictures import picture
from macroslip.result.run_input import run_input

if TYPE_CHECKING:
    import xarray as xr


def view_section(profiles: Mapping[str, Mapping[str, xr.Dataset]]) -> Section:
    """The moving bearing, with what `orbit_profile` gives by title."""
    scenes = {
        title: scene_data(profile["scene"], run_input(profile["result"]).bearing) for title, profile in profiles.items()
    }
    first = next(iter(profiles.values()))["scene"]
    return Section(
        "bearing",
        "The bearing in motion",
        (
            Paragraph(
                f"Both rows to scale, {float(first.time[0]):.4g} s to {float(first.time[-1]):.4g} s: the part around "
                f"the largest power that the samples caught. {_travel(profiles)} Values are those of the instant; a power "
                "that lasts for milliseconds falls between the samples. Point at a "
                "roller for its values, choose one to see its traces, and drag in a trace to move in time."
            ),
            View(scenes),
        ),
    )


def _travel(profiles: Mapping[str, Mapping[str, xr.Dataset]]) -> str:
    """How the rollers of the scenes travel."""
    if not any("pocket_offset" in profile["scene"] for profile in profiles.values()):
        return "Rollers travel at the speed of pure rolling."
    return (
        "Where orbit and spin were computed together, rollers are drawn between the spars of their pockets, their way in "
        "them enlarged; a red dot is the force of a spar, larger by a step for each decade. Others travel at the speed of "
        "pure rolling."
    )


def orbit_blocks(profile: Mapping[str, xr.Dataset], of: str = "") -> tuple[Block, ...]:
    """Energy over the orbit, load zone, films: pictures with what they show in numbers.

    Parameters
    ----------
    profile : mapping
        From `orbit_profile`.
    of : str
        Added to the captions where a page shows several.
    """
    orbit, load = profile["orbit"], profile["load_zone"].roller_load
    rows = orbit.row.values.tolist()
    energy = orbit.energy_over_orbit
    attributes = energy.attrs
    polar = tuple(
        picture(
            lambda axes, row=row: draw.plot_energy_over_orbit(axes, energy, row),
            f"Polar plot of the energy of the {row} row over the orbit, by interface",
            width=3.9,
            height=4.4,
            polar=True,
            legend="below",
        )
        for row in rows
    )
    zones = tuple(
        picture(
            lambda axes, row=row: draw.plot_load_zone(axes, load, row),
            f"Heat map of the roller load of the {row} row over angle and time",
            width=4.4,
            height=2.9,
        )
        for row in rows
    )
    films = tuple(
        picture(
            lambda axes, row=row: draw.plot_film_over_orbit(axes, orbit, row),
            f"Film thickness and film parameter of the {row} row over the orbit, by interface",
            legend="above",
        )
        for row in rows
    )
    return (
        Pictures(
            polar,
            f"Where on the orbit energy is dissipated{of}, looking downwind: mean over the rollers of the row and "
            f"{attributes['orbits']:.0f} orbits, in sectors of {360 / orbit.sizes['angle']:g}°. From samples of the "
            f"traces, whose energy is {attributes['energy_ratio']:.4f} times that of the integrator.",
        ),
        Pictures(
            zones,
            f"Load of the rollers over angle and time{of}. Each row has its own scale: {_largest(load)}.",
        ),
        Pictures(
            films,
            f"Film thickness and Λ over the orbit{of}: median over rollers and time, shaded from 5 to 95 %. "
            f"{_least(orbit)} Outside its range (below) the formula is used all the same.",
        ),
    )


def result_blocks(result: xr.Dataset, of: str = "") -> tuple[Block, ...]:
    """What a result shows without traces: energy by interface, spread between rollers, peaks, film range.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    of : str
        Added to the captions where a page shows several.
    """
    rows = result.row.values.tolist()
    total = result.energy.sum("interface", skipna=False)
    spread = [(row, total.sel(row=row).dropna("roller")) for row in rows]
    known = [
        f"{row} {float(one.min()):.4g} to {float(one.max()):.4g} J "
        f"({100 * float(one.max() / one.min() - 1):.2g} % apart)"
        for row, one in spread
        if one.size and float(one.min()) > 0.0
    ]
    blocks: list[Block] = [
        Pictures(
            (
                picture(
                    lambda axes: draw.plot_energy_by_interface(axes, result.energy),
                    "Bars of a mean roller's energy by interface and row",
                    legend="above",
                ),
                *(
                    picture(
                        lambda axes, row=row: draw.plot_roller_spread(axes, result.energy, row),
                        f"Energy of each roller of the {row} row over the mean of the row",
                    )
                    for row, one in spread
                    if one.size and float(one.mean()) > 0.0
                ),
            ),
            f"Energy{of} by interface, and of each roller over the mean of its row; from the least to the most: "
            f"{'; '.join(known) or 'none'}.",
        )
    ]
    pictures = [
        picture(
            lambda axes: draw.plot_outside_film_range(axes, result.outside_film_range),
            "Bars of the share of loaded time outside the film formula's range",
            legend="above",
        )
    ]
    caption = f"Share of the loaded time{of} in which load or speed is outside the range of the film formula"
    peak = result.peak_power.values
    if peak.size and np.nanmax(peak, initial=0.0) > 0.0:
        pictures.append(
            picture(
                lambda axes: draw.plot_peak_exceedance(axes, result),
                "Share of orbits whose largest power exceeds a value",
                legend="above",
            )
        )
        caption += "; and how many orbits of a roller have a largest power above a value"
    return (*blocks, Pictures(tuple(pictures), f"{caption}."))


def further_blocks(dataset: xr.Dataset, of: str = "") -> tuple[Block, ...]:
    """Energies by mechanism and by station along the roller, where the dataset has such dimensions."""
    pictures = []
    for name, values in dataset.data_vars.items():
        if "row" not in values.dims or "angle" in values.dims or values.attrs.get("units") not in ("J", "J/m"):
            continue
        if "mechanism" in values.dims and "station" not in values.dims:
            pictures.append(
                picture(
                    lambda axes, values=values: draw.plot_by_mechanism(axes, values),
                    f"Energy by mechanism and row, {name}",
                    legend="above",
                )
            )
        elif "station" in values.dims:
            pictures.append(
                picture(
                    lambda axes, values=values: draw.plot_over_station(axes, values),
                    f"Energy along the roller by row, {name}",
                    legend="above",
                )
            )
    if not pictures:
        return ()
    return (Pictures(tuple(pictures), f"Energy{of} by mechanism, and along the roller."),)


def _largest(load: xr.DataArray) -> str:
    return ", ".join(f"{row} up to {1e-3 * float(load.sel(row=row).max()):.3g} kN" for row in load.row.values.tolist())


def _least(orbit: xr.Dataset) -> str:
    middle = orbit.film_parameter.sel(quantile=0.5)
    words = []
    for row in orbit.row.values.tolist():
        for interface in ("inner", "outer"):
            values = middle.sel(row=row, interface=interface).values
            if np.isfinite(values).any():
                words.append(f"{row} {interface} {np.nanmin(values):.2g}")
    return f"Least median Λ: {', '.join(words)}." if words else ""
