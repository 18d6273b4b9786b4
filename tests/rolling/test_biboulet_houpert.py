"""Biboulet and Houpert's formulas against Martin's limit and a starved solution of Reynolds' equation."""

import math

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from macroslip.rolling import martin
from macroslip.rolling.biboulet_houpert import biboulet_houpert, starvation_factor
from macroslip.rolling.elastic_line import RIGID


def starved_share(inlet):
    """F_R over that of a flooded rigid contact at the same load; the film begins where the gap is S times the flow's."""

    def slope(t, end):
        return (t * t - end * end) / (1.0 + t * t) ** 3

    def exit_of(start):
        return brentq(lambda e: quad(slope, start, e, args=(e,))[0], 1e-6, 0.9)

    start = -brentq(lambda s: 1.0 + s * s - inlet * (1.0 + exit_of(-s) ** 2), 1e-3, 1e3)
    end = exit_of(start)
    load = -24.0 * quad(lambda t: t * slope(t, end), start, end)[0]
    force = 6.0 * math.sqrt(2.0) * quad(lambda t: (1.0 + t * t) * slope(t, end), start, end)[0]
    return force / math.sqrt(load) / martin.ROLLING


@pytest.mark.parametrize(("inlet", "tolerance"), [(5.0, 0.08), (10.0, 0.06), (30.0, 0.01), (100.0, 0.025)])
def test_starvation_factor_is_that_of_a_rigid_contact(inlet, tolerance):
    assert starvation_factor(inlet) == pytest.approx(starved_share(inlet), rel=tolerance)


def test_limits():
    assert starvation_factor(math.inf) == 1.0
    assert biboulet_houpert(1e-6) == pytest.approx(RIGID * 1e-3, rel=0.036)
    assert biboulet_houpert(1e6) == pytest.approx(1.470, abs=5e-4)
