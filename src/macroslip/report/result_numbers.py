"""Numbers of a result for its page, as plain data; None stands for an unknown number."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from macroslip.constants import HOURS_A_YEAR
from macroslip.imposed.status import Status
from macroslip.printed import number
from macroslip.report.page import Table
from macroslip.report.style import years
from macroslip.result.run_input import stored_settings, window_length
from macroslip.study.summary import RATING_VARIABLES

#: Keys of a case in which a result on imposed orbits may differ from the coupled one it is compared
#: with.
_OWN_KEYS = ("dynamics", "cage", "traces", "rollers")
#: Variables of a rating for the bearing as a whole, in the order of the table.
_RATING = (
    "static_safety",
    "equivalent_load",
    "fatigue_load_limit",
    "share_below_fatigue_load_limit",
    "minimum_load",
    "share_below_minimum_load",
    "viscosity_ratio",
    "life_modification",
    "basic_life",
    "modified_life",
)


def row_numbers(result: xr.Dataset) -> list[dict[str, Any]]:
    """The main numbers of each row of a result; None where one is not known.

    Of each row its `name`; `energy` [J], the mean of the rollers, `least` and `most`; `interface`
    with the largest energy and its `share` [%]; `rib` [J], the energy at a tapered roller's rib
    besides; `peak` [W], the largest power, and `typical` [W], the median over the orbits; `spin`
    [1], the lowest over pure rolling; `outside` [%], the share of loaded time outside the film
    formula's range, of the raceway with more, and `outside_most` [%] of any roller and interface;
    and how many `failed` of the `rollers`.
    """
    return [_of_row(result.sel(row=name)) for name in result.row.values]


def _of_row(row: xr.Dataset) -> dict[str, Any]:
    unknown = xr.full_like(row.energy, np.nan)
    energy = row.energy.sum("interface", skipna=False)
    by_interface = row.energy.mean("roller", skipna=False)
    total = known(energy.mean(skipna=False))
    interface = ""
    share = None
    if total:
        interface = str(by_interface.idxmax().item())
        largest = float(by_interface.max())
        share = 100.0 * largest / total
    peaks = row.get("peak_power", unknown)
    largest_peaks = row.get("window_peak_power", peaks)
    spin_ratios = row.get("min_spin_ratio", unknown)
    outside = 100.0 * row.get("outside_film_range", unknown)
    is_raceway = outside.interface.isin(["inner", "outer"])
    at_raceways = outside.sel(interface=is_raceway)
    return {
        "name": row.row.item(),
        "energy": total,
        "least": known(energy.min()),
        "most": known(energy.max()),
        "interface": interface,
        "share": share,
        "rib": known(row.get("rib_energy", unknown).mean(skipna=False)),
        "peak": known(largest_peaks.max()),
        "typical": known(peaks.max("interface").median()),
        "spin": known(spin_ratios.min()),
        "outside": known(at_raceways.mean("roller").max()),
        "outside_most": known(outside.max()),
        "failed": int((row.status != 0).sum()),
        "rollers": int(row.sizes["roller"]),
    }


def known(value: xr.DataArray | None) -> float | None:
    """A number; None where it is missing or not finite."""
    if value is None or not np.isfinite(value):
        return None
    return float(value)


def largest_peak(result: xr.Dataset) -> dict[str, Any] | None:
    """Largest frictional power of a result [W], with row and interface; None without one."""
    peak = result.get("window_peak_power", result.get("peak_power"))
    if peak is None or not bool(peak.notnull().any()):
        return None
    at_peak = peak.where(peak == peak.max(), drop=True).isel(row=0, interface=0)
    return {
        "power": float(peak.max()),
        "row": at_peak.row.item(),
        "interface": at_peak.interface.item(),
    }


def estimated_values(result: xr.Dataset) -> tuple[int, int]:
    """Numbers of engineering estimates and of all values of bearing and lubricant."""
    settings = stored_settings(result)
    entries = [
        value
        for part in ("bearing", "lubricant")
        for value in dict(settings.get(part) or {}).values()
    ]
    tags = [entry.get("tag") for entry in entries if isinstance(entry, dict)]
    return tags.count("E"), len(tags)


def rollers_failed(results: Iterable[xr.Dataset]) -> tuple[int, int]:
    """Number of rollers of some datasets that failed, and of all rollers."""
    failed = 0
    count = 0
    for result in results:
        failed += int((result.status != 0).sum())
        count += int(result.status.size)
    return failed, count


def failures(name: str, result: xr.Dataset) -> list[dict[str, Any]]:
    """Rollers of a result that failed, with the time and the cause."""
    if "end_time" not in result:
        return []
    status = result.status.transpose("row", "roller").values
    failed = np.argwhere(status != Status.COMPLETED)
    ends = (result.isel(row=row, roller=roller) for row, roller in failed)
    return [
        {
            "name": name,
            "row": end.row.item(),
            "roller": end.roller.item(),
            "time": float(end.end_time),
            "slip": float(end.end_slip),
            "how": Status(int(end.status)).sentence,
        }
        for end in ends
    ]


def overview_table(results: Mapping[str, xr.Dataset]) -> Table:
    """Energies, peaks, spins and failures of every result and row."""
    headings = (
        "", "row", "mean energy of a roller [J]", "least [J]", "most [J]", "highest P_max [W]",
        "lowest spin / pure rolling", "failed rollers",
    )  # fmt: skip
    keys = ("energy", "least", "most", "peak", "spin")
    rows = [
        (
            name,
            row["name"],
            *(number(row[key]) for key in keys),
            f"{row['failed']} of {row['rollers']}",
        )
        for name, result in results.items()
        for row in row_numbers(result)
    ]
    return Table(headings, rows)


def is_whole(result: xr.Dataset) -> bool:
    """True if orbit and spin were computed together."""
    is_solved_together = result.attrs.get("dynamics") == "whole-bearing"
    return is_solved_together and "momentum_residual" in result


def counterpart(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> str | None:
    """Name of the result on imposed orbits of the same case."""

    def common_settings(dataset: xr.Dataset) -> dict[str, Any]:
        return {
            key: value for key, value in stored_settings(dataset).items() if key not in _OWN_KEYS
        }

    others = {
        name: dataset
        for name, dataset in results.items()
        if dataset is not result and not is_whole(dataset)
    }
    return next(
        (
            name
            for name, dataset in others.items()
            if "input" in dataset.attrs and common_settings(dataset) == common_settings(result)
        ),
        None,
    )


def balances(result: xr.Dataset) -> dict[str, float]:
    """Residuals of a whole bearing's balances, and all that has passed through: [N m s] and [J]."""
    impulses = [
        str(name) for name in result if str(name).endswith("_impulse") and "book" in str(name)
    ]
    losses = ("book_raceway_loss", "book_friction_loss", "pocket_loss")
    return {
        "momentum": float(abs(result.momentum_residual).max()),
        "impulse": max(float(abs(result[name]).max()) for name in impulses),
        "energy": float(abs(result.energy_residual).max()),
        "spent": sum(float(result[name].isel(book_time=-1)) for name in losses),
    }


def comparison_table(result: xr.Dataset, imposed: xr.Dataset) -> Table:
    """Energy of friction at every interface beside that of the case on imposed orbits."""
    before = imposed.energy.mean("roller")
    now = result.energy.mean("roller")
    ratio = now / before.where(before > 0.0)
    rows = []
    for row, interface in itertools.product(now.row.values, now.interface.values):
        energies = [float(side.sel(row=row, interface=interface)) for side in (before, now)]
        cells = [f"{energy:.4g}" for energy in energies]
        ratio_here = ratio.sel(row=row, interface=interface)
        rows.append((row, interface, *cells, number(ratio_here)))
    return Table(("row", "interface", "imposed orbit [J]", "whole bearing [J]", "ratio"), rows)


def pocket_table(result: xr.Dataset) -> Table:
    """Forces of the spars of a whole bearing."""
    span = window_length(result)
    largest = result.largest_pocket_force.max("roller")
    mean = result.pocket_impulse.mean("roller") / span
    contact_time = result.pocket_contact_time.mean("roller")
    contact = 100.0 * contact_time / span
    rows = []
    for row, side in itertools.product(result.row.values, result.side.values):
        spar = {"row": row, "side": side}
        force = float(largest.sel(spar))
        average = float(mean.sel(spar))
        share = float(contact.sel(spar))
        rows.append((row, side, f"{force:.4g}", f"{average:.4g}", f"{share:.3g}"))
    headings = (
        "row",
        "spar",
        "largest force [N]",
        "mean force on a roller [N]",
        "time in contact [%]",
    )
    about = "Forces of the spars in the window; front is the spar ahead along the orbit."
    return Table(headings, rows, about)


def rating_tables(result: xr.Dataset) -> list[Table]:
    """The rating of a result: the bearing as a whole, its raceways, damage-equivalent loads."""
    whole = []
    for name in _RATING:
        meaning = str(result[name].attrs["long_name"])
        whole.append((meaning, rating_text(result[name])))
    for along, words in (("hertz", "as in a Hertz contact"), ("uniform", "even along the roller")):
        under_load = result.sel(load_along_roller=along)
        whole.append(
            (f"reference life, ISO/TS 16281, load {words}", rating_text(under_load.reference_life))
        )
        whole.append(
            (
                f"modified reference life, load {words}",
                rating_text(under_load.modified_reference_life),
            )
        )
    raceways = []
    for row in result.row.values.tolist():
        for raceway in ("inner", "outer"):
            at_raceway = result.sel(row=row, raceway=raceway, load_along_roller="hertz")
            values = (
                1e-3 * at_raceway.largest_roller_load,
                1e-9 * at_raceway.largest_pressure,
                at_raceway.film_ratio,
                at_raceway.film_ratio_low,
            )
            cells = [
                rating_text(value)
                for value in (
                    *(drawn.drop_attrs() for drawn in values),
                    at_raceway.raceway_reference_life,
                )
            ]
            raceways.append((f"{row}, {raceway}", *cells))
    headings = (
        "row, raceway",
        "largest roller load [kN]",
        "largest pressure [GPa]",
        "film ratio Λ, median",
        "Λ, 5 % of loaded rollers below",
        "reference life",
    )
    exponents = result.wohler_exponent.values.tolist()
    ranges = [
        (
            load,
            *(
                rating_text(result.damage_equivalent_load.sel(load=load, wohler_exponent=exponent))
                for exponent in exponents
            ),
        )
        for load in result["load"].values.tolist()
    ]
    loads = Table(
        ("load", *(f"exponent {exponent:g}" for exponent in exponents)),
        ranges,
        "Damage-equivalent load, range at 1 Hz",
    )
    return [Table(("bearing", "value"), whole), Table(headings, raceways), loads]


def rating_summary(study: xr.Dataset) -> Table | None:
    """Least, median and largest rating numbers of the runs of a study; None without any."""
    if "static_safety" not in study or not bool(study.static_safety.notnull().any()):
        return None
    rows = []
    for name in RATING_VARIABLES:
        values = study[name].dropna("case")
        if values.size:
            ends = (
                values.min(keep_attrs=True),
                values.median(keep_attrs=True),
                values.max(keep_attrs=True),
            )
            meaning = str(study[name].attrs["long_name"])
            rows.append((meaning, *map(rating_text, ends)))
    return Table(("", "least", "median of the runs", "largest"), rows)


def rating_text(value: xr.DataArray) -> str:
    """A number with its unit, in usual units: kN, years, per cent.

    Examples
    --------
    >>> rating_text(xr.DataArray(87660.0, attrs={"units": "h"}))
    '10 years'
    >>> rating_text(xr.DataArray(1.5e5, attrs={"units": "N"}))
    '150 kN'
    """
    amount = float(value)
    units = value.attrs.get("units", "")
    if not np.isfinite(amount):
        return "unlimited" if amount > 0.0 else "–"
    if units == "N":
        return f"{1e-3 * amount:.4g} kN"
    if units == "Pa":
        return f"{1e-9 * amount:.3g} GPa"
    if units == "h":
        return years(amount)
    if str(value.name).startswith("share"):
        return f"{100.0 * amount:.3g} %"
    return f"{amount:.3g}"


def usual_units(value: float, unit: str) -> str:
    """A value of a criterion with its unit, in usual units; a dash where there is none.

    Examples
    --------
    >>> usual_units(7.17e4, "W/m2"), usual_units(2.26e12, "J/m2"), usual_units(704.05, "year")
    ('0.072 W/mm²', '2.3 MJ/mm²', 'beyond 500 years')
    """
    if np.isnan(value):
        return "–"
    if unit == "year":
        return years(value * HOURS_A_YEAR)
    scale, name = {"W/m2": (1e-6, " W/mm²"), "J/m2": (1e-6, " J/mm²"), "1": (1.0, "")}.get(
        unit, (1.0, f" {unit}")
    )
    scaled = value * scale
    if name == " J/mm²" and scaled >= 1e3:
        factor = 1e-3
        name = " kJ/mm²"
        if scaled >= 1e6:
            factor = 1e-6
            name = " MJ/mm²"
        scaled = factor * scaled
    return f"{float(f'{scaled:.2g}'):g}{name}"


def criteria_table(lines: Sequence[Mapping[str, Any]]) -> Table:
    """Criteria of damage from `macroslip.result.damage.lines`, with their factors either way."""
    rows = []
    for line in lines:
        value = usual_units(line["value"], line["unit"])
        reference = usual_units(line["reference"], line["unit"])
        has_reference = np.isfinite(line["reference"])
        ratio = number(line["ratio"], 2)
        if 0.0 < line["ratio"] < 1e-3:
            ratio = "< 0.001"
        rows.append(
            (
                line["title"],
                value,
                f"{reference}, {line['compared with']}" if has_reference else "–",
                ratio,
                f"{line['factor']:g}",
            )
        )
    return Table(("criterion", "value", "reference", "ratio", "known to a factor of"), rows)


def how_sure(lines: Sequence[Mapping[str, Any]]) -> str:
    """Uncertainties of the values of criteria, once for all criteria that share one.

    Examples
    --------
    >>> both = [{"mechanism": "wear", "how sure": "factor 10: k"} for _ in "ab"]
    >>> how_sure(both)
    'factor 10: k (wear)'
    """
    mechanisms: dict[str, dict[str, None]] = {}
    for line in lines:
        mechanisms.setdefault(line["how sure"], {})[line["mechanism"]] = None
    parts = [f"{reason} ({', '.join(names)})" for reason, names in mechanisms.items()]
    return "; ".join(parts)


def by_raceway(values: xr.DataArray) -> list[tuple[str, str, float]]:
    """Row, raceway and largest value of every map."""
    other_dims = [dim for dim in values.dims if dim not in ("row", "raceway")]
    largest = values.max(other_dims)
    return [
        (row, raceway, float(largest.sel(row=row, raceway=raceway)))
        for row, raceway in itertools.product(values.row.values.tolist(), ("outer", "inner"))
    ]


def surface_shares(density: xr.DataArray) -> list[dict[str, Any]]:
    """Parts of the energy with slip < 0 and with Λ < 1 [%], for each row that dissipates energy."""
    other_dims = [dim for dim in density.dims if dim != "row"]
    total = density.sum(other_dims)
    shares = 100.0 * density / total.where(total > 0.0)
    return [
        {
            "row": row,
            "negative": float(shares.sel(row=row, slip_sign="negative").sum()),
            "thin": float(shares.sel(row=row, film_regime="below 1").sum()),
        }
        for row in total.row.values[total.values > 0.0].tolist()
    ]


def least_film_ratios(orbit: xr.Dataset) -> list[tuple[str, str, float]]:
    """Row, raceway and least median Λ over the orbit, where there is a film."""
    median = orbit.film_parameter.sel(quantile=0.5, interface=["inner", "outer"])
    least = median.min("angle")
    return [
        (row, interface, float(least.sel(row=row, interface=interface)))
        for row, interface in itertools.product(least.row.values, least.interface.values)
        if np.isfinite(least.sel(row=row, interface=interface))
    ]
