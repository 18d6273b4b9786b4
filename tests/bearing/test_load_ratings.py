"""Load ratings against the standards' theory and a maker's catalogue."""

import csv
import math
from pathlib import Path

import pytest

from macroslip.bearing.load_ratings import (
    dynamic_load_rating,
    fatigue_load_limit,
    geometry_factor,
    static_load_rating,
)
from macroslip.errors import InputError

LINES = (
    (Path(__file__).parents[1] / "data" / "srb_catalogue.csv")
    .read_text(encoding="utf-8")
    .splitlines()
)
CATALOGUE = list(csv.DictReader(line for line in LINES if not line.startswith("#")))


def test_the_table_is_lundberg_and_palmgrens_theory_rounded():
    # Load integrals, the strength of a line contact and both rings together give every f_c but for its last digit.
    for hundredths in range(1, 31):
        gamma = hundredths / 100
        ratio = 1.04 * ((1 - gamma) / (1 + gamma)) ** (143 / 108)
        theory = 207.9 * 0.83 * gamma ** (2 / 9) * (1 - gamma) ** (29 / 27) / (1 + gamma) ** 0.25
        theory *= (1 + ratio**4.5) ** (-2 / 9)
        assert geometry_factor(gamma) == pytest.approx(theory, abs=0.0501)


def test_the_tables_printed_values():
    printed = [52.1, 60.8, 66.5, 70.7, 74.1, 76.9, 79.2, 81.2, 82.8, 84.2]
    assert [geometry_factor((k + 1) / 100) for k in range(10)] == printed
    assert geometry_factor(0.30) == 83.8
    assert geometry_factor(0.105) == pytest.approx(0.5 * (84.2 + 85.4), abs=1e-12)
    for outside in (0.005, 0.31, math.nan):
        with pytest.raises(InputError, match="Allowed: 0.01 to 0.30"):
            geometry_factor(outside)


def test_scaling_of_the_ratings():
    # A bearing twice as large in all directions: C0 grows with the square, C with 7/9 + 29/27 of it.
    small = (2, 28, 0.070, 0.106, 0.195, 0.745)
    large = (2, 28, 0.140, 0.212, 0.195, 1.490)
    assert static_load_rating(*large) / static_load_rating(*small) == pytest.approx(4.0, rel=1e-14)
    assert dynamic_load_rating(*large) / dynamic_load_rating(*small) == pytest.approx(
        2 ** (7 / 9 + 29 / 27), rel=1e-14
    )
    # Two rows carry twice the static load, 2^(7/9) the dynamic one.
    single = (1, *small[1:])
    assert static_load_rating(*small) / static_load_rating(*single) == pytest.approx(2.0, rel=1e-14)
    assert dynamic_load_rating(*small) / dynamic_load_rating(*single) == pytest.approx(
        2 ** (7 / 9), rel=1e-14
    )


def test_the_fatigue_load_limit_is_what_a_maker_publishes():
    # The pitch is taken as the mean of bore and outside; published limits lie 0.8 to 1.1 of the simplified formula.
    ratios = {}
    for row in CATALOGUE:
        pitch = 5e-4 * (float(row["d_mm"]) + float(row["D_mm"]))
        ratio = float(row["Pu_kN"]) * 1e3 / fatigue_load_limit(float(row["C0_kN"]) * 1e3, pitch)
        ratios.setdefault(row["designation"][:3] + row["variant"][:2], []).append(ratio)
    assert len(CATALOGUE) == 108 and all(
        0.85 < ratio < 1.15 for family in ratios.values() for ratio in family
    )
    assert all(0.99 < ratio < 1.03 for ratio in ratios["240BC"])
    assert (
        fatigue_load_limit(8.2e5, 0.05)
        == fatigue_load_limit(8.2e5, 0.1)
        == pytest.approx(1e5, rel=1e-14)
    )
