"""How full inlets are where a case does not say it, and what cannot be."""

import math

import numpy as np
import pytest

from macroslip import Bearing, BearingLoads, Case, Laws, Lubricant
from macroslip.case.oil_supply import oil_gap, supply_note
from macroslip.constants import FLOODED_GAP
from macroslip.contact.laws import prepare
from macroslip.contact.registry import FILM_LAWS
from macroslip.errors import InputError

PAPER, PHYSICAL = Laws.paper(), Laws.physical()


def case(laws=PHYSICAL, **other):
    return Case(loads=BearingLoads.constant([0.0, -3.4e5, 1.6e5], 2.14, 10.0), laws=laws, **other)


def test_skfs_factor_counts_where_a_law_asks_for_oil_and_no_supply_is_given():
    unnamed, named = case(), case(oil_supply="skf")
    assert unnamed.inlet_supply == unnamed.as_dict()["oil_supply"] == "skf"
    assert unnamed.oil.oil_gap == named.oil.oil_gap < 1e-3
    assert (
        supply_note(unnamed)
        == supply_note(named)
        == f"oil_supply skf: inlets are full from a gap of {1e6 * unnamed.oil.oil_gap:.3g} um on"
    )
    assert supply_note(case(oil_supply="flooded")) == "oil_supply flooded: flooded inlets"
    for changed in (PAPER.but(starvation=True), PAPER.but(rolling="whole-film")):
        assert case(changed).inlet_supply == "skf" and case(changed).oil.oil_gap < 1e-3


def test_other_laws_are_flooded():
    flooded = case(PAPER)
    assert (
        flooded.inlet_supply == "flooded"
        and "oil_supply" not in flooded.as_dict()
        and supply_note(flooded) == ""
    )
    assert math.isinf(flooded.oil.oil_gap)
    inner = prepare(PAPER, flooded.bearing, flooded.oil, 1).inner
    assert inner.film_thickness(2e4, 0.4) == FILM_LAWS.named(PAPER.film)(inner.interface, 2e4, 0.4)
    assert (
        case(PAPER, oil_supply="flooded").oil.oil_gap
        == case(PAPER, oil_supply=1.0).oil.oil_gap
        == math.inf
    )


def test_rest_does_not_change_the_oil():
    """Means are over the angle turned: with the speed falling from W to 0, of W 2/3, and of a force that falls with it 2/3."""
    times = np.linspace(0.0, 10.0, 1001)
    falling = np.outer(1.0 - times / 10.0, [0.0, -6e5, 3e5])
    stop = BearingLoads(times, 2.1 * (1.0 - times / 10.0), falling, "stop")
    rest = np.arange(10.01, 130.0, 0.01)
    rested = BearingLoads(
        np.append(times, rest),
        np.append(stop.shaft_speed, 0.0 * rest),
        np.vstack([falling, 0.0 * rest[:, None] + np.zeros(3)]),
        "rest",
    )
    bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    steady = BearingLoads.constant([0.0, -4e5, 2e5], 1.4, 10.0)
    for supply in ("skf", 0.7):
        gaps = [oil_gap(supply, bearing, oil, loads, PHYSICAL) for loads in (stop, rested, steady)]
        assert gaps[1] == pytest.approx(gaps[0], rel=1e-12)
        assert gaps[2] == pytest.approx(gaps[0], rel=1e-4)
    still = BearingLoads.constant([0.0, -4e5, 2e5], 0.0, 10.0)
    assert oil_gap("skf", bearing, oil, still, PHYSICAL) == FLOODED_GAP


def test_supplies_that_cannot_be_are_refused():
    for supply in (0.5, "skf"):
        with pytest.raises(
            InputError,
            match="oil_supply: .*laws: paper have neither a starved film nor rolling resist",
        ):
            case(PAPER, oil_supply=supply)
    bearing = Bearing.read("skf-240-600-bc").replace(name="mine", bore_diameter=None)
    with pytest.raises(InputError, match="oil_supply: .*mine has no bore_diameter"):
        case(bearing=bearing)
    assert case(PAPER, bearing=bearing).inlet_supply == "flooded"
    assert case(bearing=bearing, oil_supply=0.7).inlet_supply == 0.7
