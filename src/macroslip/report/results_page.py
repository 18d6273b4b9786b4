"""The page on results of `macroslip run` and of `macroslip.simulate`."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.report import bearing_figures as draw
from macroslip.report import result_numbers as numbers
from macroslip.report.answer import answer
from macroslip.report.bearing_view import scene_data
from macroslip.report.page import Opening, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.study_figures import plot_by_result
from macroslip.report.style import OPENING, ROUND, Picture, compared, picture, row_pictures
from macroslip.result.damage import damage, lines
from macroslip.result.orbit import orbit_profile
from macroslip.result.plausibility import doubtful_result
from macroslip.result.run_input import run_input, window_length
from macroslip.result.surface_maps import energy_density, roller_energy_density

if TYPE_CHECKING:
    import xarray as xr
    from markupsafe import Markup

#: Results shown roller by roller, and with the bearing in motion, on one page; the table holds all
#: of them.
DETAILED = 6
MOVING = 3
#: Results that a subtitle names.
_NAMED = 8
_TEMPLATE = "result.html"
_BEARING = "All rows of rollers, coloured by slip, at the moment of the largest frictional power"
_PEAKS = "Share of orbits whose largest power exceeds a value"
_ZONE = "Heat map of the roller load of the {} row over angle and time"
#: Extremes of several results: key of `row_numbers`, label of the picture, and whether the least is
#: meant.
_EXTREMES = (
    ("energy", "energy of a mean roller [J]", False),
    ("peak", "largest frictional power [W]", False),
    ("spin", "lowest spin / pure rolling [–]", True),
    ("outside_most", "loaded time outside film range [%]", False),
)


@dataclass(frozen=True, slots=True)
class ShownResult:
    """A result with the numbers and curves of its page."""

    result: xr.Dataset
    profile: Mapping[str, xr.Dataset] | None  #: From `orbit_profile`; None without traces
    no_traces: str  #: Why there is no profile
    criteria: Sequence[Mapping[str, Any]]  #: Of damage, from `macroslip.result.damage.lines`
    missing: Sequence[str]  #: Sentences on criteria that are missing


def results_page(results: Mapping[str, xr.Dataset], *, title: str = "Slip of the rollers") -> str:
    """A page on results of `macroslip.simulate` by name: HTML in one piece, all text escaped.

    A result has `energy` [J] over (row, roller, interface) and `status` over (row, roller);
    variables beyond these, and traces, add to the page. Raises InputError if there is no dataset,
    or one is no result.
    """
    if not results:
        raise InputError("there is no result to report on")
    for name, dataset in results.items():
        _check(name, dataset)
    detailed = itertools.islice(results.items(), DETAILED)
    shown = {name: _shown(result) for name, result in detailed}
    is_alone = len(results) == 1
    parts = sections(_TEMPLATE, {"numbers": _numbers(results, is_alone), "bearing": _motion(shown)})
    for number, (name, details) in enumerate(shown.items()):
        parts += sections(
            _TEMPLATE,
            _roller_bodies(details)
            | _surface_bodies(details.result)
            | _further_bodies(details, results),
            suffix=f"-{number}" if number else "",
            group="" if is_alone else name,
        )
    parts.append(provenance_section(results))
    if is_alone:
        (only,) = shown.values()
        return render(title, _subtitle(only.result), result_opening(only), parts)
    names = ", ".join(list(results)[:_NAMED])
    if len(results) > _NAMED:
        names += " …"
    return render(title, f"{len(results)} results: {names}.", results_opening(results), parts)


def _check(name: str, dataset: xr.Dataset) -> None:
    missing = [variable for variable in ("energy", "status") if variable not in dataset]
    missing += [dim for dim in ("row", "roller", "interface") if dim not in dataset.dims]
    if missing:
        raise InputError(
            f"the dataset has no {', no '.join(missing)}",
            where=name,
            allowed="what macroslip run or macroslip.simulate gives",
        )


def _shown(result: xr.Dataset) -> ShownResult:
    profile = None
    no_traces = ""
    try:
        profile = orbit_profile(result)
    except InputError as error:
        no_traces = str(error)
    return ShownResult(result, profile, no_traces, *lines(result))


def _subtitle(result: xr.Dataset) -> str:
    parts = [str(result.attrs.get("title", "")).rstrip(".")]
    if "window_end" in result.attrs:
        start = float(result.attrs["window_start"])
        end = float(result.attrs["window_end"])
        parts.append(f"{start:.4g} s to {end:.4g} s")
    return f"{', '.join(filter(None, parts))}."


def result_opening(shown: ShownResult) -> Opening:
    """The opening for one result: the answer in sentences, pictures, criteria of damage.

    The pictures are the bearing coloured by slip, load zone, slip over the orbit and the criteria;
    where there are no traces or no criteria, energies and peaks take their place.
    """
    result = shown.result
    sentences = words("parts.html").sentences(
        answer(result, shown.criteria), doubtful_result(result)
    )
    pictures = []
    if shown.profile:
        load = shown.profile["load_zone"].roller_load
        # The row with more load, and slip of all.
        mean_load = load.mean(("angle", "time"))
        loaded_row = str(load.row[int(mean_load.argmax("row"))].item())
        bearing = run_input(result).bearing
        pictures = [
            picture(draw.plot_bearing, _BEARING, shown.profile["still"], bearing),
            picture(draw.plot_load_zone, _ZONE.format(loaded_row), load, loaded_row),
            picture(
                draw.plot_slip_over_orbit,
                "Slip of the rollers of all rows over the orbit",
                shown.profile["orbit"].slip,
                **OPENING,
            ),
        ]
    if shown.criteria:
        pictures.append(_criteria_picture(result))
    if len(pictures) < 4:
        pictures += _energy_bars(result)
        peak = numbers.largest_peak(result)
        if not shown.profile and peak and peak["power"] > 0.0:
            pictures.append(picture(draw.plot_peak_exceedance, _PEAKS, result, **OPENING))
    below = words(_TEMPLATE).criteria(
        numbers.criteria_table(shown.criteria),
        numbers.how_sure(shown.criteria),
        shown.missing,
        shown.no_traces,
        "damage",
    )
    return Opening(sentences, pictures, below=below)


def _criteria_picture(result: xr.Dataset) -> Picture:
    about = "Criteria of damage over what each is compared with, on a logarithmic scale"
    return picture(draw.plot_criteria, about, damage(result))


def _energy_bars(result: xr.Dataset) -> list[Picture]:
    about = "Bars of a mean roller's energy by interface and row"
    return _bars(draw.plot_energy_by_interface, about, result.energy)


def _bars(plot: Callable[..., object], about: str, values: xr.DataArray) -> list[Picture]:
    """The picture, if any of the values is above 0."""
    if np.nanmax(values.values, initial=0.0) > 0.0:
        return [picture(plot, about, values, legend="above")]
    return []


def results_opening(results: Mapping[str, xr.Dataset]) -> Opening:
    """The opening for several results."""
    by_result = {name: numbers.row_numbers(result) for name, result in results.items()}
    rows = [row["name"] for row in next(iter(by_result.values()))]
    extremes: dict[str, dict[str, Any]] = {}
    pictures = []
    for key, label, is_least in _EXTREMES:
        by_row = []
        for numbers_of_rows in by_result.values():
            by_row.append({row["name"]: row[key] for row in numbers_of_rows})
        table = [[known.get(row) for row in rows] for known in by_row]
        values = np.array(table, dtype=float)
        if np.isfinite(values).any():
            extreme = np.nanargmin(values) if is_least else np.nanargmax(values)
            which, row = np.unravel_index(extreme, values.shape)
            extremes[key] = {
                "name": list(results)[which],
                "row": rows[row],
                "value": float(values[which, row]),
            }
            pictures.append(
                picture(
                    plot_by_result,
                    f"By result and row: {label}",
                    list(results),
                    rows,
                    values,
                    label,
                    **OPENING,
                )
            )
    failed = numbers.rollers_failed(results.values())
    sentences = words(_TEMPLATE).comparison(len(results), *failed, extremes)
    doubts = [
        f"{name}: {line}" for name, result in results.items() for line in doubtful_result(result)
    ]
    return Opening(sentences + words("parts.html").doubts(doubts), pictures)


def _numbers(results: Mapping[str, xr.Dataset], is_alone: bool) -> Markup:
    """The section with the numbers of every result; of one alone with sentences on its losses."""
    text = words(_TEMPLATE)
    losses = ""
    if is_alone:
        (result,) = results.values()
        seconds = None
        if "window_end" in result.attrs:
            seconds = window_length(result)
        losses = text.losses(
            numbers.row_numbers(result),
            seconds,
            numbers.largest_peak(result),
            numbers.rollers_failed([result]),
            numbers.estimated_values(result),
        )
    return text.numbers(
        numbers.overview_table(results),
        [line for name, result in results.items() for line in numbers.failures(name, result)],
        DETAILED if len(results) > DETAILED else None,
        losses,
    )


def _motion(shown: Mapping[str, ShownResult]) -> Markup | str:
    """The moving bearing of the first results with traces; empty if none has them."""
    moving = {name: details for name, details in shown.items() if details.profile}
    moving = dict(itertools.islice(moving.items(), MOVING))
    if not moving:
        return ""
    scenes = {name: details.profile["scene"] for name, details in moving.items() if details.profile}
    drawn = {
        name: scene_data(scene, run_input(moving[name].result).bearing)
        for name, scene in scenes.items()
    }
    time = next(iter(scenes.values())).time
    pockets = any("pocket_offset" in scene for scene in scenes.values())
    return words(_TEMPLATE).motion(drawn, float(time[0]), float(time[-1]), pockets)


def _roller_bodies(shown: ShownResult) -> dict[str, Markup]:
    """Bodies of the sections on all rollers: energy, power, load zone, films."""
    text = words(_TEMPLATE)
    result = shown.result
    bodies = {"energy": _energy(shown)}
    if np.nanmax(result.peak_power.values, initial=0.0) > 0.0:
        peaks = picture(draw.plot_peak_exceedance, _PEAKS, result, legend="above")
        bodies["power"] = text.power([peaks])
    films = []
    least = []
    if shown.profile:
        orbit = shown.profile["orbit"]
        load = shown.profile["load_zone"].roller_load
        rows = orbit.row.values.tolist()
        largest = []
        for row in rows:
            kilonewtons = 1e-3 * float(load.sel(row=row).max())
            largest.append((row, kilonewtons))
        zones = row_pictures(draw.plot_load_zone, _ZONE, load, rows)
        bodies["load-zone"] = text.load_zone(zones, largest)
        about = "Film thickness and film parameter of the {} row over the orbit, by interface"
        films = row_pictures(draw.plot_film_over_orbit, about, orbit, rows, legend="above")
        least = numbers.least_film_ratios(orbit)
    about = "Bars of the share of loaded time outside the film formula's range"
    outside = _bars(draw.plot_outside_film_range, about, result.outside_film_range)
    bodies["films"] = text.films(films, least, outside)
    return bodies


def _energy(shown: ShownResult) -> Markup:
    """The section on energy: over the orbit, by interface and mechanism, and roller by roller."""
    result = shown.result
    over_orbit = []
    about_orbit = None
    if shown.profile:
        orbit = shown.profile["orbit"]
        energy = orbit.energy_over_orbit
        about = "Polar plot of the energy of the {} row over the orbit, by interface"
        rows = orbit.row.values.tolist()
        over_orbit = row_pictures(
            draw.plot_energy_over_orbit, about, energy, rows, **ROUND, legend="below"
        )
        about_orbit = {**energy.attrs, "sector": 360.0 / orbit.sizes["angle"]}
    pictures = _energy_bars(result)
    total = result.energy.sum("interface", skipna=False).mean("roller")
    dissipating = total.row.values[total.values > 0.0].tolist()
    about = "Energy of each roller of the {} row over the mean of the row"
    pictures += row_pictures(draw.plot_roller_spread, about, result.energy, dissipating)
    if "skew_by_position" in result:
        about = "Skew of pressed rollers over the orbit, and what it adds to their power"
        pictures.append(picture(draw.plot_skew_over_orbit, about, result, legend="above"))
    if "mechanism_energy" in result:
        about = "Bars of a mean roller's energy by mechanism and row"
        energies = result.mechanism_energy
        pictures.append(picture(draw.plot_by_mechanism, about, energies, legend="above"))
    spread = [row for row in numbers.row_numbers(result) if row["least"]]
    return words(_TEMPLATE).energy(
        str(result.attrs.get("title", "")),
        shown.no_traces,
        over_orbit,
        about_orbit,
        pictures,
        spread,
    )


def _surface_bodies(result: xr.Dataset) -> dict[str, Markup]:
    """Body of the section with the maps of the raceways, where the result has them."""
    if "surface_energy" not in result:
        return {}
    bearing = run_input(result).bearing
    along = roller_energy_density(result, bearing)
    about = "Energy per area along the rollers of the {} row, by sign of slip and film ratio"
    rows = along.row.values.tolist()
    profiles = row_pictures(draw.plot_along_roller, about, along, rows, legend="above")
    of = f"of {result.sizes['roller']} of {bearing.rollers_per_row} rollers of each row"
    maps = map_pictures(energy_density(result), result.surface_power_density)
    surface = words(_TEMPLATE).surface(*maps, of, profiles, numbers.surface_shares(along))
    return {"surface": surface}


def _further_bodies(shown: ShownResult, results: Mapping[str, xr.Dataset]) -> dict[str, Markup]:
    """Bodies of the sections on damage, rating and a whole bearing."""
    result = shown.result
    text = words(_TEMPLATE)
    bodies = {"damage": _damage(shown)}
    if "rating_problem" in result.attrs:
        bodies["rating"] = text.not_rated(result.attrs["rating_problem"])
    elif "static_safety" in result:
        about = "Share of time in which the load of the bearing exceeds a value"
        duration = picture(draw.plot_load_duration, about, result, legend="above")
        contamination = float(result.attrs["rating_contamination"])
        bodies["rating"] = text.rating(contamination, numbers.rating_tables(result), [duration])
    if numbers.is_whole(result):
        bodies["whole"] = whole_body(result, results)
    return bodies


def _damage(shown: ShownResult) -> Markup:
    """Damage by slip: criteria, worn profiles, time by film and slide-roll ratio."""
    result = shown.result
    pictures = []
    if shown.criteria:
        criteria = damage(result)
        pictures.append(_criteria_picture(result))
        if "worn_depth" in criteria:
            about = "Depth of wear of the {} row along the roller over the years"
            rows = criteria.row.values.tolist()
            pictures += row_pictures(draw.plot_worn_profile, about, criteria, rows, legend="above")
    if "film_slip_time" in result:
        about = "Share of the time under load by film ratio and slide-roll ratio"
        time = result.film_slip_time
        panels = {
            f"{about}, {row} row, {raceway} raceway": (
                time.sel(row=row, raceway=raceway),
                draw.FILM_AND_SLIP["time"],
                f"{row} row, {raceway}",
            )
            for row, raceway in itertools.product(time.row.values, time.raceway.values)
        }
        pictures += compared(draw.plot_film_and_slip, panels)
    return words(_TEMPLATE).criteria(
        numbers.criteria_table(shown.criteria),
        numbers.how_sure(shown.criteria),
        shown.missing,
        pictures=pictures,
    )


def map_pictures(energy: xr.DataArray, density: xr.DataArray) -> list[Any]:
    """Maps of energy [J/m²] and power [W/m²] per area, each followed by their maxima."""
    pictures: list[Any] = []
    for values, units in ((energy, "J/mm²"), (density, "W/mm²")):
        panels = {
            f"Map of the {title}, {units}": (of_raceway, units, title)
            for title, of_raceway in draw.raceways(values).items()
        }
        pictures += [compared(draw.plot_map, panels), numbers.by_raceway(1e-6 * values)]
    return pictures


def whole_body(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> Markup:
    """Coupled motion of a whole bearing beside the same case on imposed orbits."""
    rows = result.row.values.tolist()
    cages = [
        {
            "name": name,
            "slip": 100.0 * result.cage_slip.sel(cage=name).item(),
            "deviation": 100.0 * result.cage_slip_deviation.sel(cage=name).item(),
        }
        for name in result.cage.values.tolist()
    ]
    imposed = numbers.counterpart(result, results)
    about = "Polar plot of the largest force of a spar on the {} row by place on the orbit"
    pictures = row_pictures(draw.plot_force_by_position, about, result, rows, **ROUND)
    if result.sizes["book_time"] > 2:
        about = "Residuals of the balances of momentum and energy over time"
        pictures.append(picture(draw.plot_residuals, about, result, legend="above"))
    top = result.largest_force_by_position.sel(position=np.radians(90.0), method="nearest")
    return words(_TEMPLATE).whole(
        cages,
        numbers.balances(result) | {"warning": result.attrs.get("books_warning", "")},
        imposed,
        numbers.comparison_table(result, results[imposed]) if imposed else None,
        numbers.pocket_table(result),
        pictures,
        [(row, float(top.sel(row=row))) for row in rows],
    )
