"""Figures of the whole bearing and of the sensitivity, put together from the plot functions; each returns a Figure."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from macroslip.report import bearing_figures as draw
from macroslip.report.style import legend_above, new_figure
from macroslip.reproduction.sensitivity_figures import plot_tornado

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def energy_over_orbit_figure(profile: Mapping[str, xr.Dataset]) -> Figure:
    """Where on the orbit both rows dissipate, by interface. Takes what `orbit_profile` gives."""
    energy = profile["orbit"].energy_over_orbit
    figure, axes = new_figure(7.2, 4.2, 1, energy.sizes["row"], subplot_kw={"projection": "polar"})
    for one, row in zip(axes, energy.row.values.tolist(), strict=True):
        draw.plot_energy_over_orbit(one, energy, row)
        one.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), frameon=False, fontsize=9)
    return figure


def film_over_orbit_figure(profile: Mapping[str, xr.Dataset]) -> Figure:
    """Film thickness and Λ over the orbit of both rows."""
    orbit = profile["orbit"]
    figure, axes = new_figure(8.4, 3.6, 1, orbit.sizes["row"])
    for one, row in zip(axes, orbit.row.values.tolist(), strict=True):
        draw.plot_film_over_orbit(one, orbit, row)
    legend_above(figure, axes[0])
    return figure


def load_zone_figure(profile: Mapping[str, xr.Dataset]) -> Figure:
    """Load of the rollers over angle and time, a row above the other, each with its own scale."""
    load = profile["load_zone"].roller_load
    figure, axes = new_figure(7.2, 5.4, load.sizes["row"], 1, sharex=True)
    for one, row in zip(axes, load.row.values.tolist(), strict=True):
        draw.plot_load_zone(one, load, row)
    return figure


def roller_spread_figure(profile: Mapping[str, xr.Dataset]) -> Figure:
    """Energy of every roller over the mean of its row."""
    energy = profile["result"].energy
    figure, axes = new_figure(7.2, 3.2, 1, energy.sizes["row"])
    for one, row in zip(axes, energy.row.values.tolist(), strict=True):
        draw.plot_roller_spread(one, energy, row)
    return figure


def outside_film_range_figure(profile: Mapping[str, xr.Dataset]) -> Figure:
    """Share of loaded time outside the film formula's range."""
    figure, axes = new_figure(4.8, 3.4)
    draw.plot_outside_film_range(axes[0], profile["result"].outside_film_range)
    legend_above(figure, axes[0])
    return figure


def sensitivity_figure(table: xr.Dataset) -> Figure:
    """Tornado charts of energy and peak power for both rows."""
    rows = table.row.values.tolist()
    figure, axes = new_figure(9.0, 5.4, 2, len(rows))
    jobs = [(quantity, row) for quantity in ("energy", "peak_power") for row in rows]
    for one, (quantity, row) in zip(axes, jobs, strict=True):
        plot_tornado(one, table, quantity, row)
    return figure
