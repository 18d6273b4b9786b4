"""Zeros of a force inside a step against the roots of known functions."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.integrate.crossing import crossing
from macroslip.integrate.radau_step import NODES
from macroslip.integrate.tuning import AT_END

PLACES = np.array([0.0, *NODES])


@given(root=st.floats(0.03, 0.97), far=st.floats(1.2, 5.0), near=st.floats(-5.0, -0.2), sign=st.sampled_from([-1, 1]))
@settings(deadline=None)
def test_the_only_root_of_a_cubic_inside_the_step_is_found(root, far, near, sign):
    values = sign * (PLACES - root) * (PLACES - far) * (PLACES - near)
    assert crossing(*values) == pytest.approx(root, abs=1e-9)


def test_of_several_roots_in_different_parts_the_first_is_found():
    first, second, third = 0.1, 0.4, 0.8
    values = (PLACES - first) * (PLACES - second) * (PLACES - third)
    assert crossing(*values) == pytest.approx(first, abs=1e-9)


@pytest.mark.parametrize("root", [0.0, 0.3 * AT_END, 1.0 - 0.3 * AT_END, 1.0])
def test_a_root_next_to_an_end_counts_as_lying_on_it(root):
    assert crossing(*(PLACES - root)) == 1.0


@given(st.lists(st.floats(0.01, 100.0), min_size=4, max_size=4), st.sampled_from([-1.0, 1.0]))
@settings(deadline=None)
def test_without_a_change_of_sign_there_is_none(values, sign):
    assert crossing(*(sign * value for value in values)) == 1.0


def test_scale_does_not_matter():
    values = np.cos(2.0 * PLACES)
    assert crossing(*(1e-12 * values)) == crossing(*(1e9 * values)) == pytest.approx(np.pi / 4, abs=2e-2)
