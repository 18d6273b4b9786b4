"""Forces on a roller by hand and against the same model written in high precision."""

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from macroslip.ring.orbit import Instant
from macroslip.roller.contact_force import LOWEST_ENTRAINMENT_SPEED, contact_force
from macroslip.roller.forces import Station, interference, slip_forces, station
from macroslip.roller.model import interfaces, roller_model

RATED = 20.463 * 2 * math.pi / 60
ALPHA, TILT = math.radians(11.2), math.radians(5.0)
MASS = 7850.0 * math.pi * 0.035**2 * 0.106
WEIGHT = MASS * 9.81
PITCH_RADIUS, RADIUS = 0.3727, 0.035
INNER_RADIUS, OUTER_RADIUS = (PITCH_RADIUS + sign * RADIUS * math.cos(ALPHA) for sign in (-1, 1))
ORBITAL = RATED * INNER_RADIUS / (INNER_RADIUS + OUTER_RADIUS)

RIGHT, TOP, LEFT, BOTTOM = 0.0, math.pi / 2, math.pi, -math.pi / 2
clock = pytest.mark.parametrize("angle", [RIGHT, TOP, LEFT, BOTTOM], ids=["right", "top", "left", "bottom"])
rows = pytest.mark.parametrize("sign", [1, -1], ids=["downwind", "upwind"])


def at_rest(speed=0.0, displacement=(0.0, 0.0, 0.0), shaft_angle=0.0):
    return Instant(speed, shaft_angle, *displacement)


@clock
@rows
def test_weight_by_hand(models, angle, sign):
    found = station(models[sign], angle, at_rest())
    # Weight vector in the bearing frame: the shaft falls towards downwind, so part of it points along +Z0.
    weight = WEIGHT * np.array([0.0, -math.cos(TILT), math.sin(TILT)])
    y = np.array([math.cos(angle) * math.cos(ALPHA), math.sin(angle) * math.cos(ALPHA), sign * math.sin(ALPHA)])
    x = np.array([math.sin(angle), -math.cos(angle), 0.0])
    assert found.tangential == pytest.approx(weight @ x, abs=1e-12)
    outward = weight @ y
    assert found.outer_load == pytest.approx(max(outward, 0.0), abs=1e-12)
    assert found.inner_load == pytest.approx(max(-outward, 0.0), abs=1e-12)


def test_where_weight_rests(models):
    # At the top a roller lies on the inner raceway, at the bottom on the outer one.
    top, bottom = (station(models[1], angle, at_rest()) for angle in (TOP, BOTTOM))
    assert top.inner_load > 0.0 == top.outer_load
    assert bottom.outer_load > 0.0 == bottom.inner_load
    # Moving counter-clockwise it climbs at the right: weight pulls it back, along +x, there.
    right, left = (station(models[1], angle, at_rest()) for angle in (RIGHT, LEFT))
    assert right.tangential == pytest.approx(WEIGHT * math.cos(TILT), rel=1e-12, abs=0.0)
    assert left.tangential == pytest.approx(-WEIGHT * math.cos(TILT), rel=1e-12, abs=0.0)
    # The axial part of weight presses downwind rollers outward, upwind rollers inward, all round.
    axial = WEIGHT * math.sin(TILT) * math.sin(ALPHA)
    assert right.outer_load == pytest.approx(axial, rel=1e-12, abs=0.0)
    assert station(models[-1], RIGHT, at_rest()).inner_load == pytest.approx(axial, rel=1e-12, abs=0.0)


@clock
@rows
@pytest.mark.parametrize("speed", [RATED, -RATED, 30.0])
def test_centrifugal_force_and_drag_by_hand(bearing, lubricant, angle, sign, speed):
    model = roller_model(bearing, lubricant, sign, tilt=0.0, gravity=False)
    found = station(model, angle, at_rest(speed))
    orbital = speed * ORBITAL / RATED
    assert found.outer_load == pytest.approx(MASS * PITCH_RADIUS * orbital**2 * math.cos(ALPHA), rel=1e-12, abs=0.0)
    assert found.inner_load == 0.0
    drag = 0.5 * 1.0 * (0.7 * 900.0) * (2 * RADIUS * 0.106) * (orbital * PITCH_RADIUS) ** 2
    # Against the motion: a roller moves along −x for a positive shaft speed.
    assert found.tangential == pytest.approx(math.copysign(drag, speed), rel=1e-12, abs=0.0)
    still = station(model._replace(drag=0.0), angle, at_rest(speed))
    assert still.tangential == 0.0


def test_weight_and_drag_can_be_switched_off(bearing, lubricant):
    model = roller_model(bearing, lubricant, 1, tilt=TILT, gravity=False, drag=False)
    assert (model.weight_in_plane, model.weight_along_axis, model.drag) == (0.0, 0.0, 0.0)
    assert model.centrifugal == pytest.approx(MASS * PITCH_RADIUS, rel=1e-12, abs=0.0)


def test_spin_inertia_is_a_cylinders(models):
    # r²/I = 2/m.
    assert models[1].mobility == pytest.approx(2.0 / MASS, rel=1e-12, abs=0.0)


@clock
@rows
def test_elastic_load_by_hand(models, angle, sign):
    d = np.array([1.5e-4, -2.5e-4, 3e-4])
    found = station(models[sign], angle, at_rest(RATED, d))
    n = np.array([math.cos(angle) * math.cos(ALPHA), math.sin(angle) * math.cos(ALPHA), sign * math.sin(ALPHA)])
    approach = n @ d - 1e-4 * math.cos(ALPHA)
    load = models[sign].stiffness * max(approach, 0.0) ** 1.5
    assert found.interference == pytest.approx(approach, abs=1e-18)
    assert found.elastic_load == pytest.approx(load, rel=1e-12, abs=0.0)
    bare = station(models[sign], angle, at_rest(RATED))
    # Body forces add to what the rings press, at the side they point to.
    assert found.inner_load - load == pytest.approx(bare.inner_load, abs=1e-9)
    assert found.outer_load - load == pytest.approx(bare.outer_load, abs=1e-9)
    assert interference(models[sign], math.cos(angle), math.sin(angle), at_rest(0.0, d)) == found.interference


def test_rings_pass_the_roller_with_the_speeds_of_pure_rolling(models):
    found = station(models[1], 0.3, at_rest(RATED))
    assert found.ring_speed == pytest.approx(-(RATED - ORBITAL) * INNER_RADIUS, rel=1e-12, abs=0.0)
    assert found.ring_speed == pytest.approx((0.0 - ORBITAL) * OUTER_RADIUS, rel=1e-12, abs=0.0)


def test_roller_has_moved_on_by_its_part_of_the_shaft_angle(models):
    here = station(models[1], 0.4 + ORBITAL / RATED * 2.5, at_rest(RATED, (1e-4, 2e-4, 3e-4)))
    there = station(models[1], 0.4, at_rest(RATED, (1e-4, 2e-4, 3e-4), shaft_angle=2.5))
    assert there == pytest.approx(here, rel=1e-12, abs=0.0)


turns = st.floats(-10.0, 10.0)
lengths = st.floats(-4e-4, 4e-4)


@given(turns, turns, lengths, lengths, lengths)
@settings(deadline=None, max_examples=60)
def test_without_weight_no_direction_is_special(models, angle, turn, dx, dy, dz):
    model = models[1]._replace(weight_in_plane=0.0, weight_along_axis=0.0)
    turned = (dx * math.cos(turn) - dy * math.sin(turn), dx * math.sin(turn) + dy * math.cos(turn), dz)
    here = station(model, angle, at_rest(RATED, (dx, dy, dz)))
    there = station(model, angle + turn, at_rest(RATED, turned))
    assert there.interference == pytest.approx(here.interference, abs=1e-17)
    assert there == pytest.approx(here, rel=1e-9, abs=1e-6)


@given(turns, lengths, lengths, lengths, st.floats(-1.0, 1.0))
@settings(deadline=None, max_examples=60)
def test_mirror_image_turns_the_other_way(models, angle, dx, dy, dz, slip):
    # Mirror at the vertical plane: φ → π − φ, dX → −dX, all speeds and tangential forces change sign.
    here = station(models[1], angle, at_rest(RATED, (dx, dy, dz)))
    there = station(models[1], math.pi - angle, at_rest(-RATED, (-dx, dy, dz)))
    assert (there.ring_speed, there.tangential) == pytest.approx((-here.ring_speed, -here.tangential), abs=1e-9)
    assert there.interference == pytest.approx(here.interference, abs=1e-17)
    assert there[2:5] == pytest.approx(here[2:5], rel=1e-9, abs=1e-6)
    mirrored = here._replace(ring_speed=-here.ring_speed, tangential=-here.tangential)
    ahead, behind = slip_forces(models[1], here, slip), slip_forces(models[1], mirrored, -slip)
    odd = {name: -getattr(ahead, name) for name in ("inner", "outer", "cage", "cage_load")}
    assert behind == ahead._replace(**odd)


def a_station(load, extra_outer=12.0, tangential=-25.0, ring_speed=-0.39594):
    return Station(ring_speed, 1e-5, load, load, load + extra_outer, tangential)


@pytest.mark.parametrize("load", [0.0, 100.0, 2e4])
def test_pure_rolling_has_no_raceway_traction_and_a_braking_cage(models, load):
    at = a_station(load)
    found = slip_forces(models[1], at, 0.0)
    assert (found.inner, found.outer) == (0.0, 0.0)
    assert found.cage_load == at.tangential
    # The surface moves along −x, the pocket is at rest: friction drives ω up, that is towards zero.
    assert found.cage > 0.0
    assert slip_forces(models[1], at._replace(ring_speed=0.39594), 0.0).cage == -found.cage


@pytest.mark.parametrize("slip", [-0.3, -1e-4, 1e-9, 0.2])
def test_cage_normal_force_balances_everything_tangential(models, slip):
    at = a_station(3e2)
    found = slip_forces(models[1], at, slip)
    assert found.cage_load == pytest.approx(at.tangential + found.inner - found.outer, rel=1e-14, abs=0.0)
    # The slower body is driven: raceway traction has the sign of the slip.
    assert math.copysign(1.0, found.inner) == math.copysign(1.0, found.outer) == math.copysign(1.0, slip)


def test_standstill_is_at_rest(models):
    at = station(models[1], 0.7, at_rest(0.0, (0.0, 0.0, 8e-4)))
    assert at.elastic_load > 0.0 and at.ring_speed == 0.0
    found = slip_forces(models[1], at, 0.0)
    assert (found.inner, found.outer, found.cage) == (0.0, 0.0, 0.0)
    assert math.isfinite(found.slope) and found.slope > 0.0
    assert found.cage_load == pytest.approx(WEIGHT * math.cos(TILT) * math.cos(0.7), rel=1e-12, abs=0.0)


def test_contact_without_load_has_no_traction(models):
    for load in (0.0, -5.0):
        assert contact_force(models[1].inner, load, 0.3, 0.4, -0.5) == (0.0, 0.0, 0.0)
    untouched = Station(-0.4, -1e-4, 0.0, 0.0, 0.0, 0.0)
    found = slip_forces(models[1], untouched, 0.1)
    # Contacts of the paper's model give nothing beside their forces.
    details = {"inner_detail": None, "outer_detail": None, "cage_detail": None}
    nothing = details | {"rolling_power": (0.0, 0.0, 0.0)}
    assert found._asdict() == dict.fromkeys(found._fields, 0.0) | nothing


def test_entrainment_speed_has_a_floor(models):
    contact = models[1].inner
    floor = contact_force(contact, 1e3, 1e-4, LOWEST_ENTRAINMENT_SPEED, 0.0)
    assert contact_force(contact, 1e3, 1e-4, 0.0, -0.5) == floor
    assert contact_force(contact, 1e3, 1e-4, 0.99e-6, 0.5) == floor
    assert contact_force(contact, 1e3, 1e-4, 2e-6, 0.0)[0] != floor[0]


class Reference:
    """The forces of one roller in mpmath, from the interfaces' data alone."""

    def __init__(self, bearing, lubricant):
        self.faces = interfaces(bearing, lubricant)

    @staticmethod
    def film(face, load, speed):
        m, oil, radius = mpmath.mpf, face.lubricant, mpmath.mpf(face.rolling_radius)
        width = face.hertz.semi_axis_across * mpmath.cbrt(load)
        w = 3 * load / (4 * width) / (face.modulus * radius)
        u = oil.viscosity * max(speed, mpmath.mpf(1e-6)) / (face.modulus * radius)
        g, rough, hard = oil.pressure_viscosity * face.modulus, face.roughness / radius, face.hardness / m(face.modulus)
        height = m("2.691") * w ** m("-0.135") * u ** m("0.705") * g ** m("0.556")
        extra = m("0.2") * rough ** m("1.222") * hard ** m("0.223") * w ** m("-0.229") * u ** m("-0.748")
        return radius * height * (1 + extra * g ** m("-0.842"))

    def traction(self, face, load, slip, speed):
        if load <= 0:
            return mpmath.mpf(0)
        oil, size = face.lubricant, mpmath.cbrt(load)
        exponent = oil.pressure_viscosity * face.hertz.pressure * size
        heating = slip**2 * oil.temperature_viscosity * oil.viscosity / (8 * oil.thermal_conductivity)

        def integrand(s):
            b = heating * mpmath.exp(exponent * s)
            reduction = mpmath.asinh(mpmath.sqrt(b)) / mpmath.sqrt(b * (1 + b)) if b else mpmath.mpf(1)
            return s * mpmath.exp(exponent * s) * reduction

        panels = mpmath.linspace(0, 1, 2 + int(exponent / 4))
        patch = mpmath.quad(integrand, panels, method="gauss-legendre", maxdegree=4)
        area = 2 * mpmath.pi * face.hertz.semi_axis_across * face.hertz.semi_axis_along * size**2
        return area * oil.viscosity * slip / self.film(face, load, speed) * patch

    def __call__(self, at, slip):
        """(F_i, F_o, F_c) at contact speeds u1 = u2 − v, Δu_cage = −u1, u_e = |u1 + u2|/2."""
        slip, ring = mpmath.mpf(slip), mpmath.mpf(at.ring_speed)
        surface = ring - slip
        inner = self.traction(self.faces[0], mpmath.mpf(at.inner_load), slip, abs(ring + surface) / 2)
        outer = self.traction(self.faces[1], mpmath.mpf(at.outer_load), slip, abs(ring + surface) / 2)
        push = abs(mpmath.mpf(at.tangential) + inner - outer)
        return inner, outer, self.traction(self.faces[2], push, -surface, abs(surface) / 2)


# Unloaded, lightly loaded and gripped rollers, cage force of either sign, surface turning backwards.
PLACES = [
    (a_station(0.0), -0.3), (a_station(0.0, tangential=30.0), -0.05), (a_station(5.0), -1e-3), (a_station(800.0), -0.2),
    (a_station(800.0), 0.15), (a_station(3e4), -1e-8), (a_station(3e4, tangential=31.0), 2e-3), (a_station(1e5), 1e-13),
    (a_station(1e5), -0.01), (a_station(50.0), -0.9), (a_station(50.0, ring_speed=0.39594), 0.9),
    (a_station(0.0, ring_speed=0.2), 0.1), (a_station(200.0, ring_speed=0.0), 0.02),
]  # fmt: skip


@pytest.mark.parametrize(("at", "slip"), PLACES)
def test_forces_and_total_slope_in_high_precision(bearing, lubricant, models, at, slip):
    reference = Reference(bearing, lubricant)
    found = slip_forces(models[1], at, slip)
    with mpmath.workdps(40):
        expected = reference(at, slip)
        assert found[:3] == pytest.approx([float(force) for force in expected], rel=1e-11, abs=0.0)
        # Total derivative, with film and cage load following the slip.
        step = mpmath.mpf(abs(slip)) * mpmath.mpf(10) ** -10
        ahead, behind = (sum(reference(at, slip + sign * step)) for sign in (1, -1))
        slope = float((ahead - behind) / (2 * step))
    scale = abs(slope) + abs(found.inner + found.outer + found.cage) / abs(slip)
    assert found.slope == pytest.approx(slope, abs=1e-9 * scale)


def test_cage_load_couples_into_the_slope(models):
    # Without the coupling the slope would be the sum of partial derivatives at fixed cage load.
    at, slip = a_station(3e2), -0.1
    model = models[1]
    found = slip_forces(model, at, slip)
    surface, mean = abs(at.ring_speed - slip), abs(at.ring_speed - slip / 2)
    parts = [
        contact_force(model.inner, at.inner_load, slip, mean, 0.5),
        contact_force(model.outer, at.outer_load, slip, mean, 0.5),
        contact_force(model.cage, abs(found.cage_load), surface, surface / 2, 0.5),
    ]
    fixed = sum(part[1] for part in parts)
    assert abs(found.slope - fixed) > 1e-4 * abs(fixed)
