"""`macroslip compare`: results and designs side by side."""

import json

import pytest

from tests.quick import COARSE

pytestmark = pytest.mark.slow


@pytest.fixture
def ran(quick, folder, macroslip):
    """The same two seconds at two temperatures."""
    for name, further in (("cold", ""), ("warm", "temperature: 60 degC\n")):
        assert macroslip("run", quick(further), "-o", f"{name}.nc", "--quiet").code == 0
    return folder


def test_two_results(ran, macroslip):
    done = macroslip("compare", "cold.nc", "warm.nc", "--title", "Oil <b>")
    assert done.code == 0 and done.err == ""
    # Warm oil is thinner, and drags less.
    assert "warm dissipates least" in done.out and "temperature" in done.out
    page = (ran / "comparison.html").read_text(encoding="utf-8")
    assert "<h1>Oil &lt;b&gt;</h1>" in page and "warm dissipates least" in page
    again = macroslip("report", "cold.nc", "warm.nc")
    assert again.code == 2 and "the file exists" in again.err
    assert macroslip("report", "cold.nc", "warm.nc", "-o", "other.html", "--quiet").out == ""
    printed = json.loads(macroslip("compare", "cold.nc", "warm.nc", "--json", "--force").out)
    assert printed["inputs"]["temperature"] == {"cold": None, "warm": pytest.approx(333.15)}


def test_criteria_of_damage_stand_side_by_side(quick, folder, macroslip):
    for name, further in (("cold", ""), ("warm", "temperature: 60 degC\n")):
        integrator = f"integrator: {{tolerance: {COARSE.tolerance}}}\n"
        case = quick("laws: {model: physical}\n" + integrator + further)
        assert macroslip("run", case, "-o", f"{name}.nc", "--quiet").code == 0
    done = macroslip("compare", "cold.nc", "warm.nc")
    told = json.loads(macroslip("damage", "warm.nc", "--json").out)["criteria"]
    assert done.code == 0 and "value over reference" in done.out
    assert all(line["title"] in done.out for line in told)
    page = (folder / "comparison.html").read_text(encoding="utf-8")
    assert "From slip to damage" in page and "Criteria of damage of every result" in page
    printed = json.loads(macroslip("compare", "cold.nc", "warm.nc", "--json", "--force").out)
    assert printed["criteria"]["warm"] == told


def test_designs_of_a_study_with_an_event(folder, macroslip):
    (folder / "study.yaml").write_text(
        "case: {rollers: [0], loads: {start: 30 s, end: 46 s}, "
        f"integrator: {{tolerance: {COARSE.tolerance}}}}}\nloads: {{bundled: [12A, stop-14]}}\n"
        "lubricants: [vg460-pao, vg320-mineral]\n"
        "weights: {wind: {weibull: IEC II}, events: {stop-14: 100 per year}}\n",
        encoding="utf-8",
    )
    assert macroslip("study", "study.yaml", "-o", "out", "--quiet").code == 0
    done = macroslip("compare", "out", "--by", "lubricant")
    assert done.code == 0 and "dissipates least" in done.out and "supervisor is assumed" in done.out
    page = (folder / "out" / "comparison.html").read_text(encoding="utf-8")
    assert "vg320-mineral" in page
    told = macroslip("aggregate", "out", "-o", "tables")
    assert told.code == 0 and "whose supervisor is assumed" in told.out
    assert "stop-14" in (folder / "tables" / "year.csv").read_text(encoding="utf-8")
    assert macroslip("report", "out").code == 0
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert "dissipates least" in page and "supervisor is assumed" in page


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["cold.nc"], "one result only"),
        (["nothing.nc", "cold.nc"], "no such file"),
        (["cold.nc", "warm.nc", "--by", "x"], "no study"),
    ],
)
def test_what_cannot_be_compared(ran, macroslip, arguments, message):
    done = macroslip("compare", *arguments)
    assert done.code == 2 and message in done.err and "Traceback" not in done.err
