"""Details of skewed rollers: against the contacts' resultants, integrals of their own, mirrors, and straight rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import Bearing, Case, Laws, Lubricant, RollerLoads, Traces, simulate
from macroslip.bearing.geometry import ROWS, roller_radius
from macroslip.contact.laws import prepare
from macroslip.contact.skewed import constant_friction, resultants, slip_lines
from macroslip.measures.along import STATIONS, contacts_of
from macroslip.measures.samples import SAMPLE
from macroslip.result.criteria.wear import slip_profile, working_skew
from macroslip.result.damage import damage
from macroslip.roller.skew import equilibrium, raceways, skew_stop
from macroslip.whole.cage import Cage
from tests.measures.one_contact import power_along

BEARING, OIL, SPEED = (
    Bearing.read("skf-240-600-bc"),
    Lubricant.read("vg460-pao").at("50 degC"),
    -0.396,
)
SKEWED = Laws.physical().but(skew="quasi-static")
RACEWAYS = pytest.mark.parametrize("raceway", [0, 1])
STATES = pytest.mark.parametrize(
    ("load", "skew"), [(2e4, 1e-3), (5e4, 6.6e-3), (5e4, -6.6e-3), (9e4, 3e-3)]
)


def profile(raceway, load, skew, sign=1):
    """How power lies along a roller in equilibrium at a skew; its contact, lines of slip, and the equilibrium."""
    laws = prepare(SKEWED, BEARING, OIL, sign)
    pair = raceways(laws, BEARING, sign)
    at = equilibrium(pair, laws, load, SPEED, skew)
    contact, middle = pair[raceway], pair[raceway].middle(at.tilt, at.shift)
    lines = slip_lines(contact, SPEED, at.slip, skew, middle, at.tilt)
    sample = np.zeros(1, SAMPLE)[0]
    entrainment = abs(SPEED - 0.5 * at.slip)
    sample["film"][raceway] = film = contact.laws.film_thickness(load, entrainment)
    sample["share"][raceway] = contact.laws.asperity_share(load, entrainment, film)
    sample["skewed"] = 1
    sample["lines"][raceway] = [middle, *lines[:6]]
    sample["time"] = sample["under_load"] = 1.0
    state = load, SPEED, at.slip
    along, times = power_along(contacts_of(laws)[raceway], raceway, state, sample, 1.0)
    return along, contact, lines, at, times


@RACEWAYS
@STATES
def test_stations_add_up_to_what_the_contact_gives(raceway, load, skew):
    along, contact, lines, at, times = profile(raceway, load, skew)
    width = BEARING.roller_length / STATIONS
    exact = resultants(
        contact, load, SPEED, at.slip, skew, contact.middle(at.tilt, at.shift), at.tilt
    )
    # Stations of 4.4 mm, and the spin within a chord left out.
    assert along["total"] * width == pytest.approx(exact.power, rel=0.02)
    assert along["rough_total"] * width == pytest.approx(exact.asperity_power, rel=0.02)
    station = (np.arange(STATIONS) + 0.5) * width - 0.5 * BEARING.roller_length
    v = lines.v0 + station * (lines.v1 + lines.v2 * station)
    w = lines.w0 + station * (lines.w1 + lines.w2 * station)
    force = (along["negative"] + along["positive"]) * width / (v * v + w * w)
    gross = 0.04 * load
    assert (force * w).sum() == pytest.approx(exact.axial, abs=0.02 * gross)
    assert (force * v).sum() == pytest.approx(exact.pull, abs=0.02 * gross)
    # Time by classes of film and slip is that of the length under the ellipse.
    covered = np.count_nonzero(along["work"]) / STATIONS
    assert covered - 2.0 / STATIONS < times[..., 0].sum() <= covered + 1e-12


@RACEWAYS
@STATES
def test_work_is_the_integral_of_pressure_times_slip(raceway, load, skew):
    """Both components of slip all over the ellipse, on a grid; by the formulas of `contact/skewed.py`'s heading."""
    along, contact, _, at, _ = profile(raceway, load, skew)
    k, r, hertz = contact.side, roller_radius(BEARING), contact.laws.interface.hertz
    a, b, p0 = (
        x * load ** (1 / 3) for x in (hertz.semi_axis_across, hertz.semi_axis_along, hertz.pressure)
    )
    centre = at.shift + k * r * at.tilt
    middle = (-k * at.tilt + contact.along * centre) / contact.lateral
    x, y = np.meshgrid(
        (np.arange(1000) + 0.5) / 500 - 1.0, (np.arange(100) + 0.5) / 50 - 1.0, indexing="ij"
    )
    height = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    station = middle + a * x
    height[np.abs(station) > 0.5 * BEARING.roller_length] = 0.0
    turn = skew * (
        1.0 - (contact.along - contact.across) / (1.0 / r - contact.across - contact.lateral)
    )
    drop = 0.25 * station**2 * (
        1.0 / contact.roller_contour + contact.along
    ) + contact.lateral * middle * (station / 2 - middle / 4)
    rate, spin = k * SPEED / contact.raceway_radius, (SPEED - at.slip) / r
    sine, cosine = math.sin(BEARING.contact_angle), math.cos(BEARING.contact_angle)
    v = (
        at.slip
        + spin * drop
        - rate * cosine * (drop + k * at.tilt * station)
        - k * rate * sine * (station + centre)
    )
    w = -k * spin * skew * (r - drop) - (sine * rate + spin * at.tilt) * (b * y + turn * station)
    work = (p0 * height * np.hypot(v, w)).sum() * a * b / (500 * 50)
    assert along["work_total"] == pytest.approx(work, rel=0.01)


def along_roller(along, name):
    """A field of `ALONG` by station, or power with the sign of slip."""
    return along["positive"] - along["negative"] if name == "power" else along[name]


@RACEWAYS
def test_the_other_row_is_a_mirror(raceway):
    down, up = (profile(raceway, 5e4, sign * 4e-3, sign)[0] for sign in (1, -1))
    for name in ("power", "rough", "work", "density"):
        upwind, downwind = (along_roller(along, name) for along in (up, down))
        assert upwind == pytest.approx(
            downwind[::-1], rel=1e-6, abs=1e-9 * np.abs(downwind).max()
        ), name


@RACEWAYS
def test_a_little_skew_changes_what_slides_little_and_much_most_where_rolling_is_pure(raceway):
    straight, little, much = (profile(raceway, 5e4, skew)[0] for skew in (0.0, 1e-6, 6.6e-3))
    for name in ("power", "rough", "work"):
        without = along_roller(straight, name)
        assert along_roller(little, name) == pytest.approx(
            without, abs=1e-3 * np.abs(without).max()
        )
    rise = much["work"][straight["work"] > 0.0] / straight["work"][straight["work"] > 0.0]
    # No more than a slip of ψ all over the contact adds.
    added = (much["work_total"] - straight["work_total"]) / (5e4 * 6.6e-3 * abs(SPEED))
    assert rise.max() > 2.0 and 0.2 < added < 1.0


# --- Cases -----------------------------------------------------------------------------------------------------------


def case(laws=SKEWED, **cage):
    places = np.radians(np.tile(np.arange(0.0, 360.0, 45.0), (2, 2, 1)))
    loads = RollerLoads(
        np.array([0.0, 10.0]), np.full(2, 2.143), places, np.full(places.shape, 9e3), "even"
    )
    return Case(
        loads=loads, rollers=[0], laws=laws, temperature=323.15, traces=Traces(step=1.0), gravity=False, drag=False,
        cage=Cage(**cage),
    )  # fmt: skip


@pytest.fixture(scope="module")
def straight():
    return simulate(case(Laws.physical()), threads=1)


@pytest.fixture(scope="module")
def stopped():
    return simulate(case(alignment="none"), threads=1)


@pytest.mark.slow
def test_without_play_maps_and_criteria_are_those_of_straight_rollers(straight):
    result = simulate(case(skew_play=0.0), threads=1)
    for name in (
        variable
        for variable in straight.data_vars
        if variable.startswith(("surface", "film_slip", "station", "asper"))
    ):
        assert result[name].values == pytest.approx(straight[name].values, rel=1e-9, abs=1e-12), (
            name
        )
    assert damage(result).value.values == pytest.approx(
        damage(straight).value.values, rel=1e-9, nan_ok=True
    )


@pytest.mark.slow
def test_sums_over_maps_and_classes_are_the_whole(stopped, straight):
    both = stopped.sel(interface=["inner", "outer"]).sum("roller")
    assert stopped.surface_energy.sum(
        ("angle", "station", "slip_sign", "film_regime")
    ).values == pytest.approx(both.energy.transpose("row", "interface").values, rel=1e-9)
    assert stopped.surface_asperity_energy.sum(("angle", "station")).values == pytest.approx(
        both.asperity_energy.transpose("row", "interface").values, rel=1e-9
    )
    classes = ("film_class", "slip_class")
    assert stopped.film_slip_time.sum(classes).values == pytest.approx(
        straight.film_slip_time.sum(classes).values, rel=2e-3
    )
    # Both rows have the same loads, and turn the opposite way.
    down, up = (stopped.surface_work.sel(row=row).sum("angle").values for row in ROWS)
    assert up == pytest.approx(down[:, ::-1], rel=5e-3, abs=1e-3 * down.max())


@pytest.mark.slow
def test_work_and_wear_of_a_roller_at_its_stop(stopped, straight):
    """Work a second is that of the contacts under a coefficient of friction of 1; wear rises most where nothing slid."""
    seconds = stopped.attrs["window_end"] - stopped.attrs["window_start"]
    result, laws = stopped.sel(row="downwind"), prepare(SKEWED, BEARING, OIL, 1)
    bare = prepare(SKEWED.but(asperities="none"), BEARING, OIL, 1)
    speed = float(result.spin_pure[0, -1]) * roller_radius(BEARING)
    angle = skew_stop(BEARING, "conforming-pocket", 0.5e-3).largest
    at = equilibrium(raceways(laws, BEARING, 1), laws, 9e3, speed, angle)
    for i, contact in enumerate(raceways(bare, BEARING, 1, constant_friction(1.0))):
        power = resultants(
            contact, 9e3, speed, at.slip, angle, contact.middle(at.tilt, at.shift), at.tilt
        ).power
        assert float(result.surface_work[i].sum()) / seconds == pytest.approx(power, rel=0.02)
    assert (
        working_skew(result) == pytest.approx(angle, rel=1e-9)
        and working_skew(straight.sel(row="downwind")) == 0.0
    )
    skewed, held = damage(stopped), damage(straight)
    for name in ("pressure_slip_rate", "asperity_work_rate"):
        ratio = (skewed[name] / held[name]).sel(row="downwind", surface="inner").values
        assert np.nanmax(ratio) > 2.0 and skewed[name].sum() > held[name].sum()
    # The window has no complete orbit, so that no time of wear is given: the place that wears most decides it.
    assert "wear_time" not in skewed and "wear_time" not in held
    assert float(skewed.asperity_work_rate.max()) > float(held.asperity_work_rate.max())
    stations = np.linspace(-0.03, 0.03, 4 * STATIONS)
    slip = slip_profile(laws.inner, stations, np.ones_like(stations), np.ones(STATIONS), angle)
    assert slip.min() >= angle
