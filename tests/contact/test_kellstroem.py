"""Kellström's friction: over a straight contact by quadrature, its limits, and the choice in a case."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad

from macroslip import Bearing, InputError, Laws, Lubricant
from macroslip.contact.kellstroem import SaturatingFriction, saturating_patch, saturating_stress
from macroslip.contact.laws import prepare, references
from macroslip.contact.patch import patch_of
from macroslip.contact.skewed import resultants, skewed_contact
from macroslip.contact.table import tractions

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
LAWS = Laws.physical().but(rolling="none", asperities="none", traction="kellstroem")
SPEED, LOADS = -0.39594, np.array([2e4, 3.5e4, 5e4])
sides = pytest.mark.parametrize("ring", ["inner", "outer"])


def test_stress_is_linear_and_then_constant():
    friction = SaturatingFriction(0.04, 0.01)
    slip = np.array([0.0, 1e-3, 4e-3, 8e-3])
    stress = saturating_stress(friction, 1e9, slip, 0.4)
    assert stress == pytest.approx([0.0, 1e7, 4e7, 4e7], rel=1e-14, abs=0.0)


@sides
@pytest.mark.parametrize("slip", [-3e-3, 0.0, 1e-3])
@pytest.mark.parametrize("full_slip", [1e-4, 4e-3, 0.1])
def test_force_moments_and_power_over_the_ellipse_are_integrals(ring, slip, full_slip):
    contact = getattr(prepare(LAWS, BEARING, OIL, 1), ring)
    patch = patch_of(contact)
    load = 5e4
    across = patch.across * load ** (1.0 / 3.0)
    half = min(across, patch.half_length)
    bend = SPEED * patch.curvature_ratio - slip / patch.roller_radius

    def local(zeta):
        drop = zeta**2 / (2.0 * patch.contour_radius)
        return slip + bend * drop - SPEED * patch.spin_ratio * zeta

    def traction(zeta):
        per_length = 0.75 * load / across * (1.0 - (zeta / across) ** 2)
        return 0.05 * per_length * min(max(local(zeta) / full_slip, -1.0), 1.0)

    def integral(weight):
        grid = np.linspace(-half, half, 401)
        parts = [
            quad(lambda zeta: traction(zeta) * weight(zeta), *ends, epsabs=1e-10)[0]
            for ends in itertools.pairwise(grid)
        ]
        return sum(parts)

    resultant = saturating_patch(patch, 0.05, full_slip, load, SPEED, slip)
    size = 0.05 * load
    assert resultant.pull == pytest.approx(integral(lambda zeta: 1.0), abs=1e-7 * size)
    assert resultant.skew == pytest.approx(integral(lambda zeta: zeta), abs=1e-7 * size * half)
    assert resultant.power == pytest.approx(integral(local), abs=1e-7 * size * 0.02)
    lag = integral(lambda zeta: zeta**2 / (2.0 * patch.contour_radius)) / patch.roller_radius
    assert resultant.lag == pytest.approx(lag, abs=1e-7 * size)


@sides
@pytest.mark.parametrize("saturation", [0.01, 0.1])
@pytest.mark.parametrize("slip", [-2e-3, 1e-3])
def test_a_straight_roller_has_the_tractions_without_skew(ring, saturation, slip):
    laws = LAWS.but(traction_saturation=saturation, traction_limit_outer=0.04)
    contact = getattr(prepare(laws, BEARING, OIL, 1), ring)
    forces = resultants(skewed_contact(contact, BEARING, 1), LOADS, SPEED, slip, 0.0, 0.0, 0.0)
    pull, lag, skew, rough = tractions(contact, LOADS, np.full(3, SPEED), np.full(3, slip))
    reach = contact.interface.hertz.semi_axis_across * np.cbrt(LOADS)
    # Slip within the contact's width, which spin changes, is new in the skewed contact.
    assert (np.abs(forces.turning - (pull - lag)) < 2e-5 * LOADS).all()
    side = -1 if ring == "inner" else 1
    assert (np.abs(-side * forces.moment - skew) < 2e-5 * LOADS * reach).all()
    assert not rough.any()


def test_asperities_have_their_share_beside_it():
    laws = LAWS.but(asperities="film-ratio")
    rough = prepare(laws, BEARING, OIL.at("80 degC"), 1).inner
    smooth = prepare(LAWS, BEARING, OIL.at("80 degC"), 1).inner
    state = (LOADS, np.full(3, SPEED), np.full(3, 0.1))
    pull, _, _, power = tractions(rough, *state)
    film = rough.film_thickness(LOADS, abs(SPEED) + 0.05)
    share = rough.asperity_share(LOADS, abs(SPEED) + 0.05, film)
    assert (share > 0.01).all()
    mixed = (1.0 - share) * 0.05 + share * OIL.boundary_friction
    # All of the contact slides one way.
    assert pull == pytest.approx(mixed * LOADS, rel=1e-9)
    assert (power > 0.0).all() and not tractions(smooth, *state)[3].any()


def test_the_cage_keeps_its_film():
    inner, outer, cage, _ = prepare(LAWS.but(traction_limit_outer=0.04), BEARING, OIL, 1)
    assert inner.friction == (0.05, 0.01) and outer.friction == (0.04, 0.01)
    assert cage.friction is None and cage.fluid is not None and inner.fluid is None
    film = prepare(LAWS.but(traction="mechanisms"), BEARING, OIL, 1).cage
    state = (np.array([30.0]), np.zeros(1), np.array([-0.4]))
    assert tractions(cage, *state)[0] == tractions(film, *state)[0]


def test_numbers_go_with_the_law_and_the_source_is_named():
    assert any("79-Lub-23" in reference for reference in references(LAWS))
    assert LAWS.but(traction_saturation=0.003).name.endswith(
        "traction kellstroem, traction_saturation 0.003"
    )
    assert Laws(traction="kellstroem").microslip is False
    with pytest.raises(InputError) as caught:
        Laws.physical().but(traction_limit_inner=0.04)
    assert str(caught.value) == (
        "laws.traction_limit_inner: traction_limit_inner is given, and the traction is 'mechanisms', which has no "
        "such number. Allowed: with laws: {traction: kellstroem}. Set laws.traction: kellstroem, or remove "
        "traction_limit_inner."
    )
    with pytest.raises(InputError, match="traction_saturation: it is 0"):
        LAWS.but(traction_saturation=0.0)


def test_without_microslip_the_whole_contact_has_one_slip():
    contact = prepare(Laws(traction="kellstroem"), BEARING, OIL, 1).inner
    slip = np.array([1e-3, -1e-3, 0.1])
    pull, lag, skew, _ = tractions(contact, np.full(3, 1e4), np.full(3, SPEED), slip)
    mean = np.abs(SPEED - 0.5 * slip)
    expected = 500.0 * np.clip(slip / (0.01 * mean), -1.0, 1.0)
    assert pull == pytest.approx(expected, rel=1e-12)
    assert not lag.any() and np.abs(skew).max() < 1e-9
    assert math.isinf(contact.shape.contour_radius)
