"""The page on a study: numbers of its tables, what it leaves open, and that names in it stay text."""

import json
import re

import numpy as np
import pytest
import xarray as xr

from macroslip import open_study, run_study
from macroslip.constants import YEAR
from macroslip.report.study_page import CLASS_ONE, _without_folders, run_names, study_page
from macroslip.study.aggregation import Aggregation
from macroslip.study.lifetime import lifetime_energy, worst
from macroslip.study.reader import is_study
from macroslip.study.study_file import study_of
from macroslip.study.weights import Weibull

pytestmark = pytest.mark.slow


def opened(folder, **further):
    content = {
        "title": "Clearances <b>",
        "case": {"laws": {"model": "paper"}, "rollers": [0], "loads": {"end": "16 s"}},
        "loads": {"bundled": ["12A", "18B"]},
        "models": {"base": {}, "refused": {"bearing.osculation_outer": 1.5}},
    }
    run_study(study_of(content | further), folder)
    return open_study(folder)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study") / "out"
    page = opened(folder)
    assert is_study(folder) and not is_study(folder.parent)
    return page


@pytest.fixture(scope="module")
def page(study):
    return study_page(study, title="Mine <i>")


def section(page, name):
    (text,) = re.findall(rf'<section[^>]*id="{name}".*?</section>', page, re.DOTALL)
    return text


def paragraphs(html):
    """Texts with white space as a browser shows it."""
    return [
        " ".join(paragraph.split())
        for paragraph in re.findall(r"<p[^>]*>(.*?)</p>", html, re.DOTALL)
    ]


def test_the_answer_counts_what_failed(page):
    assert "2 of 4 runs completed, 2 FAILED, 0 are missing." in section(page, "answer")


def test_the_opening_has_designs_and_largest_values(page, study):
    opening = section(page, "answer")
    reported = paragraphs(opening)
    assert len(reported) == 3 and opening.count("<img") == 4
    # The refused model has no energy; without weights a year consists of the two cases.
    kept = study.isel(case=np.flatnonzero(study.model.values == "base"))
    power = float((kept.energy_mean / kept.window_length).sum("row").mean())
    table = opening.split("<tbody>")[1].split("</tbody>")[0]
    assert f">{1e-6 * YEAR * power:.3g}<" in table and "1 base" in table and "2 refused" in table
    assert (
        "all its cases count alike" in reported[1]
        and "2 runs without a result are left out." in reported[1]
    )
    _, _, missing = reported[1].partition(
        "lack the variables for it or the model does not compute it: "
    )
    assert "wear at k = 1e-17 m²/N" in missing
    for name in ("energy_mean", "peak_power_max"):
        first = worst(study, name, count=1).isel(rank=0)
        # By case and design, not by file.
        assert f"{first.row.item()} in {first.loads.item()}, {first.model.item()}." in reported[2]
    assert "4 runs, 2 load histories, bearing skf-240-600-bc" in page


def test_designs_are_ranked_by_energy(study):
    kept = study.isel(case=np.flatnonzero(study.model.values == "base"))
    other = kept.assign_coords(model=("case", ["twice"] * kept.sizes["case"])).assign(
        energy_mean=2.0 * kept.energy_mean
    )
    both = xr.concat([other, kept], "case", data_vars="minimal", combine_attrs="override")
    opening = section(study_page(both, title="Two"), "answer")
    assert opening.index("1 base") < opening.index("2 twice")
    assert (
        paragraphs(opening)[0].startswith("base dissipates least")
        and "twice 100 % more" in paragraphs(opening)[0]
    )


def in_full(energy):
    """Four digits of an energy of more than 1 MJ."""
    return f">{1e-6 * float(energy):.4g}</td>"


def test_lifetime_energy_is_that_of_the_function(page, study):
    life = lifetime_energy(study, Aggregation(CLASS_ONE))
    for row in ("downwind", "upwind"):
        assert in_full(life.lifetime_energy.isel(group=0).sel(row=row)) in section(page, "lifetime")
    assert f"{100.0 * float(life.covered):.0f} % of all time" in page
    assert "Rayleigh distribution with a mean of 10 m/s" in page


def test_class_one_has_a_mean_of_ten_metres_a_second():
    from scipy.stats import weibull_min

    assert weibull_min(CLASS_ONE.shape, scale=CLASS_ONE.scale).mean() == pytest.approx(
        10.0, rel=1e-4
    )


def test_weights_of_ones_own(study):
    own = Weibull(9.0, 2.2)
    page = study_page(study, title="x", weights=own)
    assert "scale 9 m/s and shape 2.2" in page
    life = (
        lifetime_energy(study, Aggregation(own)).lifetime_energy.isel(group=0).sel(row="downwind")
    )
    assert in_full(life) in section(page, "lifetime")


def test_the_worst_case_heads_its_table(page, study):
    first = worst(study, "peak_power_max", count=1).isel(rank=0)
    table = section(page, "worst").split("<caption>By largest power at any interface")[1]
    heading, *_ = table.split("<tbody>")[1].split("</tr>")
    assert f">{first.loads.item()}</td>" in heading and f">{first.row.item()}</td>" in heading
    assert f"{float(first.peak_power_max):.4g}" in heading


def test_exceedance_has_a_picture_of_energy_and_of_power(page):
    assert section(page, "exceedance").count("<img") == 2


def test_failures_have_their_reasons(page):
    failures = section(page, "failures")
    assert failures.count("osculation_outer: it is 1.5. Allowed: ") == 2
    assert "12A" in failures and "18B" in failures


def test_names_stay_text_and_the_page_refers_to_nothing_outside(page):
    assert "<h1>Mine &lt;i&gt;</h1>" in page
    assert "Clearances <b>" not in page and "Clearances &lt;b&gt;" in page
    assert re.findall(r"""(?:src|href)=["'](?!data:|#)""", page) == []


def test_without_wind_speeds_and_energies_of_orbits_the_page_says_so(tmp_path):
    kept = opened(tmp_path / "out", keep=["energy"], models={"base": {}})
    assert "orbit_energy" not in kept and "energy" in kept
    page = study_page(kept.drop_vars("wind_speed"), title="x")
    assert "There is no lifetime energy" in section(page, "lifetime")
    assert "no label sorts them into bins" in section(page, "exceedance")
    assert "No run failed" in section(page, "failures")
    assert "the results hold no orbit_energy" in section(study_page(kept, title="x"), "exceedance")


def test_the_page_has_no_folders_of_the_computer():
    given = {
        "loads": {"files": ["/home/me/runs/{a}.csv", "runs/b.csv"]},
        "bearings": ["/home/me/own.yaml"],
        "title": "a / b",
    }
    expected = {
        "loads": {"files": ["{a}.csv", "runs/b.csv"]},
        "bearings": ["own.yaml"],
        "title": "a / b",
    }
    assert json.loads(_without_folders(json.dumps(given))) == expected


def test_runs_are_named_by_case_and_design_not_by_file():
    labels = {
        "loads": ["runs/12_1.csv", "runs/14_2.csv"] * 2,
        "wind_speed": [12.0, 14.0] * 2,
        "seed": [1, 2] * 2,
        "bearing": ["A", "A", "B", "B"],
        "lubricant": ["oil"] * 4,
        "model": ["base"] * 4,
        "drivetrain.tilt": [5.0] * 4,
    }
    study = xr.Dataset(
        coords={name: ("case", values, {"units": "1"}) for name, values in labels.items()}
    )
    study.wind_speed.attrs["units"] = "m/s"
    assert run_names(study)[:3] == ["12 m/s, seed 1, A", "14 m/s, seed 2, A", "12 m/s, seed 1, B"]
    # Fields that do not tell files apart are no names.
    alike = study.drop_vars("seed").assign_coords(wind_speed=("case", [12.0] * 4, {"units": "m/s"}))
    assert run_names(alike)[0] == "12_1.csv, A"
