"""Spin and orbit equations of a roller from the general theorem of angular momentum, by symbols.

The roller's frame (x', y', z') turns with the orbit's speed Ω about Z, z' being tilted by α: its angular velocity is
(0, Ω sin α, Ω cos α). The roller turns in the inertial frame with (0, Ω sin α, ω). Moments of inertia are I_x' = I_y' and I_z'.
"""

import pytest
import sympy as sp

pytestmark = pytest.mark.slow

t = sp.symbols("t")
alpha, m, pitch, r, inertia_y, inertia_z = sp.symbols("alpha m rho r I_y I_z", positive=True)
orbit, spin = sp.Function("Omega")(t), sp.Function("omega")(t)
F_i, F_o, F_c, N, G, couple = sp.symbols("F_i F_o F_c N G C")


def angular_momentum_rate():
    """dL/dt of the roller about its centre, in the primed axes, L̇ + Ω × L."""
    frame = sp.Matrix([0, orbit * sp.sin(alpha), orbit * sp.cos(alpha)])
    momentum = sp.Matrix([0, inertia_y * orbit * sp.sin(alpha), inertia_z * spin])
    return momentum.diff(t) + frame.cross(momentum)


def contact_moments():
    """Moments of the tractions about the centre, from places and directions of the forces."""
    x, y = sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0])
    inner = (-r * y).cross(F_i * x)
    outer = (r * y).cross(-F_o * x)
    front = (-r * x).cross(-F_c * y)
    rear = (r * x).cross(F_c * y)
    assert front == rear  # the cage's friction drives the spin alike from either spar
    return inner + outer + front


def test_spin_equation():
    assert sp.simplify(contact_moments() - sp.Matrix([0, 0, r * (F_i + F_o + F_c)])) == sp.zeros(3, 1)
    rate = angular_momentum_rate()
    assert sp.simplify(rate[2] - inertia_z * spin.diff(t)) == 0  # (16): no gyroscopic term about z'


def test_orbit_equation_is_newtons_law_for_the_centre():
    """The moment about the bearing's axis (17), with (16) put in, leaves the centre's law; what the tilt adds is a couple."""
    rate = angular_momentum_rate()
    about_axis = m * pitch**2 * orbit.diff(t) + sp.sin(alpha) * rate[1] + sp.cos(alpha) * rate[2]
    torque = pitch * (N - G - F_i + F_o) + sp.cos(alpha) * r * (F_i + F_o + F_c) + sp.sin(alpha) * couple
    equation = (about_axis - torque).subs(spin.diff(t), r * (F_i + F_o + F_c) / inertia_z)
    # Counted as an outside couple, what the tilt needs is C = I_y' sin α dΩ/dt, and the orbit's inertia is m r~².
    newton = m * pitch**2 * orbit.diff(t) - pitch * (N - G - F_i + F_o)
    outside = equation.subs(couple, inertia_y * sp.sin(alpha) * orbit.diff(t))
    assert sp.simplify(outside - newton) == 0
    # Without a couple the orbit's inertia is m r~² + I_y' sin² α.
    guided = equation.subs(couple, 0)
    assert sp.simplify(guided - newton - inertia_y * sp.sin(alpha) ** 2 * orbit.diff(t)) == 0


def test_slip_equations():
    """The equations that are integrated, from Newton's law, (16) and the definition of the slips."""
    shaft = sp.Function("Omega_in")(t)
    inner = pitch - r * sp.cos(alpha)
    v_in = -shaft * inner + orbit * pitch - r * spin
    v_out = -orbit * pitch - r * spin
    relative = spin - orbit * sp.cos(alpha)
    outer = pitch + r * sp.cos(alpha)
    assert sp.simplify(v_in - (-(shaft - orbit) * inner - relative * r)) == 0
    assert sp.simplify(v_out - (-orbit * outer - relative * r)) == 0
    rates = {
        orbit.diff(t): (N - G - F_i + F_o) / (m * pitch),
        spin.diff(t): r * (F_i + F_o + F_c) / (m * r**2 / 2),
    }
    found_in = sp.expand(m * v_in.diff(t).subs(rates))
    found_out = sp.expand(m * v_out.diff(t).subs(rates))
    assert sp.simplify(found_in - (-3 * F_i - F_o - 2 * F_c + N - G - m * inner * shaft.diff(t))) == 0
    assert sp.simplify(found_out - (-F_i - 3 * F_o - 2 * F_c - (N - G))) == 0


def test_power_of_the_cages_friction_closes_with_the_slip_against_the_cage():
    cage = sp.symbols("Omega_c")
    on_roller, on_cage = r * F_c * spin, -r * sp.cos(alpha) * F_c * cage
    sliding = -r * (spin - cage * sp.cos(alpha))
    assert sp.simplify(on_roller + on_cage + F_c * sliding) == 0
