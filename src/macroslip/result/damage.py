"""Criteria of damage of a result: rates per second by row and place, and one line a criterion."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from macroslip.bearing import geometry
from macroslip.damage import friction_energy, micropitting, smearing, wear
from macroslip.errors import InputError
from macroslip.measures.details import FILM_EDGES, SLIP_EDGES, STATIONS
from macroslip.result.run_input import RunInput, run_input, stored_settings
from macroslip.result.variables import described

PLACES = ("inner", "outer", "roller")
YEAR = 365.25 * 86400.0
#: Time for which turbines are designed [years], IEC 61400-1.
DESIGN_LIFE = 20.0
#: Ages for which the worn profile is told [years].
_AGES = (1.0, 5.0, 20.0)
_PROFILE = ("row", "place", "station")
#: Slips in the middle that are tried, in parts of the largest microslip, to find the profile of slip.
_TRIED = 401
#: Slices of a station while wear grows: at lines of pure rolling nothing wears, and what is left of them carries the load.
_SLICES = 4
_NO_DETAILS = (
    "The result keeps no details of its contacts, from which damage is computed: it needs laws with microslip or asperities, such "
    "as laws: {model: physical}, with contact_details: true; of a study, keep has to name them."
)
_NO_WEAR = (
    "Wear was not computed, since without asperities nothing touches: choose their law, laws: {asperities: masjedi-khonsari} "
    "or film-ratio, and a boundary_friction above 0 of the lubricant."
)
_NO_THIN_FILMS = "No film under load was thinner than Λ = 3, so nothing is said of the sign of slip in thin films."
_FEW_ROLLERS = (
    "Of {all} rollers a row {some} were simulated, {why}: values at the outer raceway may be off by several times, because "
    "what lasts a short time falls on the few places where these rollers are. Leave rollers away to compute all."
)
_NO_ORBIT = (
    "No roller completed an orbit in the window, so nothing is said of a year like it: energies and wear of a part of an orbit "
    "depend on where the rollers were. Give loads that last for some orbits."
)
_LIGHT = (
    "The load lay outside the range of the law of asperities for {rows} of the loaded time of raceways; there their share, "
    "and so wear, is no more than the film ratio gives."
)
_NO_ENTRIES = "No roller entered a load zone in a complete orbit of the window, so nothing is said of smearing."


class Threshold(NamedTuple):
    """A threshold of one's own: its value in the unit of the criterion, and its source."""

    value: float
    source: str


class Criterion(NamedTuple):
    """A line of the answer."""

    name: str
    title: str
    unit: str
    reference: float  #: In the unit; NaN where none could be traced
    compared_with: str
    factor: float  #: The value holds within this factor either way
    reason: str
    lowest: bool = False  #: Whether low is bad

    @property
    def how_sure(self) -> str:
        """Factor and reason."""
        return f"factor {self.factor:g}: {self.reason}"


_FE8 = friction_energy.ThrustTest()
#: e_a [W/m²] of the FE8 test, mean of its range: what friction energy is compared with.
REFERENCE_POWER = sum(_FE8.range()) / 2.0
_IDLE = "oil at idle rollers"
CRITERIA = (
    Criterion("entry_slide_roll_ratio", "smearing: slide-roll ratio at entry", "1", smearing.RIG_SLIDE_ROLL_RATIO,
              "rig, light load, Evans 2013", 3.0, _IDLE),
    Criterion("entry_power_density", "smearing: power density at entry", "W/m2", math.nan, "", 3.0, _IDLE),
    Criterion("entry_flash_temperature", "smearing: flash temperature at entry", "K", math.nan, "", 3.0, _IDLE),
    Criterion("friction_energy_rate", "friction energy: e_a, mean of p |v|", "W/m2", REFERENCE_POWER,
              "FE8 test 81212", 1.3, "crown of washers"),
    Criterion("friction_energy_year", "friction energy: p |v| of such a year", "J/m2",
              _FE8.duration * REFERENCE_POWER, "FE8 test 81212, 20 h", 1.3, "crown of washers"),
    Criterion("mixed_time", "micropitting: loaded time with Λ < 1", "1", math.nan, "", 3.0, "roughness, oil supply"),
    Criterion("slower_time", "micropitting: ring slower, Λ < 3", "1", math.nan, "", 1.5, "profile of slip"),
    Criterion("wear_time", "wear: time to 10 µm at the middle k", "year", DESIGN_LIFE, "design life, IEC 61400",
              10.0, "k, share of asperities", lowest=True),
)  # fmt: skip


def damage(
    result: xr.Dataset,
    *,
    wear_coefficients: Sequence[float] | None = None,
    hardness: float | None = None,
    thresholds: Mapping[str, Threshold] | None = None,
) -> xr.Dataset:
    """Criteria of damage of a result, each with its reference; none of them holds generally.

    Raises InputError if the result keeps no details; if wear is asked for where no asperities were chosen; for a
    criterion that does not exist, or numbers out of range.

    Rates per second are over row, place and station; over `criterion` the worst `value`, its `reference` and `ratio`,
    and as coordinates `unit`, `compared_with` and `how_sure`. The attribute `not_kept` says what is missing, and why.

    Parameters
    ----------
    result : xarray.Dataset
        From `simulate`, with details of the contacts.
    wear_coefficients, hardness : sequence of float and float, optional
        k [m²/N], rising; 1e-18, 1e-17 and 1e-16 by default. With a hardness [Pa] they are dimensionless, and k is they
        over it.
    thresholds : mapping, optional
        Your own thresholds by the name of the criterion, each with its source, in place of a reference.
    """
    if "surface_work" not in result:
        raise InputError(_NO_DETAILS, allowed="results of contacts with microslip or asperities")
    own, known = dict(thresholds or {}), [one.name for one in CRITERIA]
    for name, one in own.items():
        if not (
            name in known and math.isfinite(one.value) and one.value > 0.0 and one.source.strip()
        ):
            allowed = f"a number above 0 and where it comes from, for one of {', '.join(known)}"
            raise InputError(
                f"the threshold of '{name}' is {one.value!r}, source {one.source!r}",
                allowed=allowed,
            )
    given = run_input(result)
    coefficients = _coefficients(wear_coefficients, hardness)
    found, missing = _Rates(result, given), []
    data = {
        "pass_rate": (("place",), found.pass_rates(), described("1/s", "passes over a place that is loaded all round")),
        "pressure_slip_rate": (_PROFILE, found.profile("surface_work"), described("W/m2", "mean of p |v| over time, e_a")),
        "friction_power": (_PROFILE, found.profile("surface_energy"), described("W/m2", "frictional power per area, mean over time")),
        **_films(result),
    }  # fmt: skip
    tells_of_year = result.sizes["orbit"] > 0 or bool(given.settings["loads"].get("event"))
    if not tells_of_year:
        missing.append(_NO_ORBIT)
    power = _largest(data["pressure_slip_rate"][1])
    values = {
        "friction_energy_rate": power,
        "friction_energy_year": YEAR * power if tells_of_year else math.nan,
        "mixed_time": _largest(data["mixed_time"][1][..., FILM_EDGES.index(1.0)]),
        "slower_time": _largest(data["slower_share"][1]),
    }
    if result.sizes["orbit"]:
        data |= _entries(result, found, own)
    if float(result.entries.sum()) > 0.0:
        values |= {name: _largest(data[name][1]) for name in known[:3]}
    else:
        missing.append(_NO_ENTRIES)
    friction = given.models[str(result.row.values[0])].laws.inner.boundary_friction
    if friction <= 0.0:
        if wear_coefficients is not None or "wear_time" in own:
            raise InputError(_NO_WEAR, where="wear", allowed="results with asperities")
        missing.append(_NO_WEAR)
    else:
        data |= _wear(result, given, found, coefficients, friction)
        missing += _outside_asperity_range(result)
        if tells_of_year:
            of_middle = data["wear_time"][1][:, :, 1, len(coefficients) // 2]
            values["wear_time"] = float(np.nanmin(of_middle, initial=math.inf)) / YEAR
        else:
            del data["wear_time"], data["worn_depth"]
    failed = int((result.status != 0).sum())
    if failed:
        missing.append(
            f"{failed} rollers failed: their rows have no maps, and their entries are left out."
        )
    if few := _few_rollers(result, given):
        missing.append(few)
    if math.isnan(values["slower_time"]):
        missing.append(_NO_THIN_FILMS)
    data |= _answer(values, own)
    coordinates = {
        "row": result.row, "place": list(PLACES), "raceway": result.raceway, "station": result.station,
        "film_ratio": ("film_ratio", list(FILM_EDGES), described("1", "upper limit of Lambda")),
        "wear_coefficient": ("wear_coefficient", coefficients, described("m2/N", "k")),
        "depth": ("depth", list(wear.DEPTHS), described("m", "depth of wear")),
        "age": ("age", np.array(_AGES) * YEAR, described("s", "time like this window")),
        "criterion": known,
        **{
            name: ("criterion", [_told(one, own, name) for one in CRITERIA]) for name in ("title", "unit", "compared_with", "how_sure")
        },
        "reference_power_low": ((), _FE8.range()[0], described("W/m2", "e_a of the FE8 test, logarithmic profile")),
        "reference_power_high": ((), _FE8.range()[1], described("W/m2", "e_a of the FE8 test, even load")),
        "rig_slide_roll_ratio": ((), smearing.RIG_SLIDE_ROLL_RATIO, described("1", "onset of smearing on a rig")),
    }  # fmt: skip
    about = {
        "title": f"Criteria of damage: {result.attrs.get('title', '')}", "model": result.attrs.get("model", ""),
        "oil": result.attrs.get("oil", ""), "not_kept": "\n".join(missing),
        "references": "\n".join(
            [friction_energy.REFERENCE, wear.REFERENCE, *smearing.REFERENCES, *micropitting.REFERENCES]
        ),
    }  # fmt: skip
    return xr.Dataset(data, coordinates, about)


def _told(one: Criterion, own: Mapping[str, Threshold], what: str) -> str:
    if what == "compared_with" and one.name in own:
        return f"your threshold: {own[one.name].source}"
    return str(getattr(one, what))


def _largest(values: np.ndarray) -> float:
    return float(np.nanmax(values)) if np.isfinite(values).any() else math.nan


def _coefficients(given: Sequence[float] | None, hardness: float | None) -> list[float]:
    found = [float(one) for one in (given if given is not None else wear.COEFFICIENTS)]
    good = (
        found
        and all(math.isfinite(one) and one > 0.0 for one in found)
        and found == sorted(set(found))
    )
    if not good or (hardness is not None and not (math.isfinite(hardness) and hardness > 0.0)):
        allowed = (
            "rising numbers above 0 in m²/N; with a hardness above 0 in Pa they are dimensionless"
        )
        raise InputError(
            f"the wear coefficients are {found}, the hardness {hardness}",
            where="wear",
            allowed=allowed,
        )
    if hardness is None:
        return found
    if given is None:
        what = "a hardness is given without wear coefficients"
        raise InputError(what, where="wear", allowed="both, K and H, or k alone")
    return [one / hardness for one in found]


class _Rates:
    """Maps of a result as rates per second of a bearing with all its rollers, by place."""

    def __init__(self, result: xr.Dataset, given: RunInput):
        self.result, self.bearing = result, given.bearing
        self.seconds = float(result.attrs["window_end"]) - float(result.attrs["window_start"])
        self.all_rollers = self.bearing.rollers_per_row / result.sizes["roller"]
        self.area = result.cell_area.transpose("row", "raceway", "station").values
        self.roller_area = (
            2.0
            * math.pi
            * geometry.roller_radius(self.bearing)
            * self.bearing.roller_length
            / STATIONS
        )

    def powers(self, name: str) -> np.ndarray:
        """Energy of a map per second [W] over row, raceway, angle and station, of all rollers of a row."""
        values = self.result[name]
        values = values.sum(
            [dim for dim in values.dims if dim in ("slip_sign", "film_regime")], skipna=False
        )
        return values.transpose("row", "raceway", "angle", "station").values * (
            self.all_rollers / self.seconds
        )

    def profile(self, name: str) -> np.ndarray:
        """Power per area [W/m²] over row, place and station.

        The inner ring turns, so that of its sectors the mean counts. Of the outer ring it is the sector with the largest
        value per pass, times the mean number of passes of all sectors: a few rollers, or orbits that are no whole number,
        pass some sectors more often than others.
        """
        density = self.powers(name) / self.area[:, :, None]
        profile = np.empty((density.shape[0], len(PLACES), STATIONS))
        profile[:, 0] = density[:, 0].mean(axis=1)
        even = density[:, 1] * self.evenness()[..., None]
        for row, sectors in enumerate(even):
            worst = int(np.argmax(np.nan_to_num(sectors).max(axis=-1)))
            profile[row, 1] = sectors[worst]
        profile[:, 2] = self.roller_share(name).sum(axis=1)
        return profile

    def evenness(self) -> np.ndarray:
        """Mean passes of all sectors of the outer raceway over those of each sector, over row and angle; 0 without passes."""
        passes = self.result.surface_passes.sel(raceway="outer").transpose("row", "angle").values
        mean = passes.mean(axis=1, keepdims=True)
        return np.divide(mean, passes, out=np.zeros_like(passes), where=passes > 0.0)

    def roller_share(self, name: str) -> np.ndarray:
        """Per area of a roller [W/m²] over row, raceway and station."""
        return self.powers(name).sum(axis=2) / (self.bearing.rollers_per_row * self.roller_area)

    def pass_rates(self) -> np.ndarray:
        """Passes a second over a place of either ring and of a roller, from the orbits in the window; NaN without one."""
        turns = self.result.sizes["orbit"]
        time = float((self.result.orbit_end - self.result.orbit_start).sum())
        rate = turns / time if turns else math.nan
        outer = geometry.outer_contact_radius(self.bearing)
        count = self.bearing.rollers_per_row
        ring = count * outer / geometry.inner_contact_radius(self.bearing)
        return rate * np.array([ring, count, 2.0 * outer / geometry.roller_radius(self.bearing)])


def _few_rollers(result: xr.Dataset, given: RunInput) -> str:
    """A sentence where the simulated rollers do not stand for all at the outer raceway; empty otherwise."""
    simulated = result.sizes["roller"]
    if simulated == given.bearing.rollers_per_row:
        return ""
    if given.settings["loads"].get("event"):
        reason = "in an event"
    elif bool((result.surface_passes.sel(raceway="outer") == 0.0).any()):
        reason = "and these did not pass the whole raceway"
    else:
        return ""
    return _FEW_ROLLERS.format(all=given.bearing.rollers_per_row, some=simulated, why=reason)


def _outside_asperity_range(result: xr.Dataset) -> list[str]:
    """For how much of the loaded time the law of asperities is out of its range at the raceways, as a sentence."""
    if "outside_asperity_range" not in result:
        return []
    shares = result.outside_asperity_range.sel(interface=["inner", "outer"])
    shares = shares.transpose("row", ...).values.reshape(result.sizes["row"], -1)
    shares = np.nan_to_num(shares).mean(axis=1)
    if not (shares > 0.0).any():
        return []
    rows = " and ".join(
        f"{100.0 * share:.3g} % in the {row} row"
        for row, share in zip(result.row.values, shares, strict=True)
    )
    return [_LIGHT.format(rows=rows)]


def _films(result: xr.Dataset) -> dict[str, Any]:
    dims, found = ("row", "raceway"), {}
    for kind in ("time", "passes"):
        amounts = result[f"film_slip_{kind}"].transpose(*dims, "film_class", "slip_class").values
        shares = np.stack(
            [micropitting.share_below(amounts, FILM_EDGES, one) for one in FILM_EDGES], axis=-1
        )
        about = described(
            "1",
            f"share of {'loaded time' if kind == 'time' else 'passes'} with Lambda below film_ratio",
        )
        found[f"mixed_{kind}"] = ((*dims, "film_ratio"), shares, about)
        if kind == "time":
            thin = amounts[:, :, : FILM_EDGES.index(3.0) + 1].sum(axis=2)
            about = described(
                "1", "of the time with Lambda below 3 the share with the ring the slower surface"
            )
            found["slower_share"] = (dims, micropitting.slower_share(thin, SLIP_EDGES), about)
    return found


def _entries(result: xr.Dataset, rates: _Rates, own: Mapping[str, Threshold]) -> dict[str, Any]:
    """Largest values at entries, entries a second, and those beyond the limits."""
    dims, found = ("row", "raceway"), {}
    orbits = float((result.orbit_end - result.orbit_start).sum()) or math.nan
    count = result.entries.transpose("row", "roller", "orbit").values
    scale = rates.all_rollers / orbits
    about = described("1/s", "entries into the load zone of all rollers of a row")
    found["entry_rate"] = (("row",), np.nansum(count, axis=(1, 2)) * scale, about)
    for one in CRITERIA[:3]:
        values = result[one.name].transpose("row", "raceway", "roller", "orbit")
        largest = values.reduce(
            np.fmax.reduce, ("roller", "orbit")
        ).values  # without a warning where none entered
        found[one.name] = (
            dims,
            largest,
            described(one.unit, str(result[one.name].attrs["long_name"]).split(",")[0]),
        )
        limit = own[one.name].value if one.name in own else one.reference
        if math.isfinite(limit):
            beyond = smearing.entries_beyond(values.values, count[:, None], limit)
            for bound, number in zip(("least", "most"), beyond, strict=True):
                about = described(
                    "1/s", f"entries of all rollers beyond {limit:g} {one.unit}, at {bound}"
                )
                found[f"{one.name}_beyond_{bound}"] = (dims, number * scale, about)
    about = described("1", "least Lambda at entry")
    found["entry_film_ratio"] = (
        dims,
        result.entry_film_ratio.reduce(np.fmin.reduce, ("roller", "orbit")).transpose(*dims).values,
        about,
    )
    return found


def _wear(
    result: xr.Dataset, given: RunInput, rates: _Rates, coefficients: list[float], friction: float
) -> dict[str, Any]:
    """Work of asperities, time to depths, and worn profiles at the middle coefficient."""
    work = wear.worn_volume(1.0, rates.profile("surface_asperity_energy"), friction)
    about = described(
        "W/m2", "asperities' pressure times slip, mean over time: depth of wear a second over k"
    )
    rows = given.models
    times = np.full((len(rows), len(PLACES), len(wear.DEPTHS)), math.inf)
    depth = np.zeros((len(rows), len(_AGES), len(PLACES), STATIONS))
    middle = coefficients[len(coefficients) // 2]
    for r, row in enumerate(rows):
        if np.isnan(work[r]).any():
            times[r] = depth[r] = math.nan
            continue
        worn = _grown(
            result.sel(row=row),
            given,
            work[r],
            rates.roller_share("surface_asperity_energy")[r] / friction,
            row,
        )
        times[r] = np.stack([worn.work_at(one) for one in wear.DEPTHS], axis=-1)
        ages = np.array([worn.depth_at(middle * age * YEAR) for age in _AGES])
        depth[r] = ages.reshape(len(_AGES), len(PLACES), STATIONS, _SLICES).mean(axis=-1)
    return {
        "asperity_work_rate": (_PROFILE, work, about),
        "wear_time": (
            ("row", "place", "depth", "wear_coefficient"), times[..., None] / np.array(coefficients),
            described("s", "time like this window until the deepest place has worn by depth"),
        ),
        "worn_depth": (
            ("row", "place", "age", "station"), np.swapaxes(depth, 1, 2), described("m", f"depth of wear at k = {middle:g} m2/N")
        ),
    }  # fmt: skip


def _grown(
    row: xr.Dataset, given: RunInput, work: np.ndarray, roller_work: np.ndarray, name: str
) -> wear.Worn:
    """Wear of a row at the load that stands for it, as deep along the roller as its maps have it in the mean.

    `work` and `roller_work` are depth a second over k [W/m²] over place and station, and the roller's over raceway and
    station.
    """
    bearing, laws = given.bearing, given.models[name].laws
    width, count = bearing.roller_length / (_SLICES * STATIONS), _SLICES * STATIONS
    place = (np.arange(count) + 0.5) * width - 0.5 * bearing.roller_length
    curvatures = (
        geometry.inner_curvatures(bearing).lateral,
        geometry.outer_curvatures(bearing).lateral,
    )
    contacts, skew = [], _working_skew(row)
    for i, (law, curvature) in enumerate(zip((laws.inner, laws.outer), curvatures, strict=True)):
        load = float(row.working_load.isel(raceway=i))
        if not load > 0.0 or not work[i].sum() > 0.0:
            contacts.append(wear.Pressed(0.0, np.zeros(count), 1.0, np.zeros(count), 0.0, 0.0))
            continue
        contour, half = (
            0.5 * curvature * place**2,
            law.interface.hertz.semi_axis_across * load ** (1.0 / 3.0),
        )
        stiffness = wear.hertz_slices(load, half, curvature)
        pressed = wear.slice_loads(contour, load, stiffness, width)
        along = row.surface_work.isel(raceway=i).sum("angle").values
        slip = _slip_profile(law.shape, place, pressed, along, skew)
        total = (pressed * slip).sum() / _SLICES
        contacts.append(
            wear.Pressed(
                load, contour, stiffness, slip, work[i].sum() / total, roller_work[i].sum() / total
            )
        )
    return wear.grow((contacts[0], contacts[1]), width)


def _working_skew(row: xr.Dataset) -> float:
    """Root of the mean square of skew [rad], weighted by pressure times slip at the outer raceway, whose angle is the orbit's."""
    if "skew_by_position" not in row:
        return 0.0
    outer = row.sel(raceway="outer")
    work = outer.surface_work.sum("station").values
    passes = outer.surface_passes.values
    weight = np.divide(work, passes, out=np.zeros_like(work), where=passes > 0.0)
    return math.sqrt(
        (np.nan_to_num(row.skew_by_position.values) ** 2 * weight).sum() / max(weight.sum(), 1e-300)
    )


def _slip_profile(
    shape: Any, place: np.ndarray, pressed: np.ndarray, work: np.ndarray, skew: float
) -> np.ndarray:
    """|v| along the roller over the ring's speed [-]: skew, microslip, and the slip of the middle that fits ∫ p |v| dt best."""
    if not shape.microslip:
        return np.ones_like(place)
    own = shape.curvature_ratio / (2.0 * shape.contour_radius) * place**2 - shape.spin_ratio * place
    tried = np.linspace(-1.0, 1.0, _TRIED)[:, None] * np.abs(own[pressed > 0.0]).max()
    slips = np.hypot(own + tried, skew)
    profiles = (slips * pressed).reshape(_TRIED, STATIONS, _SLICES).sum(axis=-1)
    error = ((profiles / profiles.sum(axis=1, keepdims=True) - work / work.sum()) ** 2).sum(axis=1)
    return slips[int(np.argmin(error))]


def _answer(values: dict[str, float], own: Mapping[str, Threshold]) -> dict[str, Any]:
    value = np.array([values.get(one.name, math.nan) for one in CRITERIA])
    reference = np.array(
        [own[one.name].value if one.name in own else one.reference for one in CRITERIA]
    )
    lowest = np.array([one.lowest for one in CRITERIA])
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(lowest, reference / value, value / reference)
    return {
        "value": (("criterion",), value, described("see unit", "worst value of either row and any place")),
        "factor": (("criterion",), [one.factor for one in CRITERIA], described("1", "the value holds within this factor")),
        "reference": (("criterion",), reference, described("see unit", "what it is compared with; NaN where nothing could be traced")),
        "ratio": (("criterion",), ratio, described("1", "value over reference; of a time reference over value")),
    }  # fmt: skip


def lines(result: xr.Dataset) -> tuple[list[dict[str, Any]], list[str]]:
    """The answer of a result: one dictionary a criterion that was computed, and sentences on what is missing."""
    if "surface_work" not in result:
        return [], [_NO_DETAILS]
    if not stored_settings(result):
        return [], ["The result does not hold its input, which criteria of damage need."]
    return criterion_lines(damage(result))


def criterion_lines(found: xr.Dataset) -> tuple[list[dict[str, Any]], list[str]]:
    """The lines of a dataset of `damage`, and the sentences on what is missing."""
    kept = found.isel(criterion=np.flatnonzero(found.value.notnull().values))
    names = (
        "criterion",
        "title",
        "value",
        "unit",
        "reference",
        "compared_with",
        "ratio",
        "factor",
        "how_sure",
    )
    table = zip(*(kept[name].values.tolist() for name in names), strict=True)
    rows = [
        dict(zip((name.replace("_", " ") for name in names), line, strict=True)) for line in table
    ]
    for one in rows:
        one["compared with"] = one["compared with"] or "no traced reference"
    return rows, [line for line in found.attrs["not_kept"].split("\n") if line]
