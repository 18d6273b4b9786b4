"""All rollers of a result: the moving bearing, where energy goes, films, load zone and spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
        "every roller with its load, slip and power; needs JavaScript",
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


def roller_sections(
    result: xr.Dataset,
    profile: Mapping[str, xr.Dataset] | None = None,
    *,
    suffix: str = "",
    group: str = "",
    first: Sequence[Block] = (),
) -> list[Section]:
    """Sections on all rollers of a result: energy, power, load zone, films.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.simulate`.
    profile : mapping, optional
        From `orbit_profile`; without it what needs traces is left out.
    suffix : str
        Added to the names of the sections where a page shows several results.
    group : str
        What the sections belong to.
    first : sequence of Block
        Head the first section.
    """
    energy = (*first, *(_orbit_energy(profile) if profile else ()), *_energy(result), *further_blocks(result))
    found = [("energy", "Energy", energy, "where on the orbit and at which contact it is dissipated, roller by roller")]
    peaks = _peaks(result)
    if peaks:
        found.append(("power", "Peak power", peaks, "how often the largest power of an orbit exceeds a value"))
    if profile:
        found.append(("load-zone", "Load zone", _load_zone(profile), "load of the rollers over angle and time"))
    films = (*(_films(profile) if profile else ()), *_film_range(result))
    found.append(("films", "Films", films, "thickness over the orbit, and where the formula leaves its range"))
    return [Section(f"{name}{suffix}", title, blocks, gist, group) for name, title, blocks, gist in found]


def _orbit_energy(profile: Mapping[str, xr.Dataset]) -> tuple[Block, ...]:
    orbit = profile["orbit"]
    energy = orbit.energy_over_orbit
    polar = tuple(
        picture(
            lambda axes, row=row: draw.plot_energy_over_orbit(axes, energy, row),
            f"Polar plot of the energy of the {row} row over the orbit, by interface",
            width=3.9,
            height=4.4,
            polar=True,
            legend="below",
        )
        for row in orbit.row.values.tolist()
    )
    caption = (
        "Where on the orbit energy is dissipated, looking downwind: mean over the rollers of the row and "
        f"{energy.attrs['orbits']:.0f} orbits, in sectors of {360 / orbit.sizes['angle']:g}°. From samples of the "
        f"traces, whose energy is {energy.attrs['energy_ratio']:.4f} times that of the integrator."
    )
    return (Pictures(polar, caption),)


def _load_zone(profile: Mapping[str, xr.Dataset]) -> tuple[Block, ...]:
    load = profile["load_zone"].roller_load
    zones = tuple(
        picture(
            lambda axes, row=row: draw.plot_load_zone(axes, load, row),
            f"Heat map of the roller load of the {row} row over angle and time",
            width=4.4,
            height=2.9,
        )
        for row in load.row.values.tolist()
    )
    return (Pictures(zones, f"Load of the rollers over angle and time. Each row has its own scale: {_largest(load)}."),)


def _films(profile: Mapping[str, xr.Dataset]) -> tuple[Block, ...]:
    orbit = profile["orbit"]
    films = tuple(
        picture(
            lambda axes, row=row: draw.plot_film_over_orbit(axes, orbit, row),
            f"Film thickness and film parameter of the {row} row over the orbit, by interface",
            legend="above",
        )
        for row in orbit.row.values.tolist()
    )
    caption = (
        "Film thickness and Λ over the orbit: median over rollers and time, shaded from 5 to 95 %. "
        f"{_least(orbit)} Outside its range (below) the formula is used all the same."
    )
    return (Pictures(films, caption),)


def _energy(result: xr.Dataset) -> tuple[Block, ...]:
    """Energy by interface, and its spread between rollers."""
    total = result.energy.sum("interface", skipna=False)
    spread = [(row, total.sel(row=row).dropna("roller")) for row in result.row.values.tolist()]
    known = [
        f"{row} {float(one.min()):.4g} to {float(one.max()):.4g} J "
        f"({100 * float(one.max() / one.min() - 1):.2g} % apart)"
        for row, one in spread
        if one.size and float(one.min()) > 0.0
    ]
    by_interface = picture(
        lambda axes: draw.plot_energy_by_interface(axes, result.energy),
        "Bars of a mean roller's energy by interface and row",
        legend="above",
    )
    by_roller = tuple(
        picture(
            lambda axes, row=row: draw.plot_roller_spread(axes, result.energy, row),
            f"Energy of each roller of the {row} row over the mean of the row",
        )
        for row, one in spread
        if one.size and float(one.mean()) > 0.0
    )
    caption = (
        "Energy by interface, and of each roller over the mean of its row; from the least to the most: "
        f"{'; '.join(known) or 'none'}."
    )
    return (Pictures((by_interface, *by_roller), caption),)


def _peaks(result: xr.Dataset) -> tuple[Block, ...]:
    if np.nanmax(result.peak_power.values, initial=0.0) <= 0.0:
        return ()
    exceedance = picture(
        lambda axes: draw.plot_peak_exceedance(axes, result),
        "Share of orbits whose largest power exceeds a value",
        legend="above",
    )
    return (Pictures((exceedance,), "How many orbits of a roller have a largest power above a value."),)


def _film_range(result: xr.Dataset) -> tuple[Block, ...]:
    bars = picture(
        lambda axes: draw.plot_outside_film_range(axes, result.outside_film_range),
        "Bars of the share of loaded time outside the film formula's range",
        legend="above",
    )
    words = "Share of the loaded time in which load or speed is outside the range of the film formula."
    return (Pictures((bars,), words),)


def further_blocks(dataset: xr.Dataset) -> tuple[Block, ...]:
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
    return (Pictures(tuple(pictures), "Energy by mechanism, and along the roller."),)


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
