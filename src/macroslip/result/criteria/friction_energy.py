"""Criteria of friction energy, pressure times slip, compared with a test for white etching cracks."""

from __future__ import annotations

from macroslip.constants import YEAR
from macroslip.damage import friction_energy
from macroslip.result.criteria.criterion import (
    OF_YEAR,
    Criterion,
    PageColumn,
    Values,
    Yearly,
    largest_of,
)
from macroslip.result.criteria.evaluation import Evaluation
from macroslip.variables import ALWAYS, Variable

_TEST = friction_energy.ThrustTest()
#: Least and largest e_a of the FE8 test [W/m²], with the logarithmic profile and with even load, and
#: their mean, with which friction energy is compared.
LEAST_POWER, LARGEST_POWER = _TEST.range()
REFERENCE_POWER = 0.5 * (LEAST_POWER + LARGEST_POWER)
_OVER = ("row", "surface", "station")


def _rates(evaluation: Evaluation) -> Values:
    return {
        "pass_rate": evaluation.pass_rates(),
        "pressure_slip_rate": evaluation.profile("surface_work"),
        "friction_power": evaluation.profile("surface_energy"),
    }


def _of_a_year(evaluation: Evaluation) -> Values:
    if not evaluation.tells_of_year:
        return {}
    return {"pressure_slip_year": YEAR * evaluation.profile("surface_work")}


CRITERIA = (
    Criterion(
        order=20,
        name="friction_energy_rate",
        mechanism="friction energy",
        quantity="e_a, mean of p |v|",
        unit="W/m2",
        declares=(
            Variable(
                "pass_rate",
                ("surface",),
                "1/s",
                ALWAYS,
                "passes over a place that is loaded all round",
            ),
            Variable("pressure_slip_rate", _OVER, "W/m2", ALWAYS, "mean of p |v| over time, e_a"),
            Variable(
                "friction_power", _OVER, "W/m2", ALWAYS, "frictional power per area, mean over time"
            ),
        ),
        variables=_rates,
        value=largest_of("pressure_slip_rate"),
        reference=REFERENCE_POWER,
        reference_range=(LEAST_POWER, LARGEST_POWER),
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
                design_column=PageColumn("friction energy / FE8 test"),
                year_column=PageColumn("p |v| [MJ/mm²]", 1e-12),
            ),
        ),
    ),
    Criterion(
        order=21,
        name="friction_energy_year",
        mechanism="friction energy",
        quantity="p |v| over such a year",
        unit="J/m2",
        declares=(
            Variable("pressure_slip_year", _OVER, "J/m2", OF_YEAR, "p |v| over a year like this"),
        ),
        variables=_of_a_year,
        value=largest_of("pressure_slip_year"),
        reference=_TEST.duration * REFERENCE_POWER,
        reference_range=(_TEST.duration * LEAST_POWER, _TEST.duration * LARGEST_POWER),
        compared_with="FE8 test 81212, 20 h",
        in_answer=False,
        factor=1.3,
        reason="crown of washers",
    ),
)
