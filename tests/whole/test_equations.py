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
    """dL/dt = L̇ + Ω × L of the roller about its centre (2)-(6), in axes turned by α (14)."""
    frame = sp.Matrix([0, orbit * sp.sin(alpha), orbit * sp.cos(alpha)])
    momentum = sp.Matrix([0, inertia_y * orbit * sp.sin(alpha), inertia_z * spin])
    return momentum.diff(t) + frame.cross(momentum)


def contact_moments():
    """Moments of the forces about the roller's centre (7)-(12), and with them the steps (15) to the pair."""
    x, y = sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0])
    inner = (-r * y).cross(F_i * x)
    outer = (r * y).cross(-F_o * x)
    front = (-r * x).cross(-F_c * y)
    rear = (r * x).cross(F_c * y)
    assert front == rear  # the cage's friction drives the spin alike from either spar
    return inner + outer + front


def test_spin_equation():
    assert sp.simplify(contact_moments() - sp.Matrix([0, 0, r * (F_i + F_o + F_c)])) == sp.zeros(
        3, 1
    )
    rate = angular_momentum_rate()
    assert sp.simplify(rate[2] - inertia_z * spin.diff(t)) == 0  # (16): no gyroscopic term about z'


def test_orbit_equation_is_newtons_law_for_the_centre():
    """The moment about the bearing's axis (17), with (16) put in, leaves the centre's law; what the tilt adds is a couple."""
    rate = angular_momentum_rate()
    about_axis = m * pitch**2 * orbit.diff(t) + sp.sin(alpha) * rate[1] + sp.cos(alpha) * rate[2]
    torque = (
        pitch * (N - G - F_i + F_o) + sp.cos(alpha) * r * (F_i + F_o + F_c) + sp.sin(alpha) * couple
    )
    equation = (about_axis - torque).subs(spin.diff(t), r * (F_i + F_o + F_c) / inertia_z)
    # Counted as an outside couple, what the tilt needs is C = I_y' sin α dΩ/dt, and the orbit's inertia is m r~².
    newton = m * pitch**2 * orbit.diff(t) - pitch * (N - G - F_i + F_o)
    outside = equation.subs(couple, inertia_y * sp.sin(alpha) * orbit.diff(t))
    assert sp.simplify(outside - newton) == 0
    # Without a couple the orbit's inertia is m r~² + I_y' sin² α.
    guided = equation.subs(couple, 0)
    assert sp.simplify(guided - newton - inertia_y * sp.sin(alpha) ** 2 * orbit.diff(t)) == 0


def test_power_of_the_cages_friction_closes_with_the_slip_against_the_cage():
    cage = sp.symbols("Omega_c")
    on_roller, on_cage = r * F_c * spin, -r * sp.cos(alpha) * F_c * cage
    sliding = -r * (spin - cage * sp.cos(alpha))
    assert sp.simplify(on_roller + on_cage + F_c * sliding) == 0


shear, shaft_speed, cage_speed, omega, orbital = sp.symbols("sigma Omega_in Omega_c omega Omega")
X, Y, Z = sp.Matrix([1, 0, 0]), sp.Matrix([0, 1, 0]), sp.Matrix([0, 0, 1])
#: The bearing's axis and the roller's centre in the primed axes, y' = y cos α + z sin α and z' = z cos α − y sin α.
AXIS = Z * sp.cos(alpha) + Y * sp.sin(alpha)
CENTRE = pitch * (Y * sp.cos(alpha) - Z * sp.sin(alpha))
#: Of the roller: its centre's velocity, and its angular velocity in the inertial frame.
TRAVEL = -orbital * pitch * X
TURNING = orbital * sp.sin(alpha) * Y + omega * Z


def about_axis(point, force):
    return point.cross(force).dot(AXIS)


@pytest.mark.parametrize("side", [-1, 1], ids=["inner", "outer"])
def test_rolling_resistance_acts_on_roller_and_ring_with_opposite_torques_and_costs_what_the_film_dissipates(
    side,
):
    """Shear σ on both surfaces at the contact, and the pressure's push −2σ R/R_i through the axis of either body.

    Motion is counted along +x' at the inner raceway and along −x' at the outer one.
    """
    along = -side * X
    point = CENTRE + side * r * Y
    arm = pitch + side * r * sp.cos(alpha)
    ring_speed = 0 if side > 0 else shaft_speed
    relative = 1 / r - side * sp.cos(alpha) / arm
    on_roller, on_ring = 1 / (r * relative), -side * sp.cos(alpha) / (arm * relative)
    assert sp.simplify(on_roller - arm / pitch) == 0
    assert (
        sp.simplify(2 * shear - 2 * shear * (on_roller + on_ring)) == 0
    )  # the film has no mass: forces balance

    pull = shear * (1 - 2 * on_roller)
    roller_torque = about_axis(point, shear * along) + about_axis(
        CENTRE, -2 * shear * on_roller * along
    )
    # The push on the ring goes through the bearing's axis.
    ring_torque = about_axis(point, shear * along)
    assert sp.simplify(roller_torque + ring_torque) == 0
    assert (
        sp.simplify(roller_torque - side * (pitch * pull + side * r * sp.cos(alpha) * shear)) == 0
    )

    about_centre = (side * r * Y).cross(shear * along)
    assert about_centre == r * shear * Z  # it turns the roller as a traction does
    power = pull * along.dot(TRAVEL) + about_centre.dot(TURNING) + ring_torque * ring_speed
    surface = r * (omega - orbital * sp.cos(alpha))
    ring = side * (ring_speed - orbital) * arm
    assert (
        sp.simplify(power - shear * (surface + ring)) == 0
    )  # −2 F_R u for σ = −F_R, u the mean speed


def test_rolling_resistance_in_a_pocket_acts_as_its_friction_does():
    """The film has no mass, so the cage gets the opposite of all that the roller gets; the push goes through its axis."""
    push = sp.symbols("P")
    for side in (-1, 1):
        point, along = CENTRE + side * r * X, side * Y
        moment = (point - CENTRE).cross(shear * along)
        assert moment == r * shear * Z
        on_cage = -about_axis(point, shear * along) - about_axis(CENTRE, push * along)
        assert sp.simplify(on_cage + r * sp.cos(alpha) * shear) == 0
        # Its forces along ±y' do no work on the centre, which travels along x'.
        power = moment.dot(TURNING) + on_cage * cage_speed
        assert sp.simplify(power - shear * r * (omega - cage_speed * sp.cos(alpha))) == 0


def test_slip_equations_where_pull_and_spin_force_differ():
    """What is integrated with rolling resistance or slip that varies along the roller: pull P moves, S turns."""
    shaft = sp.Function("Omega_in")(t)
    P_i, P_o, S_i, S_o = sp.symbols("P_i P_o S_i S_o")
    inner = pitch - r * sp.cos(alpha)
    rates = {
        orbit.diff(t): (N - G - P_i + P_o) / (m * pitch),
        spin.diff(t): r * (S_i + S_o + F_c) / (m * r**2 / 2),
    }
    v_in = -shaft * inner + orbit * pitch - r * spin
    v_out = -orbit * pitch - r * spin
    relative, outer = spin - orbit * sp.cos(alpha), pitch + r * sp.cos(alpha)
    assert sp.simplify(v_in - (-(shaft - orbit) * inner - relative * r)) == 0
    assert sp.simplify(v_out - (-orbit * outer - relative * r)) == 0
    found_in = sp.expand(m * v_in.diff(t).subs(rates))
    found_out = sp.expand(m * v_out.diff(t).subs(rates))
    turning = 2 * (S_i + S_o + F_c)
    assert sp.simplify(found_in - (-P_i + P_o - turning + N - G - m * inner * shaft.diff(t))) == 0
    assert sp.simplify(found_out - (P_i - P_o - turning - (N - G))) == 0
