"""A kind of bearing is one place: results, studies, pages and commands ask what it has, not its name."""

import ast
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, InputError, Laws, simulate
from macroslip.bearing import bearing as bearing_files
from macroslip.bearing import load_ratings
from macroslip.kinds import KINDS
from macroslip.kinds.spherical import Spherical
from macroslip.rating import kinds as ratings
from macroslip.report.answer import answer
from macroslip.report.bearing_drawing import draw_bearing
from macroslip.result.plausibility import doubtful_result
from macroslip.result.rating import rate_case, with_rating
from tests.quick import COARSE

SOURCES = Path(__file__).parents[2] / "src" / "macroslip"
FOLDERS = ("report", "study", "cli", "result")
FILES = [path for folder in FOLDERS for path in sorted((SOURCES / folder).rglob("*.py"))]


def asked(tree):
    """Names of kinds and of what is theirs, their modules, and comparisons of a number of rows."""
    modules = {f"macroslip.kinds.{name}" for name in KINDS}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and node.value in KINDS:
            yield f"line {node.lineno}: the word {node.value!r}"
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            is_of_kind = any(module.startswith(name) for name in modules)
            if is_of_kind or module.startswith("macroslip.bearing.tapered"):
                yield f"line {node.lineno}: {module}"
        elif isinstance(node, ast.Name) and any(name in node.id.lower() for name in KINDS):
            yield f"line {node.lineno}: the name {node.id}"
        elif isinstance(node, ast.Call) and ast.unparse(node.func) == "isinstance":
            if "Bearing" in ast.unparse(node.args[1]).replace("BearingLoads", "").split(", "):
                yield f"line {node.lineno}: {ast.unparse(node)}"
        elif isinstance(node, ast.Compare):
            sides = [node.left, *node.comparators]
            if any(isinstance(side, ast.Attribute) and side.attr == "rows" for side in sides):
                yield f"line {node.lineno}: {ast.unparse(node)}"


def test_no_file_above_asks_for_the_name_of_a_kind():
    assert len(FILES) > 80
    for path in FILES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        assert not list(asked(tree)), path


@pytest.mark.parametrize(
    "line",
    [
        "if bearing.kind == 'tapered': pass",
        "isinstance(bearing, Bearing)",
        "from macroslip.kinds.tapered.history import STEEL_EXPANSION",
        "if bearing.rows == 2: pass",
    ],
)
def test_such_a_line_would_be_seen(line):
    assert list(asked(ast.parse(line)))


class Barrel(Spherical):
    """A kind of the test: barrel rollers in two rows that carry no thrust, with words of its own."""

    name = "barrel"
    replenishment_factor = 5.4
    carries_rotors_only = False
    carries_thrust = False
    station_axis = "the barrel"

    def check(self, case):
        yield from super().check(case)
        if case.drag:
            yield InputError("barrels run without drag", where="forces.drag")

    def sentences(self, result, bearing):
        return [f"{bearing['name']} has barrels."]

    def doubts(self, result):
        return ["a barrel is seldom meant."]


class BarrelBearing(Bearing):
    """A bearing of that kind."""

    kind = "barrel"


class BarrelRating(ratings._Spherical):
    """Its rating, without thrust."""

    def equivalent(self, bearing, radial_load, axial_load):
        radial = np.asarray(radial_load, dtype=float)
        return ratings.EquivalentLoads(radial, radial)


@pytest.fixture
def barrel(monkeypatch):
    """A bearing of the kind, which is entered with its rows, its ratings and what it has."""
    monkeypatch.setitem(bearing_files._ROWS, "barrel", 2)
    monkeypatch.setitem(load_ratings.RATING_FACTORS, "barrel", 1.15)
    monkeypatch.setitem(ratings._RATINGS, "barrel", BarrelRating())
    monkeypatch.setitem(KINDS, "barrel", Barrel())
    return BarrelBearing.from_dict(Bearing.read("skf-240-600-bc").as_dict())


@pytest.mark.slow
def test_a_kind_of_ones_own_is_computed_rated_drawn_and_told_of(barrel):
    loads = BearingLoads.constant([0.0, -400e3, 100e3], 2.0, 4.0)
    case = Case(
        loads=loads, bearing=barrel, laws=Laws.physical(), rollers=[0], integrator=COARSE, oil_supply="skf", drag=False,
    )  # fmt: skip
    result = with_rating(simulate(case), case)
    assert (result.status == 0).all()
    assert "axial_travel" not in result
    assert result.station.long_name == "place along the barrel"
    base = rate_case(replace(case, bearing=Bearing.read("skf-240-600-bc")))
    assert float(result.basic_life) > float(base.basic_life)
    assert any("has barrels" in sentence for sentence in answer(result))
    assert "a barrel is seldom meant." in doubtful_result(result)
    assert draw_bearing(barrel).axes


def test_a_case_is_refused_as_its_kind_says(barrel):
    loads = BearingLoads.constant([0.0, -400e3, 100e3], 2.0, 4.0)
    with pytest.raises(InputError, match="barrels run without drag"):
        Case(loads=loads, bearing=barrel)
