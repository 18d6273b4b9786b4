"""Where the surface suffers: maps of frictional energy and power per area on the raceways, and along the roller."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.errors import InputError
from macroslip.report.page import Block, Paragraph, Pictures
from macroslip.report.pictures import picture
from macroslip.report.style import BLACK, BLUE, ORANGE, finish
from macroslip.result.run_input import run_input
from macroslip.result.surface_maps import energy_density, roller_energy_density
from macroslip.study.surface import weighted_maps

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from macroslip.study.weights import Weights

_PER_SQUARE_MILLIMETRE = 1e-6
_SPLIT = ("slip_sign", "film_regime")
_PARTS = {
    "slip < 0": ({"slip_sign": "negative"}, BLUE, "--"),
    "slip > 0": ({"slip_sign": "positive"}, ORANGE, "-."),
    "Λ < 1": ({"film_regime": "below 1"}, "#009E73", ":"),
}


def surface_blocks(result: xr.Dataset) -> tuple[Block, ...]:
    """Maps of a result; nothing where it has none.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`.
    """
    if "surface_energy" not in result:
        return ()
    bearing = run_input(result).bearing
    count = f"{result.sizes['roller']} of {bearing.rollers_per_row} rollers of each row"
    along = roller_energy_density(result, bearing)
    return (
        *map_blocks(energy_density(result), result.surface_power_density, f"of {count}"),
        Pictures(
            tuple(
                picture(
                    lambda axes, row=row: plot_along_roller(axes, along.sel(row=row), f"{row} row"),
                    f"Energy per area along the rollers of the {row} row, by sign of slip and film ratio",
                    legend="above",
                )
                for row in _rows(along)
            ),
            "Energy per area of a roller along its axis, both raceway contacts, mean over its circumference and the "
            f"simulated rollers; split by the sign of slip, and the part in films with Λ < 1: {_parts(along)}.",
        ),
    )


def lifetime_blocks(study: xr.Dataset, weights: Weights, years: float) -> tuple[Block, ...]:
    """Maps of a study over a lifetime, weighted by wind speed, of its first group; nothing where its cases have none."""
    if "surface_energy" not in study:
        return ()
    try:
        maps = weighted_maps(study, weights, years=years).isel(group=0)
    except InputError as problem:
        return (Paragraph(f"There are no maps over the lifetime: {problem}"),)
    labels = ", ".join(str(maps[name].item()) for name in ("bearing", "lubricant", "model") if name in maps.coords)
    of = f"in {years:g} years, of the simulated rollers, {labels}"
    note = Paragraph("Where the inner ring is when a case begins is by chance, so its maps are spread over the angle.")
    return (note, *map_blocks(energy_density(maps), maps.surface_power_density, of))


def map_blocks(energy: xr.DataArray, density: xr.DataArray, of: str) -> tuple[Block, ...]:
    """Maps of energy per area [J/m²] and largest power per area [W/m²] of every raceway."""
    found: list[Block] = [
        Paragraph(
            "Looking along the shaft, angles count from the bottom along the orbit. The outer raceway is at rest. The "
            "inner one turns; its angle is counted on the ring, from the place that was at the bottom at the first "
            "sample. Rolling friction is dissipated in the oil and is no part of the maps. No threshold of damage is "
            "marked, since none can be traced to a primary source."
        )
    ]
    for values, units, words in (
        (energy, "J/mm²", f"Frictional energy per area e = ∫|τ v| dt {of}"),
        (density, "W/mm²", f"Largest frictional power per area p = |τ v|, mean over the contact's width, {of}"),
    ):
        pictures = tuple(
            picture(
                lambda axes, one=one, title=title, units=units: plot_map(axes, one, units, title),
                f"Map of the {title}, {units}",
                width=4.4,
                height=3.0,
            )
            for title, one in raceways(values).items()
        )
        largest = _largest(_PER_SQUARE_MILLIMETRE * values)
        found.append(Pictures(pictures, f"{words}. Each map has its own scale: {largest} {units}."))
    return tuple(found)


def raceways(values: xr.DataArray) -> dict[str, xr.DataArray]:
    """The maps of every raceway by what it is called; from values per m² to values per mm²."""
    return {
        f"{row} row, {raceway} raceway": _PER_SQUARE_MILLIMETRE * values.sel(row=row, raceway=raceway)
        for row in _rows(values)
        for raceway in ("outer", "inner")
    }


def plot_map(axes: Axes, values: xr.DataArray, units: str, title: str) -> Axes:
    """A raceway unrolled: place along the roller over the angle from the bottom, one map over (angle, station)."""
    degrees = np.degrees(values.angle.values)
    # Angles count from +X0, which is a quarter of a turn past the bottom; the bottom is in the middle of the map.
    order = np.argsort((degrees + 270.0) % 360.0)
    picture_values = values.transpose("station", "angle").values[:, order]
    half = 0.5 * (values.station.values[1] - values.station.values[0])
    ends = 1e3 * (values.station.values[0] - half), 1e3 * (values.station.values[-1] + half)
    image = axes.imshow(
        picture_values,
        origin="lower",
        aspect="auto",
        cmap="cividis",
        vmin=0.0,
        vmax=max(float(np.nanmax(picture_values, initial=0.0)), 1e-30),
        extent=(-180.0, 180.0, *ends),
        interpolation="nearest",
        rasterized=True,
    )
    axes.set_xticks([-180, -90, 0, 90, 180])
    scale = axes.figure.colorbar(image, ax=axes, pad=0.02)
    scale.set_label(units)
    scale.ax.tick_params(labelsize=9)
    finish(axes, "angle from the bottom [°]", "place along the roller [mm]", title)
    axes.spines[["top", "right"]].set_visible(True)
    return axes


def plot_along_roller(axes: Axes, density: xr.DataArray, title: str) -> Axes:
    """Energy per area along a roller: all of it, by the sign of slip, and in thin films."""
    place = 1e3 * density.station.values
    total = _PER_SQUARE_MILLIMETRE * density.sum(_SPLIT).values
    axes.plot(place, total, color=BLACK, label="all", linewidth=1.8)
    for name, (part, colour, style) in _PARTS.items():
        one = density.sel(part)
        values = _PER_SQUARE_MILLIMETRE * one.sum([dim for dim in _SPLIT if dim in one.dims]).values
        axes.plot(place, values, color=colour, linestyle=style, label=name, linewidth=1.5)
    axes.set_ylim(bottom=0.0)
    return finish(axes, "place along the roller [mm]", "energy per area [J/mm²]", title)


def _rows(values: xr.DataArray) -> list[str]:
    return values.row.values.tolist()


def _largest(values: xr.DataArray) -> str:
    return ", ".join(
        f"{row} {raceway} up to {float(values.sel(row=row, raceway=raceway).max()):.3g}"
        for row in _rows(values)
        for raceway in ("outer", "inner")
    )


def _parts(density: xr.DataArray) -> str:
    words = []
    for row in _rows(density):
        one = density.sel(row=row)
        total = float(one.sum())
        if total > 0.0:
            negative = float(one.sel(slip_sign="negative").sum()) / total
            thin = float(one.sel(film_regime="below 1").sum()) / total
            words.append(f"{row} row {100 * negative:.3g} % with slip < 0, {100 * thin:.3g} % with Λ < 1")
    return "; ".join(words) or "no energy"
