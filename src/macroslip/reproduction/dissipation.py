"""Where inside the contacts a study's energy goes: by interface, mechanism and station, and how it follows the loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.statement import Statement

#: Parts of a row's energy, in the order of the stacked figure.
PARTS = (
    "inner, curvature",
    "inner, contact angle",
    "outer, curvature",
    "outer, contact angle",
    "raceways, sliding",
    "cage",
)


def knows_mechanisms(study: xr.Dataset) -> bool:
    """Whether the study was computed with contacts that distinguish mechanisms."""
    return "mechanism_energy" in study


def dissipation(study: xr.Dataset) -> xr.Dataset:
    """Energy per orbit of a mean roller by part and by station.

    Parameters
    ----------
    study : xarray.Dataset
        From `paper_study`, with microslip.

    Returns
    -------
    xarray.Dataset
        Over (case, row): part_energy [J] per orbit over `part`, which add up to all of it. At either raceway curvature
        and contact angle are what makes stations slide against each other; the sliding of the middle, of which one
        raceway may take what the other gives, is that of both together. asperity_share [1] of the energy;
        station_energy [J/m] per orbit and length of roller over (raceway, station); load_exponent [1] over (row): slope
        of log energy per orbit over log mean roller load, all cases. NaN wherever a roller failed, and the exponent
        where a row carries no load.
    """
    import xarray as xr

    per_roller = study.mechanism_energy.mean("roller", skipna=False) / study.orbits
    parts = []
    for raceway in ("inner", "outer"):
        at = per_roller.sel(interface=raceway, drop=True)
        parts += [at.sel(mechanism=mechanism, drop=True) for mechanism in ("curvature", "contact angle")]
    raceways = per_roller.sel(interface=["inner", "outer"], mechanism="sliding", drop=True)
    parts.append(raceways.sum("interface", skipna=False))
    energy = study.energy.mean("roller", skipna=False) / study.orbits
    parts.append(energy.sel(interface="cage", drop=True))
    part = xr.DataArray(list(PARTS), dims="part", name="part")
    part_energy = xr.concat(parts, part, coords="minimal", compat="override")
    total = energy.sum("interface", skipna=False)
    asperity = study.asperity_energy.sum("interface", skipna=False).mean("roller", skipna=False) / study.orbits
    length = float(np.diff(study.station.values).mean())
    along = study.station_energy.mean("roller", skipna=False) / study.orbits / length
    load = study.roller_load
    exponents = [_exponent(load.sel(row=row).values, total.sel(row=row).values) for row in study.row.values]
    found = xr.Dataset(
        {
            "part_energy": part_energy.transpose("case", "row", "part"),
            "asperity_share": asperity / total,
            "station_energy": along.transpose("case", "row", "raceway", "station"),
            "load_exponent": ("row", exponents),
        }
    )
    for name, units, long_name in (
        ("part_energy", "J", "energy per orbit of a mean roller by interface and mechanism"),
        ("asperity_share", "1", "share of the energy that asperities dissipate"),
        ("station_energy", "J/m", "energy per orbit and length of roller, by raceway"),
        ("load_exponent", "1", "exponent of energy per orbit over mean roller load, all cases"),
    ):
        found[name].attrs = {"units": units, "long_name": long_name}
    return found.drop_vars(("start_angle", "roller"), errors="ignore")


def _exponent(load: np.ndarray, energy: np.ndarray) -> float:
    if not (np.isfinite(energy).all() and (load > 0.0).all() and np.unique(load).size > 1):
        return float("nan")
    return float(np.polyfit(np.log(load), np.log(energy), 1)[0])


def reasons(study: xr.Dataset, numbers: xr.Dataset) -> dict[str, str]:
    """What was measured inside the contacts that bears on the paper's statements, in words.

    Parameters
    ----------
    study : xarray.Dataset
        From `paper_study`, with microslip.
    numbers : xarray.Dataset
        From `paper_numbers`.

    Returns
    -------
    dict
        Text by subject: "energy", "rows", "peaks", "peak ratio", "static", "cage". Empty where a number is missing.
    """
    from scipy.stats import spearmanr

    names = ("energy", "rows", "peaks", "peak ratio", "static", "cage")
    if bool((study.status != 0).any()):
        return dict.fromkeys(names, "")
    parts = dissipation(study)
    down = parts.sel(row="downwind")
    shares = (down.part_energy / down.part_energy.sum("part")).mean("case")
    curvature, angle = (
        100.0 * float(shares.sel(part=[f"inner, {one}", f"outer, {one}"]).sum())
        for one in ("curvature", "contact angle")
    )
    speed = study.wind_speed.values
    low, high = speed == speed.min(), speed == speed.max()

    def ends(values: xr.DataArray, scale: float = 1.0) -> str:
        return f"{scale * float(values.values[low].mean()):.3g} to {scale * float(values.values[high].mean()):.3g}"

    per_orbit = numbers.orbit_energy
    rank = spearmanr(study.thrust.values, per_orbit.sel(row="downwind").values).statistic
    loaded = 100.0 * study.loaded_share.sel(row="upwind")
    cage = 100.0 * (study.energy.sel(interface="cage").sum("roller") / study.energy.sum(("roller", "interface")))
    peak = numbers.peak_power_mean
    span = f"from {speed.min():g} to {speed.max():g} m/s"
    return {
        "energy": (
            f"the downwind raceways dissipate by microslip, {curvature:.0f} % of the row's energy through the "
            f"contact's curvature and {angle:.0f} % through the contact angle, and both grow with load: {span} mean thrust falls "
            f"from {ends(study.thrust, 1e-3)} kN, the row's mean roller load from "
            f"{ends(study.roller_load.sel(row='downwind'), 1e-3)} kN and its energy per orbit from "
            f"{ends(per_orbit.sel(row='downwind'))} J, as load to the power {float(down.load_exponent):.2g} (rank "
            f"correlation of energy per orbit with thrust {rank:.2f})"
        ),
        "rows": (
            "thrust unloads the upwind row: its rollers carry load during "
            f"{float(loaded.min()):.2g} to {float(loaded.max()):.2g} % of the time and spend "
            f"{ends(per_orbit.sel(row='upwind'))} J an orbit {span}, of it {float(cage.sel(row='upwind').min()):.0f} to "
            f"{float(cage.sel(row='upwind').max()):.0f} % at the cage; the energy of an unloaded roller depends on the oil "
            "around it, and on how much there is"
        ),
        "peaks": (
            "downwind the largest power of an orbit is that of microslip at the inner raceway under the largest load, not "
            f"that of a snap, {ends(peak.sel(row='downwind'))} W {span}; upwind it is {ends(peak.sel(row='upwind'))} W"
        ),
        "peak ratio": (
            "the downwind row's power hardly changes, and the upwind row's rises from "
            f"{ends(peak.sel(row='upwind'))} W {span} because it is under load more often ({ends(loaded)} % of "
            "the time)"
        ),
        "static": (
            "power at the raceways follows the load of the moment, and the energy of an orbit its mean: the static "
            "load gives less because it lacks thrust, not because it is constant"
        ),
        "cage": (
            f"the raceways take {100.0 - float(cage.sel(row='downwind').max()):.1f} % or more of the "
            f"downwind row's energy, and {100.0 - float(cage.sel(row='upwind').max()):.0f} % or more of the upwind row's"
        ),
    }


def explained(found: Mapping[str, Statement], study: xr.Dataset, numbers: xr.Dataset) -> dict[str, Statement]:
    """The statements with what was measured inside the contacts as their reasons."""
    from dataclasses import replace

    words = reasons(study, numbers)
    return {
        subject: replace(one, because=words[subject]) if subject in words else one for subject, one in found.items()
    }
