"""`macroslip doctor --warm`: afterwards nothing is compiled, and a case finds its tables."""

from dataclasses import replace
from pathlib import Path

import pytest

from macroslip.bearing.kinds import read_bearing
from macroslip.case.case import Case
from macroslip.case.case_file import read_case
from macroslip.case.parts import BackwardEuler, ExplicitEuler, Traces
from macroslip.contact import table
from macroslip.contact.mechanisms import Laws
from macroslip.loads import BearingLoads, Drivetrain
from macroslip.result.rating import with_rating
from macroslip.result.simulate import simulate
from macroslip.roller import skew_table
from macroslip.storage import tables
from macroslip.storage.waiting import COMPILING, heard_by
from tests.quick import COARSE

#: Bearings that were measured.
DATA = Path(__file__).parents[2] / "validation" / "data"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def warmed(tmp_path_factory):
    """A case file whose tables are made, by the command."""
    from typer.testing import CliRunner

    from macroslip.cli.commands import app

    path = tmp_path_factory.mktemp("warm") / "case.yaml"
    path.write_text(
        "loads: {main_bearing: {force: [0 N, -60 kN, 40 kN], shaft_speed: 20 rpm, duration: 2 s}}\n"
        "rollers: [0]\n"
        "temperature: 37 degC\nlaws: {model: physical, skew: quasi-static}\n"
        f"integrator: {{tolerance: {COARSE.tolerance}}}\n"
    )
    done = CliRunner().invoke(app, ["doctor", "--warm", str(path)])
    assert done.exit_code == 0 and "caches" in done.stdout
    return path


def test_a_warmed_case_makes_no_table(warmed, monkeypatch):
    for module in (table, skew_table):
        monkeypatch.setattr(module, "_sheet", lambda *given: pytest.fail("a table is made"))
    monkeypatch.setattr(tables, "_in_memory", tables.LRUCache(1e9, getsizeof=tables._size))
    assert (simulate(read_case(warmed)).status == 0).all()


@pytest.mark.parametrize("dynamics", ["imposed-orbit", "whole-bearing"])
@pytest.mark.parametrize(
    "further",
    ["laws: {model: paper}", "traces: none", "contact_details: false", "forces: {gravity: false}"],
)
def test_nothing_is_compiled_any_more(warmed, tmp_path, dynamics, further):
    """Whatever else a case chooses."""
    path = tmp_path / "case.yaml"
    path.write_text(
        f"loads: {{bundled: 24A, start: 60 s, end: 60.4 s}}\nrollers: [3]\ndynamics: {dynamics}\n"
        f"traces: {{step: 0.1 s}}\n{further}\n".replace("traces: {step: 0.1 s}\ntraces", "traces")
    )
    heard = []
    with heard_by(lambda *told: heard.append(told)):
        simulate(read_case(path))
    assert [told for told in heard if told[0] == COMPILING] == []


@pytest.mark.parametrize("integrator", [BackwardEuler(step=0.01), ExplicitEuler(step=1e-4)])
def test_nor_by_other_integrators(warmed, integrator):
    heard = []
    case = replace(read_case(warmed), laws=Laws.paper(), integrator=integrator, temperature=None)
    with heard_by(lambda *told: heard.append(told)):
        simulate(case)
    assert [told for told in heard if told[0] == COMPILING] == []


def test_nor_for_a_tapered_bearing(warmed):
    heard = []
    case = Case(
        loads=BearingLoads.constant([0.0, -60e3, 30e3], 1.2, 10.0),
        bearing=read_bearing("tdo-main-bearing"),
        drivetrain=Drivetrain(mount="alone"),
        oil_supply="flooded",
        rollers=[3],
        integrator=COARSE,
    )
    with heard_by(lambda *told: heard.append(told)):
        with_rating(simulate(case), case)
    assert [told for told in heard if told[0] == COMPILING] == []


@pytest.mark.parametrize("dynamics", ["imposed-orbit", "whole-bearing"])
@pytest.mark.parametrize("profile", [None, "logarithmic"])
def test_nor_for_a_cylindrical_bearing(warmed, dynamics, profile):
    bearing = read_bearing(DATA / "cylindrical-160.yaml")
    if profile is not None:
        bearing = bearing.replace(roller_crown_radius=None, roller_profile=profile)
    heard = []
    case = Case(
        loads=BearingLoads.constant([0.0, -20e3, 0.0], 30.0, 0.3),
        bearing=bearing,
        oil_supply="flooded",
        rollers=[3],
        dynamics=dynamics,
        traces=Traces(step=0.1),
        laws=Laws.physical(),
        integrator=COARSE,
    )
    with heard_by(lambda *told: heard.append(told)):
        with_rating(simulate(case), case)
    assert [told for told in heard if told[0] == COMPILING] == []


def test_nor_for_a_whole_bearing_whose_rollers_skew(warmed):
    heard = []
    case = replace(read_case(warmed), dynamics="whole-bearing", traces=Traces(step=0.1))
    with heard_by(lambda *told: heard.append(told)):
        simulate(case)
    assert [told for told in heard if told[0] == COMPILING] == []


def test_a_case_without_warm_is_refused(macroslip):
    done = macroslip("doctor", "case.yaml")
    assert done.code == 2 and "Add --warm" in done.err


def test_a_temperature_that_is_not_known_before_is_refused(macroslip, tmp_path, monkeypatch):
    from macroslip.result import warm

    monkeypatch.setattr(warm, "compile_all", lambda: None)
    path = tmp_path / "case.yaml"
    path.write_text(
        "loads: {bundled: 14B, end: 10 s}\ntemperature: balance\n"
        "heat: {conductance: 60 W/K, ambient: 15 degC}\n"
    )
    done = macroslip("doctor", "--warm", path)
    assert done.code == 2 and "tables are not known before it is computed" in " ".join(
        done.err.split()
    )
