"""The rating of a bearing: hand calculations, exact limits, and balance of what goes in."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from macroslip import Bearing, BearingLoads, Lubricant
from macroslip.errors import InputError
from macroslip.rating import rate, roller_load_history
from macroslip.rating.iso import reference_viscosity

SPEED = 2.0
OIL = Lubricant.read("vg460-pao")


@pytest.fixture(scope="module")
def bearing():
    return Bearing.read("skf-240-600-bc")


def rated(bearing, force, speed=SPEED, **options):
    loads = BearingLoads.constant(force, speed, 4.0)
    return rate(bearing, OIL, *roller_load_history(bearing, OIL, loads), **options)


def test_a_constant_load_by_hand(bearing):
    rating = rated(bearing, [0.0, -400e3, 60e3])
    values = {name: variable.item() for name, variable in rating.items() if not variable.dims}
    p = 400e3 + 2.3 * 60e3
    hours = 2 * math.pi / SPEED / 3600
    assert values["equivalent_load"] == pytest.approx(p, rel=1e-12)
    assert values["static_safety"] == pytest.approx(16300e3 / (400e3 + 2.2 * 60e3), rel=1e-12)
    assert values["basic_life"] == pytest.approx(1e6 * (8502e3 / p) ** (10 / 3) * hours, rel=1e-12)
    kappa = 0.54 / 900 / reference_viscosity(SPEED, 0.7454)
    assert values["viscosity_ratio"] == pytest.approx(kappa, rel=1e-12)
    bracket = 1 - (1.5859 - 1.2348 / 4**0.071739) * (0.5 * 1100e3 / p) ** 0.4
    assert kappa > 4 and values["life_modification"] == pytest.approx(
        min(50.0, 0.1 * bracket**-9.185), rel=1e-9
    )
    assert values["modified_life"] == pytest.approx(
        values["basic_life"] * values["life_modification"], rel=1e-12
    )
    assert (
        values["minimum_load"],
        values["share_below_minimum_load"],
        values["share_below_fatigue_load_limit"],
    ) == (
        163e3,
        0.0,
        1.0,
    )
    assert rating.damage_equivalent_load.values.tolist() == [[0.0, 0.0]] * 3


def test_every_variable_has_unit_and_name(bearing):
    rating = rated(bearing, [0.0, -400e3, 60e3])
    for name, variable in rating.variables.items():
        if name not in ("row", "raceway", "load_along_roller", "load", "wohler_exponent"):
            assert variable.attrs["units"] and variable.attrs["long_name"], name
            assert np.isfinite(variable).all() or name.startswith("film_ratio"), name


def test_rows_and_rings_together_give_the_life_of_the_bearing(bearing):
    rating = rated(bearing, [0.0, -800e3, 60e3])
    # Under a constant load Weibull's product law holds for the mean too, but for the rollers' passing.
    parts = rating.raceway_reference_life
    together = (parts ** (-9 / 8)).sum(["row", "raceway"]) ** (-8 / 9)
    np.testing.assert_allclose(together, rating.reference_life, rtol=1e-3)
    # The row that carries the thrust is worn more, and its inner ring first.
    assert (parts.sel(row="downwind") < parts.sel(row="upwind")).all()
    assert (parts.sel(raceway="inner") < parts.sel(raceway="outer")).all()


def test_reference_life_falls_with_the_fourth_power_of_the_load(bearing):
    # In proportion on all rollers: the same zone at twice the load.
    loads = BearingLoads.constant([0.0, -400e3, 60e3], SPEED, 4.0)
    finer, load = roller_load_history(bearing, OIL, loads)
    once, twice = rate(bearing, OIL, finer, load), rate(bearing, OIL, finer, 2.0 * load)
    ratio = once.reference_life / twice.reference_life
    assert ratio.sel(load_along_roller="uniform").item() == pytest.approx(16.0, rel=1e-9)
    # Load per length grows as Q^(2/3) on a length that grows as Q^(1/3): damage as 2^(10/3), life as its power 8/9.
    assert ratio.sel(load_along_roller="hertz").item() == pytest.approx(2 ** (80 / 27), rel=3e-3)
    assert twice.largest_pressure.values == pytest.approx(
        once.largest_pressure.values * 2 ** (1 / 3), rel=1e-12
    )


def test_mirrored_loads_give_mirrored_rows(bearing):
    # Thrust turned round and rows staggered by half a pitch: rows change places but for where their rollers stand.
    there, back = (rated(bearing, [0.0, -500e3, sign * 80e3]) for sign in (1, -1))
    for name in ("largest_roller_load", "largest_pressure"):
        np.testing.assert_allclose(there[name].values, back[name].values[::-1], rtol=0.02)
    assert (
        there.equivalent_load == back.equivalent_load and there.static_safety == back.static_safety
    )


def test_largest_pressure_is_hertz(bearing):
    rating = rated(bearing, [0.0, -500e3, 0.0])
    load = float(rating.largest_roller_load.max())
    # The textbook form with complete elliptic integrals of m = 1 - (b/a)^2, which the program does not use: Johnson,
    # Contact Mechanics (1985), equations (4.28) to (4.31).
    along = 1 / 0.035 + math.cos(bearing.contact_angle) / (
        0.3727 - 0.035 * math.cos(bearing.contact_angle)
    )
    across = (1 - 0.98) / (0.98 * 0.4149)

    def mismatch(ratio):
        m = 1 - ratio**2
        return (ellipe(m) / ratio**2 - ellipk(m)) / (ellipk(m) - ellipe(m)) - along / across

    ratio = brentq(mismatch, 1e-3, 0.5)
    m = 1 - ratio**2
    modulus = 210e9 / (2 * (1 - 0.3**2))
    # Curvature across: 1/R = 2 p0/E* (b/a^2) [K - E]/e^2, with p0 = 3Q/(2 pi a b), so that a^3 follows.
    semi_axis = (3 * load * (ellipk(m) - ellipe(m)) / (math.pi * modulus * across * m)) ** (1 / 3)
    pressure = 1.5 * load / (math.pi * semi_axis**2 * ratio)
    assert rating.largest_pressure.sel(raceway="inner").max().item() == pytest.approx(
        pressure, rel=1e-6
    )


def test_spectra_balance(bearing):
    rng = np.random.default_rng(3)
    time = np.arange(0.0, 20.0, 0.05)
    force = np.column_stack(
        [
            rng.normal(0, 5e4, time.size),
            rng.normal(-4e5, 5e4, time.size),
            rng.normal(5e4, 5e4, time.size),
        ]
    )
    loads = BearingLoads(time, np.linspace(1.0, 2.0, time.size), force, "noise")
    rating = rate(bearing, OIL, *roller_load_history(bearing, OIL, loads))
    np.testing.assert_allclose(rating.time_share.sum("load_class"), 1.0, rtol=1e-12)
    np.testing.assert_allclose(rating.revolution_share.sum("load_class"), 1.0, rtol=1e-12)
    assert (rating.damage_equivalent_load > 0).all()
    # A steeper line weighs the largest cycles more.
    assert (np.diff(rating.damage_equivalent_load, axis=-1) > 0).all()
    # Loads at higher speed count for more revolutions: the shares differ.
    assert not np.allclose(rating.time_share, rating.revolution_share)


def test_a_shaft_that_stands_has_no_life_but_a_safety(bearing):
    rating = rated(bearing, [0.0, -400e3, 60e3], speed=0.0)
    assert rating.static_safety > 0 and np.isfinite(rating.largest_pressure).all()
    for name in (
        "equivalent_load",
        "basic_life",
        "modified_life",
        "viscosity_ratio",
        "life_modification",
    ):
        assert np.isnan(rating[name]), name
    assert np.isnan(rating.reference_life).all() and np.isnan(rating.film_ratio).all()


def test_a_bearing_without_load(bearing):
    rating = rated(bearing, [0.0, 0.0, 0.0])
    assert (
        math.isinf(rating.static_safety)
        and math.isinf(rating.basic_life)
        and np.isinf(rating.reference_life).all()
    )
    assert (rating.share_below_minimum_load, rating.largest_pressure.max()) == (1.0, 0.0)
    assert rating.loaded_share.values.tolist() == [0.0, 0.0]
    # Under thrust alone one row carries all round, and the other nothing.
    assert rated(bearing, [0.0, 0.0, 60e3]).loaded_share.values.tolist() == [1.0, 0.0]


def test_speed_without_direction(bearing):
    there, back = (rated(bearing, [0.0, -400e3, 60e3], speed=sign * SPEED) for sign in (1, -1))
    assert there.basic_life == back.basic_life and there.viscosity_ratio == back.viscosity_ratio
    np.testing.assert_allclose(there.reference_life, back.reference_life, rtol=1e-2)


def test_published_fatigue_limit_or_the_standards(bearing):
    own = rated(bearing.replace(fatigue_load_limit=None), [0.0, -400e3, 0.0])
    assert own.fatigue_load_limit.item() == pytest.approx(
        16300e3 / 8.2 * (100 / 745.4) ** 0.3, rel=1e-12
    )
    assert rated(bearing, [0.0, -400e3, 0.0]).fatigue_load_limit == 1100e3


def test_wrong_input(bearing):
    loads = BearingLoads.constant([0.0, -4e5, 0.0], SPEED, 1.0)
    finer, load = roller_load_history(bearing, OIL, loads)
    with pytest.raises(InputError, match=r"roller_load has the shape \(28, 21\).*\(2, 28, 21\)"):
        rate(bearing, OIL, finer, load[0])
    with pytest.raises(InputError, match="negative or not finite"):
        rate(bearing, OIL, finer, -load)
    for contamination in (0.0, 1.1, math.nan):
        with pytest.raises(InputError, match="the contamination factor is"):
            rate(bearing, OIL, finer, load, contamination=contamination)
    with pytest.raises(InputError, match="it has no dynamic_load_rating, which the rating needs"):
        rate(bearing.replace(dynamic_load_rating=None), OIL, finer, load)
