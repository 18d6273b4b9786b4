"""The `physical` model as a whole: sizes known beforehand, balances, symmetries, and each mechanism by itself.

The sizes of a 50 kN contact at rated speed under constant friction (8.7 and 7.1 W, 17 N m, 23 mm/s, mean 3.5 mm/s) are
those of each raceway at the slip at which it exerts no moment on the roller; at the roller's common equilibrium, 0.1 mm/s
away, they are the same within 2 %. The largest and the mean slip are those of the inner raceway.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from macroslip import BearingLoads, Case, Drivetrain, HubLoads, Radau, Traces, Window, simulate
from macroslip.bearing import Bearing
from macroslip.contact.mechanisms import Laws
from macroslip.contact.patch import patch_of, patch_power, patch_tractions
from macroslip.contact.starvation import film_factor
from macroslip.contact.table import tractions
from macroslip.contact.traction import chord_table
from macroslip.imposed.status import Status
from macroslip.lubricant import Lubricant
from macroslip.roller.model import roller_model

pytestmark = pytest.mark.slow

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
# The oil around the rollers has tests of its own, tests/roller/test_films.py.
FULL, PAPER = Laws.physical().but(rolling="none"), Laws.paper()
LIMITED = FULL.but(rheology="limiting-shear")
RATED = 20.463 * 2 * math.pi / 60
RADIUS = 0.035
START = Window(start=0.0)


def run(loads, laws=FULL, rollers=(0, 9), **settings):
    settings.setdefault("window", START)
    return simulate(Case(loads=loads, laws=laws, rollers=list(rollers), **settings))


# --- Sizes known beforehand -------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def coulomb():
    """Constant friction 0.05: a film so thin and cool that its stress is at the limit all over."""
    oil = OIL.replace(limiting_shear=0.05)
    return roller_model(
        BEARING, oil, 1, tilt=0.0, laws=LIMITED.but(heating=False, asperities="none")
    )


def slip_along(contact, z, slip, ring_speed):
    """Slip [m/s] at stations z [m], and the contour's drop there [m]."""
    shape = contact.shape
    drop = z**2 / (2 * shape.contour_radius)
    rate = ring_speed * shape.curvature_ratio - slip / RADIUS
    return slip + rate * drop - ring_speed * shape.spin_ratio * z, drop


def constant_friction(contact, load, slip, ring_speed):
    """The same by hand: µ p over the stations of a Hertz contact; power, force, moment/r, skew, |v| largest and mean."""
    across = contact.interface.hertz.semi_axis_across * load ** (1 / 3)
    z = (np.arange(200000) + 0.5) / 100000 * across - across
    v, drop = slip_along(contact, z, slip, ring_speed)
    carried = 0.75 * load / across * (1 - (z / across) ** 2) * (z[1] - z[0])
    pull = 0.05 * carried * np.sign(v)
    mean = (carried * np.abs(v)).sum() / load
    return (
        (pull * v).sum(),
        pull.sum(),
        (pull * (1 - drop / RADIUS)).sum(),
        (pull * z).sum(),
        np.abs(v).max(),
        mean,
    )


class Film:
    """Traction of a contact's film of a given thickness at 50 kN."""

    def __init__(self, contact, thickness, ring_speed):
        self._patch, self._chords = patch_of(contact), chord_table(contact.fluid)
        self._state = 5e4, thickness
        self._ring_speed = ring_speed

    def __call__(self, slip):
        """Pull and lag [N], and skew moment [N m]."""
        state = *self._state, 0.0, self._ring_speed, slip
        return patch_tractions(self._patch, self._chords, *state)[:3]

    def power(self, slip):
        return patch_power(self._patch, self._chords, *self._state, self._ring_speed, slip)

    def still(self):
        """Slip without a moment on the roller."""
        return brentq(lambda slip: self(slip)[0] - self(slip)[1], -0.02, 0.02, xtol=1e-12)


@pytest.mark.parametrize(
    ("ring", "power", "fastest", "mean"),
    [("inner", 8.7, 23e-3, 3.5e-3), ("outer", 7.1, 19e-3, 2.9e-3)],
)
def test_a_loaded_contact_dissipates_what_constant_friction_does(
    coulomb, ring, power, fastest, mean
):
    contact = getattr(coulomb.laws, ring)
    ring_speed = -RATED * coulomb.orbit_ratio * coulomb.outer_radius
    film = Film(contact, 1e-11, ring_speed)
    still = film.still()
    spent, skew = film.power(still), film(still)[2]
    assert spent == pytest.approx(power, rel=0.03)
    assert abs(skew) == pytest.approx(17.0, rel=0.03)
    hand = brentq(
        lambda s: constant_friction(contact, 5e4, s, ring_speed)[2], -0.02, 0.02, xtol=1e-12
    )
    exact = constant_friction(contact, 5e4, hand, ring_speed)
    # A patch has its axis tilted to the positive side.
    assert (spent, skew) == pytest.approx(
        (exact[0], math.copysign(1.0, contact.shape.spin_ratio) * exact[3]), rel=5e-3
    )
    assert still == pytest.approx(hand, rel=0.02)
    assert exact[4] == pytest.approx(fastest, rel=0.03) and exact[5] == pytest.approx(
        mean, rel=0.03
    )
    # Where both raceways share one slip the sizes hardly change.
    both = brentq(
        lambda s: sum(
            constant_friction(c, 5e4, s, ring_speed)[2]
            for c in (coulomb.laws.inner, coulomb.laws.outer)
        ),
        -0.02,
        0.02,
    )
    assert constant_friction(contact, 5e4, both, ring_speed)[0] == pytest.approx(power, rel=0.03)


# --- Balances and symmetries of whole runs ----------------------------------------------------------------------------


@pytest.fixture(scope="module")
def gusty():
    return HubLoads.bundled("14B").window(30.0, 45.0)


@pytest.fixture(scope="module")
def blown(gusty):
    return simulate(
        Case(
            loads=gusty,
            laws=FULL,
            rollers=[0, 9, 20],
            traces=Traces(step=0.01),
            window=Window(start=30.0),
        )
    )


def test_energies_add_up(blown):
    energy = blown.energy
    assert (blown.status == Status.COMPLETED).all() and blown.attrs[
        "model"
    ] == "physical, but rolling none"
    assert (energy >= 0.0).all() and float(energy.sum()) > 1.0
    total = blown.mechanism_energy.sum("mechanism")
    assert total.values == pytest.approx(energy.values, rel=1e-9, abs=1e-12)
    stations = blown.station_energy
    assert (stations >= 0.0).all()
    raceways = energy.sel(interface=["inner", "outer"]).values
    assert stations.sum("station").values == pytest.approx(raceways, rel=1e-9, abs=1e-12)
    assert (blown.asperity_energy <= energy * (1 + 1e-9) + 1e-12).all() and (
        blown.asperity_energy >= 0.0
    ).all()
    # The cage contact has no curvature and no spin.
    assert (
        blown.mechanism_energy.sel(interface="cage", mechanism=["curvature", "contact angle"])
        == 0.0
    ).all()


def test_energy_is_the_integral_of_the_power_traced(blown):
    traced = blown.power.integrate("time")
    energy = blown.energy
    assert (blown.power >= 0.0).all()
    # Loads have corners every sample; 10 ms see most of them.
    assert traced.sum("interface").values == pytest.approx(energy.sum("interface").values, rel=5e-3)


def test_traces_stay_within_the_laws(blown):
    load = blown.roller_load
    for ring in ("inner", "outer"):
        # Body forces of up to 40 N come on top of the load; asperities may take part at 0.1.
        assert (abs(blown.traction.sel(interface=ring)) <= 0.1 * (load + 40.0)).all()
        skew = abs(blown.skew_moment.sel(raceway=ring))
        assert (skew <= 0.05 * (load + 40.0) * 0.053).all()
    assert (blown.film_thickness.where(blown.film_thickness.notnull(), 1e-6) > 1e-8).all()


def test_net_skew_moment_of_a_held_roller_is_the_small_difference_of_its_raceways():
    """Traction that drives the spin acts along +x' at the inner raceway and along −x' at the outer one.

    So the moments have opposite signs, and the net one is smaller than either.
    """
    loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.1, 8.0)
    case = Case(loads=loads, rollers=[0], laws=FULL, traces=Traces(step=0.02, start=3.0))
    result = simulate(case).isel(roller=0).sel(row="downwind")
    at = result.isel(time=int(result.roller_load.argmax("time")))
    model = roller_model(BEARING, OIL, 1, tilt=case.drivetrain.tilt, laws=FULL)
    load, slip = float(at.roller_load), float(at.slip)
    ring_speed = float(at.spin_pure) * model.radius
    along_x = 0.0
    for contact, sign in ((model.laws.inner, 1.0), (model.laws.outer, -1.0)):
        # Body forces of some tens of newtons beside the load are left out.
        _, _, skew, _ = tractions(
            contact, *(np.array([number]) for number in (load, ring_speed, slip))
        )
        # A patch has its axis tilted to the positive side.
        along_x += sign * math.copysign(1.0, contact.shape.spin_ratio) * float(skew[0])
    inner, outer = at.skew_moment.values
    # As a sum of like signs it would be larger than either.
    assert abs(along_x) < min(abs(inner), abs(outer))
    assert inner * outer < 0.0
    assert inner + outer == pytest.approx(along_x, abs=0.02 * abs(inner))


def test_microslip_needs_a_load(blown):
    """Rows' energies go with what their rollers carry."""
    ratio = blown.energy.sum(["roller", "interface"])
    assert float(ratio.sel(row="downwind")) > 20.0 * float(ratio.sel(row="upwind"))
    assert (blown.quadrature_error.sel(row="downwind") < 2e-3).all()


def test_mirror_at_the_vertical_plane():
    force = np.array([40e3, -343e3, 60e3])
    ahead = run(
        BearingLoads.constant(force, 2.1, 5.0), rollers=[0], integrator=Radau(tolerance=1e-6)
    )
    back = run(
        BearingLoads.constant(force * [-1, 1, 1], -2.1, 5.0),
        rollers=[0],
        integrator=Radau(tolerance=1e-6),
    )
    # Roller 0 of the downwind row starts at the bottom, on the plane itself.
    for name in ("energy", "mechanism_energy", "asperity_energy", "station_energy"):
        here, there = (x[name].sel(row="downwind").values for x in (ahead, back))
        assert there == pytest.approx(here, rel=1e-5, abs=1e-6 * float(ahead.energy.max())), name


def test_reversed_thrust_swaps_the_rows():
    """Without weight and under thrust alone all rollers of the pressed row are alike, and the rows mirror images."""
    settings = {
        "gravity": False,
        "drag": False,
        "rollers": [0, 5],
        "drivetrain": Drivetrain(tilt=0.0),
    }
    push = run(BearingLoads.constant([0.0, 0.0, 300e3], 2.1, 4.0), **settings)
    pull = run(BearingLoads.constant([0.0, 0.0, -300e3], 2.1, 4.0), **settings)
    for name in ("energy", "mechanism_energy"):
        here, there = push[name].sel(row="downwind"), pull[name].sel(row="upwind")
        assert there.values == pytest.approx(here.values, rel=1e-6, abs=1e-9)
    here, there = (
        push.station_energy.sel(row="downwind").values,
        pull.station_energy.sel(row="upwind").values,
    )
    assert there[..., ::-1] == pytest.approx(here, rel=1e-6, abs=1e-9)
    # The end at which curvature and contact angle add up is the other one in the other row.
    assert not np.allclose(there, here, rtol=0.1)
    assert push.energy.sel(row="downwind").values[0] == pytest.approx(
        push.energy.sel(row="downwind").values[1], rel=1e-6
    )


def test_no_load_no_friction():
    nothing = BearingLoads.constant([0.0, 0.0, 0.0], 2.1, 3.0)
    result = run(nothing, gravity=False, drag=False)
    # Centrifugal force alone presses the roller outward.
    assert (result.energy.sel(interface="inner") == 0.0).all() and float(result.energy.max()) < 1e-2


# --- Each mechanism alone ---------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def steady():
    return BearingLoads.constant([0.0, -343e3, 50e3], RATED, 7.0)


@pytest.fixture(scope="module")
def energies(steady):
    """Summed energies [J] by interface, and the largest power, of the downwind row by changes of the paper's model."""
    known = {}

    def of(laws):
        if laws not in known:
            result = run(steady, laws, rollers=[0, 14]).sel(row="downwind")
            assert (result.status == Status.COMPLETED).all()
            known[laws] = result
        return known[laws]

    return of


def total(result, interface=None):
    energy = result.energy if interface is None else result.energy.sel(interface=interface)
    return float(energy.sum())


@pytest.mark.parametrize("base", [PAPER, FULL], ids=["paper", "physical"])
def test_starved_and_heated_inlets_thin_the_film_and_raise_friction(energies, steady, base):
    def trace_of(laws, **supply):
        return run(steady, laws, rollers=[0], traces=Traces(step=1.0), **supply).sel(row="downwind")

    def film(laws, **supply):
        return trace_of(laws, **supply).film_thickness.sel(interface="inner")

    starved, fed = base.but(starvation=True), base.but(starvation=False)
    heated, cool = base.but(inlet_heating=True), base.but(inlet_heating=False)
    loaded = film(base).notnull()
    assert loaded.any()
    # The inlet begins to be full at one gap for all loads.
    gap = Case(loads=steady, laws=starved, oil_supply=0.7).oil.oil_gap
    full, thin = film(fed), film(starved, oil_supply=0.7)
    assert 0.69 < float((thin / full).max()) < 0.72
    # Where the load is small the roller slips more, and entrainment is less.
    thinner = film_factor(gap / thin) * full
    assert ((thin < 1.0001 * thinner) | ~loaded).all()
    pressed = trace_of(base).roller_load > 5e3
    assert pressed.any() and ((thin > 0.999 * thinner) | ~pressed).all()
    assert ((film(heated) < film(cool)) | ~loaded).all() and (
        (film(heated) > 0.95 * film(cool)) | ~loaded
    ).all()
    short = run(steady, starved, rollers=[0, 14], oil_supply=0.7).sel(row="downwind")
    assert total(short, "inner") > total(energies(fed), "inner")


def test_asperities_alone_add_friction(energies):
    assert float(energies(FULL.but(asperities="none")).asperity_energy.sum()) == 0.0
    with_, without = energies(FULL), energies(FULL.but(asperities="none"))
    assert total(with_) > total(without)
    alone = energies(PAPER.but(asperities="masjedi-khonsari"))
    assert float(alone.asperity_energy.sum()) > 0.0
    assert total(alone) == pytest.approx(total(energies(PAPER)), rel=0.1)


def test_contact_angle_and_curvature_share_the_friction(energies):
    energy = energies(FULL).mechanism_energy.sum("roller").sel(interface="inner")
    sliding, curvature, angle = energy.values
    assert curvature > 0.0 and angle > 0.0 and abs(sliding) < 0.05 * (curvature + angle)


# --- The cage ---------------------------------------------------------------------------------------------------------


def test_a_floating_roller_leaves_no_heat_in_the_ellipse_of_its_cage_contact():
    """The oil of the pocket is sheared over all of it; without rolling resistance metal touches, and there is a flash."""
    loads = BearingLoads.constant([-20.3e3, -343.5e3, 164.4e3], shaft_speed=2.143, duration=14.0)
    floating, dry = (
        simulate(Case(loads=loads, rollers=[0], laws=Laws.physical().but(rolling=rolling)))
        for rolling in ("whole-film", "none")
    )
    for name in ("flash_temperature", "power_density"):
        largest = floating[name].max(("roller", "orbit"))
        # The film of the pocket, tens of micrometres thick, leaves less in the small ellipse than a loaded raceway has.
        assert float(largest.sel(interface="cage").max()) < 0.1 * float(
            largest.sel(interface="inner").max()
        )
        assert float(largest.sel(interface=["inner", "outer"]).min()) > 0.0
        assert float(dry[name].sel(interface="cage").min()) > 0.0


def test_the_largest_power_per_area_at_the_cage_is_that_of_its_contact():
    """From the traces, by the contact's law: what the pocket's oil takes, and corrections of slip, are no part of it."""
    # Long enough for tables, and the extremes from a run without traces, whose steps and corrections of slip are larger.
    loads = HubLoads.bundled("14B").window(0.0, 130.0)
    case = Case(loads=loads, laws=Laws.physical(), rollers=[0], window=Window(start=8.0))
    extremes = simulate(case).power_density.sel(interface="cage").isel(roller=0)
    result = simulate(replace(case, traces=Traces(step=0.01)))
    cage = roller_model(
        BEARING, case.oil, 1, tilt=math.radians(5.0), laws=Laws.physical()
    ).laws.cage
    hertz = cage.interface.hertz
    area = 2.0 * hertz.semi_axis_across * hertz.semi_axis_along
    for row in result.row.values:
        trace = result.sel(row=row).isel(roller=0)
        pushes, surfaces = np.abs(trace.cage_force.values), RADIUS * trace.spin.values
        pressed = pushes > 0.0
        thickness = cage.film_thickness(pushes[pressed], 0.5 * np.abs(surfaces[pressed]))
        power = np.abs(surfaces[pressed]) * cage.uniform_traction(
            pushes[pressed], thickness, np.abs(surfaces[pressed])
        )
        density = np.zeros(pushes.size)
        density[pressed] = 0.75 * power / (area * pushes[pressed] ** (2.0 / 3.0))
        for orbit in range(result.sizes["orbit"]):
            inside = (result.time >= result.orbit_start[orbit]) & (
                result.time <= result.orbit_end[orbit]
            )
            largest = float(extremes.sel(row=row)[orbit])
            # Contacts are looked at every ten degrees.
            assert 0.7 < largest / density[inside.values].max() < 1.02
