"""Wear: load is conserved and spread, nothing wears where nothing slides, and time goes with 1/k."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.damage.wear import STEP, Pressed, grow, hertz_slices, slice_loads, worn_volume

HALF = 0.029
PLACE = (np.arange(96) + 0.5) * (2.2 * HALF / 96) - 1.1 * HALF
WIDTH, LOAD, CURVATURE = PLACE[1] - PLACE[0], 35e3, 0.05
CONTOUR = 0.5 * CURVATURE * PLACE**2
#: Slip with lines of pure rolling at −4 and +18 mm, as at the base bearing.
SLIP = np.abs((PLACE + 0.004) * (PLACE - 0.018))


def pressed(slip=SLIP, ring=5.0, roller=2.0, load=LOAD):
    return Pressed(load, CONTOUR, hertz_slices(LOAD, HALF, CURVATURE), slip, ring, roller)


@given(
    st.lists(st.floats(0.0, 1e-4), min_size=1, max_size=40),
    st.floats(1e-3, 1e6),
    st.floats(1e8, 1e12),
)
def test_slices_carry_the_load_and_never_pull(gap, load, stiffness):
    loads = slice_loads(gap, load, stiffness, 1e-3)
    # Where gaps are far larger than the approach, loads are small differences of large numbers.
    rounding = 1e-3 * len(gap) * 4.0 * np.finfo(float).eps * stiffness * max(gap)
    assert (loads >= 0.0).all() and loads.sum() * 1e-3 == pytest.approx(
        load, rel=1e-9, abs=rounding
    )
    # Where load is, the approach is the same everywhere; where none is, the gap is open.
    approach = (loads / stiffness + gap)[loads > 0.0]
    assert (
        np.ptp(approach) <= 1e-9 * approach.max()
        and (np.array(gap)[loads == 0.0] >= approach.max() * (1 - 1e-9)).all()
    )


def test_unworn_slices_carry_what_hertz_has():
    loads = slice_loads(CONTOUR, LOAD, hertz_slices(LOAD, HALF, CURVATURE), WIDTH)
    hertz = 0.75 * LOAD / HALF * np.maximum(1.0 - (PLACE / HALF) ** 2, 0.0)
    np.testing.assert_allclose(loads, hertz, atol=2e-3 * hertz.max())


def test_a_worn_profile_spreads_pressure_with_the_load_conserved():
    worn = grow((pressed(), pressed()), WIDTH, deepest=1e-5)
    loads = [
        slice_loads(
            CONTOUR + depths[0] + depths[2], LOAD, hertz_slices(LOAD, HALF, CURVATURE), WIDTH
        )
        for depths in worn.depth
    ]
    assert all(load.sum() * WIDTH == pytest.approx(LOAD, rel=1e-12) for load in loads)
    deepest = np.argmax(worn.depth[-1, 0])
    assert loads[-1][deepest] < 0.8 * loads[0][deepest]
    # More of the roller carries load than before, and the pure rolling lines more than they did.
    assert (loads[-1] > 0.0).sum() > (loads[0] > 0.0).sum()
    line = np.argmin(np.abs(PLACE + 0.004))
    assert loads[-1][line] > loads[0][line]


def test_nothing_wears_at_the_lines_of_pure_rolling_and_rates_fall():
    slip = np.where(np.abs(PLACE + 0.004) < WIDTH, 0.0, SLIP)
    worn = grow((pressed(slip), pressed(slip)), WIDTH, deepest=2e-5)
    assert (worn.depth[-1][:, slip == 0.0] == 0.0).all()
    first, later = worn.work_at(1e-6), worn.work_at(2e-5)
    assert (later > 20.0 * first).all()


def test_the_first_step_is_archards_law():
    worn = grow((pressed(ring=5.0), pressed(ring=0.0, load=0.0)), WIDTH, deepest=1e-6)
    load = slice_loads(CONTOUR, LOAD, hertz_slices(LOAD, HALF, CURVATURE), WIDTH)
    np.testing.assert_allclose(worn.depth[1, 0], 5.0 * load * SLIP * worn.work[1], rtol=1e-12)
    np.testing.assert_allclose(worn.depth[1, 2], 0.4 * worn.depth[1, 0], rtol=1e-12)
    assert worn.depth[1].max() == pytest.approx(STEP) and (worn.depth[:, 1] == 0.0).all()


def test_a_finer_grid_gives_the_same_time():
    def at(count):
        position = (np.arange(count) + 0.5) * (2.2 * HALF / count) - 1.1 * HALF
        pressed = Pressed(
            LOAD, 0.5 * CURVATURE * position**2, hertz_slices(LOAD, HALF, CURVATURE),
            np.abs((position + 0.004) * (position - 0.018)), 5.0, 2.0,
        )  # fmt: skip
        return grow((pressed, pressed), position[1] - position[0], deepest=1e-5).work_at(1e-5)

    np.testing.assert_allclose(at(96), at(384), rtol=0.03)


def test_nothing_slides_nothing_wears():
    still = pressed(slip=np.zeros_like(SLIP))
    assert np.isinf(grow((still, still), WIDTH).work_at(1e-6)).all()
    assert worn_volume(1e-17, 0.0, 0.1) == 0.0
