"""Maps of the raceways: energy dissipated over angle and station along the roller.

The maps belong to the bearing, not to a roller: what all simulated rollers of a row leave at a
place of the raceway. The outer raceway is at rest, so its angle is φ; the inner one turns, and its
angle is counted on the ring, from where +X0 was at the first sample. Energies are stored, in J, so
that sums over a map are the energies of `simulate`; over `cell_area` they are energies per area.
How often each sector was passed is stored beside them (`surface_passes`).
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import xarray as xr

from macroslip.bearing import geometry
from macroslip.bearing.geometry import AXIAL_SIGNS, row_names
from macroslip.bearing.kinds import AnyBearing
from macroslip.constants import SECTORS
from macroslip.errors import InputError
from macroslip.kinds import kind_of
from macroslip.measures.along import FILM_EDGES, SLIP_EDGES, STATIONS
from macroslip.measures.details import Details
from macroslip.measures.maps import FILM_REGIMES, SLIP_SIGNS
from macroslip.variables import described


def values(records: list[list[Details]], failed: np.ndarray) -> dict[str, np.ndarray]:
    """Maps of the rows; NaN for a row with a roller that failed, whose part is missing."""

    def total(name: str) -> np.ndarray:
        sums = [sum(getattr(record, name) for record in row) for row in records]
        return np.array(sums, dtype=float)

    density = []
    for row in records:
        densities = [record.surface_density for record in row]
        density.append(np.max(densities, axis=0))
    weighted_load = total("working_load")
    classes = total("film_slip")
    with np.errstate(invalid="ignore", divide="ignore"):
        load = weighted_load[..., 0] / weighted_load[..., 1]
    maps = {
        "surface_energy": total("surface_energy"),
        "surface_power_density": np.array(density),
        "surface_asperity_energy": total("surface_asperities"),
        "surface_work": total("surface_work"),
        "surface_passes": total("surface_passes"),
        "working_load": load,
        "film_slip_time": classes[..., 0],
        "film_slip_passes": classes[..., 1],
    }
    for row in np.flatnonzero(failed.any(axis=1)):
        for of_rows in maps.values():
            of_rows[row] = np.nan
    return maps


def coordinates(bearing: AnyBearing) -> dict[str, Any]:
    """Angles, areas of the cells, and names of the parts of the energy."""
    sector = 2.0 * math.pi / SECTORS
    angle = (np.arange(SECTORS) + 0.5) * sector
    about = described(
        "rad", "angle on the raceway, outer: from +X0 to +Y0, inner: the same on the ring"
    )
    # The radius of a place from the bearing's axis changes along the roller.
    edges = np.linspace(-0.5, 0.5, STATIONS + 1) * bearing.roller_length
    middles = 0.5 * (edges[1:] + edges[:-1])
    width = bearing.roller_length / STATIONS
    inner_radius = geometry.inner_contact_radius(bearing)
    outer_radius = geometry.outer_contact_radius(bearing)
    kind = kind_of(bearing)
    areas = []
    for row in row_names(bearing):
        sign = AXIAL_SIGNS[row]
        radii = (
            kind.raceway_radii(bearing, sign, radius, middles)
            for radius in (inner_radius, outer_radius)
        )
        areas.append([along * sector * width for along in radii])
    area = described("m2", "area of a place of the raceway")
    return {
        "angle": ("angle", angle, about),
        "slip_sign": list(SLIP_SIGNS),
        "film_regime": list(FILM_REGIMES),
        "film_class": _classes(FILM_EDGES),
        "slip_class": _classes(SLIP_EDGES),
        "cell_area": (("row", "raceway", "station"), np.array(areas), area),
    }


def _classes(edges: tuple[float, ...]) -> list[str]:
    return [
        f"below {edges[0]:g}",
        *(f"{a:g} to {b:g}" for a, b in itertools.pairwise(edges)),
        f"{edges[-1]:g} and above",
    ]


def even_energy(result: xr.Dataset) -> xr.DataArray:
    """Frictional energy of the maps as if all sectors had been passed equally often [J].

    A few rollers, or a window of no whole number of orbits, pass some sectors of a raceway more
    often than others. The energy per pass of a sector keeps its place; the sum over each raceway
    keeps its value. A sector without passes has none.

    Parameters
    ----------
    result : xarray.Dataset
        With `surface_energy` and `surface_passes`; without the latter the energy is returned as it
        is.

    Returns
    -------
    xarray.DataArray
        Over row, raceway, angle, station, slip_sign and film_regime.
    """
    energy = result.surface_energy
    if "surface_passes" not in result:
        return energy
    passes = result.surface_passes
    per_pass = xr.where(passes > 0.0, energy / passes, 0.0 * energy)
    over_raceway = ("angle", "station", "slip_sign", "film_regime")
    total = per_pass.sum(over_raceway, skipna=False)
    whole = energy.sum(over_raceway, skipna=False)
    scale = whole / total.where(total != 0.0, 1.0)
    return (per_pass * scale).transpose(*energy.dims)


def energy_density(result: xr.Dataset) -> xr.DataArray:
    """Frictional energy per area, e = ∫|τ v| dt [J/m²], over row, raceway, angle and station.

    Of a result with maps, InputError without, or from `macroslip.study.lifetime.weighted_maps`; all
    sectors count as passed equally often (`even_energy`).
    """
    _require_maps(result)
    energy = even_energy(result).sum(("slip_sign", "film_regime"), skipna=False)
    density = energy / result.cell_area
    return density.assign_attrs(units="J/m2", long_name="frictional energy per area of the raceway")


def roller_energy_density(result: xr.Dataset, bearing: AnyBearing) -> xr.DataArray:
    """Frictional energy per area of a roller along its axis [J/m²], of both raceways.

    Over row, station, slip_sign and film_regime; mean over the simulated rollers. InputError if the
    result has no maps.
    """
    _require_maps(result)
    circumference = 2.0 * math.pi * geometry.roller_radius(bearing)
    area = circumference * bearing.roller_length / STATIONS
    of_rollers = result.surface_energy.sum(("raceway", "angle"), skipna=False)
    energy = of_rollers / result.sizes["roller"]
    density = energy / area
    about = "frictional energy per area of the roller"
    return density.assign_attrs(units="J/m2", long_name=about)


def share_above(density: xr.DataArray, area: xr.DataArray, threshold: float) -> xr.DataArray:
    """Share of a raceway's area, over row and raceway, on which a map exceeds a threshold.

    Of `surface_power_density` or `energy_density`, over angle and station, with `cell_area` and a
    threshold in the unit of the map [W/m² or J/m²]. None is built in: no threshold of damage by
    frictional power or energy per area could be traced to a primary source.
    """
    weight = (area + 0.0 * density).where(density.notnull())
    above = weight.where(density > threshold, 0.0)
    over_raceway = ("angle", "station")
    share = above.sum(over_raceway) / weight.sum(over_raceway)
    return share.rename("share_above")


def _require_maps(result: xr.Dataset) -> None:
    if "surface_energy" not in result:
        allowed = "results of contacts with microslip or asperities"
        remedy = "Write laws: {model: physical} and contact_details: true in the case."
        raise InputError("the result has no maps of the raceways", allowed=allowed, remedy=remedy)
