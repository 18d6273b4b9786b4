"""Plots of a result in a notebook: `result.macroslip.plot.load_zone()`.

Importing this module registers the accessor with xarray; `macroslip.simulate` and
`macroslip.open_result` bring it. Pictures need matplotlib, which is imported when the first one is
drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import xarray as xr

from macroslip.errors import InputError, MacroslipError
from macroslip.overview import html_overview
from macroslip.printed import number
from macroslip.report import bearing_figures as draw
from macroslip.report.result_numbers import row_numbers
from macroslip.report.style import SMALL, program_style
from macroslip.result.run_input import run_input
from macroslip.result.stored import REMEDY, check_result
from macroslip.storage.files import check_regular

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.projections.polar import PolarAxes


def open_result(path: str | Path) -> xr.Dataset:
    """Read a netCDF file that `macroslip run` wrote into memory, with `result.macroslip.plot`.

    Raises InputError if there is no such file, or it cannot be read.
    """
    if Path(path).is_dir():
        raise InputError(
            "this is a folder", where=str(path), allowed="one netCDF file that macroslip run wrote"
        )
    (result,) = read_results(Path(path)).values()
    return result


def read_results(path: Path) -> dict[str, xr.Dataset]:
    """The datasets of a netCDF file, or of all netCDF files in a folder, by the name of the file.

    Subfolders are not searched. Raises InputError if there is no such path, the folder holds no
    netCDF file, or a file cannot be read or holds no result.
    """
    path = Path(path)
    if not path.exists():
        raise InputError(
            "there is no such file or folder",
            where=str(path),
            remedy="Name what macroslip run wrote.",
        )
    files = [path]
    if path.is_dir():
        files = sorted(path.glob("*.nc"))
    if not files:
        raise InputError(
            "the folder holds no netCDF file",
            where=str(path),
            allowed="files that macroslip run wrote (*.nc)",
        )
    for file in files:
        check_regular(file, REMEDY)
    datasets = {}
    for file in files:
        try:
            # Units of seconds are units, not times of day.
            datasets[file.stem] = xr.load_dataset(file, engine="h5netcdf", decode_times=False)
        except (OSError, ValueError, KeyError) as error:
            raise InputError(
                f"the file cannot be read as netCDF ({error})", where=str(file), remedy=REMEDY
            ) from None
        check_result(datasets[file.stem], str(file))
    return datasets


@xr.register_dataset_accessor("macroslip")
class Macroslip:
    """Accessor `macroslip` of a result: `plot`, and a summary for its display."""

    def __init__(self, result: xr.Dataset):
        self._result = result

    @property
    def plot(self) -> Plot:
        """Pictures of the result."""
        return Plot(self._result)

    def summary(self) -> pd.DataFrame:
        """The headline values of the result, units in the names, a column for each row.

        The model, oil and temperature stand in `attrs`.
        """
        import pandas as pd

        result = self._result
        columns = {}
        unknown = xr.DataArray(float("nan"))
        for numbers in row_numbers(result):
            of_row = result.sel(row=numbers["name"])
            by_interface = of_row.energy.mean("roller", skipna=False)
            columns[numbers["name"]] = {
                "mean energy per roller [J]": numbers["energy"],
                "largest energy of a roller [J]": numbers["most"],
                "energy at the inner raceway [J]": by_interface.sel(interface="inner").item(),
                "energy at the outer raceway [J]": by_interface.sel(interface="outer").item(),
                "energy at the cage [J]": by_interface.sel(interface="cage").item(),
                "rolling energy per roller [J]": float(
                    of_row.rolling_energy.sum("interface").mean("roller", skipna=False)
                ),
                "highest peak power [W]": numbers["peak"],
                "lowest spin / pure rolling [1]": numbers["spin"],
                "largest flash temperature [K]": of_row.get("flash_temperature", unknown)
                .max()
                .item(),
                "least film ratio [1]": of_row.get("min_film_ratio", unknown).min().item(),
                "failed rollers [1]": numbers["failed"],
            }
        table = pd.DataFrame(columns, dtype=float)
        table.attrs = {
            name: result.attrs[name] for name in ("title", "model", "oil") if name in result.attrs
        }
        return table

    @property
    def damage(self) -> xr.Dataset:
        """Criteria of damage by slip, as `macroslip.result.damage.damage` gives them."""
        from macroslip.result.damage import damage

        return damage(self._result)

    def _rows(self) -> list[list[str]]:
        return [
            [
                numbers["name"],
                number(numbers["energy"]),
                number(numbers["spin"], 3),
                f"{numbers['failed']} of {numbers['rollers']}",
            ]
            for numbers in row_numbers(self._result)
        ]

    def __repr__(self) -> str:
        rows = "; ".join(
            f"{name} {energy} J a roller, lowest spin {spin} of pure rolling, "
            f"{failed} rollers failed"
            for name, energy, spin, failed in self._rows()
        )
        warning = (
            f"; warning: {self._result.attrs['books_warning']}"
            if "books_warning" in self._result.attrs
            else ""
        )
        title = self._result.attrs.get("title", "result")
        return f"<{title}: {rows}{warning}>"

    def _repr_html_(self) -> str:
        headings = [
            "row",
            "mean energy of a roller [J]",
            "lowest spin / pure rolling [1]",
            "failed rollers",
        ]
        return html_overview(self._result.attrs.get("title", "result"), headings, self._rows())


class Plot:
    """Pictures of a result, on axes of yours or in figures of their own; each returns its axes.

    A figure of its own has the program's style; on axes of yours the picture has yours.
    """

    def __init__(self, result: xr.Dataset):
        self._result = result

    def _new_axes(
        self, projection: str | None = None, *, rows: int = 1, columns: int = 1, **options: Any
    ) -> Any:
        """Axes in a new figure, which a notebook shows, under the model, oil and temperature."""
        try:
            from matplotlib import pyplot
        except ModuleNotFoundError:
            raise MacroslipError(
                "a picture needs matplotlib: pip install 'macroslip[figures]'"
            ) from None
        from macroslip.report.styled_figure import StyledFigure

        # Outside the style's context: a notebook's backend becomes interactive with its first
        # figure, which would be undone with the style, and figures of the user would not be shown.
        figure = pyplot.figure(FigureClass=StyledFigure, layout="constrained", **options)
        with program_style():
            axes = figure.subplots(rows, columns, subplot_kw={"projection": projection})
            if "oil" in self._result.attrs:
                attributes = self._result.attrs
                model = f"model {attributes['model']}, {attributes['oil']}"
                figure.suptitle(model, fontsize=SMALL)
        return axes

    def _drawn(
        self,
        axes: Any,
        plot: Callable[..., Any],
        *data: Any,
        projection: str | None = None,
        legend: Mapping[str, Any] | None = None,
    ) -> Any:
        """The plot of the data on the axes given, or on new ones in the program's style."""
        if axes is None:
            new = self._new_axes(projection)
            with program_style():
                return self._drawn(new, plot, *data, legend=legend)
        plot(axes, *data)
        if legend is not None:
            axes.legend(frameon=False, fontsize=SMALL, **legend)
        return axes

    def _row(self, row: str | None, first: str = "downwind") -> str:
        if row:
            return row
        if first in self._result.row:
            return first
        return str(self._result.row[0].item())

    def energy(self, *, axes: Axes | None = None) -> Axes:
        """Energy of a mean roller of each row, by interface."""
        energy = self._result.energy
        return self._drawn(axes, draw.plot_energy_by_interface, energy, legend={})

    def rollers(self, row: str | None = None, *, axes: Axes | None = None) -> Axes:
        """Energy of every roller of a row, downwind by default, over the mean of the row."""
        energy = self._result.energy
        return self._drawn(axes, draw.plot_roller_spread, energy, self._row(row))

    def peaks(self, *, axes: Axes | None = None) -> Axes:
        """Share of orbits whose largest power exceeds a value, for both rows."""
        return self._drawn(axes, draw.plot_peak_exceedance, self._result, legend={})

    def spin(
        self, row: str | None = None, roller: int | None = None, *, axes: Axes | None = None
    ) -> Axes:
        """Spin of a roller and in pure rolling, by default of the upwind row. Needs traces."""
        number = roller
        if number is None:
            number = int(self._result.roller[0])
        row = self._row(row, "upwind")
        return self._drawn(axes, draw.plot_spin_over_time, self._result, row, number)

    def load_zone(self, row: str | None = None, *, axes: Axes | None = None) -> Axes:
        """Roller load over angle and time. Needs traces that begin with the loads."""
        from macroslip.result.orbit import load_zone

        load = load_zone(self._result)
        return self._drawn(axes, draw.plot_load_zone, load, self._row(row))

    def orbit(self, row: str | None = None, *, axes: PolarAxes | None = None) -> PolarAxes:
        """Dissipated energy over the orbit, looking downwind; own axes must be polar.

        Needs traces that begin with the loads.
        """
        from macroslip.result.orbit import energy_over_orbit

        return self._drawn(
            axes,
            draw.plot_energy_over_orbit,
            energy_over_orbit(self._result),
            self._row(row),
            projection="polar",
            legend={"loc": "upper center", "bbox_to_anchor": (0.5, -0.06)},
        )

    def bearing(self, *, axes: Axes | None = None) -> Axes:
        """All rows to scale, coloured by slip, at the moment of largest power. Needs traces."""
        from macroslip.result.orbit import still

        bearing = run_input(self._result).bearing
        return self._drawn(axes, draw.plot_bearing, still(self._result), bearing)

    def damage(self, *, axes: Axes | None = None) -> Axes:
        """Criteria of damage, each over its reference. Needs details of the contacts."""
        return self._drawn(axes, draw.plot_criteria, self._result.macroslip.damage)

    def wear(self, row: str | None = None, *, axes: Axes | None = None) -> Axes:
        """Worn profile of the raceways and the rollers of a row over the years."""
        criteria = self._result.macroslip.damage
        return self._drawn(axes, draw.plot_worn_profile, criteria, self._row(row), legend={})

    def maps(self, quantity: str = "energy", *, axes: Sequence[Axes] | None = None) -> list[Axes]:
        """Energy, or with "power" the largest power, per area on each of the four raceways.

        Needs a result of a model with microslip. Axes of your own are four: outer and inner raceway
        of each row.
        """
        from macroslip.result.surface_maps import energy_density

        if quantity not in ("energy", "power"):
            raise InputError(
                f"the quantity of the maps is {quantity!r}", allowed="'energy' or 'power'"
            )
        density = energy_density(self._result)
        units = "J/mm²"
        if quantity == "power":
            density = self._result.surface_power_density
            units = "W/mm²"
        panels = [(values, units, title) for title, values in draw.raceways(density).items()]
        return self._panels(axes, draw.plot_map, panels, (9.0, 6.0))

    def film_and_slip(
        self, row: str | None = None, quantity: str = "time", *, axes: Sequence[Axes] | None = None
    ) -> list[Axes]:
        """Time under load, or "passes", by Λ and slide-roll ratio with its sign.

        Needs details of the contacts. Axes of your own are two: inner and outer raceway.
        """
        if quantity not in draw.FILM_AND_SLIP:
            raise InputError(f"the quantity is {quantity!r}", allowed="'time' or 'passes'")
        if "film_slip_time" not in self._result:
            raise InputError(
                "the result has no time by film and slip",
                allowed="details of contacts",
                remedy="Write laws: {model: physical} and contact_details: true in the case.",
            )
        row = self._row(row)
        amounts = self._result[f"film_slip_{quantity}"].sel(row=row)
        units = draw.FILM_AND_SLIP[quantity]
        panels = [
            (amounts.sel(raceway=name), units, f"{row} row, {name}")
            for name in amounts.raceway.values.tolist()
        ]
        return self._panels(axes, draw.plot_film_and_slip, panels, (10.0, 3.8))

    def _panels(
        self,
        axes: Sequence[Axes] | None,
        plot: Callable[..., Axes],
        panels: Sequence[tuple[Any, ...]],
        size: tuple[float, float],
    ) -> list[Axes]:
        """The plot of each panel's data on the axes given, or on new ones of a size [inches]."""
        if axes is None:
            new = self._new_axes(rows=len(panels) // 2, columns=2, figsize=size)
            with program_style():
                return self._panels(new.ravel(), plot, panels, size)
        return [plot(panel, *data) for panel, data in zip(axes, panels, strict=True)]
