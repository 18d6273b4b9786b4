"""Stiffness of the ring against differences of its balance, and of an energy with tilted rings."""

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from macroslip import BearingLoads, Case
from macroslip.errors import InputError
from macroslip.result.stiffness import (
    LOADS,
    MOTIONS,
    STIFFNESS,
    UNITS,
    _ring,
    ring_stiffness,
    stiffness_data,
    stiffness_table,
)
from macroslip.ring.balance import balance, tangent_stiffness
from tests.variables import check_variables

#: A single-row cylindrical roller bearing.
CYLINDRICAL = Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml"
FORCE = np.array([-60e3, -400e3, 120e3])


@pytest.fixture(scope="module")
def geometry(bearing, lubricant):
    return _ring(bearing, lubricant)


def test_differences_of_the_balance_are_its_inverse(geometry):
    """The compliance, from balances under slightly different loads, inverted."""
    angle = np.array([0.37])
    displacement, _ = balance(geometry, angle, FORCE[None], np.zeros((1, 3)))
    step = 50.0
    columns = []
    for axis in np.eye(3):
        ends = [
            balance(geometry, angle, (FORCE + sign * step * axis)[None], displacement)[0][0]
            for sign in (1.0, -1.0)
        ]
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    compliance = np.array(columns).T
    stiffness = tangent_stiffness(geometry, angle, displacement)[0]
    assert np.abs(np.linalg.inv(compliance) - stiffness).max() < 1e-5 * stiffness.max()
    np.testing.assert_allclose(stiffness, stiffness.T, rtol=1e-12)


def test_all_five_degrees_of_freedom_of_tilted_rings(geometry, bearing):
    """Differences of an energy whose inner ring is displaced and turned as a rigid body.

    The rollers go with the inner ring and touch the sphere of the outer raceway: a roller's approach
    is its distance from the centre of the sphere less that at rest and the play. Displacements are not
    small against the approach there, which makes up for 1 % of the stiffness.
    """
    angle = np.array([0.37])
    displacement, _ = balance(geometry, angle, FORCE[None], np.zeros((1, 3)))
    turn = geometry.orbit_ratio * angle[0]
    cosine = geometry.cosine * math.cos(turn) - geometry.sine * math.sin(turn)
    sine = geometry.sine * math.cos(turn) + geometry.cosine * math.sin(turn)
    radial = geometry.cos_contact_angle
    normals = np.column_stack([cosine * radial, sine * radial, geometry.axial])
    radius = 0.4
    play = geometry.radial_play * radial

    def energy(motion):
        x, y = motion[3:]
        about_x = np.array(
            [[1, 0, 0], [0, math.cos(x), -math.sin(x)], [0, math.sin(x), math.cos(x)]]
        )
        about_y = np.array(
            [[math.cos(y), 0, math.sin(y)], [0, 1, 0], [-math.sin(y), 0, math.cos(y)]]
        )
        centres = radius * normals @ (about_y @ about_x).T + motion[:3]
        approach = np.maximum(np.linalg.norm(centres, axis=1) - radius - play, 0.0)
        return 0.4 * geometry.stiffness * (approach**2.5).sum()

    at = np.append(displacement[0], [0.0, 0.0])
    steps = np.array([1e-7] * 3 + [1e-6] * 2)

    def second(i, k):
        total = 0.0
        for a in (1.0, -1.0):
            for b in (1.0, -1.0):
                moved = at.copy()
                moved[i] += a * steps[i]
                moved[k] += b * steps[k]
                total += a * b * energy(moved)
        return total / (4.0 * steps[i] * steps[k])

    differences = np.array([[second(i, k) for k in range(5)] for i in range(5)])
    stiffness = np.zeros((5, 5))
    stiffness[:3, :3] = tangent_stiffness(geometry, angle, displacement)[0]
    # Contact normals that pass the centre at a tenth of the radius would have entries of a tenth.
    scale = stiffness.max() * np.outer(
        [1.0, 1.0, 1.0, radius, radius], [1.0, 1.0, 1.0, radius, radius]
    )
    off = np.abs(differences - stiffness) / scale
    assert off[:3, :3].max() < 0.02
    assert off[3:].max() < 0.005 and off[:, 3:].max() < 0.005


def case(force=FORCE, **others):
    return Case(loads=BearingLoads.constant(force, 2.1, 1.0), **others)


def test_table_and_matrices_agree_and_have_units():
    stiffness = ring_stiffness({"a": case(), "b": case([0.0, -200e3, 50e3])})
    check_variables(stiffness, STIFFNESS)
    table = stiffness_table(stiffness)
    data = json.loads(json.dumps(stiffness_data(stiffness)))
    assert len(table) == 6 and len(data["points"]) == 6
    for (_, line), point in zip(table.iterrows(), data["points"], strict=True):
        matrix = np.array(point["stiffness"])
        np.testing.assert_array_equal(matrix, matrix.T)
        assert point["held"]
        for i, load in enumerate(LOADS):
            for k, motion in enumerate(MOTIONS):
                assert line[f"k {load} {motion} [{UNITS[i][k]}]"] == matrix[i, k]
    assert UNITS[0][0] == "N/m" and UNITS[0][3] == "N/rad" and UNITS[4][2] == "N m/m"
    assert (table["variation over a pitch [1]"] < 0.2).all()


def test_stiffness_grows_with_the_load():
    loads = {f"{scale}": case(FORCE * scale) for scale in (0.5, 1.0, 2.0)}
    diagonal = ring_stiffness(loads).sel(load="F_Y0", motion="d_Y0").stiffness.values[::3]
    assert (np.diff(diagonal) > 0.0).all()


def test_a_ring_that_is_not_held_is_marked():
    """Without load nothing holds it."""
    stiffness = ring_stiffness({"idle": case([0.0, 0.0, 0.0])})
    assert not stiffness.held.any() and (stiffness.stiffness == 0.0).all()


def test_bearings_that_do_not_align_themselves_are_refused():
    from macroslip import Bearing

    cylindrical = case([0.0, -10e3, 0.0], bearing=Bearing.read(CYLINDRICAL))
    with pytest.raises(
        InputError, match="cylindrical roller bearing, whose stiffness is not computed"
    ):
        ring_stiffness({"one": cylindrical})


@pytest.mark.slow
def test_the_command(tmp_path, monkeypatch):
    from typer.testing import CliRunner

    from macroslip.cli.commands import app

    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.yaml").write_text("loads: {bundled: 14B, start: 0 s, end: 5 s}\n")
    arguments = ["stiffness", "case.yaml", "--loads", "14B", "--loads", "12A"]
    done = CliRunner().invoke(app, [*arguments, "-o", "k.csv"])
    assert done.exit_code == 0 and "written: k.csv" in done.stdout
    table = pd.read_csv("k.csv")
    assert table["case"].unique().tolist() == ["case, 14B", "case, 12A"]
    done = CliRunner().invoke(app, [*arguments, "-o", "k.json", "--json"])
    data = json.loads(done.stdout)
    assert data == json.loads((tmp_path / "k.json").read_text(encoding="utf-8"))
    entry = data["points"][0]["stiffness"][1][1]
    assert table["k F_Y0 d_Y0 [N/m]"][0] == pytest.approx(entry, rel=1e-12)
    assert CliRunner().invoke(app, [*arguments, "-o", "k.csv"]).exit_code == 2
    assert CliRunner().invoke(app, [*arguments, "-o", "k.txt"]).exit_code == 2
