"""The slip of one roller against SciPy's Radau: on the equation written again without shared code, and with all mechanisms."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from macroslip import Laws
from macroslip.imposed.status import Status
from macroslip.ring.orbit import instant
from tests.one_roller import (
    BEARING,
    OIL,
    RATED,
    end_slips,
    energies,
    forces_of,
    limits_of,
    models,
    motion_of,
    net,
    rollers,
    station_of,
    walk,
)

pytestmark = pytest.mark.slow


class PlainRoller:
    """The slip equation written again from the paper with NumPy, by quadrature instead of closed forms.

    One downwind roller on its imposed orbit under a constant ring displacement (three numbers), at constant speed
    or constant shaft acceleration.
    """

    def __init__(
        self, bearing, lubricant, displacement, shaft_speed, start_angle, acceleration=0.0, tilt=math.radians(5)
    ):
        self.b, self.l = bearing, lubricant
        self.d, self.speed, self.acceleration, self.phi0, self.tilt = (
            displacement,
            shaft_speed,
            acceleration,
            start_angle,
            tilt,
        )
        r = bearing.roller_diameter / 2
        alpha = bearing.contact_angle
        self.r, self.alpha = r, alpha
        self.r_in = bearing.pitch_radius - r * math.cos(alpha)
        self.r_out = bearing.pitch_radius + r * math.cos(alpha)
        self.mass = bearing.density * math.pi * r**2 * bearing.roller_length
        self.inertia = 0.5 * self.mass * r**2
        modulus = 1.0 / ((1.0 - bearing.poisson_ratio**2) / bearing.youngs_modulus)
        contour = bearing.osculation_outer * bearing.outer_raceway_radius
        lateral = 1.0 / contour - 1.0 / bearing.outer_raceway_radius
        self.contacts = [
            self._hertz(1 / r + math.cos(alpha) / self.r_in, lateral, modulus),
            self._hertz(1 / r - math.cos(alpha) / self.r_out, lateral, modulus),
            self._hertz(1 / r - bearing.osculation_outer / r, lateral, modulus),
        ]
        self.nodes, self.weights = np.polynomial.legendre.leggauss(60)
        self.nodes, self.weights = 0.5 * (self.nodes + 1), 0.5 * self.weights

    @staticmethod
    def _hertz(rolling, lateral, modulus):
        """Semi-axes, pressure and approach per power of load from K and E (Johnson 4.26)."""
        from scipy.optimize import brentq
        from scipy.special import ellipe, ellipkm1

        def mismatch(k):
            m1 = k * k
            big_k, big_e = ellipkm1(m1), ellipe(1 - m1)
            return (big_e / m1 - big_k) / (big_k - big_e) - rolling / lateral

        k = brentq(mismatch, 1e-4, 0.9999, xtol=1e-15, rtol=1e-14)
        m1 = k * k
        big_k, big_e = ellipkm1(m1), ellipe(1 - m1)
        # B = ρ/2 = (p0/E*)(b/(e² a²)) (E/k² − K) with p0 = 3/(2πab), E* = E'/2
        a = (3.0 / (math.pi * modulus) * (big_e / m1 - big_k) / (1 - m1) * 2.0 / rolling) ** (1 / 3)
        return {
            "a": a,
            "b": k * a,
            "p": 1.5 / (math.pi * a * k * a),
            "E": modulus,
            "R": 1 / rolling,
            "approach": 3.0 * big_k / (math.pi * a * modulus),
        }

    def film(self, contact, load, speed):
        lub, b = self.l, self.b
        speed = max(abs(speed), 1e-6)
        w = 0.75 * load / (contact["a"] * load ** (1 / 3)) / (contact["E"] * contact["R"])
        u = lub.viscosity * speed / (contact["E"] * contact["R"])
        g = lub.pressure_viscosity * contact["E"]
        sigma, v = b.composite_roughness / contact["R"], b.hardness / contact["E"]
        smooth = 2.691 * w**-0.135 * u**0.705 * g**0.556
        return contact["R"] * smooth * (1 + 0.2 * sigma**1.222 * v**0.223 * w**-0.229 * u**-0.748 * g**-0.842)

    def force(self, contact, load, slip, speed):
        if load <= 0.0 or slip == 0.0:
            return 0.0
        lub = self.l
        root = load ** (1 / 3)
        pressure = contact["p"] * root
        s = self.nodes
        viscosity = lub.viscosity * np.exp(lub.pressure_viscosity * pressure * s)
        heating = lub.temperature_viscosity * viscosity * slip**2 / (8 * lub.thermal_conductivity)
        reduction = np.arcsinh(np.sqrt(heating)) / np.sqrt(heating * (1 + heating))
        integral = np.sum(self.weights * s * viscosity * reduction)
        area = 2 * math.pi * contact["a"] * contact["b"] * root**2
        return area * integral * slip / self.film(contact, load, speed)

    def motion(self, t):
        omega_in = self.speed + self.acceleration * t
        omega = omega_in * self.r_in / (self.r_in + self.r_out)
        ratio = self.r_in / (self.r_in + self.r_out)
        phi = self.phi0 + ratio * (self.speed * t + 0.5 * self.acceleration * t * t)
        return omega, phi

    def forces(self, t, slip):
        omega, phi = self.motion(t)
        ca, sa = math.cos(self.alpha), math.sin(self.alpha)
        d = self.d
        approach = (d[0] * math.cos(phi) + d[1] * math.sin(phi) - self.b.diametral_clearance / 2) * ca + d[2] * sa
        stiffness = (self.contacts[0]["approach"] + self.contacts[1]["approach"]) ** -1.5
        load = stiffness * max(approach, 0.0) ** 1.5
        weight = self.mass * 9.81
        radial = self.mass * self.b.pitch_radius * omega**2 - weight * math.cos(self.tilt) * math.sin(phi)
        outward = radial * ca + weight * math.sin(self.tilt) * sa
        lub = self.l
        drag = 0.5 * lub.drag_coefficient * lub.fill_factor * lub.density * 2 * self.r * self.b.roller_length
        drag *= (omega * self.b.pitch_radius) ** 2 * math.copysign(1.0, omega)
        u2 = -omega * self.r_out
        u1 = u2 - slip
        inner = self.force(self.contacts[0], load + max(-outward, 0.0), slip, 0.5 * (u1 + u2))
        outer = self.force(self.contacts[1], load + max(outward, 0.0), slip, 0.5 * (u1 + u2))
        cage_load = abs(weight * math.cos(self.tilt) * math.cos(phi) + drag + inner - outer)
        cage = self.force(self.contacts[2], cage_load, -u1, 0.5 * u1)
        return inner, outer, cage, u1

    def rate(self, t, y):
        """Slip [m/s], and the energies of inner, outer and cage interface [J]."""
        inner, outer, cage, u1 = self.forces(t, y[0])
        ring = -self.acceleration * self.r_in / (self.r_in + self.r_out) * self.r_out
        slip_rate = ring - self.r**2 / self.inertia * (inner + outer + cage)
        return [slip_rate, abs(inner * y[0]), abs(outer * y[0]), abs(cage * u1)]


def independent(roller, slip, times):
    found = solve_ivp(
        roller.rate,
        (0.0, times[-1]),
        [slip, 0.0, 0.0, 0.0],
        method="Radau",
        t_eval=times,
        rtol=1e-8,
        atol=[1e-12, 1e-10, 1e-10, 1e-10],
        first_step=1e-7,
        max_step=0.02,
    )
    assert found.success
    return found.y


@pytest.fixture(scope="module")
def paper():
    return rollers(models(Laws.paper()), load=1.2e5, speeds=(-6.0, 6.0), tolerance=1e-5)["downwind"]


def solve(paper, displacement, start_angle, slip, times, acceleration=0.0, tolerance=1e-7):
    """Slip at `times` and energies up to the last, under a fixed ring displacement."""
    time = np.linspace(0.0, times[-1], 401)
    motion = motion_of(time, 2.143 + acceleration * time, displacement)
    limits = limits_of(paper, motion, tolerance)
    steps, status, _ = walk(paper, motion, limits, times, start_angle, slip=slip)
    assert status == Status.COMPLETED
    return end_slips(steps, times), energies(steps)


# Ring displacements [m], start angle, start slip [m/s], shaft acceleration [rad/s²] and span [s]; the radial ones leave the top
# unloaded.
STORIES = {
    "leaves the load zone and coasts over the top": ((0.0, -2.3e-4, 0.0), -0.55, 0.0, 0.0, 1.6),
    "coasts into the load zone and snaps back": ((0.0, -2.3e-4, 0.0), 3.6, -0.15, 0.0, 0.9),
    "unloaded all round": ((0.0, 0.0, -3e-4), 0.3, -0.02, 0.0, 2.0),
    "the shaft brakes while the roller is lightly loaded": ((0.0, -1.1e-4, 0.0), -2.2, 0.0, -0.4, 1.5),
    # At 150 rad/s² the light contacts cannot pull the roller along: slip grows although traction has peaked.
    "the shaft is too quick for traction": ((0.0, -0.3e-4, 0.0), -math.pi / 2, 0.0, 150.0, 0.2),
}


@pytest.mark.parametrize("story", STORIES)
def test_slip_and_energies_of_the_papers_model(paper, story):
    displacement, angle, slip, acceleration, span = STORIES[story]
    times = np.linspace(span / 8, span, 8)
    reference = independent(PlainRoller(BEARING, OIL, displacement, 2.143, angle, acceleration), slip, times)
    found, energy = solve(paper, displacement, angle, slip, times, acceleration)
    assert found == pytest.approx(reference[0], rel=3e-6, abs=2e-8)
    assert energy == pytest.approx(reference[1:, -1], rel=1e-5, abs=1e-9)


def test_roller_forced_to_skid_follows_the_root_continuous_with_the_past(paper):
    """A heavily loaded roller that starts with large slip sits on the falling branch of its traction curve.

    Every implicit step then has up to three roots: skidding on, the unstable one, and gripped. The solution is the one
    that time leads to, and the roller grips when, not before, its traction has stopped it.
    """
    displacement, angle, slip = (0.0, -1.25e-4, 0.0), -math.pi / 2, 0.36
    roller = PlainRoller(BEARING, OIL, displacement, 2.143, angle)
    inner, outer, _, _ = roller.forces(0.0, slip)
    more, outer_more, _, _ = roller.forces(0.0, 1.05 * slip)
    assert more + outer_more < inner + outer  # the falling branch
    grip = solve_ivp(roller.rate, (0.0, 0.01), [slip, 0, 0, 0], method="Radau", rtol=1e-9, atol=1e-13)
    stopped = grip.t[np.argmax(grip.y[0] < 0.01 * slip)]
    times = np.array([0.2, 0.5, 0.8, 0.95, 1.5, 3.0]) * stopped
    reference = independent(roller, slip, times)
    for tolerance, accuracy in ((1e-2, 2e-2), (1e-4, 3e-4), (1e-8, 2e-6)):
        found, energy = solve(paper, displacement, angle, slip, times, tolerance=tolerance)
        assert found == pytest.approx(reference[0], abs=accuracy * slip)
        assert energy.sum() == pytest.approx(reference[1:, -1].sum(), rel=5 * accuracy)


# --- All mechanisms --------------------------------------------------------------------------------------------------

FULL = Laws.physical()
HOT = {
    "physical": FULL,
    "barus, newtonian": FULL.but(rheology="newtonian", viscosity="barus", asperities="none", rolling="none"),
    "limiting shear": FULL.but(rheology="limiting-shear"),
    "without microslip": FULL.but(microslip=False),
}


def of(name):
    # Without weight a roller meets the same all the time.
    return rollers(models(HOT[name], gravity=False, drag=False), speeds=(-0.6, 0.6))["downwind"]


def thrust(roller, load):
    """Axial displacement of the ring [m] that presses every roller of the downwind row with a load [N]."""
    body = roller.body[0]
    approach = (load / float(body["stiffness"])) ** (2 / 3) + float(body["radial_play"] * body["cos_contact_angle"])
    return 0.0, 0.0, approach / float(body["sin_contact_angle"])


def by_scipy(roller, motion, angle, slip, times):
    """dv/dt = du2/dt − (r²/I)(F_i + F_o + F_c + resistance) by SciPy's Radau, sample by sample."""
    body = roller.body[0]

    def rate(t, v):
        k = min(int(np.searchsorted(motion.time, t, side="right")) - 1, motion.time.size - 2)
        acceleration = (motion.shaft_speed[k + 1] - motion.shaft_speed[k]) / (motion.time[k + 1] - motion.time[k])
        at = station_of(roller, angle, instant(motion, k, t))
        drive = -body["orbit_ratio"] * body["outer_radius"] * acceleration
        return [drive - body["mobility"] * net(forces_of(roller, at, v[0]))]

    state, ends = slip, np.unique(np.concatenate([motion.time, times]))
    at = {ends[0]: slip}
    for start, end in itertools.pairwise(ends):
        piece = solve_ivp(rate, (start, end), [state], method="Radau", rtol=1e-8, atol=1e-12)
        assert piece.success
        at[end] = state = float(piece.y[0, -1])
    return np.array([at[t] for t in times])


@pytest.mark.parametrize("name", HOT)
@pytest.mark.parametrize("slip", [-0.35, 0.3, -0.02])
def test_a_skidding_roller_follows_its_past(name, slip):
    """Set down far from rolling under a heavy load: traction falls with slip at first, and rolling, where the roller would be
    gripped, is another root of a long implicit step. SciPy's integrator in small steps knows the way."""
    roller = of(name)
    motion = motion_of(np.linspace(0.0, 4e-3, 5), RATED, thrust(roller, 1.8e4))
    times = np.linspace(1e-5, 4e-3, 60)
    steps, status, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), times, 0.2, slip=slip)
    wanted = by_scipy(roller, motion, 0.2, slip, times)
    assert status == Status.COMPLETED
    assert np.abs(end_slips(steps, times) - wanted).max() < 2e-4 * abs(slip) + 2e-6


def test_a_roller_whose_shaft_jerks_follows_its_past():
    """The shaft gains a third of its speed within 2 ms: more than traction of a lightly loaded roller can give."""
    roller = of("physical")
    motion = motion_of([0.0, 0.02, 0.022, 0.05], RATED * np.array([1.0, 1.0, 1.33, 1.33]), thrust(roller, 700.0))
    times = np.linspace(1e-3, 0.05, 80)
    steps, _, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), times, 0.2)
    wanted = by_scipy(roller, motion, 0.2, 0.0, times)
    assert np.abs(wanted).max() > 0.05
    assert np.abs(end_slips(steps, times) - wanted).max() < 3e-4 * np.abs(wanted).max()


@pytest.mark.parametrize("load", [5e3, 3e4, 8e4])
@pytest.mark.parametrize("name", ["physical", "limiting shear"])
def test_slip_settles_where_moments_balance(name, load):
    roller = of(name)
    motion = motion_of(np.linspace(0.0, 0.5, 11), RATED, thrust(roller, load))
    steps, _, _ = walk(roller, motion, limits_of(roller, motion, 1e-6), [0.5], 0.2)
    at = station_of(roller, 0.2, instant(motion, 9, 0.5))
    root = brentq(lambda slip: net(forces_of(roller, at, slip)), -0.02, 0.02, xtol=1e-15)
    assert abs(root) > 1e-5
    assert end_slips(steps, [0.5]) == pytest.approx(root, rel=1e-3)
