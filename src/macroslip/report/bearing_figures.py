"""Figures of a result: energy over the orbit, films, load zone, rollers, raceways, pockets.

Every function draws on the axes that it takes, and returns them. Angles count from the bottom along
the orbit; polar axes look downwind, so that rollers rise on the left.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from macroslip.bearing import geometry
from macroslip.constants import YEAR
from macroslip.errors import InputError
from macroslip.measures.along import FILM_EDGES, SLIP_EDGES
from macroslip.report.style import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    INTERFACE,
    LABEL,
    ORANGE,
    ROW,
    SMALL,
    colour_scale,
    decade_ticks,
    finish,
    log_ticks,
    three_digits,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.projections.polar import PolarAxes

    from macroslip.bearing import Bearing

_ANGLE = "angle from the bottom, top at 180 [°]"
_ALONG = "place along the roller [mm]"
_QUARTERS = [0, 90, 180, 270, 360]
_SPLIT = ("slip_sign", "film_regime")
_PARTS = {
    "slip < 0": ({"slip_sign": "negative"}, {"color": BLUE, "linestyle": "--"}),
    "slip > 0": ({"slip_sign": "positive"}, {"color": ORANGE, "linestyle": "-."}),
    "Λ < 1": ({"film_regime": "below 1"}, {"color": GREEN, "linestyle": ":"}),
}
#: What `plot_film_and_slip` shares out, by name, and the least share that has a colour [%].
FILM_AND_SLIP = {"time": "time under load", "passes": "passes"}
_LEAST_SHARE = 0.01
#: Ratios of criteria are drawn from here on.
_LEAST_RATIO = 1e-4
_LOADS = {
    "radial": {"color": BLUE, "linestyle": "-"},
    "axial": {"color": ORANGE, "linestyle": "--"},
    "equivalent": {"color": BLACK, "linestyle": "-."},
}


def plot_energy_over_orbit(axes: PolarAxes, energy: xr.DataArray, row: str) -> PolarAxes:
    """Energy per orbit and degree of a row at each interface, on polar axes that look downwind.

    Takes the array of `macroslip.result.orbit.energy_over_orbit` [J/degree]; drawn in mJ/degree.
    The legend gives the energy per orbit of each interface.
    """
    from matplotlib.ticker import MaxNLocator

    of_row = 1e3 * energy.sel(row=row)
    width = 360.0 / of_row.sizes["angle"]
    angles = of_row.angle.values
    closed_angles = np.append(angles, angles[0] + 360.0)
    theta = np.radians(closed_angles)
    for interface in of_row.interface.values.tolist():
        values = of_row.sel(interface=interface).values
        total = width * values.sum()
        orbit = f"{three_digits(total)} mJ"
        if total >= 1e3:
            orbit = f"{three_digits(1e-3 * total)} J"
        label = f"{interface}: {orbit} per orbit"
        closed = np.append(values, values[0])
        axes.plot(theta, closed, label=label, linewidth=1.6, **INTERFACE[interface])
    axes.set_ylim(bottom=0.0)
    axes.yaxis.set_major_locator(MaxNLocator(3, prune="lower"))
    return _round(axes, "S", ["bottom", "left", "top", "right"], f"{row} row [mJ/°]")


def _round(axes: PolarAxes, zero: str, quarters: Sequence[str], title: str) -> PolarAxes:
    axes.set_theta_zero_location(zero)
    axes.set_theta_direction(-1)
    axes.set_xticks(np.radians(_QUARTERS[:4]), quarters)
    axes.tick_params(labelsize=SMALL)
    axes.tick_params(axis="x", pad=1)
    axes.set_rlabel_position(22.5)
    axes.set_title(title, fontsize=LABEL, loc="left", pad=12)
    return axes


def _whole_orbit(axes: Axes) -> None:
    """The horizontal axis from 0 to 360 degrees."""
    axes.set_xlim(0.0, 360.0)
    axes.set_xticks(_QUARTERS)


def plot_film_over_orbit(axes: Axes, orbit: xr.Dataset, row: str) -> Axes:
    """Median film thickness of a row at each interface over the orbit, with the range of 5 to 95 %.

    Takes `film_thickness` [m] and `film_parameter` [1] over (row, interface, quantile, angle). The
    right axis shows the film parameter Λ, film thickness over composite roughness.
    """
    thickness = 1e6 * orbit.film_thickness.sel(row=row)
    angle = thickness.angle.values
    for interface in thickness.interface.values.tolist():
        of_interface = thickness.sel(interface=interface).transpose("quantile", "angle")
        low, middle, high = of_interface.values
        style = INTERFACE[interface]
        axes.fill_between(angle, low, high, color=style["color"], alpha=0.18, linewidth=0.0)
        axes.plot(angle, middle, label=interface, linewidth=1.6, **style)
    _whole_orbit(axes)
    if not (thickness > 0.0).any():
        return finish(axes, _ANGLE, "film thickness [µm]", f"{row} row, never touched")
    log_ticks(axes)
    # Rollers without load have no film but play.
    _, highest = axes.get_ylim()
    axes.set_ylim(top=min(highest, 300.0))
    per_metre = orbit.film_parameter / orbit.film_thickness
    scale = 1e-6 * float(per_metre.median())

    def to_parameter(thickness: np.ndarray) -> np.ndarray:
        return np.multiply(thickness, scale)

    def to_thickness(parameter: np.ndarray) -> np.ndarray:
        return np.divide(parameter, scale)

    right = axes.secondary_yaxis("right", functions=(to_parameter, to_thickness))
    decade_ticks(right.yaxis)
    right.set_ylabel("film parameter Λ [–]", fontsize=LABEL)
    right.tick_params(labelsize=SMALL)
    return finish(axes, _ANGLE, "film thickness [µm]", f"{row} row")


def plot_load_zone(axes: Axes, load: xr.DataArray, row: str) -> Axes:
    """Roller load of a row over angle and time as a heat map, darkest where there is no load.

    Takes the array of `macroslip.result.orbit.load_zone` [N].
    """
    of_row = 1e-3 * load.sel(row=row)
    start = float(of_row.time[0])
    end = float(of_row.time[-1])
    extent = (start, end, 0.0, 360.0)
    _heat_map(axes, of_row.values.T, extent, "roller load [kN]", least=1e-3)
    axes.set_yticks(_QUARTERS)
    return _framed(finish(axes, "time [s]", "angle from the bottom [°]", f"{row} row"))


def plot_bearing(
    axes: Axes, still: xr.Dataset, bearing: Bearing, longest: float | None = None
) -> Axes:
    """Both rows to scale, looking downwind: rollers coloured by slip, with spokes for their loads.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    still : xarray.Dataset
        From `macroslip.result.orbit.still`.
    bearing : Bearing
    longest : float, optional
        Load that the longest spoke stands for [N], by default the largest one of the moment;
        pictures of several moments share one.
    """
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Circle

    radius = geometry.roller_radius(bearing)
    pitch = bearing.pitch_radius
    outer = geometry.outer_contact_radius(bearing)
    most = longest
    if most is None:
        most = max(float(still.roller_load.max()), 1.0)
    reach = 1.4 * outer
    rollers = []
    for k, row in enumerate(still.row.values.tolist()):
        of_row = still.sel(row=row)
        centre = 2.0 * k * reach
        for ring in (outer, geometry.inner_contact_radius(bearing)):
            axes.add_patch(Circle((centre, 0.0), ring, fill=False, edgecolor=GREY, linewidth=1.2))
        angle = np.radians(of_row.angle.values)
        x = -np.sin(angle)
        y = -np.cos(angle)
        inner_end = np.full(angle.size, 1.06 * outer)
        load_share = of_row.roller_load.values / most
        outer_end = inner_end + 0.3 * outer * load_share
        spokes = np.stack([inner_end, outer_end])
        axes.plot(
            centre + spokes * x,
            spokes * y,
            color=GREY,
            linewidth=3.0,
            solid_capstyle="butt",
        )
        rollers += [
            Circle((centre + pitch * to_right, pitch * up), radius)
            for to_right, up in zip(x, y, strict=True)
        ]
        axes.text(centre, 0.0, row, ha="center", va="center", fontsize=LABEL)
    shown = PatchCollection(rollers, cmap="cividis", edgecolor=BLACK, linewidth=0.6)
    slip = still.slip.transpose("row", "roller")
    shown.set_array(100.0 * slip.values.ravel())
    shown.set_clim(0.0, 100.0)
    axes.add_collection(shown)
    axes.set(
        xlim=(-reach, (2.0 * still.sizes["row"] - 1.0) * reach),
        ylim=(-reach, reach),
        aspect="equal",
    )
    axes.axis("off")
    colour_scale(axes, shown, "slip / speed [%]", orientation="horizontal", shrink=0.7, aspect=30)
    axes.set_title(
        f"{float(still.time):.2f} s; spokes: load, to {1e-3 * most:.3g} kN",
        fontsize=LABEL,
        loc="left",
    )
    return axes


def plot_roller_spread(axes: Axes, energy: xr.DataArray, row: str) -> Axes:
    """Energy of every roller of a row over the mean of the row, by the number of the roller.

    Takes `energy` [J] of a result, over (row, roller, interface).
    """
    total = energy.sel(row=row).sum("interface", skipna=False)
    mean = float(total.mean())
    axes.axhline(1.0, color=GREY, linewidth=0.8)
    numbers = total.roller.values
    style = {**ROW[row], "linestyle": "none"}
    axes.plot(numbers, total.values / mean, markersize=5, **style)
    between_ticks = max(1, numbers.size // 7)
    axes.set_xticks(numbers[::between_ticks])
    axes.margins(y=0.25)
    axes.ticklabel_format(axis="y", useOffset=False)
    title = f"{row} row, mean {three_digits(mean)} J"
    return finish(axes, "number of the roller [–]", "energy / mean of the row [–]", title)


def plot_outside_film_range(axes: Axes, share: xr.DataArray) -> Axes:
    """Share of loaded time outside the film formula's range, at each interface of both rows.

    Takes `outside_film_range` of a result [–]; bars are means over the rollers, whiskers smallest
    and largest.
    """
    for x, width, row, style in _row_bars(share):
        of_row = 1e2 * share.sel(row=row)
        # An interface that never carries load has no share.
        known = of_row.notnull().any("roller").values
        of_row = of_row.isel(interface=known)
        x = x[known]
        mean = of_row.mean("roller").values
        low = of_row.min("roller").values
        high = of_row.max("roller").values
        axes.bar(x, mean, width, **style)
        axes.errorbar(
            x, mean, yerr=[mean - low, high - mean], color=BLACK, linestyle="none", capsize=3
        )
        labels = [f"{value:.3g}" for value in mean]
        _values_above(axes, x, mean, labels, 5)
    interfaces = share.interface.values.tolist()
    axes.set_xticks(np.arange(len(interfaces)), interfaces)
    axes.set_ylim(0.0, 118.0)
    return finish(axes, "interface", "share of loaded time [%]")


def plot_energy_by_interface(axes: Axes, energy: xr.DataArray) -> Axes:
    """Energy of a mean roller of each row by interface, on a logarithmic axis.

    Takes `energy` [J] of a result, over (row, roller, interface).
    """
    for x, width, row, style in _row_bars(energy):
        values = energy.sel(row=row).mean("roller").values
        axes.bar(x, values, width, **style)
        some = values > 0.0
        labels = [three_digits(value) for value in values[some]]
        _values_above(axes, x[some], values[some], labels, 2)
    if np.nanmax(energy.values, initial=0.0) > 0.0:
        axes.set_yscale("log")
        axes.margins(y=0.12)
    interfaces = energy.interface.values.tolist()
    axes.set_xticks(np.arange(len(interfaces)), interfaces)
    axes.set_xlim(-0.6, len(interfaces) - 0.4)
    return finish(axes, "interface", "energy of a roller [J]")


def plot_peak_exceedance(axes: Axes, result: xr.Dataset) -> Axes:
    """Share of (roller, orbit) samples whose P_max exceeds a power, for both rows.

    Takes a result with complete orbits; samples of failed rollers are left out.
    """
    from matplotlib.ticker import LogFormatter

    for row in result.row.values.tolist():
        of_interfaces = result.peak_power.sel(row=row)
        largest = of_interfaces.max("interface", skipna=False)
        peak = np.sort(largest.values.ravel())
        peak = peak[np.isfinite(peak)]
        if peak.size:
            below = np.arange(peak.size) / peak.size
            share = np.append(1.0, 1.0 - below)
            style = _line_of(row)
            power = np.append(0.5 * peak[0], peak)
            axes.step(power, share, where="pre", label=f"{row} row", linewidth=1.6, **style)
    axes.set(xscale="log", yscale="log")
    # Powers within a decade would be written one over the other.
    axes.xaxis.set_minor_formatter(LogFormatter(minor_thresholds=(0.5, 0.25)))
    return finish(axes, r"$P_\mathrm{max}$ of an orbit [W]", "share of orbits above [–]")


def _line_of(row: str) -> dict[str, Any]:
    """Colour and dashes of a row, without its marker."""
    style = ROW[row]
    return {"color": style["color"], "linestyle": style["linestyle"]}


def plot_by_mechanism(axes: Axes, energy: xr.DataArray) -> Axes:
    """Energy of a mean roller of each row by mechanism, from `mechanism_energy` [J]."""
    mean = energy.mean("roller").sum("interface")
    for x, width, row, style in _row_bars(mean, "mechanism"):
        values = mean.sel(row=row).values
        axes.barh(x, values, width, **style)
    mechanisms = [str(name) for name in mean.mechanism.values]
    axes.set_yticks(np.arange(len(mechanisms)), mechanisms)
    return finish(axes, "energy of a roller [J]", "mechanism")


def plot_spin_over_time(axes: Axes, result: xr.Dataset, row: str, roller: int) -> Axes:
    """Spin speed of a roller [rad/s] over time, with its spin in pure rolling.

    Where they part, the roller slips.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    result : xarray.Dataset
        With traces.
    row : str
        Name of the row.
    roller : int
        Number of the roller in its row.
    """
    if "time" not in result.dims:
        raise InputError(
            "the result has no traces",
            remedy="Give the case traces, such as traces: {step: 0.05 s}.",
        )
    of_roller = result.sel(row=row, roller=roller)
    time = of_roller.time.values
    axes.plot(
        time,
        abs(of_roller.spin_pure.values),
        color=BLACK,
        linestyle="--",
        linewidth=1.2,
        label="pure rolling",
    )
    spin = abs(of_roller.spin.values)
    axes.plot(time, spin, color=BLUE, linewidth=1.6, label="roller")
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False, fontsize=SMALL)
    title = f"roller {roller} of the {row} row"
    return finish(axes, "time [s]", "spin speed |ω| [rad/s]", title)


def raceways(values: xr.DataArray) -> dict[str, xr.DataArray]:
    """The maps of every raceway by title; from values per m² to values per mm²."""
    return {
        f"{row} row, {raceway} raceway": 1e-6 * values.sel(row=row, raceway=raceway)
        for row in values.row.values.tolist()
        for raceway in ("outer", "inner")
    }


def _framed(axes: Axes) -> Axes:
    """The axes with lines all round, as a map needs them."""
    axes.spines[["top", "right"]].set_visible(True)
    return axes


def plot_map(
    axes: Axes, values: xr.DataArray, units: str, title: str, *, difference: bool = False
) -> Axes:
    """A raceway unrolled: station along the roller over the angle from the bottom.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    values : xarray.DataArray
        Values in `units` over (angle [rad from +X0], station [m]).
    units : str
        Their unit, for the scale of colours.
    title : str
        Title of the map.
    difference : bool, optional
        Whether the colours have their middle at zero.
    """
    # Angles count from +X0, which is a quarter of a turn past the bottom; the bottom is in the
    # middle of the map.
    degrees = np.degrees(values.angle.values)
    from_top = (degrees + 270.0) % 360.0
    order = np.argsort(from_top)
    along = 1e3 * values.station.values
    half = 0.5 * (along[1] - along[0])
    extent = (-180.0, 180.0, along[0] - half, along[-1] + half)
    by_station = values.transpose("station", "angle").values
    shown = by_station[:, order]
    _heat_map(axes, shown, extent, units, least=1e-30, difference=difference)
    axes.set_xticks([-180, -90, 0, 90, 180])
    return _framed(finish(axes, "angle from the bottom [°]", _ALONG, title))


def plot_film_and_slip(axes: Axes, amounts: xr.DataArray, units: str, title: str) -> Axes:
    """Shares [%] of time under load, or of passes, by Λ and by slide-roll ratio of one raceway.

    Left of the middle the roller is the faster surface, right of it the ring.

    Parameters
    ----------
    axes : matplotlib.axes.Axes
    amounts : xarray.DataArray
        `film_slip_time` [s] or `film_slip_passes` [1] over (film_class, slip_class).
    units : str
        What is shared out: a value of `FILM_AND_SLIP`.
    title : str
        Row and raceway.
    """
    values = amounts.transpose("film_class", "slip_class").values
    total = max(values.sum(), 1e-300)
    shares = 100.0 * values / total
    drawn_shares = np.maximum(shares, _LEAST_SHARE)
    shown = np.log10(drawn_shares / _LEAST_SHARE)
    decades = np.log10(100.0 / _LEAST_SHARE)
    image = axes.pcolormesh(shown, cmap="Blues", vmin=0.0, vmax=decades, edgecolors="white")
    for (film, slip), share in np.ndenumerate(shares):
        if share >= 10.0 * _LEAST_SHARE:
            colour = "white" if share > 10.0 else BLACK
            text = f"{share:.0f}" if share >= 9.5 else f"{share:.1f}"
            axes.text(
                slip + 0.5,
                film + 0.5,
                text,
                ha="center",
                va="center",
                fontsize=SMALL,
                color=colour,
            )
    image.set_rasterized(True)
    slip_labels = [f"{edge:g}" for edge in SLIP_EDGES]
    film_labels = [f"{edge:g}" for edge in FILM_EDGES]
    axes.set_xticks(range(1, len(slip_labels) + 1), slip_labels, rotation=60)
    axes.set_yticks(range(1, len(film_labels) + 1), film_labels)
    label = "slide-roll ratio, ring − roller [1]"
    return _framed(finish(axes, label, "Λ [1]", f"{title} [% of {units}]"))


def plot_along_roller(axes: Axes, density: xr.DataArray, row: str) -> Axes:
    """Energy per area along a roller: all of it, by the sign of slip, and in thin films.

    Takes the array of `macroslip.result.surface_maps.roller_energy_density` [J/m²].
    """
    density = 1e-6 * density.sel(row=row)
    along = 1e3 * density.station.values
    axes.plot(along, density.sum(_SPLIT).values, color=BLACK, label="all", linewidth=1.8)
    for name, (part, style) in _PARTS.items():
        part_density = density.sel(part)
        other_dims = [dim for dim in _SPLIT if dim in part_density.dims]
        values = part_density.sum(other_dims).values
        axes.plot(along, values, label=name, linewidth=1.5, **style)
    axes.set_ylim(bottom=0.0)
    return finish(axes, _ALONG, "energy per area [J/mm²]", f"{row} row")


def plot_load_duration(axes: Axes, result: xr.Dataset) -> Axes:
    """Share of time in which each load of the bearing exceeds a value, from its rating."""
    middle = 1e-3 * result.load_class_middle.values
    for load in result["load"].values.tolist():
        of_load = result.time_share.sel(load=load)
        falling = of_load.values[::-1]
        exceeded = np.cumsum(falling)[::-1]
        axes.plot(100.0 * exceeded, middle, label=load, linewidth=1.6, **_LOADS[load])
    axes.set_xlim(0.0, 101.0)
    return finish(axes, "share of time above [%]", "load of the bearing [kN]")


def plot_force_by_position(axes: PolarAxes, result: xr.Dataset, row: str) -> PolarAxes:
    """Largest force of a spar [N] by position on the orbit, looking downwind; logarithmic.

    Takes a result of a whole bearing.
    """
    angle = result.position.values
    largest = result.largest_force_by_position.sel(row=row)
    values = np.maximum(largest.values, 1e-1)
    # A full turn later, not back across the picture.
    axes.plot(
        np.append(angle, angle[0] + 2.0 * np.pi),
        np.append(values, values[0]),
        drawstyle="steps-mid",
    )
    axes.set_rscale("log")
    farthest = 2.0 * float(values.max())
    axes.set_rlim(1e-1, max(10.0, farthest))
    # Looking downwind +X0 is on the left, and φ runs clockwise.
    return _round(axes, "W", ["left", "top", "right", "bottom"], f"{row} row [N]")


def plot_residuals(axes: Axes, result: xr.Dataset) -> Axes:
    """Residuals of a whole bearing's balances over time, over all that has passed through."""
    largest_impulse = float(abs(result.book_inner_impulse).max())
    impulse = largest_impulse or 1.0
    raceway_loss = float(abs(result.book_raceway_loss[-1]))
    pocket_loss = float(abs(result.pocket_loss[-1]))
    spent = raceway_loss + pocket_loss or 1.0
    residuals = {
        "angular momentum": (result.momentum_residual / impulse, BLUE, "-"),
        "energy": (result.energy_residual / spent, ORANGE, "--"),
    }
    for label, (residual, colour, dashes) in residuals.items():
        size = np.maximum(np.abs(residual.values), 1e-17)
        axes.plot(result.book_time.values, size, label=label, color=colour, linestyle=dashes)
    axes.set_yscale("log")
    return finish(axes, "time [s]", "residual / passed through [–]")


def plot_slip_over_orbit(axes: Axes, slip: xr.DataArray) -> Axes:
    """Slip over the orbit, a line a row: the median of its rollers, and shaded from 5 to 95 %.

    Takes `slip` [1] over (row, quantile, angle): 1 for a roller that does not spin.
    """
    for row in slip.row.values.tolist():
        of_row = slip.sel(row=row).transpose("quantile", "angle")
        low, middle, high = 100.0 * of_row.values
        style = _line_of(row)
        axes.fill_between(
            slip.angle.values, low, high, color=style["color"], alpha=0.18, linewidth=0.0
        )
        axes.plot(slip.angle.values, middle, label=f"{row} row", linewidth=1.6, **style)
    _whole_orbit(axes)
    return finish(axes, _ANGLE, "slip / speed [%]")


def plot_criteria(axes: Axes, damage: xr.Dataset) -> Axes:
    """Criteria of damage: value over reference with its uncertainty; grey without a reference.

    Takes the dataset of `macroslip.result.damage.damage`. A criterion that is passed lies right of
    1.
    """
    is_known = damage.value.notnull()
    known = damage.isel(criterion=np.flatnonzero(is_known))
    ratio = np.clip(known.ratio.values, _LEAST_RATIO, None)
    factor = known.factor.values
    axes.axvline(1.0, color=BLACK, linewidth=1.0)
    axes.set_xscale("log")
    criteria = zip(known.title.values, ratio, factor, strict=True)
    for line, (title, own, sure) in enumerate(criteria):
        has_reference = np.isfinite(own)
        if has_reference:
            colour = ORANGE if own > 1.0 else BLUE
            below = own - own / sure
            above = own * sure - own
            bar = [[below], [above]]
            axes.errorbar(own, -line, xerr=bar, color=colour, marker="o", capsize=3)
            _name_line(axes, line, str(title))
        else:
            _name_line(axes, line, f"{title} (no reference)", color=GREY)
    return _finish_lines(axes, 0.4 - known.sizes["criterion"])


def _name_line(axes: Axes, line: int, name: str, color: str = BLACK) -> None:
    """Write a name above a line of a chart whose lines are numbered downwards."""
    axes.annotate(
        name,
        (0.01, -line),
        xycoords=("axes fraction", "data"),
        xytext=(0, 7),
        textcoords="offset points",
        fontsize=SMALL,
        color=color,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
    )


def _finish_lines(axes: Axes, bottom: float) -> Axes:
    """Axes of criteria over their references, a line each."""
    axes.set_ylim(bottom, 0.9)
    axes.set_yticks([])
    axes.margins(x=0.15)
    finish(axes, "value / reference [–]", "")
    axes.spines["left"].set_visible(False)
    return axes


def plot_criteria_side_by_side(
    axes: Axes, by_name: Mapping[str, Sequence[Mapping[str, Any]]]
) -> Axes:
    """Criteria of damage of several results: value over reference, a colour for each result.

    Takes the lines of `macroslip.result.damage.lines` by the results' names; criteria without a
    reference are left out.
    """
    judged = {
        name: {line["title"]: line for line in lines if np.isfinite(line["ratio"])}
        for name, lines in by_name.items()
    }
    titles_of_all = [title for lines in judged.values() for title in lines]
    titles = list(dict.fromkeys(titles_of_all))
    axes.axvline(1.0, color=BLACK, linewidth=1.0)
    axes.set_xscale("log")
    gap = 0.5 / max(len(judged), 1)
    for k, (name, lines) in enumerate(judged.items()):
        heights = [-titles.index(title) - gap * k for title in lines]
        ratios = [line["ratio"] for line in lines.values()]
        factors = [line["factor"] for line in lines.values()]
        ratio = np.clip(ratios, _LEAST_RATIO, None)
        factor = np.array(factors)
        below = ratio - ratio / factor
        above = ratio * factor - ratio
        bars = [below, above]
        colour = f"C{k % 10}"
        axes.errorbar(
            ratio, heights, xerr=bars, color=colour, marker="o", linestyle="", capsize=3, label=name
        )
    for line, title in enumerate(titles):
        _name_line(axes, line, title)
    return _finish_lines(axes, 0.4 - len(titles) - gap)


def plot_worn_profile(axes: Axes, damage: xr.Dataset, row: str) -> Axes:
    """Depth of wear along either raceway and the roller over the years, from `damage`."""
    if "worn_depth" not in damage:
        raise InputError("there is no wear", remedy=damage.attrs["not_kept"])
    depth = 1e6 * damage.worn_depth.sel(row=row)
    for name in depth.surface.values.tolist():
        style = INTERFACE.get(name, {"color": GREEN, "linestyle": "-."})
        last = depth.age.size - 1
        for k, age in enumerate(depth.age.values):
            label = name if k == last else None
            axes.plot(
                1e3 * depth.station,
                depth.sel(surface=name, age=age),
                linewidth=0.7 + 0.5 * k,
                label=label,
                **style,
            )
    years = ", ".join(f"{age / YEAR:g}" for age in depth.age.values)
    return finish(axes, _ALONG, "depth of wear [µm]", f"{row} row, after {years} years")


def _row_bars(
    values: xr.DataArray, over: str = "interface"
) -> list[tuple[np.ndarray, float, str, dict[str, Any]]]:
    """Of each row the positions and width of its bars, its name, and its style."""
    rows = values.row.values.tolist()
    width = 0.8 / len(rows)
    middles = np.arange(values.sizes[over])
    bars = []
    for k, row in enumerate(rows):
        style = {
            "color": ROW[row]["color"],
            "edgecolor": "white",
            "label": f"{row} row",
            "hatch": "///" if k else None,
        }
        from_middle = k - 0.5 * (len(rows) - 1)
        positions = middles + width * from_middle
        bars.append((positions, 0.9 * width, row, style))
    return bars


def _values_above(
    axes: Axes, x: np.ndarray, y: np.ndarray, labels: Sequence[str], points: float
) -> None:
    for position, value, label in zip(x, y, labels, strict=True):
        at = (position, max(value, 0.0))
        axes.annotate(
            label, at, xytext=(0, points), textcoords="offset points", ha="center", fontsize=SMALL
        )


def _heat_map(
    axes: Axes,
    values: np.ndarray,
    extent: tuple[float, ...],
    label: str,
    *,
    least: float,
    difference: bool = False,
) -> None:
    largest = float(np.nanmax(abs(values), initial=0.0))
    most = max(largest, least)
    image = axes.imshow(
        values,
        origin="lower",
        aspect="auto",
        cmap="RdBu_r" if difference else "cividis",
        vmin=-most if difference else 0.0,
        vmax=most,
        extent=extent,
        interpolation="nearest",
        rasterized=True,
    )
    colour_scale(axes, image, label)


def plot_skew_over_orbit(axes: Axes, result: xr.Dataset) -> Axes:
    """Mean skew of pressed rollers over the orbit, and dashed the power that it adds.

    Takes a result with `skew_by_position` [rad] and `skew_power_by_position` [W].
    """
    position = np.degrees(result.position.values)
    angle = (position + 90.0) % 360.0
    order = np.argsort(angle)
    power = axes.twinx()
    for row in result.row.values.tolist():
        colour = ROW[row]["color"]
        of_row = result.sel(row=row)
        axes.plot(
            angle[order],
            1e3 * of_row.skew_by_position.values[order],
            color=colour,
            label=f"{row} row",
        )
        power.plot(
            angle[order], of_row.skew_power_by_position.values[order], color=colour, linestyle="--"
        )
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    _whole_orbit(axes)
    power.set_ylabel("added power, dashed [W]")
    return finish(axes, _ANGLE, "skew [mrad]")
