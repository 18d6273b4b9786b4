"""`result.macroslip`: pictures of a result, each of the numbers that the result holds."""

import subprocess
import sys

import matplotlib
import numpy as np
import pytest

from macroslip import BearingLoads, Case, InputError, Laws, Traces, open_result, simulate
from macroslip.result.surface_maps import energy_density

pytestmark = pytest.mark.slow

matplotlib.use("agg")


@pytest.fixture(scope="module")
def result():
    loads = BearingLoads.constant([0.0, -343.5e3, 100e3], 2.143, 14.0)
    return simulate(
        Case(loads=loads, laws=Laws.paper(), rollers=[0, 7, 14, 21], traces=Traces(step=0.02))
    )


@pytest.fixture(autouse=True)
def closed():
    from matplotlib import pyplot

    yield
    pyplot.close("all")


def test_spin_is_the_traced_one(result):
    axes = result.macroslip.plot.spin("upwind", 14)
    lines = {line.get_label(): line.get_xydata() for line in axes.lines}
    roller = result.sel(row="upwind", roller=14)
    assert np.array_equal(lines["roller"], np.column_stack([roller.time, abs(roller.spin)]))
    assert np.array_equal(lines["pure rolling"][:, 1], abs(roller.spin_pure.values))


def test_energy_bars_are_the_means_over_the_rollers(result):
    axes = result.macroslip.plot.energy()
    heights = [bar.get_height() for bar in axes.patches]
    assert heights == pytest.approx(result.energy.mean("roller").values.ravel(), rel=1e-12)


@pytest.mark.parametrize(
    "name", ["energy", "peaks", "rollers", "spin", "load_zone", "orbit", "bearing"]
)
def test_every_picture_is_drawn_on_new_axes_or_on_those_given(result, name):
    from matplotlib.figure import Figure

    draw = getattr(result.macroslip.plot, name)
    figure = draw().figure
    assert figure.axes and figure.get_suptitle() == f"model paper, {result.attrs['oil']}"
    projection = {"projection": "polar"} if name == "orbit" else {}
    axes = Figure().add_subplot(**projection)
    assert draw(axes=axes) is axes


def test_maps_are_those_of_the_result():
    from matplotlib import pyplot

    loads = BearingLoads.constant([0.0, -343.5e3, 100e3], 2.143, 8.0)
    result = simulate(Case(loads=loads, rollers=[0], laws=Laws.physical()))
    for quantity, density in (
        ("energy", energy_density(result)),
        ("power", result.surface_power_density),
    ):
        drawn = result.macroslip.plot.maps(quantity)
        assert [axes.get_title(loc="left") for axes in drawn] == [
            f"{row} row, {raceway} raceway"
            for row in ("downwind", "upwind")
            for raceway in ("outer", "inner")
        ]
        for axes, row, raceway in zip(
            drawn, ["downwind"] * 2 + ["upwind"] * 2, ["outer", "inner"] * 2, strict=True
        ):
            (image,) = axes.images
            values = 1e-6 * density.sel(row=row, raceway=raceway).values
            assert (
                image.get_array().sum() == pytest.approx(values.sum(), rel=1e-12)
                and values.sum() >= 0.0
            )
    _, own = pyplot.subplots(1, 4)
    assert result.macroslip.plot.maps(axes=own)[3] is own[3]
    with pytest.raises(InputError, match="'energy' or 'power'"):
        result.macroslip.plot.maps("heat")


def test_without_microslip_there_are_no_maps(result):
    with pytest.raises(InputError, match="microslip"):
        result.macroslip.plot.maps()


def test_time_and_passes_by_film_and_slip_add_up_to_a_hundred_percent(result):
    loads = BearingLoads.constant([0.0, -343.5e3, 100e3], 2.143, 8.0)
    detailed = simulate(Case(loads=loads, rollers=[0], laws=Laws.physical()))
    for quantity in ("time", "passes"):
        for axes, raceway in zip(
            detailed.macroslip.plot.film_and_slip("downwind", quantity),
            ["inner", "outer"],
            strict=True,
        ):
            shares = 0.01 * 10.0 ** np.asarray(axes.collections[0].get_array())
            amounts = detailed[f"film_slip_{quantity}"].sel(row="downwind", raceway=raceway)
            assert shares[shares > 0.0101].sum() == pytest.approx(100.0, abs=0.5)
            film, slip = np.unravel_index(np.argmax(shares), shares.shape)
            assert amounts[film, slip] == amounts.max()
    with pytest.raises(InputError, match="'time' or 'passes'"):
        detailed.macroslip.plot.film_and_slip(quantity="heat")
    with pytest.raises(InputError, match="physical"):
        result.macroslip.plot.film_and_slip()


def test_pictures_that_need_traces_say_so(result):
    bare = result.drop_dims("time")
    for name in ("spin", "load_zone", "orbit", "bearing"):
        with pytest.raises(InputError, match=r"has no traces.*step: 0.05 s"):
            getattr(bare.macroslip.plot, name)()


def test_the_summary_has_the_numbers_of_the_result(result):
    energy = float(result.energy.sel(row="downwind").sum("interface").mean("roller"))
    for text in (repr(result.macroslip), result.macroslip._repr_html_()):
        assert f"{energy:.4g}" in text and "0 of 4" in text


def test_a_file_opens_with_its_pictures(result, tmp_path):
    (tmp_path / "case.nc").write_bytes(result.to_netcdf(engine="h5netcdf"))
    opened = open_result(tmp_path / "case.nc")
    assert opened.energy.equals(result.energy) and opened.macroslip.plot.energy().patches
    with pytest.raises(InputError, match="this is a folder"):
        open_result(tmp_path)


def test_importing_the_package_imports_neither_xarray_nor_matplotlib():
    code = "import sys, macroslip; print([name for name in ('xarray', 'matplotlib') if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
    code = "import sys; from macroslip import simulate; print('matplotlib' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
