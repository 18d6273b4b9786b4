"""How thick films are on the way round, from a run's traces and its film law."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from macroslip.bearing import geometry
from macroslip.contact.laws import LOWEST_ENTRAINMENT_SPEED
from macroslip.result.orbit_position import in_window, position
from macroslip.result.run_input import run_input
from macroslip.roller.model import RollerModel

if TYPE_CHECKING:
    import xarray as xr

#: Most samples of time for which films are computed.
_FILM_SAMPLES = 2400


def films(result: xr.Dataset) -> xr.Dataset:
    """Film thickness, film parameter and whether the formula is in its range, at times of the traces in the window.

    Parameters
    ----------
    result : xarray.Dataset
        With traces from the first sample of the loads on.

    Returns
    -------
    xarray.Dataset
        Over (row, roller, time, interface): film_thickness [m] by the film law of the case; film_parameter Λ [1], film
        thickness over composite roughness; in_range [1] whether W and U are in the range of the formula; and angle
        [degrees] over (row, roller, time). NaN for an interface that carries no load, and after a failure.
    """
    import xarray as xr

    angles = position(result)
    window = in_window(result)
    window = window.isel(time=slice(None, None, max(1, math.ceil(window.sizes["time"] / _FILM_SAMPLES))))
    angle = angles.sel(time=window.time)
    given = run_input(result)
    bearing, models = given.bearing, given.models
    load = np.empty((*angle.shape, result.sizes["interface"]))
    radius = geometry.roller_radius(bearing)
    for r, row in enumerate(window.row.values.tolist()):
        load[r, ..., :2] = _raceway_loads(models[row], window.isel(row=r), angle.values[r])
        load[r, ..., 2] = np.abs(window.cage_force.values[r])
    surface = radius * window.spin.values
    ring = radius * window.spin_pure.values
    speed = np.stack([0.5 * np.abs(ring + surface)] * 2 + [0.5 * np.abs(surface)], axis=-1)
    speed = np.maximum(speed, LOWEST_ENTRAINMENT_SPEED)
    thickness, inside = np.full(load.shape, np.nan), np.full(load.shape, np.nan)
    model = next(iter(models.values()))
    for i, contact in enumerate(model.laws):
        here = (load[..., i] > 0.0) & np.isfinite(speed[..., i])
        thickness[..., i][here] = contact.film_thickness(load[..., i][here], speed[..., i][here])
        inside[..., i][here] = contact.film_in_range(load[..., i][here], speed[..., i][here])
    dims = ("row", "roller", "time", "interface")
    coordinates = {name: result[name] for name in ("row", "roller", "interface")} | {"time": window.time}
    return xr.Dataset(
        {
            "film_thickness": (dims, thickness, {"units": "m", "long_name": "film thickness"}),
            "film_parameter": (
                dims,
                thickness / bearing.composite_roughness,
                {"units": "1", "long_name": "film thickness over composite roughness, Λ"},
            ),
            "in_range": (dims, inside, {"units": "1", "long_name": "whether W and U are in the film formula's range"}),
            "angle": (dims[:3], angle.values, angle.attrs),
        },
        coordinates,
    )


def _raceway_loads(model: RollerModel, row: xr.Dataset, angle: np.ndarray) -> np.ndarray:
    """Normal loads at inner and outer raceway with weight and centrifugal force (18), as `macroslip.roller.forces.station`."""
    orbital = row.spin_pure.values * model.radius / model.outer_radius
    height = -np.cos(np.radians(angle))  # sine of the position φ
    outward = (model.centrifugal * orbital**2 - model.weight_in_plane * height) * model.cos_contact_angle
    outward = outward + model.weight_along_axis * model.sin_contact_angle
    load = row.roller_load.values
    return np.stack([load + np.maximum(-outward, 0.0), load + np.maximum(outward, 0.0)], axis=-1)
