"""Maps of the raceways over a lifetime: where the cases of a study leave energy, weighted by how likely each is."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from macroslip.errors import InputError
from macroslip.study.weights import YEAR, Weights, binned

if TYPE_CHECKING:
    import xarray as xr

_PLACES = ("row", "raceway", "angle", "station")


def weighted_maps(
    study: xr.Dataset,
    weights: Weights,
    *,
    years: float = 20.0,
    field: str = "wind_speed",
    width: float = 2.0,
    by: Sequence[str] = (),
) -> xr.Dataset:
    """Frictional energy at the places of the raceways over a lifetime, and the largest power per area of all cases.

        E = T Σ_b p_b (1/N_b) Σ_{c in b} E_c / t_c

    as in `lifetime_energy`, at every place and for every sign of slip and film regime.

    Parameters
    ----------
    study : xarray.Dataset
        From `open_study`, of cases with microslip or asperities.
    weights : Weibull or Given
    years : float
        T [years of 365.25 days], above 0.
    field, width, by
        As in `macroslip.study.weights.binned`.

    Returns
    -------
    xarray.Dataset
        `surface_energy` [J] and `surface_power_density` [W/m²] over group and what they are over in a result, and
        `cell_area` [m²]. Energies are NaN where a bin of some weight has no complete run. In which place the inner ring
        is when a case begins is by chance, so its map is spread evenly over the angle.

    Raises
    ------
    InputError
        If a label, a probability or the lifetime is wrong, or the study has no maps.
    """
    import xarray as xr

    if "surface_energy" not in study:
        raise InputError(
            "the study has no maps of the raceways",
            allowed="cases with microslip or asperities that keep surface_energy and surface_power_density",
            remedy="Write laws: {model: physical} and contact_details: true in the case, and leave keep out or add both "
            "to it.",
        )
    if not (math.isfinite(years) and years > 0.0):
        raise InputError(f"the lifetime is {years!r} years", allowed="a number above 0")
    bins = binned(study, field, width, by)
    dims = (*_PLACES, "slip_sign", "film_regime")
    shape = (len(bins.groups), bins.centres.size)
    rate = np.zeros((*shape, *(study.sizes[dim] for dim in dims)))
    largest = np.zeros((shape[0], *(study.sizes[dim] for dim in _PLACES)))
    used = np.zeros(shape)
    # One case after the other: all maps of a large study do not fit into memory.
    for case in range(study.sizes["case"]):
        one = study.isel(case=case)
        energy = one.surface_energy.transpose(*dims).values
        if not np.isfinite(energy).all():
            continue
        cell = bins.group[case], bins.bin[case]
        rate[cell] += energy / float(one.window_length)
        used[cell] += 1
        density = one.surface_power_density.transpose(*_PLACES).values
        largest[cell[0]] = np.maximum(largest[cell[0]], density)
    with np.errstate(invalid="ignore"):
        mean = rate / used.reshape(*shape, *(1 for _ in dims))
    probability = bins.probabilities(weights).reshape(1, -1, *(1 for _ in dims))
    found = years * YEAR * np.where(probability > 0.0, probability * mean, 0.0).sum(axis=1)
    inner = study.raceway.values.tolist().index("inner")
    found[:, :, inner] = found[:, :, inner].mean(axis=2, keepdims=True)
    largest[:, :, inner] = largest[:, :, inner].max(axis=2, keepdims=True)
    energy_about = {"units": "J", "long_name": f"energy at each place of a raceway in {years:g} years"}
    return xr.Dataset(
        {
            "surface_energy": (("group", *dims), found, energy_about),
            "surface_power_density": (("group", *_PLACES), largest, dict(study.surface_power_density.attrs)),
        },
        bins.coordinates(study, bins=False) | {name: study[name] for name in (*dims,)} | {"cell_area": _area(study)},
        {"title": f"Maps of the raceways: {study.attrs.get('title', '')}", "years": years},
    )


def _area(study: xr.Dataset) -> xr.DataArray:
    """Areas of the places, which all bearings of the study have to share."""
    area = study.cell_area
    if "case" not in area.dims:
        return area
    values = area.values
    known = np.flatnonzero(np.isfinite(values).all(axis=tuple(range(1, values.ndim))))
    if not known.size or np.ptp(values[known], axis=0).max() > 1e-12 * values[known].max():
        raise InputError(
            "the bearings of the study have raceways of different size",
            remedy="Select the cases of one bearing first: study.isel(case=study.bearing == 'name').",
        )
    return area.isel(case=int(known[0]), drop=True)
