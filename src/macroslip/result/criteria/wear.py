"""Criterion of wear: time until the deepest point has worn by 10 µm."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
import xarray as xr

from macroslip.bearing import geometry
from macroslip.constants import YEAR
from macroslip.contact.laws import PreparedContact
from macroslip.contact.line import PALMGREN_EXPONENT
from macroslip.contact.strips import PreparedStrips, strip_approach
from macroslip.damage import wear
from macroslip.errors import InputError
from macroslip.measures.along import STATIONS
from macroslip.result.criteria.criterion import OF_YEAR, Criterion, PageColumn, Values, Yearly
from macroslip.result.criteria.evaluation import SURFACES, Evaluation
from macroslip.variables import Variable, described

#: Time for which turbines are designed [years], IEC 61400-1.
DESIGN_LIFE = 20.0
#: Ages for which the worn profile is computed [years].
AGES = (1.0, 5.0, 20.0)
#: Slips in the middle that are tried, in parts of the largest microslip, to find the profile of
#: slip.
_TRIED = 401
#: Slices of a station while wear grows: at lines of pure rolling nothing wears, and what is left of
#: them carries the load.
_SLICES = 4
#: Depth whose time is compared [m], its number, and the middle coefficient k of a run.
COMPARED_DEPTH = 1e-5
_COMPARED = wear.DEPTHS.index(COMPARED_DEPTH)
MIDDLE_COEFFICIENT = wear.COEFFICIENTS[len(wear.COEFFICIENTS) // 2]
#: When variables of wear are there.
_ROUGH = "with asperities"
_ROUGH_YEAR = f"with asperities, {OF_YEAR}"
_NO_WEAR = (
    "Wear was not computed, since without asperities nothing touches: choose their law, laws: "
    "{asperities: masjedi-khonsari} "
    "or film-ratio, and a boundary_friction above 0 of the lubricant."
)
_LIGHT = (
    "The load lay outside the range for which the law of asperities was fitted for {rows} of the "
    "loaded time; there the part that asperities carry, and with it wear, is limited to what the "
    "film ratio gives."
)


def _values(evaluation: Evaluation) -> Values:
    """Work of asperities, time to depths, and worn profiles at the middle coefficient."""
    friction = evaluation.boundary_friction
    if friction <= 0.0:
        if evaluation.wear_is_asked_for or "wear_time" in evaluation.thresholds:
            raise InputError(_NO_WEAR, where="wear", allowed="results with asperities")
        return {}
    # Splines may leave a little less than nothing of what asperities have.
    on_surfaces = np.maximum(evaluation.profile("surface_asperity_energy"), 0.0)
    work = wear.worn_volume(1.0, on_surfaces, friction)
    of_roller = np.maximum(evaluation.roller_share("surface_asperity_energy"), 0.0)
    on_roller = of_roller / friction
    if not evaluation.tells_of_year:
        return {"asperity_work_rate": work}
    coefficients = np.array(evaluation.wear_coefficients)
    middle = coefficients[len(coefficients) // 2]
    rows = evaluation.run_input.models
    times = np.full((len(rows), len(SURFACES), len(wear.DEPTHS)), math.inf)
    depths = np.zeros((len(rows), len(SURFACES), len(AGES), STATIONS))
    for r, row in enumerate(rows):
        if np.isnan(work[r]).any():
            times[r] = math.nan
            depths[r] = math.nan
            continue
        worn = _grown(evaluation, row, work[r], on_roller[r])
        works = [worn.work_at(depth) for depth in wear.DEPTHS]
        times[r] = np.stack(works, axis=-1)
        for a, age in enumerate(AGES):
            depth = worn.depth_at(middle * age * YEAR)
            slices = depth.reshape(len(SURFACES), STATIONS, _SLICES)
            depths[r, :, a] = slices.mean(axis=-1)
    return {
        "asperity_work_rate": work,
        "wear_time": times[..., None] / coefficients,
        "worn_depth": depths,
    }


def _coordinates(evaluation: Evaluation) -> dict[str, Any]:
    """Coefficients, depths and ages for which wear is computed."""
    return {
        "wear_coefficient": (
            "wear_coefficient",
            evaluation.wear_coefficients,
            described("m2/N", "coefficient of wear k"),
        ),
        "depth": ("depth", list(wear.DEPTHS), described("m", "depth of wear")),
        "age": ("age", np.array(AGES) * YEAR, described("s", "time like this window")),
    }


def _grown(evaluation: Evaluation, row: str, work: np.ndarray, on_roller: np.ndarray) -> wear.Worn:
    """Wear of a row at a representative load, with the mean depth of its maps.

    `work` and `on_roller` are depth a second over k [W/m²] over surface and station, and the roller's
    over raceway and
    station.
    """
    bearing = evaluation.bearing
    width = bearing.roller_length / (_SLICES * STATIONS)
    from_end = (np.arange(_SLICES * STATIONS) + 0.5) * width
    along = from_end - 0.5 * bearing.roller_length
    curvatures = (geometry.inner_curvatures(bearing), geometry.outer_curvatures(bearing))
    result = evaluation.result.sel(row=row)
    laws = evaluation.run_input.models[row].laws
    skew = working_skew(result)
    contacts = []
    for i, (law, curved) in enumerate(zip((laws.inner, laws.outer), curvatures, strict=True)):
        load = float(result.working_load.isel(raceway=i))
        if not load > 0.0 or not work[i].sum() > 0.0:
            nothing = np.zeros(along.size)
            contacts.append(wear.Pressed(0.0, nothing, 1.0, nothing, 0.0, 0.0))
            continue
        contour, stiffness = _slices(law, load, along, curved.lateral)
        pressed = wear.slice_loads(contour, load, stiffness, width)
        mapped = result.surface_work.isel(raceway=i).sum("angle").values
        slip = slip_profile(law, along, pressed, mapped, skew)
        total = (pressed * slip).sum() / _SLICES
        ring = work[i].sum() / total
        roller = on_roller[i].sum() / total
        contacts.append(wear.Pressed(load, contour, stiffness, slip, ring, roller))
    return wear.grow((contacts[0], contacts[1]), width)


def _slices(
    law: PreparedContact, load: float, along: np.ndarray, curvature: float
) -> tuple[np.ndarray, float]:
    """Gap of the slices of a contact [m], and their load per length over their approach [Pa].

    At a load Q > 0 [N], slices at places along the roller [m], and the lateral curvature [1/m] of
    an elliptical contact. The law of strips is straightened at the middle of the roller.
    """
    if isinstance(law, PreparedStrips):
        strips = law.strips
        approach = float(strip_approach(strips, load))
        load_per_length = float(strips.load_per_length(approach))
        slope = PALMGREN_EXPONENT * load_per_length / approach
        return strips.profile(along), slope
    half_length = law.interface.hertz.semi_axis_across * load ** (1.0 / 3.0)
    contour = 0.5 * curvature * along**2
    return contour, wear.hertz_slices(load, half_length, curvature)


def working_skew(row: xr.Dataset) -> float:
    """Root-mean-square skew of a row [rad], weighted by ∫ p |v| dt of a pass.

    The angle of that raceway is the orbit's.
    """
    if "skew_by_position" not in row:
        return 0.0
    outer = row.sel(raceway="outer")
    work = outer.surface_work.sum("station").values
    passes = outer.surface_passes.values
    weight = np.divide(work, passes, out=np.zeros_like(work), where=passes > 0.0)
    square = np.nan_to_num(row.skew_by_position.values) ** 2
    total = max(weight.sum(), 1e-300)
    return math.sqrt((square * weight).sum() / total)


def slip_profile(
    law: PreparedContact, along: np.ndarray, pressed: np.ndarray, work: np.ndarray, skew: float
) -> np.ndarray:
    """|v| along the roller over the ring's speed [-], with the slip of the middle that fits best.

    Parameters
    ----------
    law : PreparedContact
        Of the raceway.
    along : ndarray, shape (n,)
        Places of the slices along the roller [m].
    pressed : ndarray, shape (n,)
        Load per length of the slices [N/m].
    work : ndarray, shape (stations,)
        ∫∫ p |v| dA dt of the map by station [J].
    skew : float
        Skew [rad], whose slip lies across rolling.

    Returns
    -------
    ndarray, shape (n,)
    """
    microslip = _microslip(law, along)
    if not microslip.any():
        return np.ones_like(along)
    largest = np.abs(microslip[pressed > 0.0]).max()
    middle = np.linspace(-1.0, 1.0, _TRIED)[:, None] * largest
    slip_along = microslip + middle * _growth(law, along)
    slips = np.hypot(slip_along, skew)
    work_of_slices = (slips * pressed).reshape(_TRIED, STATIONS, _SLICES)
    profiles = work_of_slices.sum(axis=-1)
    profiles /= profiles.sum(axis=1, keepdims=True)
    mapped = work / work.sum()
    error = ((profiles - mapped) ** 2).sum(axis=1)
    return slips[int(np.argmin(error))]


def _microslip(law: PreparedContact, along: np.ndarray) -> np.ndarray:
    """Slip along the roller over the ring's speed [-], of a middle that rolls; 0 without microslip."""
    shape = law.shape
    if not shape.microslip:
        return np.zeros_like(along)
    if isinstance(law, PreparedStrips):
        return 0.5 * law.strips.curvature * law.strips.profile(along)
    curvature = shape.curvature_ratio / (2.0 * shape.contour_radius)
    return curvature * along**2 - shape.spin_ratio * along


def _growth(law: PreparedContact, along: np.ndarray) -> np.ndarray:
    """Radius along the roller over that of its middle [-]; the slip of the middle grows with it."""
    if isinstance(law, PreparedStrips):
        return 1.0 + along * law.strips.taper
    return np.ones_like(along)


def _years(variables: Mapping[str, np.ndarray]) -> float:
    if "wear_time" not in variables:
        return math.nan
    times = variables["wear_time"][:, :, _COMPARED]
    middle = times.shape[-1] // 2
    shortest = float(np.nanmin(times[..., middle], initial=math.inf))
    return shortest / YEAR


def _missing(evaluation: Evaluation, variables: Mapping[str, np.ndarray]) -> list[str]:
    """Why there is no wear, or how long the law of asperities was out of its range."""
    if evaluation.boundary_friction <= 0.0:
        return [_NO_WEAR]
    if "outside_asperity_range" not in evaluation.result:
        return []
    shares = evaluation.result.outside_asperity_range.sel(interface=["inner", "outer"])
    shares = shares.fillna(0.0).mean(["roller", "interface"])
    if not bool((shares > 0.0).any()):
        return []
    rows = " and ".join(
        f"{100.0 * float(share):.3g} % in the {share.row.item()} row" for share in shares
    )
    return [_LIGHT.format(rows=rows)]


def _wear_rate(criteria: xr.Dataset, _: xr.Dataset) -> xr.DataArray | None:
    if "asperity_work_rate" not in criteria:
        return None
    work = criteria.asperity_work_rate.max(["surface", "station"], skipna=False)
    return MIDDLE_COEFFICIENT * work


CRITERIA = (
    Criterion(
        order=40,
        name="wear_time",
        mechanism="wear",
        quantity="time to 10 µm at the middle k",
        unit="year",
        declares=(
            Variable(
                "asperity_work_rate",
                ("row", "surface", "station"),
                "W/m2",
                _ROUGH,
                "asperities' pressure times slip, mean over time: depth of wear a second over k",
            ),
            Variable(
                "wear_time",
                ("row", "surface", "depth", "wear_coefficient"),
                "s",
                _ROUGH_YEAR,
                "time like this window until the deepest place has worn by depth",
            ),
            Variable(
                "worn_depth",
                ("row", "surface", "age", "station"),
                "m",
                _ROUGH_YEAR,
                "depth of wear at the middle wear_coefficient",
            ),
        ),
        variables=_values,
        coordinates=_coordinates,
        value=_years,
        missing=_missing,
        reference=DESIGN_LIFE,
        compared_with="design life, IEC 61400",
        factor=10.0,
        reason="k, share of asperities",
        lowest=True,
        references=(wear.REFERENCE,),
        yearly=(
            Yearly(
                run_name="wear_rate",
                run_unit="m/s",
                run_meaning="growth of the deepest wear at k = 1e-17 m2/N, unworn contour",
                of_run=_wear_rate,
                name="wear",
                drawn="max",
                year_unit="m",
                year_meaning="depth of wear at k = 1e-17 m2/N, at most",
                unit="m/year",
                meaning="wear at k = 1e-17 m²/N, deepest place",
                by_factors=True,
                design_column=PageColumn("wear at k = 1e-17 m²/N [µm/year]", 1e6),
                year_column=PageColumn("wear [µm]", 1e6),
                leads=True,
            ),
        ),
    ),
)
