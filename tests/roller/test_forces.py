"""Forces on a roller: by hand, in high precision, in balance with rings and cage, and mirrored."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from macroslip import Laws
from macroslip.bearing import geometry
from macroslip.compiled import jit
from macroslip.contact.interface import interfaces
from macroslip.contact.rolling import light_contact
from macroslip.mechanics.film_sharing import film_load
from macroslip.ring.orbit import Instant
from tests.one_roller import (
    BEARING,
    OIL,
    RATED,
    RING_SPEED,
    TILT,
    a_station,
    forces_of,
    models,
    net,
    powers_of,
    rollers,
    station_of,
)
from tests.quick import COARSE

ALPHA, RADIUS, PITCH_RADIUS = math.radians(11.2), 0.035, 0.3727
MASS = 7850.0 * math.pi * RADIUS**2 * 0.106
WEIGHT = MASS * 9.81
INNER_RADIUS, OUTER_RADIUS = (PITCH_RADIUS + sign * RADIUS * math.cos(ALPHA) for sign in (-1, 1))
ORBITAL = RATED * INNER_RADIUS / (INNER_RADIUS + OUTER_RADIUS)
SIGNS = {"downwind": 1, "upwind": -1}
ODD = ("inner", "outer", "cage", "cage_load", "resistance", "lag", "skew")

clock = pytest.mark.parametrize(
    "angle", [0.0, math.pi / 2, math.pi, -math.pi / 2], ids=["right", "top", "left", "bottom"]
)
rows = pytest.mark.parametrize("row", SIGNS)


@pytest.fixture(scope="module")
def paper():
    return rollers(models(Laws.paper()))


@pytest.fixture(scope="module")
def physical():
    return rollers(models(Laws.physical()), tolerance=COARSE.tolerance)


@pytest.fixture(scope="module")
def dry():
    """All mechanisms but rolling resistance: no oil beside the contacts."""
    return rollers(models(Laws.physical().but(rolling="none")), tolerance=COARSE.tolerance)


def now(speed=0.0, displacement=(0.0, 0.0, 0.0), shaft_angle=0.0):
    return Instant(speed, shaft_angle, *map(float, displacement))


# --- Stations --------------------------------------------------------------------------------------------------------


@clock
@rows
def test_weight_by_hand(paper, angle, row):
    conditions = station_of(paper[row], angle, now())
    # Weight vector in the bearing frame: the shaft falls towards downwind, so part of it points along +Z0.
    weight = WEIGHT * np.array([0.0, -math.cos(TILT), math.sin(TILT)])
    y = [
        math.cos(angle) * math.cos(ALPHA),
        math.sin(angle) * math.cos(ALPHA),
        SIGNS[row] * math.sin(ALPHA),
    ]
    outward = float(weight @ np.array(y))
    assert conditions["tangential"] == pytest.approx(
        weight @ [math.sin(angle), -math.cos(angle), 0.0], abs=1e-12
    )
    assert conditions["outer_load"] == pytest.approx(max(outward, 0.0), abs=1e-12)
    assert conditions["inner_load"] == pytest.approx(max(-outward, 0.0), abs=1e-12)


@clock
@pytest.mark.parametrize("speed", [RATED, -RATED])
def test_centrifugal_force_and_drag_by_hand(angle, speed):
    made = models(Laws.paper(), tilt=0.0, gravity=False)
    conditions = station_of(rollers(made)["downwind"], angle, now(speed))
    orbital = speed * ORBITAL / RATED
    assert conditions["outer_load"] == pytest.approx(
        MASS * PITCH_RADIUS * orbital**2 * math.cos(ALPHA), rel=1e-12
    )
    assert conditions["inner_load"] == 0.0
    drag = 0.5 * 1.0 * (0.7 * 900.0) * (2 * RADIUS * 0.106) * (orbital * PITCH_RADIUS) ** 2
    # Against the motion: a roller moves along −x for a positive shaft speed.
    assert conditions["tangential"] == pytest.approx(math.copysign(drag, speed), rel=1e-12)
    assert models(Laws.paper(), drag=False)["downwind"].drag == 0.0
    # r²/I = 2/m of a cylinder.
    assert made["downwind"].mobility == pytest.approx(2.0 / MASS, rel=1e-12)


@clock
@rows
def test_elastic_load_by_hand(paper, angle, row):
    d = np.array([1.5e-4, -2.5e-4, 3e-4])
    conditions = station_of(paper[row], angle, now(RATED, d))
    n = [
        math.cos(angle) * math.cos(ALPHA),
        math.sin(angle) * math.cos(ALPHA),
        SIGNS[row] * math.sin(ALPHA),
    ]
    approach = float(np.array(n) @ d) - 1e-4 * math.cos(ALPHA)
    load = paper[row].body[0]["stiffness"] * max(approach, 0.0) ** 1.5
    assert conditions["approach"] == pytest.approx(approach, abs=1e-18)
    assert conditions["elastic_load"] == pytest.approx(load, rel=1e-12)
    # Body forces add to what the rings press, at the side they point to.
    bare = station_of(paper[row], angle, now(RATED))
    for side in ("inner_load", "outer_load"):
        assert conditions[side] - load == pytest.approx(bare[side], abs=1e-9)


def test_rings_pass_with_the_speeds_of_pure_rolling_and_the_roller_moves_on(paper):
    conditions = station_of(paper["downwind"], 0.3, now(RATED))
    assert conditions["ring_speed"] == pytest.approx(-(RATED - ORBITAL) * INNER_RADIUS, rel=1e-12)
    assert conditions["ring_speed"] == pytest.approx(-ORBITAL * OUTER_RADIUS, rel=1e-12)
    here = station_of(
        paper["downwind"], 0.4 + ORBITAL / RATED * 2.5, now(RATED, (1e-4, 2e-4, 3e-4))
    )
    there = station_of(paper["downwind"], 0.4, now(RATED, (1e-4, 2e-4, 3e-4), shaft_angle=2.5))
    assert there.tolist() == pytest.approx(here.tolist(), rel=1e-12)


# --- Mirrors ---------------------------------------------------------------------------------------------------------

lengths = st.floats(-3e-4, 3e-4)


@pytest.mark.parametrize("kind", ["paper", "physical"])
@given(
    st.floats(-10.0, 10.0),
    lengths,
    lengths,
    lengths,
    st.floats(-0.3, 0.3).map(lambda x: round(x, 9)),
)
@settings(max_examples=40)
def test_a_shaft_that_turns_back_is_the_mirror_image(request, kind, angle, dx, dy, dz, slip):
    """Mirror at the vertical plane: φ → π − φ, dX → −dX, all speeds and tangential forces change sign."""
    roller = request.getfixturevalue(kind)["downwind"]
    here = station_of(roller, angle, now(RATED, (dx, dy, dz)))
    there = station_of(roller, math.pi - angle, now(-RATED, (-dx, dy, dz)))
    for name, sign in (
        ("ring_speed", -1),
        ("tangential", -1),
        ("inner_load", 1),
        ("outer_load", 1),
    ):
        assert there[name] == pytest.approx(sign * here[name], rel=1e-9, abs=1e-6)
    there["ring_speed"], there["tangential"] = -here["ring_speed"], -here["tangential"]
    for name in ("approach", "elastic_load", "inner_load", "outer_load"):
        there[name] = here[name]
    ahead, back = forces_of(roller, here, slip), forces_of(roller, there, -slip)
    for name in ahead.dtype.names:
        sign = -1 if name in ODD else 1
        np.testing.assert_allclose(back[name], sign * ahead[name], rtol=1e-12, err_msg=name)
    np.testing.assert_allclose(
        powers_of(roller, there, back, -slip), powers_of(roller, here, ahead, slip), rtol=1e-12
    )


@pytest.mark.parametrize("slip", [-0.2, 1e-3, 0.05])
def test_rows_are_mirror_images(physical, slip):
    """But for the side to which the roller's axis tilts, which turns the sign of its skew moment."""
    at = a_station(3e4, 10.0)
    downwind, other = (forces_of(physical[row], at, slip) for row in SIGNS)
    np.testing.assert_array_equal(other["skew"], -downwind["skew"])
    assert (downwind["skew"] != 0.0).all()
    for name in set(downwind.dtype.names) - {"skew"}:
        np.testing.assert_array_equal(other[name], downwind[name], err_msg=name)
    here, there = (
        powers_of(physical[row], at, forces_of(physical[row], at, slip), slip) for row in SIGNS
    )
    np.testing.assert_allclose(there, here, rtol=1e-12)


# --- Forces ----------------------------------------------------------------------------------------------------------


class Reference:
    """The forces of one roller of the paper's model in mpmath, from the interfaces' data alone."""

    faces = interfaces(BEARING, OIL)

    @staticmethod
    def film(face, load, speed):
        m, oil, radius = mpmath.mpf, face.lubricant, mpmath.mpf(face.rolling_radius)
        width = face.hertz.semi_axis_across * mpmath.cbrt(load)
        w = 3 * load / (4 * width) / (face.modulus * radius)
        u = oil.viscosity * max(speed, mpmath.mpf(1e-6)) / (face.modulus * radius)
        g, rough, hard = (
            oil.pressure_viscosity * face.modulus,
            face.roughness / radius,
            face.hardness / m(face.modulus),
        )
        height = m("2.691") * w ** m("-0.135") * u ** m("0.705") * g ** m("0.556")
        extra = (
            m("0.2")
            * rough ** m("1.222")
            * hard ** m("0.223")
            * w ** m("-0.229")
            * u ** m("-0.748")
        )
        return radius * height * (1 + extra * g ** m("-0.842"))

    def traction(self, face, load, slip, speed):
        if load <= 0:
            return mpmath.mpf(0)
        oil, size = face.lubricant, mpmath.cbrt(load)
        exponent = oil.pressure_viscosity * face.hertz.pressure * size
        heating = (
            slip**2 * oil.temperature_viscosity * oil.viscosity / (8 * oil.thermal_conductivity)
        )

        def integrand(s):
            b = heating * mpmath.exp(exponent * s)
            reduction = (
                mpmath.asinh(mpmath.sqrt(b)) / mpmath.sqrt(b * (1 + b)) if b else mpmath.mpf(1)
            )
            return s * mpmath.exp(exponent * s) * reduction

        panels = mpmath.linspace(0, 1, 2 + int(exponent / 4))
        patch = mpmath.quad(integrand, panels, method="gauss-legendre", maxdegree=4)
        area = 2 * mpmath.pi * face.hertz.semi_axis_across * face.hertz.semi_axis_along * size**2
        return area * oil.viscosity * slip / self.film(face, load, speed) * patch

    def __call__(self, at, slip):
        """F_i, F_o and F_c at contact speeds u1 = u2 − v, Δu_cage = −u1, u_e = |u1 + u2|/2."""
        slip, ring = mpmath.mpf(slip), mpmath.mpf(float(at["ring_speed"]))
        surface = ring - slip
        inner, outer = (
            self.traction(
                face, mpmath.mpf(float(at[f"{face.name}_load"])), slip, abs(ring + surface) / 2
            )
            for face in self.faces[:2]
        )
        push = abs(mpmath.mpf(float(at["tangential"])) + inner - outer)
        return inner, outer, self.traction(self.faces[2], push, -surface, abs(surface) / 2)


# Unloaded, lightly loaded and gripped rollers, cage force of either sign, surface turning backwards.
PLACES = [
    (a_station(0.0, 12.0), -0.3), (a_station(0.0, 12.0, 30.0), -0.05), (a_station(5.0, 12.0), -1e-3),
    (a_station(800.0), -0.2), (a_station(800.0), 0.15), (a_station(3e4), -1e-8), (a_station(3e4, 0.0, 31.0), 2e-3),
    (a_station(1e5), 1e-13), (a_station(1e5), -0.01), (a_station(50.0, 12.0), -0.9),
    (a_station(50.0, 12.0, ring_speed=0.39594), 0.9), (a_station(0.0, 12.0, ring_speed=0.2), 0.1),
    (a_station(200.0, ring_speed=0.0), 0.02),
]  # fmt: skip


@pytest.mark.parametrize(("at", "slip"), PLACES)
def test_the_papers_forces_and_their_slope_in_high_precision(paper, at, slip):
    """Total derivative, with film and cage load following the slip; films are those of a table over loads and speeds."""
    reference, forces = Reference(), forces_of(paper["downwind"], at, slip)
    with mpmath.workdps(30):
        expected = reference(at, slip)
        for name, force in zip(("inner", "outer", "cage"), expected, strict=True):
            assert forces[name] == pytest.approx(float(force), rel=2e-7), name
        step = mpmath.mpf(abs(slip)) * mpmath.mpf(10) ** -8
        slope = float(
            (sum(reference(at, slip + step)) - sum(reference(at, slip - step))) / (2 * step)
        )
    scale = abs(slope) + abs(net(forces)) / abs(slip)
    assert forces["slope"] == pytest.approx(slope, abs=1e-4 * scale)
    assert forces["cage_load"] == pytest.approx(
        float(at["tangential"] + forces["inner"] - forces["outer"]), rel=1e-14
    )


@pytest.mark.parametrize("kind", ["paper", "physical", "dry"])
@pytest.mark.parametrize("load", [0.4, 40.0, 700.0, 2e4, 1e5])
@pytest.mark.parametrize("slip", [-0.35, -0.05, 1e-4, 0.03])
def test_slopes_are_the_derivatives_of_all_forces(request, kind, load, slip):
    """By which Newton's iteration converges: of the net force, of each raceway's, and of the cage's load."""
    roller, at = request.getfixturevalue(kind)["downwind"], a_station(load, 8.0)
    change = 1e-7 * max(abs(slip), 1e-3)
    here, ahead, behind = (
        forces_of(roller, at, nearby) for nearby in (slip, slip + change, slip - change)
    )
    scale = sum(abs(float(here[name])) for name in ("inner", "outer", "cage", "resistance")) / max(
        abs(slip), 1e-3
    )
    assert here["slope"] == pytest.approx(
        (net(ahead) - net(behind)) / (2.0 * change), rel=1e-4, abs=1e-5 * scale
    )
    for name in ("inner", "outer", "cage_load"):
        difference = (ahead[name] - behind[name]) / (2.0 * change)
        assert here[f"{name}_slope"] == pytest.approx(difference, rel=1e-4, abs=1e-5 * scale), name


def test_pure_rolling_and_standstill(paper):
    for load in (0.0, 100.0, 2e4):
        at = a_station(load, 12.0)
        forces = forces_of(paper["downwind"], at, 0.0)
        assert forces["inner"] == forces["outer"] == 0.0 and forces["cage_load"] == at["tangential"]
        # The surface moves along −x, the pocket is at rest: friction drives ω up, that is towards zero.
        assert forces["cage"] > 0.0
    at = station_of(paper["downwind"], 0.7, now(0.0, (0.0, 0.0, 8e-4)))
    forces = forces_of(paper["downwind"], at, 0.0)
    assert at["elastic_load"] > 0.0 and forces["inner"] == forces["outer"] == forces["cage"] == 0.0
    assert math.isfinite(forces["slope"]) and forces["slope"] > 0.0
    assert forces["cage_load"] == pytest.approx(WEIGHT * math.cos(TILT) * math.cos(0.7), rel=1e-12)


def test_no_load_no_force(paper, dry):
    at = a_station(0.0, tangential=0.0)
    for made in (paper, dry):
        forces = forces_of(made["downwind"], at, 0.1)
        assert all(np.all(forces[name] == 0.0) for name in forces.dtype.names)


@pytest.mark.parametrize("kind", ["paper", "physical"])
def test_what_is_not_a_number_is_never_a_plausible_one(request, kind):
    roller = request.getfixturevalue(kind)["downwind"]
    assert math.isnan(net(forces_of(roller, a_station(2e4), math.nan)))
    assert math.isnan(net(forces_of(roller, a_station(2e4, ring_speed=math.nan), 0.01)))


@pytest.mark.parametrize("kind", ["physical", "dry"])
@given(
    load=st.floats(1.0, 5.0).map(lambda x: 10.0**x),
    slip=st.floats(-0.2, 0.2).map(lambda x: round(x, 9)),
    ring=st.sampled_from([0.39, -0.39]),
    tangential=st.floats(-60.0, 60.0),
)
@settings(max_examples=60)
def test_what_the_rings_give_heats_the_contacts_or_drives_the_spin(
    request, kind, load, slip, ring, tangential
):
    """Torques about the axes of ring and roller, with lever arms in space, times their speeds in the orbiting frame.

    The cage, at rest there, takes nothing; nor does what acts on the centre. A raceway's rolling shear acts on both surfaces along
    the ring's motion, its pressure pushes both bodies the other way: power 2 F_R |u|.
    """
    roller, at = request.getfixturevalue(kind)["downwind"], a_station(load, 5.0, tangential, ring)
    forces = forces_of(roller, at, slip)
    surface = ring - slip
    given_by_rings, tilt = 0.0, math.sin(ALPHA)
    for k, (name, distance, up) in enumerate(
        (("inner", INNER_RADIUS, 1.0), ("outer", OUTER_RADIUS, -1.0))
    ):
        # Distance from the bearing axis: r~ − ζ sin α ± h cos α, the drop being towards the roller.
        pull = forces[name] + forces["lag"][k]
        torque = (
            distance * pull
            - tilt * forces["skew"][k]
            + up * math.cos(ALPHA) * RADIUS * forces["lag"][k]
        )
        given_by_rings += ring / distance * torque
    spent = powers_of(roller, at, forces, slip).sum()
    into_spin = surface * (forces["inner"] + forces["outer"] + forces["cage"])
    size = abs(spent) + abs(into_spin) + abs(given_by_rings)
    assert given_by_rings == pytest.approx(spent + into_spin, abs=1e-9 * size)
    rough = forces["rough"]
    assert (rough >= -1e-9 * size).all() and rough.sum() <= spent + 1e-9 * size
    assert (forces["rolling"] >= 0.0).all()


@jit
def _film_load(body, tables, play, outward, ring_speed, log_balance):
    return film_load(body, tables, 0.0, -play, outward, ring_speed, log_balance).load


def shared_film_load(body, tables, play, outward, ring_speed, log_balance=0.0):
    """Load of the films on a roller that the rings do not press and that has a play [N]."""
    return _film_load(body, tables.ctypes.data, play, outward, ring_speed, log_balance)


# --- Oil -------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("body", [-35.0, 0.0, 4.0, 50.0])
@pytest.mark.parametrize("play", [2e-6, 5e-5, 3e-4])
def test_films_and_approach_fill_the_play(physical, play, body):
    """[h(q) + h(q + |B|)]/1.2257 − (q/K)^(2/3) = p, by bracketing with the laws themselves."""
    roller, laws = physical["downwind"], models(Laws.physical())["downwind"].laws
    stiffness = float(roller.body[0]["stiffness"])

    def excess(log_load):
        q = math.exp(log_load)
        loads = q + max(-body, 0.0), q + max(body, 0.0)
        heights = [
            float(light_contact(law.rolling, np.array(load), np.array(0.5 * abs(RING_SPEED)))[2])
            / 1.2257
            for law, load in zip((laws.inner, laws.outer), loads, strict=True)
        ]
        return sum(heights) - (q / stiffness) ** (2.0 / 3.0) - play

    expected = math.exp(brentq(excess, math.log(1e-6), math.log(1e5), xtol=1e-12))
    assert shared_film_load(roller.body[0], roller.tables, play, body, RING_SPEED) == pytest.approx(
        expected, rel=2e-4
    )


def test_loads_are_continuous_where_play_ends_and_films_fade(physical):
    roller = physical["downwind"]
    dx = np.linspace(-3e-6, 4e-5, 1000) + 1e-4
    conditions = np.array(
        [station_of(roller, 0.0, now(RATED, (shift, 0.0, 0.0))).tolist() for shift in dx]
    )
    approach, elastic, inner = conditions[:, 1], conditions[:, 2], conditions[:, 3]
    assert (np.diff(inner) > 0.0).all() and approach[0] < 0.0 < approach[-1]
    # The steepest change is that of the elastic load; where play ends nothing jumps.
    assert np.diff(inner).max() < 1.05 * np.diff(elastic).max()
    faded = elastic > float(roller.body[0]["faded_load"])
    assert faded.any() and not faded.all()
    body = inner[faded] - elastic[faded]
    np.testing.assert_allclose(body, body[0], atol=1e-6)
    # Just below that load films carry next to nothing.
    last = np.flatnonzero(~faded)[-1]
    assert inner[last] - elastic[last] - body[0] < 1e-9 * elastic[last]


def test_films_carry_more_the_less_play_there_is_and_nothing_at_standstill(physical):
    body, tables = physical["downwind"].body[0], physical["downwind"].tables
    loads = [
        shared_film_load(body, tables, play, 30.0, RING_SPEED) for play in (1e-6, 1e-5, 1e-4, 1e-3)
    ]
    assert loads == sorted(loads, reverse=True) and loads[-1] > 0.0
    assert shared_film_load(body, tables, 1e-4, 30.0, 0.0) == 0.0


def test_what_films_carry_does_not_depend_on_where_the_search_begins(physical):
    body, tables = physical["downwind"].body[0], physical["downwind"].tables
    for play in (0.0, 1e-6, 1e-4, 3e-4):
        alone = shared_film_load(body, tables, play, 30.0, RING_SPEED)
        again = [
            shared_film_load(body, tables, play, 30.0, RING_SPEED, math.log(guess))
            for guess in (1e-9, 1e-3, alone, 50.0, 1e6)
        ]
        assert again == pytest.approx([alone] * 5, rel=1e-9, abs=2e-9), play


def test_starved_films_carry_nothing_where_the_play_is_wider_than_the_oil_reaches():
    made = models(Laws.physical(), OIL.supplied(2e-4))
    roller = rollers(made, tolerance=COARSE.tolerance)["downwind"]
    within, beyond = (
        shared_film_load(roller.body[0], roller.tables, play, 30.0, RING_SPEED)
        for play in (1e-4, 4e-4)
    )
    assert within > 0.1 and beyond < 1e-8


@pytest.mark.parametrize("supply", [2e-5, 2e-4])
def test_a_play_beyond_the_reach_of_films_is_one_at_which_the_search_finds_none(supply):
    made = models(Laws.physical(), OIL.supplied(supply))
    roller = rollers(made, tolerance=COARSE.tolerance)["downwind"]
    searched = roller.body.copy()
    searched["film_reach"] = math.inf
    reach = roller.body["film_reach"][0]
    assert ((reach > 0.0) & (reach < 1e-2)).all()
    assert (np.diff(reach, axis=1) <= 0.0).all()
    for share in (0.5, 0.7, 0.9, 0.97, 1.0, 1.01, 2.0):
        for outward in (-200.0, -30.0, -7.0, -0.1, 0.0, 0.1, 7.0, 30.0, 200.0):
            for speed in (0.1 * RING_SPEED, RING_SPEED):
                alone, bounded = (
                    shared_film_load(body[0], roller.tables, share * reach.max(), outward, speed)
                    for body in (searched, roller.body)
                )
                assert bounded == pytest.approx(alone, rel=1e-9)
                assert share < 1.0 or bounded == pytest.approx(1e-9)


def test_an_idle_roller_lies_between_two_films(physical, dry):
    top, bottom = (
        station_of(physical["downwind"], angle, now(2.14)) for angle in (math.pi / 2, -math.pi / 2)
    )
    for at in (top, bottom):
        assert at["elastic_load"] == 0.0 < min(at["inner_load"], at["outer_load"])
    assert bottom["outer_load"] > bottom["inner_load"] and top["inner_load"] > top["outer_load"]
    assert station_of(dry["downwind"], -math.pi / 2, now(2.14))["inner_load"] == 0.0


def test_a_gripped_roller_makes_up_for_its_rolling_resistance(physical):
    roller, at = physical["downwind"], a_station(2e4)
    slip = brentq(lambda trial: net(forces_of(roller, at, trial)), -0.05, 0.05, xtol=1e-16)
    forces = forces_of(roller, at, slip)
    assert forces["resistance"] > 0.0  # against a motion along −x
    assert forces["inner"] + forces["outer"] + forces["cage"] == pytest.approx(
        -forces["resistance"], rel=1e-6
    )
    assert (forces["rolling"] > 0.0).all()


@pytest.mark.parametrize("load", [5.0, 300.0, 2e4])
@pytest.mark.parametrize("slip", [-0.3, 0.002])
def test_oil_at_a_raceway_turns_nothing_about_the_bearing(load, slip):
    """Torques of shear and inclined pressure on roller and ring add up to zero; the pushes act through both axes."""
    roller = rollers(models(Laws.paper().but(rolling="whole-film")))["downwind"]
    bare = rollers(models(Laws.paper()))["downwind"]
    at = a_station(load)
    with_oil, without = forces_of(roller, at, slip), forces_of(bare, at, slip)
    mean = RING_SPEED - 0.5 * slip
    for name, radius in (("inner", INNER_RADIUS), ("outer", OUTER_RADIUS)):
        law = getattr(models(Laws.paper().but(rolling="whole-film"))["downwind"].laws, name)
        conductance, resistance, _ = (
            float(component)
            for component in light_contact(law.rolling, np.array(load), np.array(-mean))
        )
        assert with_oil[name] - without[name] == pytest.approx(
            conductance * slip, rel=1e-4, abs=1e-6
        )
        assert with_oil["rolling"][0 if name == "inner" else 1] == pytest.approx(
            2.0 * resistance * abs(mean), rel=1e-4
        )
        # Shear F_R acts on both surfaces at the contact's radius; the push along x at the roller's centre is (push − 1) of it.
        push = float(roller.body[0][name]["push"]) - 1.0
        curvature = (
            geometry.inner_curvatures(BEARING)
            if name == "inner"
            else geometry.outer_curvatures(BEARING)
        )
        assert push == pytest.approx(-2.0 / (curvature.rolling * RADIUS), rel=1e-9)
        assert 2.0 * radius + push * PITCH_RADIUS == pytest.approx(0.0, abs=1e-9)
