"""The section on a bearing whose rollers and cages move together, and its moving picture."""

import base64
import re
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from macroslip import BearingLoads, Case, Laws, Traces, simulate
from macroslip.bearing import Bearing
from macroslip.report.answer import answer
from macroslip.report.bearing_figures import plot_force_by_position, plot_residuals
from macroslip.report.bearing_view import scene_data
from macroslip.report.result_numbers import counterpart, is_whole
from macroslip.report.results_page import results_page
from macroslip.result.orbit import in_window, scene

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def case():
    loads = BearingLoads.constant([0.0, -343e3, 0.0], 2.143, 2.0)
    return Case(loads=loads, laws=Laws.paper(), traces=Traces(step=0.05))


@pytest.fixture(scope="module")
def results(case):
    return {"imposed": simulate(case), "coupled": simulate(replace(case, dynamics="whole-bearing"))}


@pytest.fixture(scope="module")
def page(results):
    return results_page(results)


def test_only_a_coupled_result_has_the_section(results, page):
    assert is_whole(results["coupled"])
    assert not is_whole(results["imposed"])
    assert 'id="whole-1"' in page and 'id="whole"' not in page


def test_it_finds_the_same_case_on_imposed_orbits(case, results):
    assert counterpart(results["coupled"], results) == "imposed"
    other = simulate(replace(case, drag=False))
    assert counterpart(results["coupled"], {"other": other}) is None


def test_numbers_stand_on_the_page(page, results):
    coupled, imposed = results["coupled"], results["imposed"]
    assert "Orbit and spin together" in page
    assert "Angular momentum closes to" in page
    for row in ("downwind", "upwind"):
        selection = {"row": row, "interface": "cage"}
        energies = [
            float(result.energy.sel(selection).mean("roller")) for result in (imposed, coupled)
        ]
        assert f'class="number">{energies[1]:.4g}</td>' in page
        assert f'class="number">{energies[1] / energies[0]:.4g}</td>' in page
    assert f'class="number">{float(coupled.largest_pocket_force.max()):.4g}</td>' in page


def test_its_rows_are_told_by_its_own_motion(results):
    coupled = results["coupled"]
    window = in_window(coupled)
    sentences = answer(coupled)
    assert [sentence.partition(":")[0] for sentence in sentences] == ["Downwind row", "Upwind row"]
    for row, sentence in zip(("downwind", "upwind"), sentences, strict=True):
        of_row = window.sel(row=row)
        ratio, pressed = (of_row.spin / of_row.spin_pure).values, of_row.roller_load.values > 0.0
        told = [float(number) for number in re.findall(r"\d+\.?\d*", sentence)]
        if pressed.any():
            assert told[0] == pytest.approx(100.0 * pressed.mean(), rel=0.05)
            assert told[1] == pytest.approx(abs(100.0 - 100.0 * ratio[pressed].mean()), rel=0.5)
            assert told[2] == pytest.approx(100.0 * ratio[~pressed].min(), rel=0.05)
        else:
            quantiles = 100.0 * np.quantile(ratio, [0.05, 0.95])
            assert "never loaded" in sentence and told == pytest.approx(quantiles, rel=0.05)


def test_figures_show_what_the_result_holds(results):
    axes = Figure().add_subplot(projection="polar")
    plot_force_by_position(axes, results["coupled"], "upwind")
    drawn = axes.lines[0].get_ydata()[:-1]
    # Once round and on to where it began, never back across the picture.
    angle = axes.lines[0].get_xdata()
    assert (np.diff(angle) > 0.0).all()
    assert angle[-1] - angle[0] == pytest.approx(2.0 * np.pi)
    wanted = results["coupled"].largest_force_by_position.sel(row="upwind").values
    assert drawn == pytest.approx(np.maximum(wanted, 0.1))
    axes = Figure().subplots()
    plot_residuals(axes, results["coupled"])
    assert [line.get_label() for line in axes.lines] == ["angular momentum", "energy"]
    assert max(axes.lines[0].get_ydata()) < 1e-5


def test_the_moving_bearing_has_pockets(results):
    bearing = Bearing.read("skf-240-600-bc")
    assert scene_data(scene(results["imposed"]), bearing)["pockets"] is None
    coupled = results["coupled"]
    data = scene_data(scene(coupled), bearing)
    pockets = data["pockets"]
    codes = np.frombuffer(base64.b64decode(pockets["codes"]), "<u2").reshape(
        coupled.pocket_offset.shape
    )
    offsets = pockets["reach"] * (2.0 * codes / 65534 - 1.0)
    assert offsets == pytest.approx(1e3 * coupled.pocket_offset.values, abs=1e-4 * pockets["reach"])
    lead = np.frombuffer(base64.b64decode(pockets["lead"]), "<f4").reshape(2, -1)
    assert lead[0] == pytest.approx(
        np.degrees(coupled.cage_lag.values[0] / bearing.pitch_radius), abs=1e-6
    )
    assert data["quantities"][pockets["force"]]["unit"] == "N"
    # Neighbouring pockets do not meet in the drawing.
    free = 2.0 * np.pi * bearing.pitch_radius / bearing.rollers_per_row - bearing.roller_diameter
    assert pockets["enlarged"] * pockets["reach"] < 0.5e3 * free
