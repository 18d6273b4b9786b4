"""Tables of contacts against the laws they were made of."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from macroslip.contact import table_store
from macroslip.mechanisms import Laws
from macroslip.roller import play_build, raceway_build, raceway_sheets
from macroslip.roller.cage_force import cage_force
from macroslip.roller.contact import raceway_contact
from macroslip.roller.contact_force import raceway_force
from macroslip.roller.films import cage_film, raceway_film
from macroslip.roller.forces import Station, slip_forces
from macroslip.roller.friction_power import friction_power
from macroslip.roller.model import roller_model
from macroslip.roller.play import carried, film_load
from macroslip.roller.raceway_sheets import stored_sheets
from macroslip.roller.raceway_table import no_raceway_table, place_of, table_force
from macroslip.roller.table_box import LARGEST_ERROR, SPEED_SPACING, TableBox, error_summary, table_box, wide_box
from macroslip.roller.tables import needs_tables, tabulated

BOX = TableBox(highest_load=9e4, highest_cage_load=1.8e3, lowest_speed=0.37, highest_speed=0.42)
#: What an error may be at any place of a cell whose middle is within `LARGEST_ERROR`.
ERROR = 2e-4
rings = pytest.mark.parametrize("ring", ["inner", "outer"])
speeds = st.floats(0.3705, 0.4195)
light, held = st.floats(0.0, 3.8).map(lambda x: 10.0**x), st.floats(2.1e4, 8.9e4)


@pytest.fixture(scope="module")
def rows(bearing, lubricant):
    return {
        row: roller_model(bearing, lubricant, sign, tilt=math.radians(5.0), laws=Laws.physical())
        for row, sign in (("downwind", 1), ("upwind", -1))
    }


@pytest.fixture(scope="module")
def made(rows):
    return tabulated(rows, BOX)


def both(made, rows, row, ring):
    return getattr(made[0][row], ring), getattr(rows[row], ring)


def looked_up(table, load, speed, slip):
    return table_force(table, place_of(table, load, speed, slip), load, speed, slip)


def forces(contact, load, speed, slip):
    mean = speed - 0.5 * slip
    found = raceway_force(contact, load, slip, speed, abs(mean), -0.5 if mean >= 0.0 else 0.5)
    return found, friction_power(contact, slip, speed, found.spin, found.detail)


def largest_force(contact, load, speed):
    return max(abs(forces(contact, load, speed, ratio * speed)[0].spin) for ratio in (0.01, 0.1, 0.5, 0.9))


def test_tables_tell_their_errors(made):
    report = made[1]
    assert 0.0 < report.typical_error <= 1e-5 < report.worst_error <= 1.5e-4
    assert 0.9 < report.known <= 1.0 and 1e6 < report.size < 3e7 and 0.0 < report.build_time < 100.0


@rings
@given(load=light, speed=speeds, ratio=st.floats(-0.001, 0.999))
@settings(deadline=None, max_examples=150)
def test_light_rollers(made, rows, ring, load, speed, ratio):
    table, laws = both(made, rows, "downwind", ring)
    compare(table, laws, load, speed, ratio * speed)


@rings
@given(load=held, speed=speeds, ratio=st.floats(-0.006, 0.006))
@settings(deadline=None, max_examples=150)
def test_held_rollers(made, rows, ring, load, speed, ratio):
    table, laws = both(made, rows, "downwind", ring)
    compare(table, laws, load, speed, ratio * speed)


def compare(table, laws, load, speed, slip):
    (found, power), (expected, expected_power) = forces(table, load, speed, slip), forces(laws, load, speed, slip)
    scale = ERROR * max(abs(expected.spin), 0.1 * largest_force(laws, load, speed))
    assert found.spin == pytest.approx(expected.spin, abs=scale)
    assert found.pull == pytest.approx(expected.pull, abs=scale)
    assert power == pytest.approx(expected_power, rel=ERROR)
    assert found.detail.asperity_power == pytest.approx(expected.detail.asperity_power, abs=ERROR * expected_power)


@rings
def test_most_states_are_known_and_the_rest_are_those_of_the_laws(made, rows, ring):
    """Exactly: outside the table, and in cells where it is not good enough."""
    table, laws = both(made, rows, "downwind", ring)
    random = np.random.default_rng(5)
    unknown = 0
    for _ in range(1000):
        load, speed, ratio = 10.0 ** random.uniform(-1.0, 5.2), random.uniform(0.3, 0.5), random.uniform(-0.1, 1.1)
        if not looked_up(table.table, load, speed, ratio * speed).known:
            unknown += 1
            assert forces(table, load, speed, ratio * speed) == forces(laws, load, speed, ratio * speed)
    assert 200 < unknown < 900
    empty = no_raceway_table()
    assert not looked_up(empty, 1e3, 0.4, 0.1).known and not looked_up(table.table, 1e3, 0.0, 0.1).known


@rings
@given(load=light, speed=speeds, ratio=st.floats(-0.001, 0.999), side=st.sampled_from([-1.0, 1.0]))
@settings(deadline=None, max_examples=60)
def test_derivatives_of_a_table_are_those_of_its_values(made, rows, ring, load, speed, ratio, side):
    """Central differences of the forces; between cells the splines' second derivatives are continuous."""
    table, _ = both(made, rows, "downwind", ring)
    state = np.array([load, side * speed, side * ratio * speed])
    steps = np.array([1e-4 * load, 1e-5 * speed, 1e-5 * 6e-4 * (1.0 + abs(ratio) / 6e-4) * speed])
    found = raceway_contact(table, *state)
    around = [[forces(table, *(state + sign * step))[0] for sign in (1, -1)] for step in np.diag(steps)]
    assume(all(looked_up(table.table, *(state + sign * step)).known for step in np.diag(steps) for sign in (-1, 0, 1)))
    here, power = forces(table, *state)
    assert (found.spin, found.pull) == pytest.approx((here.spin, here.pull), rel=1e-10)
    assert (found.power, found.asperity_power) == pytest.approx((power, here.detail.asperity_power), rel=1e-10)
    scale = largest_force(table, load, speed)
    for name, size, step, (more, less) in zip(("load", "speed", "slip"), abs(state), steps, around, strict=True):
        for force in ("spin", "pull"):
            slope = (getattr(more, force) - getattr(less, force)) / (2.0 * step)
            unit = scale / max(size, 6e-4 * speed) if name == "slip" else scale / size
            assert getattr(found, f"{force}_by_{name}") == pytest.approx(slope, rel=1e-4, abs=1e-4 * unit)


@rings
@given(load=light, speed=speeds, ratio=st.floats(-0.001, 0.999))
@settings(deadline=None, max_examples=60)
def test_traction_is_odd_and_power_even(made, rows, ring, load, speed, ratio):
    table, _ = both(made, rows, "downwind", ring)
    (ahead, power), (behind, other) = (
        forces(table, load, speed, ratio * speed),
        forces(table, load, -speed, -ratio * speed),
    )
    assert behind.spin == pytest.approx(-ahead.spin, rel=1e-12) and other == pytest.approx(power, rel=1e-9)
    assert behind.spin_slope == pytest.approx(ahead.spin_slope, rel=1e-9, abs=1e-9 * load)
    assert behind.detail.skew == pytest.approx(-ahead.detail.skew, rel=1e-12)


@rings
def test_a_held_roller_is_known_where_its_moments_balance(made, rows, ring):
    """At −0.002 of the ring's speed the moment passes through zero, and no relative error of it would be small."""
    table, _ = both(made, rows, "downwind", ring)
    known = [
        looked_up(table.table, load, 0.4, ratio * 0.4).known
        for load in np.geomspace(2.1e4, 8e4, 30)
        for ratio in np.linspace(-0.005, 0.0, 30)
    ]
    assert np.mean(known) > 0.98


@rings
def test_the_other_row_has_the_other_sign_of_the_skew_moment(made, rows, ring):
    for row in rows:
        table, laws = both(made, rows, row, ring)
        found, expected = forces(table, 4e4, 0.4, -1e-3)[0], forces(laws, 4e4, 0.4, -1e-3)[0]
        assert found.detail.skew == pytest.approx(expected.detail.skew, rel=1e-4)
    assert made[0]["downwind"].inner.table.side == -made[0]["upwind"].inner.table.side == 1.0


@rings
@given(load=st.floats(0.5, 4.9).map(lambda x: 10.0**x), speed=speeds, ratio=st.floats(-0.005, 0.3))
@settings(deadline=None, max_examples=100)
def test_slopes_are_those_of_the_values(made, rows, ring, load, speed, ratio):
    table = getattr(made[0]["downwind"], ring)
    step = 1e-7 * max(abs(ratio), 1e-3)
    there = [looked_up(table.table, load, speed, (ratio + change) * speed) for change in (-step, 0.0, step)]
    assume(all(one.known for one in there))
    for name in ("pull", "lag"):
        difference = (getattr(there[2], name) - getattr(there[0], name)) / (2.0 * step * speed)
        scale = abs(getattr(there[1], name)) / (abs(ratio) + 1e-3)
        assert getattr(there[1], f"{name}_slope") == pytest.approx(difference, rel=1e-5, abs=1e-5 * scale)


@given(load=st.floats(-1.9, 3.2).map(lambda x: 10.0**x), slip=st.floats(0.01, 0.42))
@settings(deadline=None, max_examples=100)
def test_cage(made, rows, load, slip):
    table, laws = made[0]["downwind"].cage, rows["downwind"].cage
    for sign in (1.0, -1.0):
        found = cage_force(table, load, sign * slip, 0.5 * slip, 0.5 * sign)
        expected = cage_force(laws, load, sign * slip, 0.5 * slip, 0.5 * sign)
        assert found[0] == pytest.approx(expected[0], rel=1e-4)
        # The force hardly depends on slip: its film grows with it.
        assert found[1] == pytest.approx(expected[1], abs=2e-2 * abs(expected[0]) / slip)
        assert found[2] == pytest.approx(expected[2], rel=2e-2)


@pytest.mark.parametrize("raceway", [0, 1])
@given(load=st.floats(-1.5, 4.9).map(lambda x: 10.0**x), speed=speeds, ratio=st.floats(-0.01, 1.0))
@settings(deadline=None, max_examples=100)
def test_oil_of_a_raceway(made, rows, raceway, load, speed, ratio):
    found = raceway_film(made[0]["downwind"].films, raceway, load, ratio * speed, -speed)
    expected = raceway_film(rows["downwind"].films, raceway, load, ratio * speed, -speed)
    for name in ("sliding", "shear", "pull", "power"):
        scale = 1e-4 * (abs(expected.sliding) + abs(expected.shear))
        assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-4, abs=scale)
    slopes = expected.sliding_slope, expected.shear_slope
    assert (found.sliding_slope, found.shear_slope) == pytest.approx(slopes, rel=1e-2, abs=1e-3 * abs(slopes[0]))


@given(load=st.floats(0.0, 5e4), play=st.floats(0.0, 4e-4), body=st.floats(-34.0, 34.0), speed=speeds)
@settings(deadline=None, max_examples=100)
def test_load_of_films(made, rows, load, play, body, speed):
    films, by_laws = made[0]["downwind"].films, rows["downwind"].films
    for elastic, approach in ((load, 1e-5), (0.0, -play)):
        expected = film_load(by_laws, elastic, approach, body, speed)
        assert film_load(films, elastic, approach, body, speed) == pytest.approx(expected, rel=1e-3, abs=1e-12)


@given(load=st.floats(-1.9, 3.2).map(lambda x: 10.0**x), speed=st.floats(0.02, 0.42))
@settings(deadline=None, max_examples=100)
def test_oil_in_the_pocket(made, rows, load, speed):
    films, by_laws = made[0]["downwind"].films, rows["downwind"].films
    for sign in (1.0, -1.0):
        found, expected = cage_film(films, load, sign * speed), cage_film(by_laws, load, sign * speed)
        assert (found.sliding, found.shear) == pytest.approx((expected.sliding, expected.shear), rel=1e-4)
        assert found.power == pytest.approx(expected.power, rel=1e-4)
        assert found.slope == pytest.approx(expected.slope, rel=5e-3)
        assert found.by_load == pytest.approx(expected.by_load, rel=5e-3, abs=1e-3 * abs(expected.sliding) / load)


def test_idle_rollers_are_in_the_tables(made):
    """A flooded roller without load turns at a tenth of pure rolling, under the few newtons of its films."""
    for load in (2.0, 5.0, 20.0, 60.0):
        for ratio in (0.85, 0.9, 0.95):
            assert looked_up(made[0]["upwind"].outer.table, load, 0.4, ratio * 0.4).known


@given(play=st.floats(0.0, 4e-4), body=st.floats(-34.0, 34.0), speed=speeds)
@settings(deadline=None, max_examples=100)
def test_what_films_carry_in_their_play(made, rows, play, body, speed):
    expected = carried(rows["downwind"].films, play, body, -speed)
    assert carried(made[0]["downwind"].films, play, body, -speed) == pytest.approx(expected, rel=ERROR)


def test_no_load_no_friction(made):
    model = made[0]["downwind"]
    for load in (0.0, -3.0):
        assert forces(model.inner, load, 0.4, 0.1)[0][:4] == (0.0, 0.0, 0.0, 0.0)
        assert cage_force(model.cage, load, 0.1, 0.05, 0.5)[:3] == (0.0, 0.0, 0.0)
    still = slip_forces(model, Station(0.0, -1e-4, 0.0, 0.0, 0.0, 0.0), 0.0)
    assert still.inner == still.outer == still.cage == 0.0
    assert cage_film(model.films, 0.0, 0.0).sliding == 0.0


def test_a_worse_table_marks_more_cells(rows, monkeypatch):
    contact = raceway_sheets.bare(rows["downwind"].inner)
    monkeypatch.setattr(raceway_sheets, "_LOAD_SPACING", 1.0)
    axes, numbers = raceway_sheets.sheet_axes(contact, BOX.highest_load), raceway_build.sheet_numbers(BOX)
    sheets = [raceway_sheets.made_sheet(contact, axes, number) for number in numbers]
    coarse = raceway_build.from_sheets(contact, axes, numbers, sheets)
    assert coarse.good.mean() < 0.6
    errors = raceway_build.raceway_errors(contact, coarse, BOX)
    assert errors[1] < 20 * LARGEST_ERROR and errors[2] < 0.9


def test_cases_share_their_sheets(rows, tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(table_store, "_in_memory", table_store.OrderedDict())
    contact, faster = rows["downwind"].inner, BOX._replace(lowest_speed=0.41, highest_speed=0.45)
    made = []
    monkeypatch.setattr(raceway_build, "stored_sheets", lambda *args: made.append(args[2]) or stored_sheets(*args))
    tables = [raceway_build.raceway_table(contact, box)[0] for box in (BOX, faster, faster)]
    one, other = made
    assert len(list((tmp_path / "macroslip" / "tables").glob("*.table"))) == len({*one, *other}) < len(one) + len(other)
    assert tables[1] is tables[2]
    values = [looked_up(table, 500.0, 0.415, 0.02) for table in tables]
    assert values[0].known and values[1].known
    assert values[1][1:] == pytest.approx(values[0][1:], rel=1e-4)


def test_rollers_that_need_no_table(bearing, lubricant):
    paper = roller_model(bearing, lubricant, 1, tilt=0.0)
    plain = roller_model(bearing, lubricant, 1, tilt=0.0, laws=Laws.physical().but(microslip=False))
    assert not needs_tables(paper) and not needs_tables(plain)


def test_boxes():
    assert table_box(np.zeros(5), 1e4, 30.0) is None
    one, other = (table_box(np.array([-0.4, -0.37]), load, 30.0) for load in (8.1e4, 8.2e4))
    assert one == other and one.highest_load > 8.2e4
    assert one.lowest_speed < 0.37 and one.highest_speed > 0.4
    turning = table_box(np.array([-0.4, 0.1]), 1e4, 30.0)
    assert 0.09 < turning.lowest_speed < 0.1
    assert wide_box(one) == wide_box(wide_box(one)) and wide_box(one).lowest_speed <= one.lowest_speed


@pytest.mark.parametrize("slowest", [0.37, 0.1, 0.399])
def test_sheets_reach_from_the_lowest_to_the_highest_speed(slowest):
    box = table_box(np.array([-0.4, -slowest]), 1e4, 30.0)
    for numbers in (raceway_build.sheet_numbers(box), raceway_build.sheet_numbers(box._replace(lowest_speed=slowest))):
        assert math.exp(numbers[0] * SPEED_SPACING) <= slowest and math.exp(numbers[-1] * SPEED_SPACING) >= 0.4
        assert len(numbers) == max(5, round(math.log(box.highest_speed / box.lowest_speed) / SPEED_SPACING) + 3)


def test_errors_of_nothing_known():
    assert (error_summary(np.zeros(5)) == 0.0).all()
    assert list(error_summary(np.array([0.0, 1.0, 3.0, 5.0]))) == [3.0, 5.0, 0.75]


def test_stored_tables_are_the_same(made, rows, monkeypatch):
    monkeypatch.setattr(table_store, "_in_memory", table_store.OrderedDict())
    monkeypatch.setattr(raceway_sheets, "made_sheet", None)
    again, report = tabulated(rows, BOX)
    assert report == made[1]
    np.testing.assert_array_equal(again["upwind"].outer.table.coefficients, made[0]["upwind"].outer.table.coefficients)
    model = rows["downwind"]
    most = play_build.highest_body_force(model, 0.42)
    assert play_build.faded_load(again["upwind"].films, most, 0.42) == again["upwind"].films.faded_load
