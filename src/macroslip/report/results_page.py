"""The page on results of `macroslip run` and of `macroslip.simulate`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.errors import InputError
from macroslip.report import bearing_figures as draw
from macroslip.report import result_numbers as numbers
from macroslip.report.bearing_view import scene_data
from macroslip.report.page import Opening, Section, render, sections, words
from macroslip.report.provenance import provenance_section
from macroslip.report.study_figures import plot_by_result, plot_case_energies
from macroslip.report.style import OPENING, Picture, picture, row_pictures
from macroslip.result.orbit_profile import orbit_profile
from macroslip.result.run_input import run_input
from macroslip.result.surface_maps import energy_density, roller_energy_density

if TYPE_CHECKING:
    import xarray as xr
    from markupsafe import Markup

    Profile = Mapping[str, xr.Dataset]

#: Results shown roller by roller, and with the bearing in motion, on one page; the table holds all of them.
DETAILED, MOVING = 6, 3
_TEMPLATE = "result.html"
_POLAR = {"width": 3.9, "height": 4.4, "polar": True}
_PEAKS = "Share of orbits whose largest power exceeds a value"
_SPREAD = "Energy of each roller of the {} row over the mean of the row"
_ORBIT = "Polar plot of the energy of the {} row over the orbit, by interface"
_ZONE = "Heat map of the roller load of the {} row over angle and time"


def results_page(results: Mapping[str, xr.Dataset], *, title: str = "Slip of the rollers") -> str:
    """A page on results of `macroslip.simulate` and on studies.

    Parameters
    ----------
    results : mapping
        Datasets by name. A result has `energy` [J] over (row, roller, interface) and `status` over (row, roller); a
        study has them over `case` too. Variables beyond these, and traces, add to the page.
    title : str

    Returns
    -------
    str
        HTML in one piece, every name and text in it escaped.

    Raises
    ------
    InputError
        If there is no dataset, or one is neither a result nor a study.
    """
    if not results:
        raise InputError("there is no result to report on")
    for name, dataset in results.items():
        _check(name, dataset)
    studies = {name: one for name, one in results.items() if "case" in one.dims}
    single = {name: one for name, one in results.items() if name not in studies}
    every = single | {
        f"{name}, {case}": study.sel(case=case)
        for name, study in studies.items()
        for case in study.case.values.tolist()
    }
    shown = dict(list(single.items())[:DETAILED])
    profiles: dict[str, dict[str, xr.Dataset]] = {}
    reasons = {}
    for name, result in shown.items():
        try:
            profiles[name] = orbit_profile(result)
        except InputError as error:
            reasons[name] = str(error)
    failed = [line for name, one in single.items() for line in numbers.failures(name, one)]
    overview = words(_TEMPLATE).numbers(
        numbers.overview_table(every), failed, DETAILED if len(single) > DETAILED else None
    )
    found = sections(_TEMPLATE, {"numbers": overview})
    if profiles:
        found.append(view_section(dict(list(profiles.items())[:MOVING])))
    for place, (name, result) in enumerate(shown.items()):
        options = {"suffix": f"-{place}" if place else "", "group": name if len(results) > 1 else ""}
        intro = str(result.attrs.get("title", ""))
        found += roller_sections(result, profiles.get(name), intro=intro, no_traces=reasons.get(name, ""), **options)
        found += _further_sections(result, results, **options)
    for place, (name, study) in enumerate(studies.items()):
        found.append(Section(f"study-{place}", name, _cases(study)))
    found.append(provenance_section(results))
    if len(results) == 1 and single:
        (result,) = single.values()
        return render(title, _subtitle(result), result_opening(result, next(iter(profiles.values()), None)), found)
    count = f"{len(results)} dataset{'' if len(results) == 1 else 's'}"
    subtitle = f"{count}: {', '.join(list(results)[:8])}{' …' if len(results) > 8 else ''}."
    return render(title, subtitle, results_opening(every), found)


def _check(name: str, dataset: xr.Dataset) -> None:
    """Refuse a dataset that is neither a result nor a study."""
    missing = [one for one in ("energy", "status") if one not in dataset]
    missing += [one for one in ("row", "roller", "interface") if one not in dataset.dims]
    if missing:
        allowed = "what macroslip run, macroslip.simulate or a study gives"
        raise InputError(f"the dataset has no {', no '.join(missing)}", where=name, allowed=allowed)


def _subtitle(result: xr.Dataset) -> str:
    """Bearing, loads, model and window."""
    parts = [str(result.attrs.get("title", "")).rstrip(".")]
    parts += [f"model {result.attrs['model']}"] if "model" in result.attrs else []
    if "window_end" in result.attrs:
        parts.append(f"{float(result.attrs['window_start']):.4g} s to {float(result.attrs['window_end']):.4g} s")
    return f"{', '.join(filter(None, parts))}."


def result_opening(result: xr.Dataset, profile: Profile | None) -> Opening:
    """The opening for one result; `profile` is from `orbit_profile`, None without traces."""
    rows, energy = numbers.row_numbers(result), result.energy
    seconds = None
    if "window_end" in result.attrs:
        seconds = float(result.attrs["window_end"]) - float(result.attrs["window_start"])
    peak = numbers.largest_peak(result)
    sentences = words(_TEMPLATE).answer(
        rows, seconds, peak, *numbers.rollers_failed([result]), *numbers.estimated_values(result)
    )
    pictures = [picture(draw.plot_energy_by_interface, "Energy of a mean roller by interface", energy, **OPENING)]
    if peak and peak["power"] > 0.0:
        pictures.append(picture(draw.plot_peak_exceedance, _PEAKS, result, **OPENING))
    plain = {**OPENING, "legend": ""}
    if profile is None:
        some = [row for row in energy.row.values.tolist() if float(energy.sel(row=row).sum()) > 0.0]
        return Opening(sentences, pictures + row_pictures(draw.plot_roller_spread, _SPREAD, energy, some, **plain))
    # The row with more energy, and the row with more load.
    total, load = energy.sum(("interface", "roller")), profile["load_zone"].roller_load
    spends = str(total.row[int(np.argmax(total.values))].item())
    carries = str(load.row[int(np.argmax(load.mean(("angle", "time")).values))].item())
    polar = {**OPENING, "height": 1.15 * OPENING["height"], "polar": True, "legend": "below"}
    over_orbit = profile["orbit"].energy_over_orbit
    pictures.append(picture(draw.plot_energy_over_orbit, _ORBIT.format(spends), over_orbit, spends, **polar))
    pictures.append(picture(draw.plot_load_zone, _ZONE.format(carries), load, carries, **plain))
    return Opening(sentences, pictures)


def results_opening(results: Mapping[str, xr.Dataset]) -> Opening:
    """The opening for several results, one of them a case of a study too."""
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
        extremes[key] = {"name": list(found)[place], "row": rows[row], "value": float(values[place, row])}
        pictures.append(
            picture(plot_by_result, f"By result and row: {label}", list(found), rows, values, label, **OPENING)
        )
    failed = numbers.rollers_failed(results.values())
    sentences = words(_TEMPLATE).comparison(
        len(results), *failed, *(extremes.get(key) for key in ("energy", "peak", "spin"))
    )
    return Opening(sentences, pictures)


def view_section(profiles: Mapping[str, Profile]) -> Section:
    """The moving bearing, with the profiles of `orbit_profile` by title."""
    scenes = {
        title: scene_data(profile["scene"], run_input(profile["result"]).bearing) for title, profile in profiles.items()
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
    shown = [picture(draw.plot_energy_by_interface, about, energy, legend="above")]
    spread = energy.sum("interface", skipna=False).mean("roller") > 0.0
    shown += row_pictures(draw.plot_roller_spread, _SPREAD, energy, spread.row.values[spread.values].tolist())
    known = [row for row in numbers.row_numbers(result) if row["least"]]
    polar, about_orbit, films, least, zone = [], (0, 0, 0), [], [], None
    if profile:
        orbit, load = profile["orbit"], profile["load_zone"].roller_load
        over, names = orbit.energy_over_orbit, orbit.row.values.tolist()
        polar = row_pictures(draw.plot_energy_over_orbit, _ORBIT, over, names, **_POLAR, legend="below")
        about_orbit = over.attrs["orbits"], 360.0 / orbit.sizes["angle"], over.attrs["energy_ratio"]
        zones = row_pictures(draw.plot_load_zone, _ZONE, load, names, width=4.4, height=2.9)
        zone = text.load_zone(zones, [(row, 1e-3 * float(load.sel(row=row).max())) for row in names])
        about = "Film thickness and film parameter of the {} row over the orbit, by interface"
        films = row_pictures(draw.plot_film_over_orbit, about, orbit, names, legend="above")
        least = numbers.least_film_ratios(orbit)
    bodies = {"energy": text.energy(intro, no_traces, polar, *about_orbit, shown, known, mechanism_pictures(result))}
    if np.nanmax(result.peak_power.values, initial=0.0) > 0.0:
        bodies["power"] = text.power([picture(draw.plot_peak_exceedance, _PEAKS, result, legend="above")])
    if zone:
        bodies["load-zone"] = zone
    about = "Bars of the share of loaded time outside the film formula's range"
    bars = picture(draw.plot_outside_film_range, about, result.outside_film_range, legend="above")
    bodies["films"] = text.films(films, least, [bars])
    return sections(_TEMPLATE, bodies, suffix=suffix, group=group)


def _further_sections(
    result: xr.Dataset, results: Mapping[str, xr.Dataset], *, suffix: str, group: str
) -> list[Section]:
    """Sections on surfaces, rating and coupled motion, where the result has them."""
    text, bodies = words(_TEMPLATE), {}
    if "surface_energy" in result:
        bodies["surface"] = _surface(result)
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
    lines = row_pictures(draw.plot_along_roller, about, along, along.row.values.tolist(), legend="above")
    of = f"of {result.sizes['roller']} of {bearing.rollers_per_row} rollers of each row"
    maps = map_pictures(energy_density(result), result.surface_power_density)
    return words(_TEMPLATE).surface(*maps, of, lines, numbers.surface_shares(along))


def map_pictures(energy: xr.DataArray, density: xr.DataArray) -> list[Any]:
    """Maps of energy per area [J/m²] and of largest power per area [W/m²], each followed by their largest values."""
    found: list[Any] = []
    for values, units in ((energy, "J/mm²"), (density, "W/mm²")):
        pictures = [
            picture(draw.plot_map, f"Map of the {title}, {units}", one, units, title, width=4.4, height=3.0)
            for title, one in draw.raceways(values).items()
        ]
        found += [pictures, numbers.by_raceway(1e-6 * values)]
    return found


def whole_body(result: xr.Dataset, results: Mapping[str, xr.Dataset]) -> Markup:
    """Coupled motion of a whole bearing; a result on imposed orbits of the same case is compared."""
    rows = result.row.values.tolist()
    slips = zip(result.cage.values.tolist(), result.cage_slip.values, result.cage_slip_deviation.values, strict=True)
    cages = [
        {"name": name, "slip": 100 * float(slip), "deviation": 100 * float(spread)} for name, slip, spread in slips
    ]
    imposed = numbers.counterpart(result, results)
    about = "Polar plot of the largest force of a spar on the {} row by place on the orbit"
    pictures = row_pictures(draw.plot_force_by_position, about, result, rows, **_POLAR)
    if result.sizes["book_time"] > 2:
        about = "Residuals of the balances of momentum and energy over time"
        pictures.append(picture(draw.plot_residuals, about, result, legend="above"))
    top = result.largest_force_by_position.sel(position=np.radians(90.0), method="nearest")
    return words(_TEMPLATE).whole(
        cages,
        numbers.balances(result),
        imposed,
        numbers.comparison_table(result, results[imposed]) if imposed else None,
        numbers.pocket_table(result),
        pictures,
        [(row, float(top.sel(row=row))) for row in rows],
    )


def mechanism_pictures(dataset: xr.Dataset) -> list[Picture]:
    """Energies by mechanism and by station along the roller, where the dataset has such dimensions."""
    pictures = []
    for name, values in dataset.data_vars.items():
        if "row" not in values.dims or "angle" in values.dims or values.attrs.get("units") not in ("J", "J/m"):
            continue
        if "station" in values.dims:
            plot, about = draw.plot_over_station, f"Energy along the roller by row, {name}"
        elif "mechanism" in values.dims:
            plot, about = draw.plot_by_mechanism, f"Energy by mechanism and row, {name}"
        else:
            continue
        pictures.append(picture(plot, about, values, legend="above"))
    return pictures


def _cases(study: xr.Dataset) -> Markup:
    count = study.sizes["case"]
    size = {"width": min(8.6, max(4.2, 0.28 * count)), "height": 3.4, "wide": count > 15}
    shown = picture(plot_case_energies, "Energy of a roller by case and row", study, legend="above", **size)
    mean = study.mean("case", skipna=True, keep_attrs=True)
    return words(_TEMPLATE).cases(str(study.attrs.get("title", "")), [shown], mechanism_pictures(mean))
