"""The page on results of `macroslip run` and of `macroslip.simulate`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.report import bearing_figures as draw
from macroslip.report import result_numbers as numbers
from macroslip.report.bearing_view import scene_data
from macroslip.report.page import Opening, Section, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.study_figures import plot_by_result
from macroslip.report.style import OPENING, ROUND, Picture, compared, picture, row_pictures
from macroslip.result.damage import damage, lines
from macroslip.result.orbit import orbit_profile
from macroslip.result.plausibility import doubtful_result
from macroslip.result.run_input import run_input
from macroslip.result.surface_maps import energy_density, roller_energy_density

if TYPE_CHECKING:
    import xarray as xr
    from markupsafe import Markup

    Profile = Mapping[str, xr.Dataset]

#: Results shown roller by roller, and with the bearing in motion, on one page; the table holds all of them.
DETAILED, MOVING = 6, 3
_TEMPLATE = "result.html"
_BEARING = "Both rows of rollers, coloured by slip, at the moment of the largest frictional power"
_PEAKS = "Share of orbits whose largest power exceeds a value"
_SPREAD = "Energy of each roller of the {} row over the mean of the row"
_ORBIT = "Polar plot of the energy of the {} row over the orbit, by interface"
_ZONE = "Heat map of the roller load of the {} row over angle and time"


def results_page(results: Mapping[str, xr.Dataset], *, title: str = "Slip of the rollers") -> str:
    """A page on results of `macroslip.simulate` by name: HTML in one piece, every name and text in it escaped.

    A result has `energy` [J] over (row, roller, interface) and `status` over (row, roller); variables beyond these, and
    traces, add to the page. Raises InputError if there is no dataset, or one is no result.
    """
    if not results:
        raise InputError("there is no result to report on")
    for name, dataset in results.items():
        _check(name, dataset)
    shown = dict(list(results.items())[:DETAILED])
    profiles: dict[str, dict[str, xr.Dataset]] = {}
    reasons = {}
    for name, result in shown.items():
        try:
            profiles[name] = orbit_profile(result)
        except InputError as error:
            reasons[name] = str(error)
    failed = [line for name, one in results.items() for line in numbers.failures(name, one)]
    first, result = next(iter(results.items()))
    alone = len(results) == 1
    sentences = _sentences(result, short=False) if alone and lines(result)[0] else ""
    overview = words(_TEMPLATE).numbers(
        numbers.overview_table(results),
        failed,
        DETAILED if len(results) > DETAILED else None,
        sentences,
    )
    found = sections(_TEMPLATE, {"numbers": overview})
    if profiles:
        found.append(view_section(dict(list(profiles.items())[:MOVING])))
    for place, (name, one) in enumerate(shown.items()):
        options = {"suffix": f"-{place}" if place else "", "group": "" if alone else name}
        intro = str(one.attrs.get("title", ""))
        found += roller_sections(
            one, profiles.get(name), intro=intro, no_traces=reasons.get(name, ""), **options
        )
        found += _further_sections(one, results, **options)
    found.append(provenance_section(results))
    if alone:
        opening = result_opening(result, profiles.get(first), reasons.get(first, ""))
        return render(title, _subtitle(result), opening, found)
    names = f"{', '.join(list(results)[:8])}{' …' if len(results) > 8 else ''}"
    return render(title, f"{len(results)} results: {names}.", results_opening(results), found)


def _check(name: str, dataset: xr.Dataset) -> None:
    missing = [one for one in ("energy", "status") if one not in dataset]
    missing += [one for one in ("row", "roller", "interface") if one not in dataset.dims]
    if missing:
        allowed = "what macroslip run or macroslip.simulate gives"
        raise InputError(f"the dataset has no {', no '.join(missing)}", where=name, allowed=allowed)


def _subtitle(result: xr.Dataset) -> str:
    parts = [str(result.attrs.get("title", "")).rstrip(".")]
    if "window_end" in result.attrs:
        parts.append(
            f"{float(result.attrs['window_start']):.4g} s to {float(result.attrs['window_end']):.4g} s"
        )
    return f"{', '.join(filter(None, parts))}."


def result_opening(result: xr.Dataset, profile: Profile | None, no_traces: str = "") -> Opening:
    """The opening for one result: `profile` from `orbit_profile`, or why there is none.

    The bearing coloured by slip, load zone and slip over the orbit, then a line for every criterion of damage; where
    there are no traces or no criteria, energies and peaks take their place.
    """
    text, pictures = words(_TEMPLATE), []
    found, missing = lines(result)
    if profile:
        load, about = (
            profile["load_zone"].roller_load,
            "Slip of the rollers of both rows over the orbit",
        )
        # The row with more load, and slip of both.
        carries = str(load.row[int(np.argmax(load.mean(("angle", "time")).values))].item())
        plain = {**OPENING, "legend": ""}
        pictures = [
            picture(
                draw.plot_bearing, _BEARING, profile["still"], run_input(result).bearing, **plain
            ),
            picture(draw.plot_load_zone, _ZONE.format(carries), load, carries, **plain),
            picture(draw.plot_slip_over_orbit, about, profile["orbit"].slip, **OPENING),
        ]
    if len(pictures) < 3 or not found:
        pictures += _bars(
            draw.plot_energy_by_interface,
            "Energy of a mean roller by interface",
            result.energy,
            **OPENING,
        )
        peak = numbers.largest_peak(result)
        if not profile and peak and peak["power"] > 0.0:
            pictures.append(picture(draw.plot_peak_exceedance, _PEAKS, result, **OPENING))
    criteria = text.criteria(numbers.criteria_table(found), missing, no_traces, "damage")
    return Opening(_sentences(result, short=bool(found)), pictures, below=criteria)


def _bars(
    plot: Callable[..., object], about: str, values: xr.DataArray, **options: Any
) -> list[Picture]:
    return (
        [picture(plot, about, values, **options)]
        if np.nanmax(values.values, initial=0.0) > 0.0
        else []
    )


def _sentences(result: xr.Dataset, *, short: bool) -> Markup:
    seconds = None
    if "window_end" in result.attrs:
        seconds = float(result.attrs["window_end"]) - float(result.attrs["window_start"])
    known = numbers.rollers_failed([result]), numbers.estimated_values(result)
    rows, peak = numbers.row_numbers(result), numbers.largest_peak(result)
    idle, orbits = (
        result.attrs.get("oil_supply_note", "").startswith("oil_supply "),
        result.sizes.get("orbit", 1),
    )
    sentences = words(_TEMPLATE).answer(
        rows, seconds, orbits, peak, *known[0], *known[1], short, idle
    )
    # In full the range of the films has its sentence already.
    judged = result if short else result.drop_vars("outside_film_range", errors="ignore")
    return sentences + words("parts.html").doubts(doubtful_result(judged))


def results_opening(results: Mapping[str, xr.Dataset]) -> Opening:
    """The opening for several results."""
    found = {name: numbers.row_numbers(one) for name, one in results.items()}
    rows = [row["name"] for row in next(iter(found.values()))]
    extremes, pictures = {}, []
    for key, label, extreme in (
        ("energy", "energy of a mean roller [J]", np.nanargmax),
        ("peak", "largest frictional power [W]", np.nanargmax),
        ("spin", "lowest spin / pure rolling [–]", np.nanargmin),
        ("outside_most", "loaded time outside film range [%]", np.nanargmax),
    ):
        lines = [{row["name"]: row[key] for row in one} for one in found.values()]
        values = np.array([[line.get(row) for row in rows] for line in lines], dtype=float)
        if not np.isfinite(values).any():
            continue
        place, row = np.unravel_index(extreme(values), values.shape)
        extremes[key] = {
            "name": list(found)[place],
            "row": rows[row],
            "value": float(values[place, row]),
        }
        about = f"By result and row: {label}"
        pictures.append(picture(plot_by_result, about, list(found), rows, values, label, **OPENING))
    failed = numbers.rollers_failed(results.values())
    sentences = words(_TEMPLATE).comparison(
        len(results), *failed, *(extremes.get(key) for key in ("energy", "peak", "spin"))
    )
    doubts = [f"{name}: {line}" for name, one in results.items() for line in doubtful_result(one)]
    return Opening(sentences + words("parts.html").doubts(doubts), pictures)


def view_section(profiles: Mapping[str, Profile]) -> Section:
    """The moving bearing, with the profiles of `orbit_profile` by title."""
    scenes = {
        title: scene_data(profile["scene"], run_input(profile["result"]).bearing)
        for title, profile in profiles.items()
    }
    first = next(iter(profiles.values()))["scene"].time
    pockets = any("pocket_offset" in profile["scene"] for profile in profiles.values())
    body = words(_TEMPLATE).motion(scenes, float(first[0]), float(first[-1]), pockets)
    return sections(_TEMPLATE, {"bearing": body})[0]


def roller_sections(
    result: xr.Dataset,
    profile: Profile | None = None,
    *,
    suffix: str = "",
    group: str = "",
    intro: str = "",
    no_traces: str = "",
) -> list[Section]:
    """Sections on all rollers: energy, power, load zone, films.

    Without a profile, from `orbit_profile`, some pictures are left out; `no_traces` says why there is none. `intro`
    heads the first section.
    """
    text, energy = words(_TEMPLATE), result.energy
    about = "Bars of a mean roller's energy by interface and row"
    shown = _bars(draw.plot_energy_by_interface, about, energy, legend="above")
    spread = energy.sum("interface", skipna=False).mean("roller") > 0.0
    shown += row_pictures(
        draw.plot_roller_spread, _SPREAD, energy, spread.row.values[spread.values].tolist()
    )
    known = [row for row in numbers.row_numbers(result) if row["least"]]
    polar, about_orbit, films, least, zone = [], (0, 0, 0), [], [], None
    if profile:
        orbit, load = profile["orbit"], profile["load_zone"].roller_load
        over, names = orbit.energy_over_orbit, orbit.row.values.tolist()
        polar = row_pictures(
            draw.plot_energy_over_orbit, _ORBIT, over, names, **ROUND, legend="below"
        )
        about_orbit = over.attrs["orbits"], 360.0 / orbit.sizes["angle"], over.attrs["energy_ratio"]
        zones = row_pictures(draw.plot_load_zone, _ZONE, load, names)
        zone = text.load_zone(
            zones, [(row, 1e-3 * float(load.sel(row=row).max())) for row in names]
        )
        about = "Film thickness and film parameter of the {} row over the orbit, by interface"
        films = row_pictures(draw.plot_film_over_orbit, about, orbit, names, legend="above")
        least = numbers.least_film_ratios(orbit)
    if "skew_by_position" in result:
        about = "Skew of pressed rollers over the orbit, and what it adds to their power"
        shown.append(picture(draw.plot_skew_over_orbit, about, result, legend="above"))
    if "mechanism_energy" in result:
        about = "Bars of a mean roller's energy by mechanism and row"
        shown.append(
            picture(draw.plot_by_mechanism, about, result.mechanism_energy, legend="above")
        )
    bodies = {"energy": text.energy(intro, no_traces, polar, *about_orbit, shown, known)}
    if np.nanmax(result.peak_power.values, initial=0.0) > 0.0:
        bodies["power"] = text.power(
            [picture(draw.plot_peak_exceedance, _PEAKS, result, legend="above")]
        )
    if zone:
        bodies["load-zone"] = zone
    about = "Bars of the share of loaded time outside the film formula's range"
    bars = _bars(draw.plot_outside_film_range, about, result.outside_film_range, legend="above")
    bodies["films"] = text.films(films, least, bars)
    return sections(_TEMPLATE, bodies, suffix=suffix, group=group)


def _further_sections(
    result: xr.Dataset, results: Mapping[str, xr.Dataset], *, suffix: str, group: str
) -> list[Section]:
    text, bodies = words(_TEMPLATE), {}
    if "surface_energy" in result:
        bodies["surface"] = _surface(result)
    bodies["damage"] = _damage(result)
    if "rating_problem" in result.attrs:
        bodies["rating"] = text.not_rated(result.attrs["rating_problem"])
    elif "static_safety" in result:
        about = "Share of time in which the load of the bearing exceeds a value"
        shown = [picture(draw.plot_load_duration, about, result, legend="above")]
        contamination = float(result.attrs["rating_contamination"])
        bodies["rating"] = text.rating(contamination, numbers.rating_tables(result), shown)
    if numbers.is_whole(result):
        bodies["whole"] = whole_body(result, results)
    return sections(_TEMPLATE, bodies, suffix=suffix, group=group)


def _surface(result: xr.Dataset) -> Markup:
    bearing = run_input(result).bearing
    along = roller_energy_density(result, bearing)
    about = "Energy per area along the rollers of the {} row, by sign of slip and film ratio"
    lines = row_pictures(
        draw.plot_along_roller, about, along, along.row.values.tolist(), legend="above"
    )
    of = f"of {result.sizes['roller']} of {bearing.rollers_per_row} rollers of each row"
    maps = map_pictures(energy_density(result), result.surface_power_density)
    return words(_TEMPLATE).surface(*maps, of, lines, numbers.surface_shares(along))


def _damage(result: xr.Dataset) -> Markup:
    found, missing = lines(result)
    shown = []
    if found:
        criteria = damage(result)
        about = "Criteria of damage over what each is compared with"
        shown.append(picture(draw.plot_criteria, about, criteria, height=3.4))
        if "worn_depth" in criteria:
            rows = criteria.row.values.tolist()
            about = "Depth of wear of the {} row along the roller over the years"
            shown += row_pictures(draw.plot_worn_profile, about, criteria, rows, legend="above")
    if "film_slip_time" in result:
        panels = {
            f"Share of the time under load by film ratio and slide-roll ratio, {row} row, {raceway} raceway": (
                result.film_slip_time.sel(row=row, raceway=raceway), draw.FILM_AND_SLIP["time"], f"{row} row, {raceway}"
            )
            for row in result.row.values.tolist()
            for raceway in result.raceway.values.tolist()
        }  # fmt: skip
        shown += compared(draw.plot_film_and_slip, panels)
    return words(_TEMPLATE).criteria(numbers.criteria_table(found), missing, "", "", shown)


def map_pictures(energy: xr.DataArray, density: xr.DataArray) -> list[Any]:
    """Maps of energy [J/m²] and largest power per area [W/m²], each kind on one scale, followed by their maxima."""
    found: list[Any] = []
    for values, units in ((energy, "J/mm²"), (density, "W/mm²")):
        panels = {
            f"Map of the {title}, {units}": (one, units, title)
            for title, one in draw.raceways(values).items()
        }
        found += [compared(draw.plot_map, panels), numbers.by_raceway(1e-6 * values)]
    return found


def whole_body(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> Markup:
    """Coupled motion of a whole bearing; a result on imposed orbits of the same case is compared."""
    rows = result.row.values.tolist()
    slips = zip(
        result.cage.values.tolist(),
        result.cage_slip.values,
        result.cage_slip_deviation.values,
        strict=True,
    )
    cages = [
        {"name": name, "slip": 100 * float(slip), "deviation": 100 * float(spread)}
        for name, slip, spread in slips
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
