"""Histories and independent solutions that the integrator tests share."""

from __future__ import annotations

import math

import numpy as np
import pytest

from macroslip import BearingLoads, Case, Drivetrain, HubLoads, Radau, Traces, simulate


@pytest.fixture(scope="session")
def radial_trace():
    """Two orbits of a downwind roller under a static radial load, every 2 ms, tightly solved."""
    loads = BearingLoads.constant([0.0, -343e3, 0.0], 2.143, 13.0)
    case = Case(loads=loads, rollers=[3], traces=Traces(step=0.002), integrator=Radau(tolerance=1e-8))
    return simulate(case).isel(roller=0).sel(row="downwind")


@pytest.fixture(scope="session")
def turbulent():
    """Forty seconds of the windiest bundled case, on the main bearing."""
    from macroslip import main_bearing_load

    return main_bearing_load(HubLoads.bundled("24A").window(100.0, 140.0), Drivetrain())


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


@pytest.fixture(scope="session")
def plain_roller():
    return PlainRoller
