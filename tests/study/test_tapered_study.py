"""Studies of tapered roller bearings: keys of their own are varied as those of others."""

import pytest

from macroslip import InputError
from macroslip.bearing.kinds import read_bearing
from macroslip.study.settings import Setting, replaced
from macroslip.study.study_file import study_of

CASE = {
    "bearing": "tdo-main-bearing",
    "temperature": "35 degC",
    "oil_supply": 0.7,
    "drivetrain": {"mount": "alone"},
}


def test_preload_and_temperature_difference_are_varied():
    grid = {
        "bearing.preload": {"values": [0, 0.2, 0.4], "unit": "mm"},
        "temperature_difference": {"values": [0, 5], "unit": "K"},
    }
    study = study_of({"loads": {"bundled": ["14B"]}, "case": CASE, "variations": {"grid": grid}})
    assert len(study) == 6
    labels = next(study.runs()).labels
    assert (labels["bearing.preload"], labels["temperature_difference"]) == (0, 0)


def test_values_of_a_tapered_bearing_are_replaced():
    settings = [
        Setting("bearing.preload", 0.1, "mm"),
        Setting("bearing.rib.oil_supply", 0.2, ""),
    ]
    bearing = replaced(read_bearing("tdo-main-bearing"), [one.checked() for one in settings])
    assert (bearing.preload, bearing.rib_oil_supply) == (1e-4, 0.2)
    assert bearing.provenance["preload"].tag == "U"


def test_a_value_that_no_bearing_has_is_refused():
    with pytest.raises(InputError, match=r"bearing\.prelode"):
        Setting("bearing.prelode", 0.1, "mm").checked()


def test_bearings_of_two_kinds_are_no_study():
    with pytest.raises(InputError, match="bearings of one kind"):
        study_of(
            {
                "loads": {"bundled": ["14B"]},
                "case": CASE,
                "bearings": ["tdo-main-bearing", "skf-240-600-bc"],
            }
        )
