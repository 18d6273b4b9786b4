"""Traction laws given as functions of arrays: their tables against the formulas, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import BearingLoads, Case, InputError, Laws, load_laws, simulate
from macroslip.roller.model import interfaces
from macroslip.traction import traction_law
from macroslip.traction.tabulated_traction import register_function, tabulated_law

EXAMPLES = Path(__file__).parents[2] / "examples"


def limited(interface, load, film, slip):
    """Newtonian at first, limited to 0.05 of the load: µQ(1 − exp(−c Δu/(µQ)))."""
    conductance = 1e-2 * load ** (2.0 / 3.0) / (film / 1e-6)
    limit = 0.05 * load
    return -limit * np.expm1(-conductance * slip / limit)


def heated(interface, load, film, slip):
    """A film that heats itself, with a peak at 0.1 m/s."""
    return 10.0 * load ** (1.0 / 3.0) * (1e-6 / film) * slip / (1.0 + (slip / 0.1) ** 2)


@pytest.fixture(scope="module")
def inner(bearing, lubricant):
    return interfaces(bearing, lubricant)[0]


@pytest.fixture(scope="module", params=[limited, heated])
def law(request, inner):
    return request.param, tabulated_law("tried", request.param, inner)


states = given(
    load=st.floats(0.0, 5.2).map(lambda x: 10.0**x),
    film=st.floats(-7.5, -5.0).map(lambda x: 10.0**x),
    slip=st.floats(-14.0, 0.0).map(lambda x: 10.0**x),
)


@states
def test_values_and_derivatives(law, inner, load, film, slip):
    function, table = law
    for sign in (1.0, -1.0):
        found = traction_law.patch_traction(table, load, film, sign * slip)
        force = float(function(inner, load, film, slip))
        assert found[0] == pytest.approx(sign * force, rel=1e-3)
        state = np.array([load, film, slip])
        for place, derivative in ((2, found[1]), (1, sign * found[2]), (0, sign * found[3])):
            step = np.zeros(3)
            step[place] = 1e-4 * state[place]
            expected = (function(inner, *(state + step)) - function(inner, *(state - step))) / (2.0 * step[place])
            assert derivative == pytest.approx(expected, rel=2e-2, abs=1e-2 * force / state[place])


def test_force_rises_up_to_the_slip_that_is_said(law, inner):
    function, table = law
    for load in (3.0, 2e3, 1e5):
        rising = traction_law.rising_slip(table, load, 5e-7)
        if function is heated:
            assert 0.04 < rising < 0.1
        slips = np.geomspace(1e-6, min(rising, 10.0), 400)
        force = [traction_law.patch_traction(table, load, 5e-7, float(slip))[0] for slip in slips]
        # The limit is approached to within rounding.
        assert (np.diff(force) >= -1e-9 * force[-1]).all()


def test_without_slip_there_is_no_force(law):
    force, slope, by_film, by_load = traction_law.patch_traction(law[1], 1e4, 1e-6, 0.0)
    assert force == by_film == by_load == 0.0 and slope > 0.0


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (lambda interface, load, film, slip: 1.0, "returns one of shape ()"),
        (lambda interface, load, film, slip: slip - 0.5, "a positive number"),
        (
            lambda interface, load, film, slip: np.where(slip > 1e-3, 1e-3, slip) * np.where(load > 9.0, 2.0, 1.0),
            "jumps",
        ),
        (lambda interface, load, film, slip: np.full(slip.shape, math.inf), "the force is inf N"),
    ],
)
def test_refused(inner, function, words):
    with pytest.raises(InputError) as caught:
        tabulated_law("mine", function, inner)
    assert words in str(caught.value) and "traction law mine, inner" in str(caught.value)


def barus(interface, load, film, slip):
    """F = 2π a b (η0/h) Δu ∫ s exp(α_p p0 s) ds, the law of examples/own_law.py without its derivatives."""
    hertz, oil = interface.hertz, interface.lubricant
    root = np.cbrt(load)
    exponent = oil.pressure_viscosity * hertz.pressure * root
    small = exponent < 0.01
    whole = np.where(small, 1.0, exponent)
    integral = np.where(small, 0.5 + exponent / 3.0, (np.exp(whole) * (whole - 1.0) + 1.0) / whole**2)
    return (
        2.0
        * math.pi
        * hertz.semi_axis_across
        * hertz.semi_axis_along
        * oil.viscosity
        * root**2
        / film
        * slip
        * integral
    )


def test_a_case_with_a_function():
    """The same law as a function and compiled with its derivatives: rollers spend the same energy."""
    register_function("barus-function", barus, reference="none")
    (compiled,) = load_laws(EXAMPLES / "own_law.py").traction
    try:
        loads = BearingLoads.constant([0.0, -300e3, 100e3], 1.5, 20.0)
        found, expected = (
            simulate(Case(loads=loads, laws=Laws(traction=name), rollers=[3])) for name in ("barus-function", compiled)
        )
    finally:
        traction_law.remove("barus-function")
    assert float(expected.energy.sum()) > 0.1
    np.testing.assert_allclose(found.energy, expected.energy, rtol=1e-3, atol=1e-6)
