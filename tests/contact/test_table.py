"""Tables of contacts against the laws they were made of, at states that rollers reach."""

from __future__ import annotations

import math
from functools import partial

import numpy as np
import pytest

from macroslip import Laws
from macroslip.compiled import jit
from macroslip.contact import table as contact_table
from macroslip.contact.laws import POCKET_GAP, prepare
from macroslip.contact.look_up import (
    PLANE,
    TRACTION,
    Traction,
    contact_load,
    contact_speeds,
    in_plane,
    log_load,
    log_speed,
    rising_slip,
    traction,
    traction_cell,
)
from macroslip.contact.rolling import light_contact, rigid_pocket_contact
from macroslip.contact.table import (
    Box,
    Tables,
    cage_values,
    film_values,
    larger,
    oil_values,
    table_box,
    tractions,
    write_plane,
    write_traction,
)
from macroslip.storage import tables as store
from tests.one_roller import BEARING, OIL

FULL = Laws.physical()
CHOICES = {
    "physical": FULL,
    "limiting shear": FULL.but(rheology="limiting-shear"),
    "without microslip": FULL.but(microslip=False),
}
#: A shaft that turns at rated speed, and one that also stands still.
RUNNING, TURNING = (
    table_box(np.array(speeds), 1.2e5, 2e-4) for speeds in ([-0.42, -0.37], [-0.4, 0.4])
)


class Table:
    """A raceway's table, its laws, and look-ups in it."""

    def __init__(self, laws: Laws, box: Box, ring: str = "inner", sign: int = 1, oil=OIL):
        self.law, self.box = getattr(prepare(laws, BEARING, oil, sign), ring), box
        record, tables = np.zeros(1, TRACTION), Tables()
        self.errors = write_traction(record[0], tables, self.law, box)
        self.record, self.flat = record[0], tables.flat()

    def __call__(self, load, ring_speed, slip) -> Traction:
        load, ring_speed, slip = (
            np.ascontiguousarray(states) for states in np.broadcast_arrays(load, ring_speed, slip)
        )
        looked_up = np.zeros((load.size, len(Traction._fields)))
        look_up(self.record, self.flat, load.ravel(), ring_speed.ravel(), slip.ravel(), looked_up)
        return Traction(*(column.reshape(load.shape) for column in looked_up.T))

    def rising(self, load, speed) -> float:
        return rising_at(self.record, self.flat, load, speed)


@jit
def look_up(table, tables, load, ring_speed, slip, values):
    for n in range(load.size):
        speeds = contact_speeds(ring_speed[n], slip[n], 0)
        pressed = contact_load(load[n])
        at_state = traction(table, tables, pressed, speeds, traction_cell(table, pressed, speeds))
        for k in range(len(at_state)):
            values[n, k] = at_state[k]


@jit
def rising_at(table, tables, load, speed):
    return rising_slip(table, tables, load, speed)


@jit
def plane_at(plane, tables, load, speed, values):
    for n in range(load.size):
        values[n] = in_plane(plane, tables, log_load(load[n]), log_speed(speed[n]))[0]


@pytest.fixture(scope="module", params=CHOICES)
def running(request):
    return Table(CHOICES[request.param], RUNNING)


@pytest.fixture(scope="module")
def turning():
    return Table(FULL, TURNING)


def states(loads, speeds, ratios, count=400, slips=10):
    """Random loads and speeds w, even in their logarithms, with slip ratios y at each; half of them near pure rolling."""
    random = np.random.default_rng(5)
    load, speed = (np.exp(random.uniform(*np.log(ends), (count, 1))) for ends in (loads, speeds))
    ratio = random.uniform(*ratios, (count, slips))
    near = np.clip(6e-4 * np.sinh(random.uniform(-3.0, 7.0, (count, slips // 2))), *ratios)
    ratio[:, : slips // 2] = near
    load, speed = np.broadcast_to(load, ratio.shape), np.broadcast_to(speed, ratio.shape)
    return load, speed * np.sqrt(1.0 - 0.25 * ratio**2), speed * ratio


def errors(table, *reached):
    """Of pull, relative to it or to a twentieth of the largest at the same load and speed."""
    computed, expected = table(*reached).pull, tractions(table.law, *reached)[0]
    largest = np.abs(expected).max(axis=1, keepdims=True)
    return np.abs(computed - expected) / np.maximum(np.abs(expected), 0.05 * largest)


@pytest.mark.parametrize(
    ("loads", "ratios", "median", "most"),
    [
        ((0.06, 5.0), (-0.006, 1.0), 2e-5, 2e-2),
        ((5.0, 3e3), (-0.006, 1.0), 5e-6, 5e-3),
        ((3e3, 2e4), (-0.01, 0.5), 3e-6, 3e-3),
        ((2e4, 1.2e5), (-0.006, 0.006), 1e-6, 1e-3),
        ((2e4, 1.2e5), (-0.2, 0.2), 1e-6, 1e-3),
    ],
    ids=["films only", "light", "middle", "held", "skidding"],
)
def test_a_table_is_its_laws(running, loads, ratios, median, most):
    off = errors(running, *states(loads, (0.37, 0.44), ratios))
    assert np.median(off) < median and np.quantile(off, 0.99) < most


def test_backward_rollers_are_in_the_table_too(turning):
    """Slip ratios up to 1.5 either way; where rolling comes to rest, at 1.41, the film has a root's end and laws a kink."""
    off = errors(turning, *states((5.0, 5e4), (0.1, 0.5), (-1.5, 1.5)))
    assert np.median(off) < 1e-5 and np.quantile(off, 0.95) < 1e-2


@pytest.mark.parametrize("ratios", [(1.9, 2.0), (-2.0, -1.9)])
def test_rollers_that_spin_while_a_ring_comes_to_rest(turning, ratios):
    off = errors(turning, *states((5.0, 5e4), (0.1, 0.5), ratios))
    assert np.median(off) < 5e-5 and np.quantile(off, 0.99) < 5e-3


@pytest.mark.parametrize(
    ("speeds", "median", "most"),
    [((0.03, 0.1), 2e-4, 2e-2), ((3e-3, 0.03), 2e-4, 2e-2), ((1e-5, 3e-3), 5e-3, 0.1)],
)
def test_slow_rollers(turning, speeds, median, most):
    """A shaft that starts or stops. Speeds even in a root lower than the fourth would leave such states between two nodes."""
    off = errors(turning, *states((1.0, 1e5), speeds, (-0.006, 0.8)))
    assert np.median(off) < median and np.quantile(off, 0.95) < most


def test_lag_skew_and_power_of_asperities(running):
    reached = states((5.0, 1.2e5), (0.37, 0.44), (-0.006, 0.006))
    looked_up, expected = running(*reached), tractions(running.law, *reached)
    for value, exact in zip(
        (looked_up.lag, looked_up.skew, looked_up.asperity_power), expected[1:], strict=True
    ):
        assert np.abs(value - exact).max() <= 1e-3 * np.abs(exact).max() + 1e-12


def test_derivatives_are_those_of_the_values(running):
    load, ring, slip = states((1.0, 1e5), (0.37, 0.44), (-0.006, 0.9))
    here = running(load, ring, slip)
    scale = np.abs(here.pull).max(axis=1, keepdims=True)
    size = np.abs(slip) + 6e-4 * ring
    steps = {"load": (1e-5 * load, 0, 0), "speed": (0, 1e-5 * ring, 0), "slip": (0, 0, 1e-5 * size)}
    for name, step in steps.items():
        more, less = (
            running(
                *(
                    coordinate + sign * part
                    for coordinate, part in zip((load, ring, slip), step, strict=True)
                )
            )
            for sign in (1.0, -1.0)
        )
        width = 2.0 * sum(step)
        for force in ("pull", "lag"):
            slope = (getattr(more, force) - getattr(less, force)) / width
            unit = scale * (1.0 if force == "pull" else np.cbrt(load) ** 2 * 1e-5) / (0.5e5 * width)
            assert np.all(
                np.abs(getattr(here, f"{force}_by_{name}") - slope)
                <= 2e-4 * np.abs(slope) + 2e-4 * unit
            ), (
                name,
                force,
            )


def test_traction_is_odd_under_reversal(running):
    load, ring, slip = states((0.06, 1.2e5), (0.37, 0.44), (-0.5, 1.0), 50)
    ahead, back = running(load, ring, slip), running(load, -ring, -slip)
    for name in ("pull", "lag", "skew", "pull_by_load", "lag_by_load"):
        np.testing.assert_array_equal(getattr(back, name), -getattr(ahead, name))
    for name in ("asperity_power", "pull_by_slip", "lag_by_slip", "pull_by_speed", "lag_by_speed"):
        np.testing.assert_array_equal(getattr(back, name), getattr(ahead, name))


def test_without_microslip_no_slip_is_no_traction():
    for box in (RUNNING, TURNING):
        table = Table(CHOICES["without microslip"], box)
        load, ring = np.meshgrid([0.1, 1e2, 2e4, 1e5], [0.4, -0.38])
        most = table(load, ring, 1e-3).pull
        assert np.all(np.abs(table(load, ring, 0.0).pull) < 1e-12 * most)
        assert np.all(table(load, ring, 1e-15).pull > 0.0)


def test_the_other_row_has_the_other_sign_of_the_skew_moment_and_shares_the_table():
    plus, other = (Table(FULL, RUNNING, "outer", sign) for sign in (1, -1))
    direct, mirrored = (table(4e4, 0.4, -1e-3) for table in (plus, other))
    assert mirrored._replace(skew=-mirrored.skew) == direct and abs(direct.skew.item()) > 1.0
    assert plus.record["side"] == 1.0 == -other.record["side"]


# --- Boxes -----------------------------------------------------------------------------------------------------------


def test_a_box_holds_what_rollers_reach():
    box = table_box(np.array([-0.40, -0.38]), 5e4, 2e-4)
    # A roller at rest has w = √(1 + 1/4) u2; loads are rounded up so that cases alike share their tables.
    assert box.fastest >= math.sqrt(1.25) * 0.40 and box.slowest == 0.38 and box.load == 65536.0
    assert table_box(np.array([-0.40, -0.38]), 6e4, 2e-4) == box
    turning = table_box(np.array([-0.3, 0.4]), 5e4, 2e-4)
    # A roller may still run forward when the ring runs back.
    assert turning.slowest == 0.0 and turning.fastest >= math.sqrt(2.0) * 0.4
    still = table_box(np.zeros(5), 0.0, 2e-4)
    assert still.fastest > 0.0 and still.load > 0.0


def test_a_larger_box_holds_more_and_its_table_is_the_same_inside():
    box = larger(RUNNING)
    assert box.load == 2.0 * RUNNING.load and box.slowest == 0.0 and box.fastest > RUNNING.fastest
    narrow, wide = Table(FULL, RUNNING), Table(FULL, box)
    reached = states((10.0, 1e5), (0.38, 0.43), (-0.006, 0.5), 100)
    here, there = narrow(*reached).pull, wide(*reached).pull
    assert np.quantile(np.abs(there - here) / np.abs(here).max(axis=1, keepdims=True), 0.99) < 1e-3
    assert np.median(errors(wide, *states((1.2e5, 2.4e5), (0.46, 0.6), (-0.006, 0.006)))) < 1e-5


def test_fineness_follows_the_tolerance():
    assert [table_box(np.ones(1), 1e4, 2e-4 * part).fineness for part in (1e-4, 1 / 16, 0.25, 1.0, 16.0, 1e3)] == [
        0.5, 0.5, 2**-0.5, 1.0, 2.0, 2.0,
    ]  # fmt: skip
    coarse, fine = (Table(FULL, RUNNING._replace(fineness=fineness)) for fineness in (2.0, 1.0))
    assert 6.0 * fine.errors.typical < coarse.errors.typical < 100.0 * fine.errors.typical
    assert fine.errors.typical < 2e-5


# --- Slip up to which traction rises, and planes ------------------------------------------------------------------------


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_the_moment_rises_up_to_rising_slip(ring):
    table = Table(FULL, RUNNING, ring)
    for load in (5.0, 300.0, 8e3, 5e4, 1.1e5):
        top = table.rising(load, 0.4)
        assert 0.0 < top <= 0.8
        slip = np.linspace(-top, top, 400)
        pull, lag, *_ = tractions(
            table.law, np.full_like(slip, load), np.full_like(slip, 0.4), slip
        )
        moment = pull - lag
        # Bounds stand at nodes, and at a constant speed w, which grows with slip.
        assert (np.maximum.accumulate(moment) - moment).max() <= 1e-2 * np.abs(moment).max()
    # Hot films give way.
    assert table.rising(5e4, 0.4) < 0.6 * table.rising(5.0, 0.4)


@pytest.mark.parametrize("name", ["film", "oil", "cage"])
def test_planes_are_their_laws(name):
    laws = prepare(
        FULL if name != "film" else Laws.paper().but(asperities="film-ratio"), BEARING, OIL, 1
    )
    law = laws.cage if name == "cage" else laws.outer
    values = {
        "film": partial(film_values, law),
        "oil": partial(oil_values, law),
        "cage": partial(cage_values, law, POCKET_GAP),
    }[name]
    record, tables = np.zeros(1, PLANE), Tables()
    write_plane(record[0], tables, values, 1e-4, 1e-4 * RUNNING.fastest, RUNNING)
    random = np.random.default_rng(3)
    load = np.exp(random.uniform(math.log(1e-3), math.log(1e5), 500))
    speed = np.exp(random.uniform(math.log(1e-3), math.log(0.45), 500))
    interpolated = np.zeros((500, 4))
    plane_at(record[0], tables.flat(), load, speed, interpolated)
    for value, exact in zip(interpolated.T, values(load, speed), strict=False):
        off = np.abs(value - exact) / np.maximum(np.abs(exact), 1e-3 * np.abs(exact).max() + 1e-300)
        assert np.median(off) < 1e-6 and np.quantile(off, 0.99) < 3e-4
    if name == "oil":
        conductance, resistance, film = light_contact(law.rolling, load, speed)
        np.testing.assert_array_equal(values(load, speed), (conductance, resistance, np.log(film)))
    if name == "cage":
        np.testing.assert_array_equal(
            values(load, speed)[2:],
            rigid_pocket_contact(law.rolling, load, 0.5 * speed, POCKET_GAP),
        )
        film = law.film_thickness(load, 0.5 * speed)
        np.testing.assert_allclose(
            values(load, speed)[0] * speed, law.uniform_traction(load, film, speed), rtol=2e-3
        )


@pytest.mark.parametrize("gap", [2.1e-4, 1.2e-5], ids=["nearly full", "barely wide"])
def test_tables_at_two_gaps_serve_all_between(gap, monkeypatch, tmp_path):
    """Histories that differ in their mean speeds share tables, which give what tables of their own gap would."""
    made = []
    sheet = contact_table._sheet
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(store, "_in_memory", store.LRUCache(1e9, getsizeof=store._size))
    monkeypatch.setattr(
        contact_table, "_sheet", lambda *given: (made.append(given), sheet(*given))[1]
    )
    Table(FULL, RUNNING, oil=OIL.supplied(0.99 * gap))
    first = len(made)
    shared = Table(FULL, RUNNING, oil=OIL.supplied(gap))
    assert first > 0 and len(made) == first
    monkeypatch.setattr(contact_table, "shared_gaps", lambda gap, *_: ((gap, 1.0),))
    own = Table(FULL, RUNNING, oil=OIL.supplied(gap))
    assert len(made) == first + first // 2
    reached = states((1.0, 1.2e5), (0.37, 0.42), (-0.01, 1.2))
    pull = own(*reached).pull
    largest = np.abs(pull).max(axis=1, keepdims=True)
    off = np.abs(shared(*reached).pull - pull) / np.maximum(np.abs(pull), 0.05 * largest)
    # The integrator's tolerance is 2e-4; contacts of some newtons, whose films are thick, are off most.
    assert np.median(off) < 1e-5 and off.max() < 2e-4


def test_a_case_with_heavier_rollers_makes_only_the_loads_beyond(monkeypatch, tmp_path):
    made = []
    sheet = contact_table._sheet
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(store, "_in_memory", store.LRUCache(1e9, getsizeof=store._size))
    monkeypatch.setattr(
        contact_table, "_sheet", lambda *given: (made.append(given[2]), sheet(*given))[1]
    )
    light = RUNNING._replace(load=65536.0)
    Table(FULL, light)
    loads = made.copy()
    made.clear()
    Table(FULL, light._replace(load=2.0 * light.load))
    assert len(made) == len(loads)
    assert min(part.min() for part in made) > max(part.max() for part in loads)
    assert max(part.max() for part in made) >= 2.0 * light.load


@pytest.mark.parametrize(
    "other", [{"slowest": 0.2}, {"slowest": 0.3}, {"load": 65536.0}, {"load": 524288.0}], ids=str
)
def test_a_table_does_not_tell_which_case_made_its_sheets(other, monkeypatch, tmp_path):
    """What lies in the store before may save sheets, and changes no byte of what a case reads."""

    def table(box, folder):
        monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / folder))
        monkeypatch.setattr(store, "_in_memory", store.LRUCache(1e9, getsizeof=store._size))
        return Table(FULL, box).flat

    alone = table(RUNNING, "alone")
    table(RUNNING._replace(**other), "shared")
    assert np.array_equal(table(RUNNING, "shared"), alone)
