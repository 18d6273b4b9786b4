"""Slopes of the linearised tractions, on which Newton's method and forces between evaluations rest."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from macroslip import Cage
from macroslip.compiled import jit
from macroslip.contact.mechanisms import Laws
from macroslip.contact.table import table_box
from macroslip.whole.model import whole_bearing, with_tables
from macroslip.whole.stage import FIRST, ROLLER, SCHEDULE
from macroslip.whole.tractions import (
    COUPLED_CONDITIONS,
    LINEARISATION,
    address,
    cage_from,
    evaluate_marked,
    new_linearisations,
    raceway_from,
    shear_from,
)

SPEED, SLIP = -0.37, 2e-3


@pytest.fixture(scope="module", params=["paper", "rolling", "physical"])
def assembly(request, bearing, lubricant):
    laws = {
        "paper": Laws.paper(),
        "rolling": Laws.paper().but(rolling="whole-film"),
        "physical": Laws.physical(),
    }
    held = whole_bearing(
        bearing.replace(rollers_per_row=3), lubricant, Cage(), tilt=0.0, laws=laws[request.param]
    )
    return with_tables(held, table_box(np.array([-0.41, -0.36]), 5e4, 2e-4))[0]


def linearisations_at(assembly, load, speed, slip):
    """The linearised tractions of a roller whose both raceways are at this load [N], ring speed and slip [m/s]."""
    count = assembly.positions.size
    conditions, (linearisations, _), schedules = (
        np.zeros((2, count), COUPLED_CONDITIONS),
        new_linearisations(count),
        np.zeros(count, SCHEDULE),
    )
    for name in ("inner", "outer"):
        conditions[f"{name}_load"], conditions[f"{name}_speed"] = load, speed
    schedules["marked"] = True
    rollers = np.zeros(count, ROLLER)
    rollers["y"][:, FIRST] = slip
    assert (
        evaluate_marked(assembly, 0.0, conditions[0], rollers, FIRST, schedules, linearisations[0])
        == 2 * count
    )
    return linearisations[0, 0]


@pytest.mark.parametrize("raceway", ["inner", "outer"])
@pytest.mark.parametrize("load", [30.0, 3e4])
@pytest.mark.parametrize("direction", [-1.0, 1.0])
def test_slopes_of_a_raceway(assembly, raceway, load, direction):
    speed, slip = direction * SPEED, direction * SLIP
    linear = linearisations_at(assembly, load, speed, slip)[raceway]
    for name, width, ways in (
        ("slip", 2e-6, [(load, speed, slip + step) for step in (1e-6, -1e-6)]),
        ("load", 2e-5 * load, [(load * (1.0 + step), speed, slip) for step in (1e-5, -1e-5)]),
        ("speed", 2e-6, [(load, speed + step, slip) for step in (1e-6, -1e-6)]),
    ):
        more, less = (linearisations_at(assembly, *way)[raceway] for way in ways)
        for force in ("turning", "pull", "shear"):
            slope = (more[force] - less[force]) / width
            size = abs(linear["pull"]) / {"slip": SLIP, "load": load, "speed": abs(SPEED)}[name]
            assert linear[f"{force}_by_{name}"] == pytest.approx(slope, rel=1e-3, abs=1e-5 * size)
    # The inlet resists whatever turns.
    assert linear["shear"] * speed <= 0.0


def test_between_evaluations_forces_follow_the_slopes(assembly):
    linear = linearisations_at(assembly, 3e4, SPEED, SLIP)["inner"]
    state = (3.003e4, 1.001 * SPEED, 1.001 * SLIP)
    exact = linearisations_at(assembly, *state)["inner"]
    linear = SimpleNamespace(**{name: linear[name] for name in LINEARISATION.names or ()})
    assert raceway_from(linear, *state) == pytest.approx(
        (exact["turning"], exact["pull"]), rel=1e-4
    )
    assert shear_from(linear, *state) == pytest.approx(exact["shear"], rel=1e-4)
    assert raceway_from(linear, 0.0, SPEED, SLIP) == (0.0, 0.0)


@jit
def friction(assembly, linear, push, sliding):
    """Friction of the cage with its slopes, evaluated anew."""
    linear.load = -1.0
    contact = (assembly.bodies[0], address(assembly), assembly.evaluate_cage)
    return cage_from(contact, linear, push, sliding, 0.1)


@pytest.mark.parametrize("push", [-30.0, 0.5])
@pytest.mark.parametrize("sliding", [0.35, -0.35])
def test_slopes_of_the_cage(assembly, push, sliding):
    linear = new_linearisations(1)[0][0, 0]["cage"]
    force, by_sliding, by_push = friction(assembly, linear, push, sliding)
    assert force * sliding > 0.0
    slope = (
        friction(assembly, linear, push, sliding + 1e-5)[0]
        - friction(assembly, linear, push, sliding - 1e-5)[0]
    ) / 2e-5
    assert by_sliding == pytest.approx(slope, rel=1e-3, abs=1e-6 * abs(force / sliding))
    step = 1e-4 * abs(push)
    slope = (
        friction(assembly, linear, push + step, sliding)[0]
        - friction(assembly, linear, push - step, sliding)[0]
    ) / (2.0 * step)
    assert by_push == pytest.approx(slope, rel=1e-3, abs=1e-6 * abs(force / push))


def test_a_dry_roller_in_the_middle_of_its_pocket_feels_nothing(assembly):
    linear = new_linearisations(1)[0][0, 0]["cage"]
    force, _, _ = friction(assembly, linear, 0.0, 0.35)
    assert (force == 0.0) == (assembly.bodies[0]["oily"] == 0)
    assert math.isfinite(force)
