"""A tapered roller's line contact by strips: quadrature, limits, and the laws of a uniform line."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Laws, Lubricant
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.gap import film_at_load
from macroslip.contact.laws import prepare
from macroslip.contact.line_rolling import line_contacts, line_traction
from macroslip.contact.strips import PreparedStrips, ellipse_load, strip_approach
from macroslip.contact.traction import chord_stress

MAIN = TaperedBearing.read("tdo-main-bearing")
OIL = Lubricant.read("vg460-pao").at(308.15)
#: Laws without roughness, so that a film is all there is.
FILM = {"film": "masjedi-khonsari", "asperities": "none", "starvation": False, "rolling": "none"}
SPEED = 0.24


def laws(**choices):
    return replace(Laws.physical(), **{**FILM, **choices})


def contact(chosen, **bearing):
    return prepare(chosen, MAIN.replace(**bearing), OIL, 1).inner


def test_load_of_an_approach_by_quadrature():
    strips = contact(laws()).strips
    for load in (10.0, 3e3, 2e5):
        approach = float(strip_approach(strips, load))
        end = float(strips.reach(approach))
        pressed = quad(
            lambda z, d=approach: max(d - float(strips.profile(z)), 0.0) ** (10 / 9),
            0.0,
            end,
        )[0]
        assert 2.0 * strips.coefficient * pressed == pytest.approx(load, rel=2e-5)


def test_uniform_line_is_the_limit_without_profile_and_taper():
    """As the contact angle goes to 0 and the profile with it, of a cylindrical roller on a plane strip."""
    law = contact(laws(microslip=False, inlet_heating=False))
    law = replace(law, strips=law.strips._replace(depth=1e-16, taper=0.0))
    inner, _ = line_contacts(MAIN, OIL)
    loads = np.array([1e3, 2e4, 2e5])
    slip = np.full(3, 1e-3)
    pull = law.tractions(loads, np.full(3, SPEED), slip).pull
    per_length = loads / MAIN.roller_length
    film = ellipse_load(law.interface.hertz, per_length)
    height = super(PreparedStrips, law).film_thickness(film, SPEED - 0.5 * slip)
    expected = line_traction(inner, loads, height, slip, laws())
    assert pull == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("load", [2e4, 1.5e5])
@pytest.mark.parametrize("slip", [-2e-5, 1e-5, 3e-3])
def test_traction_of_a_tapered_line_by_quadrature(load, slip):
    law = contact(laws())
    strips = law.strips
    approach = float(strip_approach(strips, load))
    end = float(strips.reach(approach))

    def parts(station):
        drop = float(strips.profile(station))
        per_length = strips.coefficient * max(approach - drop, 1e-15) ** (10 / 9)
        growth = 1.0 + station * strips.taper
        local = slip * (growth - 0.5 * drop / strips.radius)
        local += 0.5 * SPEED * strips.curvature * drop
        ellipse = np.array(ellipse_load(law.interface.hertz, per_length))
        film = super(PreparedStrips, law).film_thickness(ellipse, (SPEED - 0.5 * slip) * growth)
        pressure = math.sqrt(per_length * strips.curvature * strips.modulus / (2.0 * math.pi))
        width = math.sqrt(8.0 * per_length / (math.pi * strips.modulus * strips.curvature))
        stress = chord_stress(law.fluid, pressure, film, max(abs(local), 1e-30))
        return 2.0 * width * float(stress) * math.copysign(1.0, local), growth, local, drop

    edges = np.sort([z for z in (-end, end, *_rolling(parts, end)) if -end <= z <= end])
    sums = np.zeros(3)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    for low, high in itertools.pairwise(edges):
        t = 0.5 * (nodes + 1.0)
        stations = low + (high - low) * t * t * (3.0 - 2.0 * t)
        part = 0.5 * weights * (high - low) * 6.0 * t * (1.0 - t)
        for z, w in zip(stations, part, strict=True):
            force, growth, local, drop = parts(z)
            sums += w * force * np.array([growth, 0.5 * drop / strips.radius, local])
    tractions = law.tractions(np.array([load]), np.array([SPEED]), np.array([slip]))
    pull, lag = float(tractions.pull[0]), float(tractions.lag[0])
    power = slip * (pull - lag) + SPEED * strips.curvature * strips.radius * lag
    assert pull == pytest.approx(sums[0], rel=5e-3)
    assert lag == pytest.approx(sums[1], rel=5e-3)
    assert power == pytest.approx(sums[2], rel=5e-3)
    assert power > 0.0


def _rolling(parts, end):
    """Stations at which slip passes zero, on a fine grid."""
    stations = np.linspace(-end * (1 - 1e-9), end * (1 - 1e-9), 4001)
    local = np.array([parts(z)[2] for z in stations])
    turns = np.flatnonzero(local[:-1] * local[1:] < 0.0)
    return stations[turns] - local[turns] * (stations[1] - stations[0]) / (
        local[turns + 1] - local[turns]
    )


def test_microslip_of_the_hardest_roller_is_negligible():
    """At 12 r/min and 235 kN a constant µ of 0.05 loses half a watt; 8.7 W at 50 kN in a spherical bearing."""
    strips = contact(laws()).strips
    approach = float(strip_approach(strips, 235e3))
    station = np.linspace(-1.0, 1.0, 4001) * float(strips.reach(approach))
    load = strips.coefficient * np.maximum(approach - strips.profile(station), 0.0) ** (10 / 9)
    slip = 0.5 * tapered_geometry(MAIN).surface_speed(1.2566) * strips.curvature
    slip = slip * strips.profile(station)
    weight = load / load.sum()
    middle = np.sort(slip)[np.searchsorted(np.cumsum(weight[np.argsort(slip)]), 0.5)]
    mean = float((weight * np.abs(slip - middle)).sum())
    assert 20e-6 < mean < 50e-6
    assert 0.05 * 235e3 * mean < 0.6


def test_asperities_carry_their_share_of_every_strip():
    """Where asperities alone are sheared, the force is µ_b times their share of the load."""
    law = contact(laws(asperities="film-ratio", microslip=False))
    load = np.array([5e4])
    tractions = law.tractions(load, np.array([SPEED]), np.array([1e-2]))
    without = contact(laws(microslip=False)).tractions(load, np.array([SPEED]), np.array([1e-2]))
    share = float(tractions.asperity_power[0]) / 1e-2 / law.boundary_friction / load[0]
    middle = float(law.asperity_share(load, SPEED, law.film_thickness(load, SPEED))[0])
    assert 0.3 * middle < share < 1.01 * middle
    fluid = float(tractions.pull[0]) - law.boundary_friction * share * load[0]
    assert fluid == pytest.approx((1.0 - share) * float(without.pull[0]), rel=0.01)


def test_light_contacts_are_the_rigid_gap_and_heavy_ones_the_elastic_line():
    law = contact(laws(rolling="whole-film"))
    speed = np.array([SPEED])
    light = np.array([1.0])
    _, resistance, film = law.light(light, speed)
    log_gap, log_rolling, _ = film_at_load(law.rolling.gap, np.log(light / (OIL.viscosity * SPEED)))
    assert float(resistance[0]) == pytest.approx(
        OIL.viscosity * SPEED * math.exp(float(log_rolling[0])), rel=0.02
    )
    assert float(film[0]) == pytest.approx(1.2257 * math.exp(float(log_gap[0])), rel=0.15)
    # A heavy line resists by its length and hardly by its load.
    ratio = law.light(np.array([2e5]), speed)[1] / law.light(np.array([5e4]), speed)[1]
    assert 0.9 < float(ratio[0]) < 1.2
    assert 8.0 < float(law.light(np.array([5e4]), speed)[1][0]) < 25.0
