"""Values in place of the base case's."""

import pytest

from macroslip import InputError, Lubricant
from macroslip.input.files import Place, Source
from macroslip.study.build import template
from macroslip.study.settings import Setting, replaced


def check(key, value, unit=""):
    Setting(key, value, unit).check(Place(Source("study.yaml")))


@pytest.mark.parametrize(
    ("key", "value", "unit"),
    [
        ("bearing.diametral_clearance", 0.2, "mm"), ("bearing.rollers_per_row", 27, ""), ("drivetrain.tilt", 4, "deg"),
        ("forces.drag", False, ""), ("integrator.tolerance", 1e-4, ""), ("integrator.step", 1.0, "ms"),
        ("laws.film", "masjedi-khonsari", ""), ("window.start", "auto", ""), ("traces", "none", ""),
        ("rollers", [0, 1], ""), ("lubricant.at", 50, "degC"),
    ],
)  # fmt: skip
def test_what_a_case_file_takes_is_taken(key, value, unit):
    check(key, value, unit)


@pytest.mark.parametrize(
    ("key", "value", "unit", "message"),
    [
        ("bearing.diametral_clearence", 0.2, "mm", "Did you mean 'bearing.diametral_clearance'"),
        ("bearing.diametral_clearance", 0.2, "", "unit"),
        ("bearing.diametral_clearance", "wide", "", "a number with its unit"),
        ("bearing.diametral_clearance", 0.2, "kg", "unit"),
        ("lubricant.at", 50, "mm", "unit"),
        ("bearing", "other", "", "its own key in a study: bearings"),
        ("loads.start", 3.0, "s", "its own key in a study: loads"),
        ("drivetrain.tlt", 4, "deg", "Did you mean 'drivetrain.tilt'"),
        ("drivetrain.tilt", 4, "", "does not give its unit"),
        ("drivetrain", 4, "", "unknown"),
        ("forces.drag", "no", "", "true or false"),
        ("forces.drag", True, "N", "without unit"),
        ("laws.film", "unheard-of", "", "does not exist"),
    ],
)
def test_what_it_does_not_take_is_refused_in_its_words(key, value, unit, message):
    with pytest.raises(InputError, match=message):
        check(key, value, unit)


def test_a_replaced_value_is_the_users_and_the_others_keep_their_origin():
    before = Lubricant.read("vg460-pao")
    key = next(key for key, origin in before.provenance.items() if origin.unit != "degC")
    entry = before.as_dict()[key]
    after = replaced(before, [Setting(f"lubricant.{key}", entry["value"] * 1.01, entry["unit"])])
    assert getattr(after, key) == pytest.approx(1.01 * getattr(before, key)) and after.provenance[key].tag == "U"
    others = {name: origin for name, origin in before.provenance.items() if name != key}
    assert {name: origin for name, origin in after.provenance.items() if name != key} == others
    assert replaced(before, [Setting("bearing.diametral_clearance", 1, "mm")]) == before


def test_settings_reach_the_case():
    settings = [
        Setting("bearing.diametral_clearance", 0.1, "mm"),
        Setting("drivetrain.tilt", 4.0, "deg"),
        Setting("integrator.tolerance", 1e-5),
        Setting("forces.drag", False),
        Setting("traces.step", 0.1, "s"),
    ]
    case, cut = template({"loads": {"end": "3 s"}, "traces": "none"}, settings, {})
    assert (case.bearing.diametral_clearance, case.drivetrain.tilt) == (1e-4, pytest.approx(0.0698, abs=1e-4))
    assert (case.integrator.tolerance, case.drag, case.traces.step, cut) == (1e-5, False, 0.1, {"end": 3.0})


def test_values_that_do_not_go_together_are_reported():
    with pytest.raises(InputError, match="rollers"):
        template({}, [Setting("bearing.rollers_per_row", 60)], {})


def test_a_lubricant_at_another_temperature_has_what_follows_from_it():
    before = Lubricant.read("vg460-pao")
    settings = [Setting("lubricant.at", 50.0, "degC"), Setting("lubricant.limiting_shear", 0.05)]
    after = replaced(before, settings)
    warm = before.at("50 degC")
    assert (after.viscosity, after.pressure_viscosity) == (warm.viscosity, warm.pressure_viscosity)
    assert after.limiting_shear == 0.05 and after.viscosity < before.viscosity
    alone = replaced(before, [Setting("lubricant.inlet_temperature", 50.0, "degC")])
    assert (alone.inlet_temperature, alone.viscosity) == (323.15, before.viscosity)
