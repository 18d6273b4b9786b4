"""Criteria of friction energy, pressure times slip, beside a test for white etching cracks."""

from __future__ import annotations

from macroslip.constants import YEAR
from macroslip.damage import friction_energy
from macroslip.result.criteria.criterion import Criterion, Variables, Yearly, largest_of
from macroslip.result.criteria.evaluation import Evaluation
from macroslip.result.variables import described

_TEST = friction_energy.ThrustTest()
#: Least and largest e_a of the FE8 test [W/m²], and their mean, with which friction energy is
#: compared.
LEAST_POWER, LARGEST_POWER = _TEST.range()
REFERENCE_POWER = 0.5 * (LEAST_POWER + LARGEST_POWER)
_OVER = ("row", "surface", "station")


def _rates(evaluation: Evaluation) -> Variables:
    return {
        "pass_rate": (
            ("surface",),
            evaluation.pass_rates(),
            described("1/s", "passes over a place that is loaded all round"),
        ),
        "pressure_slip_rate": (
            _OVER,
            evaluation.profile("surface_work"),
            described("W/m2", "mean of p |v| over time, e_a"),
        ),
        "friction_power": (
            _OVER,
            evaluation.profile("surface_energy"),
            described("W/m2", "frictional power per area, mean over time"),
        ),
    }


def _of_a_year(evaluation: Evaluation) -> Variables:
    if not evaluation.tells_of_year:
        return {}
    energy = YEAR * evaluation.profile("surface_work")
    return {"pressure_slip_year": (_OVER, energy, described("J/m2", "p |v| over a year like this"))}


CRITERIA = (
    Criterion(
        order=20,
        name="friction_energy_rate",
        mechanism="friction energy",
        quantity="e_a, mean of p |v|",
        unit="W/m2",
        variables=_rates,
        value=largest_of("pressure_slip_rate"),
        reference=REFERENCE_POWER,
        compared_with="FE8 test 81212",
        factor=1.3,
        reason="crown of washers",
        references=(friction_energy.REFERENCE,),
        yearly=(
            Yearly(
                run_name="pressure_slip_rate",
                run_unit="W/m2",
                run_meaning="mean of pressure times slip over time, e_a, at the place with most",
                of_run=lambda criteria, _: criteria.pressure_slip_rate.max(
                    ["surface", "station"], skipna=False
                ),
                name="pressure_slip",
                drawn="max",
                year_unit="J/m2",
                year_meaning="pressure times slip per area, largest place",
                unit="1",
                meaning="e_a over the FE8 test",
                mean_over=REFERENCE_POWER,
                by_factors=True,
            ),
        ),
    ),
    Criterion(
        order=21,
        name="friction_energy_year",
        mechanism="friction energy",
        quantity="p |v| of such a year",
        unit="J/m2",
        variables=_of_a_year,
        value=largest_of("pressure_slip_year"),
        reference=_TEST.duration * REFERENCE_POWER,
        compared_with="FE8 test 81212, 20 h",
        in_answer=False,
        factor=1.3,
        reason="crown of washers",
    ),
)
