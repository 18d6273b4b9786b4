"""How much energy and peak power depend on values that are not known well: one at a time, from real runs."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from macroslip.case.case import Case
from macroslip.errors import InputError
from macroslip.result.simulate import simulate

if TYPE_CHECKING:
    import xarray as xr

LEVELS = ("low", "base", "high")
#: Parts of a variation's distance that are tried, the next one where a value is refused.
_PARTS = (1.0, 0.5, 0.25, 0.125)
#: Film thickness of the starved bearing over that of the flooded one.
STARVED = 0.7


@dataclass(frozen=True, slots=True, kw_only=True)
class Variation:
    """One value that is varied.

    Parameters
    ----------
    name : str
        What it is, as it stands in the figure.
    unit : str
        Of `low`, `high` and what `base` gives.
    low, high : float
        Values beside that of the case; equal to it where there is none on that side.
    base : callable
        base(case) -> the case's own value [unit].
    apply : callable
        apply(case, value) -> the case with that value.
    note : str
        What goes with it.
    """

    name: str
    unit: str
    low: float
    high: float
    base: Callable[[Case], float]
    apply: Callable[[Case, float], Case]
    note: str = ""


def _with_bearing(case: Case, **values: float) -> Case:
    return dataclasses.replace(case, bearing=case.bearing.replace(**values))


def with_inlet_temperature(case: Case, temperature: float) -> Case:
    """The case with its lubricant at another inlet temperature [K], by `Lubricant.at`.

    Examples
    --------
    >>> from macroslip import Case, HubLoads
    >>> warm = with_inlet_temperature(Case(loads=HubLoads.bundled("14B")), 333.15)
    >>> round(warm.lubricant.viscosity, 4)
    0.1332
    """
    return dataclasses.replace(case, lubricant=case.lubricant.at(temperature))


def film_factor(case: Case) -> float:
    """Film thickness over that of a flooded contact [-] in a case."""
    return case.lubricant.starvation if case.laws.starvation else 1.0


def with_film_factor(case: Case, factor: float) -> Case:
    """The case with films `factor` times as thick as flooded ones, by the starvation of its lubricant.

    Examples
    --------
    >>> from macroslip import Case, HubLoads
    >>> starved = with_film_factor(Case(loads=HubLoads.bundled("14B")), 0.7)
    >>> starved.laws.name, starved.lubricant.starvation
    ('paper, but starvation on', 0.7)
    """
    return dataclasses.replace(
        case, lubricant=case.lubricant.replace(starvation=factor), laws=case.laws.but(starvation=True)
    )


VARIATIONS = (
    Variation(
        name="diametral clearance",
        unit="mm",
        low=0.0,
        high=0.4,
        base=lambda case: 1e3 * case.bearing.diametral_clearance,
        apply=lambda case, value: _with_bearing(case, diametral_clearance=1e-3 * value),
    ),
    Variation(
        name="osculation",
        unit="1",
        low=0.97,
        high=0.99,
        base=lambda case: case.bearing.osculation_outer,
        apply=lambda case, value: _with_bearing(case, osculation_inner=value, osculation_outer=value),
        note="at both raceways; the cage pocket conforms with it",
    ),
    Variation(
        name="inlet temperature",
        unit="°C",
        low=20.0,
        high=60.0,
        base=lambda case: case.lubricant.inlet_temperature - 273.15,
        apply=lambda case, value: with_inlet_temperature(case, value + 273.15),
        note="viscosity η0 exp(−β (T − T0)) from the base temperature T0; nothing else changes",
    ),
    Variation(
        name="bearing to gearbox",
        unit="m",
        low=1.8,
        high=2.6,
        base=lambda case: case.drivetrain.bearing_to_gearbox,
        apply=lambda case, value: dataclasses.replace(
            case, drivetrain=dataclasses.replace(case.drivetrain, bearing_to_gearbox=value)
        ),
        note="distance between the supports of the shaft, which turns hub loads into the load on the bearing",
    ),
    Variation(
        name="film factor",
        unit="1",
        low=STARVED,
        high=1.0,
        base=film_factor,
        apply=with_film_factor,
        note="film thickness over that of the law, at every interface; 0.7 is reported for a starved bearing",
    ),
)

#: Of a film whose stress is limited, beside `VARIATIONS`.
LIMITING_SHEAR = Variation(
    name="limiting shear",
    unit="1",
    low=0.035,
    high=0.05,
    base=lambda case: case.lubricant.limiting_shear,
    apply=lambda case, value: dataclasses.replace(case, lubricant=case.lubricant.replace(limiting_shear=value)),
    note="largest shear stress of the film over pressure; the range reported for PAO",
)


def variations_of(case: Case) -> tuple[Variation, ...]:
    """`VARIATIONS`, and `LIMITING_SHEAR` where the laws of a case know it.

    Examples
    --------
    >>> from macroslip import Case, HubLoads, Laws
    >>> [one.name for one in variations_of(Case(loads=HubLoads.bundled("14B"), laws=Laws.physical()))][-2:]
    ['film factor', 'limiting shear']
    """
    return (*VARIATIONS, LIMITING_SHEAR) if case.laws.rheology == "limiting-shear" else VARIATIONS


def sensitivity(
    case: Case,
    variations: Sequence[Variation] = VARIATIONS,
    *,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> xr.Dataset:
    """Energy and peak power with each value low and high, all others as in the case.

    Parameters
    ----------
    case : Case
    variations : sequence of Variation
    threads : int, optional
        Threads over rollers.
    progress : callable, optional
        Called as progress(done, total) after each run.

    Returns
    -------
    xarray.Dataset
        Over (variation, level): value, in the unit that the coordinate `unit` says; over (variation, level, row):
        energy [J] in the window, mean over the rollers; peak_power [W], mean over rollers and orbits of the largest
        power at any interface per orbit; failed, the number of failed rollers. A mean that a failed roller enters is
        NaN. A value that the model refuses, because a contact ellipse would reach past the roller's ends, say, is halved
        towards that of the case until it does not; the coordinate `refused` over variation says so.

    Raises
    ------
    InputError
        If a value is still refused when it has come within an eighth of its distance.
    """
    import xarray as xr

    total = 1 + sum(_differs(one, case, level) for one in variations for level in ("low", "high"))
    found, values, refused, done = {}, [], [], 0

    def count() -> None:
        nonlocal done
        done += 1
        if progress:
            progress(done, total)

    base = _row_values(simulate(case, threads=threads))
    count()
    for one in variations:
        used, refusals = {"base": one.base(case)}, []
        found[one.name, "base"] = base
        for level in ("low", "high"):
            if not _differs(one, case, level):
                used[level], found[one.name, level] = one.base(case), base
                continue
            used[level], found[one.name, level], refusal = _nearest_run(case, one, level, threads)
            refusals += refusal
            count()
        values.append([used[level] for level in LEVELS])
        refused.append(" ".join(refusals))
    names = [one.name for one in variations]
    variation = xr.DataArray(names, dims="variation", name="variation")
    level = xr.DataArray(list(LEVELS), dims="level", name="level")
    table = xr.concat(
        [xr.concat([found[name, one] for one in LEVELS], level) for name in names], variation, combine_attrs="override"
    )
    attributes = {"long_name": "varied value, in the unit of its variation", "units": "1"}
    table["value"] = (("variation", "level"), np.array(values, dtype=float), attributes)
    table.attrs = {"title": f"Sensitivity under {case.loads.source}", "source_load": case.loads.source}
    return table.assign_coords(
        unit=("variation", [one.unit for one in variations]),
        note=("variation", [one.note for one in variations]),
        refused=("variation", refused),
    )


def _nearest_run(
    case: Case, variation: Variation, level: str, threads: int | None
) -> tuple[float, xr.Dataset, list[str]]:
    """The value used, what it gives, and what was refused before."""
    own, refusals = variation.base(case), []
    distance = getattr(variation, level) - own
    for part in _PARTS:
        value = own + part * distance
        try:
            return value, _row_values(simulate(variation.apply(case, value), threads=threads)), refusals
        except InputError as error:
            if part == _PARTS[-1]:
                raise
            unit = "" if variation.unit == "1" else f" {variation.unit}"
            refusals.append(f"{value:g}{unit} is refused: {error}")


def _differs(variation: Variation, case: Case, level: str) -> bool:
    return not math.isclose(getattr(variation, level), variation.base(case), rel_tol=1e-9, abs_tol=1e-12)


def _row_values(result: xr.Dataset) -> xr.Dataset:
    import xarray as xr

    energy = result.energy.sum("interface", skipna=False).mean("roller", skipna=False)
    peak = result.peak_power.max("interface", skipna=False).mean(("roller", "orbit"), skipna=False)
    values = xr.Dataset({"energy": energy, "peak_power": peak, "failed": (result.status != 0).sum("roller")})
    values.energy.attrs = {"units": "J", "long_name": "energy in the window, mean over the rollers of the row"}
    values.peak_power.attrs = {"units": "W", "long_name": "mean over rollers and orbits of P_max per orbit"}
    values.failed.attrs = {"units": "1", "long_name": "failed rollers"}
    return values
