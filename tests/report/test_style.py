"""Pictures look the same whatever the user's settings of Matplotlib are, and need no backend of the user's."""

import base64
import os
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
import xarray as xr

from macroslip import Bearing, BearingLoads
from macroslip.report.bearing_drawing import draw_bearing
from macroslip.report.bearing_figures import plot_energy_by_interface
from macroslip.report.load_figures import load_figure
from macroslip.report.style import picture

matplotlib.use("agg")

#: Settings of a user; TeX need not be installed.
OWN = {
    "font.size": 31.0,
    "font.family": "serif",
    "lines.linewidth": 9.0,
    "axes.facecolor": "black",
    "xtick.major.size": 20.0,
    "text.usetex": True,
    "savefig.bbox": "tight",
}


@pytest.fixture
def energy():
    values = np.array([[[3.0, 2.0, 0.1]], [[1.0, 0.5, 0.2]]])
    names = {"row": ["downwind", "upwind"], "roller": [0], "interface": ["inner", "outer", "cage"]}
    return xr.DataArray(values, coords=names, dims=list(names), name="energy")


def pixels(figure):
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba()).copy()


def test_a_picture_of_a_page_does_not_follow_the_users_settings(energy):
    plain = picture(plot_energy_by_interface, "energy", energy, legend="above")
    with matplotlib.rc_context(OWN):
        assert picture(plot_energy_by_interface, "energy", energy, legend="above") == plain
    assert b"<svg" in base64.b64decode(plain.source.partition(",")[2])


def test_figures_of_loads_and_of_a_bearing_do_not_follow_them_where_they_are_saved(tmp_path):
    loads = BearingLoads.constant([0.0, -343.5e3, 100e3], 2.143, 14.0)
    time = np.linspace(0.0, 14.0, 20)
    bearing = Bearing.read("skf-240-600-bc")
    for name in ("plain", "own"):
        with matplotlib.rc_context(OWN if name == "own" else {}):
            load_figure(loads, time, 1e3 * time).savefig(tmp_path / f"{name}_loads.png")
            draw_bearing(bearing).savefig(tmp_path / f"{name}_bearing.png")
    for picture_of in ("loads", "bearing"):
        plain, own = (tmp_path / f"{name}_{picture_of}.png" for name in ("plain", "own"))
        assert plain.read_bytes() == own.read_bytes()


def test_a_figure_in_a_session_keeps_the_programs_style_and_the_session_its_own(energy):
    from matplotlib import pyplot

    from macroslip.report.accessor import Plot

    plot = Plot(xr.Dataset({"energy": energy}))
    plain = pixels(plot.energy().figure)
    with matplotlib.rc_context(OWN):
        assert np.array_equal(pixels(plot.energy().figure), plain)
        assert pyplot.rcParams["font.size"] == 31.0 and pyplot.rcParams["text.usetex"]
        with matplotlib.rc_context({"text.usetex": False}):
            figure, axes = pyplot.subplots()
            assert plot.energy(axes=axes) is axes and axes.get_facecolor() == (0.0, 0.0, 0.0, 1.0)
            assert not np.array_equal(pixels(figure), plain)
    assert pyplot.get_fignums(), "figures of a session are pyplot's, so that it shows them"
    pyplot.close("all")


def test_figures_beside_measurements_do_not_follow_them(monkeypatch, tmp_path):
    from validation.__main__ import main

    for name in ("plain", "own"):
        monkeypatch.setattr(sys, "argv", ["validation", "wear_lines", "-o", str(tmp_path / name)])
        with matplotlib.rc_context(OWN if name == "own" else {}):
            main()
    plain, own = (tmp_path / name / "measured_wear_lines.png" for name in ("plain", "own"))
    assert plain.read_bytes() == own.read_bytes()


def draw_in_a_process(folder, **environment):
    command = [
        sys.executable,
        "-c",
        "from macroslip.cli import main; main()",
        *("bearing", "draw", "skf-240-600-bc", "-o", "bearing.svg"),
    ]
    return subprocess.run(
        command, cwd=folder, env=os.environ | environment, capture_output=True, text=True
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "backend", ["module://no_such_package.backend", "no-such-backend", "TkAgg"]
)
def test_a_backend_that_is_not_installed_is_not_needed(backend, tmp_path):
    done = draw_in_a_process(tmp_path, MPLBACKEND=backend, DISPLAY="")
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "bearing.svg").stat().st_size > 1000


@pytest.mark.slow
def test_settings_of_the_current_folder_that_cannot_be_read_are_named(tmp_path):
    (tmp_path / "matplotlibrc").write_bytes(b"# caf\xe9\nfont.size: 30\n")
    done = draw_in_a_process(tmp_path)
    assert done.returncode == 2 and "error: Matplotlib" in done.stderr
    assert "'matplotlibrc'" in done.stderr and "internal error" not in done.stderr
    (tmp_path / "matplotlibrc").write_text("text.usetex: True\n")
    done = draw_in_a_process(tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
