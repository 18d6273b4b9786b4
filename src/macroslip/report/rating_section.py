"""The rating of the bearing that a result holds, as tables and pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.report.page import Block, Paragraph, Pictures, Table
from macroslip.report.pictures import picture
from macroslip.report.style import BLACK, BLUE, ORANGE, finish
from macroslip.study.rating_values import VARIABLES as RATING_VARIABLES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

_HOURS_A_YEAR = 8766.0
#: Variables of the bearing as a whole in the order of the table, and what they are called there.
_BEARING = {
    "static_safety": "static safety C0/P0, the least",
    "equivalent_load": "mean equivalent load P",
    "fatigue_load_limit": "fatigue load limit C_u",
    "share_below_fatigue_load_limit": "time with P below C_u",
    "minimum_load": "minimum load the maker requires",
    "share_below_minimum_load": "time with P below it",
    "viscosity_ratio": "viscosity ratio κ at the mean speed",
    "life_modification": "life modification factor a_ISO",
    "basic_life": "basic rating life L10h, ISO 281",
    "modified_life": "modified rating life L10mh, ISO 281",
}
_LOADS = {"radial": (BLUE, "-"), "axial": (ORANGE, "--"), "equivalent": (BLACK, "-.")}


def rating_blocks(result: xr.Dataset) -> tuple[Block, ...]:
    """The ratings in a result; nothing where it was not rated.

    Parameters
    ----------
    result : xarray.Dataset
        From `macroslip.result.rating.with_rating`.
    """
    if "rating_problem" in result.attrs:
        return (Paragraph(f"The bearing is not rated: {result.attrs['rating_problem']}"),)
    if "static_safety" not in result:
        return ()
    contamination = float(result.attrs["rating_contamination"])
    lives = [
        (f"{name}, load {words}", rating_text(result[variable].sel(load_along_roller=along)))
        for along, words in (("hertz", "as in a Hertz contact"), ("uniform", "even along the roller"))
        for variable, name in (("reference_life", "reference life, ISO/TS 16281"),
                               ("modified_reference_life", "modified reference life"))
    ]  # fmt: skip
    whole = tuple((name, rating_text(result[variable])) for variable, name in _BEARING.items()) + tuple(lives)
    ranges = tuple(
        (f"{load} load", *(rating_text(result.damage_equivalent_load.sel(load=load, wohler_exponent=one))
                           for one in result.wohler_exponent.values))
        for load in result["load"].values.tolist()
    )  # fmt: skip
    exponents = tuple(f"exponent {one:g}" for one in result.wohler_exponent.values)
    return (
        Paragraph(
            "Over all loads of the case, as if they repeated for ever; lives weigh loads by revolutions. The "
            f"contamination factor is {contamination:g}, an assumption. A rating depends on loads, speed and viscosity, "
            "not slip."
        ),
        Table(("bearing", "value"), whole),
        Table(_RACEWAY_HEADINGS, tuple(_raceways(result))),
        Table(("damage-equivalent load, range at 1 Hz", *exponents), ranges),
        Pictures(
            (
                picture(
                    lambda axes: plot_load_duration(axes, result),
                    "Share of time in which the load of the bearing exceeds a value",
                    legend="above",
                ),
            ),
            "Load duration: share of time in which the radial, axial and equivalent load exceed a value.",
        ),
    )


_RACEWAY_HEADINGS = (
    "row, raceway",
    "largest roller load [kN]",
    "largest pressure [GPa]",
    "film ratio Λ, median",
    "Λ, 5 % of loaded rollers below",
    "reference life [h]",
)


def _raceways(result: xr.Dataset) -> list[tuple[str, ...]]:
    rows = []
    for row in result.row.values.tolist():
        for raceway in ("inner", "outer"):
            one = result.sel(row=row, raceway=raceway)
            life = float(one.raceway_reference_life.sel(load_along_roller="hertz"))
            values = (1e-3 * one.largest_roller_load, 1e-9 * one.largest_pressure, one.film_ratio, one.film_ratio_low)
            rows.append((f"{row}, {raceway}", *(_number(float(value)) for value in values), _number(life)))
    return rows


def rating_summary(study: xr.Dataset) -> tuple[Block, ...]:
    """Least, median and largest of the rating's numbers over the runs of a study; nothing where none was rated."""
    if "static_safety" not in study or not bool(study.static_safety.notnull().any()):
        return ()
    rows = []
    for name in RATING_VARIABLES:
        values = study[name].dropna("case")
        if values.size:
            ends = (values.min(keep_attrs=True), values.median(keep_attrs=True), values.max(keep_attrs=True))
            rows.append((str(study[name].attrs["long_name"]), *map(rating_text, ends)))
    rated = int(study.static_safety.notnull().sum())
    return (
        Paragraph(f"Ratings of {rated} of {study.sizes['case']} runs, each as if its loads repeated for ever."),
        Table(("", "least", "median of the runs", "largest"), tuple(rows)),
    )


def rating_text(value: xr.DataArray) -> str:
    """A number with its unit, in usual units: kN, hours with years, per cent.

    Examples
    --------
    >>> import xarray as xr
    >>> rating_text(xr.DataArray(87660.0, attrs={"units": "h"})), rating_text(xr.DataArray(1.5e5, attrs={"units": "N"}))
    ('8.77e+04 h (10 years)', '150 kN')
    """
    number, units = float(value), value.attrs.get("units", "")
    if not np.isfinite(number):
        return "unlimited" if number > 0.0 else "–"
    if units == "N":
        return f"{1e-3 * number:.4g} kN"
    if units == "Pa":
        return f"{1e-9 * number:.3g} GPa"
    if units == "h":
        return f"{number:.3g} h ({number / _HOURS_A_YEAR:.3g} years)"
    if str(value.name).startswith("share"):
        return f"{100.0 * number:.3g} %"
    return _number(number)


def _number(value: float) -> str:
    return "–" if np.isnan(value) else "unlimited" if np.isinf(value) else f"{value:.3g}"


def plot_load_duration(axes: Axes, result: xr.Dataset) -> Axes:
    """Share of time in which each load of the bearing exceeds a value."""
    middle = 1e-3 * result.load_class_middle.values
    for load in result["load"].values.tolist():
        share = result.time_share.sel(load=load).values
        exceeded = np.cumsum(share[::-1])[::-1]
        colour, style = _LOADS[load]
        axes.plot(100.0 * exceeded, middle, color=colour, linestyle=style, label=load, linewidth=1.6)
    axes.set_xlim(0.0, 101.0)
    return finish(axes, "share of time above [%]", "load of the bearing [kN]")
