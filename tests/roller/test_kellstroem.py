"""Rests of a roller under Kellström's friction, against a fine grid of the contact and forces by vectors."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve

from macroslip import Bearing, Laws, Lubricant
from macroslip.bearing import geometry
from macroslip.contact.interface import interfaces
from macroslip.contact.laws import prepare
from macroslip.contact.table import Box
from macroslip.roller.skew import equilibrium, raceways, skew_stop
from macroslip.roller.skew_table import guide_of, skew_table, turned

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
SPEED = -0.39594
CHORDS = 400
POINTS = 24


class Side(NamedTuple):
    """Geometry of a raceway."""

    k: int
    hertz: object
    distance: float
    along: float
    across: float


def side(name):
    inner = name == "inner"
    contact = next(interface for interface in interfaces(BEARING, OIL) if interface.name == name)
    k = -1 if inner else 1
    distance = (
        geometry.inner_contact_radius(BEARING) if inner else geometry.outer_contact_radius(BEARING)
    )
    contour = (
        geometry.inner_raceway_contour_radius(BEARING) if inner else BEARING.outer_raceway_radius
    )
    return Side(
        k, contact.hertz, distance, 1.0 / contour, k * math.cos(BEARING.contact_angle) / distance
    )


R = geometry.roller_radius(BEARING)
CONTOUR = geometry.roller_contour_radius(BEARING)
ALPHA = BEARING.contact_angle
SIDES = (side("inner"), side("outer"))


def forces(ring, friction, load, slip, skew, tilt, shift):
    """Traction on the roller, its moment about the roller's middle, and the pressure's about y'."""
    k = ring.k
    lateral = 1.0 / CONTOUR - ring.along
    middle = (-k * tilt + ring.along * (shift + k * R * tilt)) / lateral
    root = load ** (1.0 / 3.0)
    a = ring.hertz.semi_axis_across * root
    b = ring.hertz.semi_axis_along * root
    p0 = ring.hertz.pressure * root
    # Hessian of the gap between a turned roller and its raceway: its long axis.
    turned_shape = np.array(
        [
            [1.0 / R - ring.across, (ring.along - ring.across) * skew],
            [(ring.along - ring.across) * skew, lateral],
        ]
    )
    _, axes = np.linalg.eigh(turned_shape)
    long_axis = axes[:, 0] / axes[1, 0]
    turn = long_axis[0]
    low, high = (
        max(middle - a, -BEARING.roller_length / 2),
        min(middle + a, BEARING.roller_length / 2),
    )
    # Midpoints of chords even in the angle of the ellipse.
    ends = np.arcsin(np.clip((np.array([low, high]) - middle) / a, -1.0, 1.0))
    angles = ends[0] + (ends[1] - ends[0]) * (np.arange(CHORDS) + 0.5) / CHORDS
    zeta = (middle + a * np.sin(angles))[:, None]
    width = (ends[1] - ends[0]) / CHORDS * a * np.cos(angles)[:, None]
    places = math.pi * (np.arange(POINTS) + 0.5) / POINTS
    height = np.cos(angles)[:, None]
    chord = b * height * np.cos(places)
    pressure = p0 * height * np.sin(places)
    area = width * b * height * np.sin(places) * math.pi / POINTS
    mean = 0.5 * (1.0 / CONTOUR + ring.along)
    drop = 0.5 * mean * zeta**2 + lateral * (0.5 * middle * zeta - 0.25 * middle**2)
    # Position from the roller's middle: x of the contact's own axes is counted from the roller's axis turned by ψ.
    off = chord + turn * zeta
    axis = np.array([skew, -tilt, 1.0])
    x = skew * zeta + off
    y = k * (R - drop) - tilt * zeta
    z = np.broadcast_to(zeta + k * R * tilt, x.shape)
    ring_rate = k * SPEED / ring.distance
    spin = (SPEED - slip) / R
    shaft = np.array([0.0, math.sin(ALPHA), math.cos(ALPHA)])
    centre = BEARING.pitch_radius * np.array([0.0, math.cos(ALPHA), -math.sin(ALPHA)])
    at = np.stack([x, np.broadcast_to(y, x.shape), z], axis=-1)
    point = at + centre + np.array([0.0, 0.0, shift])
    relative = ring_rate * np.cross(shaft, point) - spin * np.cross(axis, at)
    speed = np.hypot(relative[..., 0], relative[..., 2])
    limit, saturation = friction[0 if k < 0 else 1]
    size = limit * pressure * np.minimum(speed / (saturation * abs(SPEED - 0.5 * slip)), 1.0)
    stress = np.zeros_like(relative)
    for i in (0, 2):
        stress[..., i] = size * relative[..., i] / np.maximum(speed, 1e-30)
    part = stress * area[..., None]
    moment = np.cross(at, part).sum(axis=(0, 1))
    # Normals of a body of revolution: across them the pressure turns the roller.
    pressing = -(1.0 / R - 1.0 / CONTOUR) * (pressure * area * off * zeta).sum()
    return part.sum(axis=(0, 1)), moment, pressing, middle


def balance(friction, load, skew):
    """Net moment about the normal, in equilibrium of spin, axial force and couple."""

    def rows(unknowns):
        slip, tilt, shift = unknowns[0] * 1e-3, unknowns[1] * 1e-4, unknowns[2] * 1e-4
        spin = axial = couple = about = 0.0
        for ring in SIDES:
            force, moment, pressing, middle = forces(ring, friction, load, slip, skew, tilt, shift)
            slope = ring.along * (middle + shift + ring.k * R * tilt)
            spin += np.array([skew, -tilt, 1.0]) @ moment
            axial += force[2] - load * slope
            couple += ring.k * R * (force[2] - load * slope) + ring.k * load * middle
            about += moment[1] + pressing
        return spin, axial, couple, about

    def conditions(unknowns):
        spin, axial, couple, _ = rows(unknowns)
        return [spin / (load * R), axial / load, couple / (load * R)]

    solution, _, status, message = fsolve(conditions, [0.5, 0.0, 0.0], full_output=True, xtol=1e-9)
    assert status == 1, message
    return rows(solution)[3]


def package(load, saturation, inner, outer):
    laws = prepare(
        Laws.physical().but(
            rolling="none",
            asperities="none",
            traction="kellstroem",
            traction_limit_inner=inner,
            traction_limit_outer=outer,
            traction_saturation=saturation,
        ),
        BEARING,
        OIL,
        1,
    )
    both = raceways(laws, BEARING, 1)
    return laws, lambda skew: float(equilibrium(both, laws, load, SPEED, skew).moment)


CASES = [
    (2e4, 0.001, 0.05, 0.05, (-0.5e-3, 0.3e-3)),
    (5e4, 0.003, 0.05, 0.05, (-1.5e-3, 0.3e-3)),
    (3.5e4, 0.01, 0.05, 0.05, (-0.3e-3, 3e-3)),
    (5e4, 0.01, 0.04, 0.05, (-15e-3, -3e-3)),
]


@pytest.mark.parametrize(("load", "saturation", "inner", "outer", "bracket"), CASES)
def test_rests_are_those_of_a_fine_grid(load, saturation, inner, outer, bracket):
    _, moment = package(load, saturation, inner, outer)
    rest = brentq(moment, *bracket, xtol=1e-8)
    friction = ((inner, saturation), (outer, saturation))
    fine = brentq(lambda skew: balance(friction, load, skew), *bracket, xtol=1e-6)
    assert rest == pytest.approx(fine, abs=0.05e-3)


#: Rests of the model's specification by ten points along the contact [mrad], at 20, 35, 50 and 80 kN: by the program's
#: formulas, and by a second derivation.
SPECIFIED = {
    0.001: ([-0.12, -0.24, -0.34, -0.42], [-0.13, -0.23, -0.30, -0.43]),
    0.003: ([-0.10, -0.20, -0.48, -0.46], None),
    0.01: ([2.6, 0.48, -0.06, -0.33], [2.2, 0.85, 0.13, -0.47]),
}


@pytest.mark.parametrize("saturation", SPECIFIED)
def test_rests_have_the_signs_and_sizes_of_two_coarse_derivations(saturation):
    first, second = SPECIFIED[saturation]
    for k, load in enumerate((2e4, 3.5e4, 5e4, 8e4)):
        _, moment = package(load, saturation, 0.05, 0.05)
        coarse = [estimates[k] for estimates in (first, second) if estimates is not None]
        rest = 1e3 * brentq(moment, -2e-3, 5e-3, xtol=1e-7)
        # Ten points miss the corner: their own difference, or a third of the size and .15 mrad.
        spread = max(max(coarse) - min(coarse), 0.15 + 0.33 * abs(coarse[0]))
        assert min(coarse) - spread <= rest <= max(coarse) + spread


def test_a_film_that_saturates_late_does_not_guide():
    for saturation in (0.03, 0.1):
        for load in (2e4, 3.5e4, 5e4):
            _, moment = package(load, saturation, 0.05, 0.05)
            stop = skew_stop(BEARING, "conforming-pocket", 0.5e-3).largest
            assert min(moment(skew) for skew in np.linspace(0.0, stop, 4)) > 0.0


def test_unequal_limits_choose_the_side():
    _, less_inside = package(5e4, 0.01, 0.04, 0.05)
    _, more_inside = package(5e4, 0.01, 0.05, 0.04)
    assert less_inside(0.0) < 0.0 < more_inside(0.0)


@pytest.mark.slow
def test_the_table_of_a_case_has_these_rests():
    laws, _ = package(2e4, 0.003, 0.05, 0.05)
    table = skew_table(laws, BEARING, Box(32768.0, 0.38, 0.42, 1.0))
    guide = guide_of(skew_stop(BEARING, "conforming-pocket", 0.5e-3), 1)
    for load in (1.1e4, 2e4, 2.9e4):
        _, moment = package(load, 0.003, 0.05, 0.05)
        rest = brentq(moment, -2e-3, 2e-3, xtol=1e-8)
        assert turned(table, guide, load, SPEED, 0.0).skew == pytest.approx(rest, abs=0.05e-3)
