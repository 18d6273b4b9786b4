"""Studies of tapered roller bearings: keys of their own are varied as those of others."""

from pathlib import Path

import numpy as np
import pytest

from macroslip import InputError, compare, open_study, run_study
from macroslip.bearing.kinds import read_bearing
from macroslip.study.settings import Setting, replaced
from macroslip.study.study_file import study_of
from tests.quick import COARSE

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
    bearing = replaced(
        read_bearing("tdo-main-bearing"), [setting.checked() for setting in settings]
    )
    assert (bearing.preload, bearing.rib_oil_supply) == (1e-4, 0.2)
    assert bearing.provenance["preload"].tag == "U"


def test_a_value_that_no_bearing_has_is_refused():
    with pytest.raises(InputError, match=r"bearing\.prelode"):
        Setting("bearing.prelode", 0.1, "mm").checked()


def test_bearings_with_one_row_and_with_two_are_no_study():
    cylindrical = Path(__file__).parents[2] / "validation" / "data" / "cylindrical-160.yaml"
    with pytest.raises(InputError, match="bearings with as many rows as each other"):
        study_of(
            {
                "loads": {"bundled": ["14B"]},
                "case": CASE,
                "bearings": ["tdo-main-bearing", str(cylindrical)],
            }
        )


@pytest.mark.slow
def test_a_spherical_and_a_tapered_bearing_are_designs_of_one_study(tmp_path):
    """Two bearings of two rows on one drivetrain: numbers that one of them lacks are missing there."""
    study = study_of(
        {
            "loads": {"bundled": ["14B"]},
            "case": CASE
            | {
                "loads": {"start": "100 s", "end": "103 s"},
                "drivetrain": {"mount": "three-point", "gearbox_stiffness": "100 MN/m"},
                "rollers": [0],
                "integrator": {"tolerance": COARSE.tolerance},
            },
            "bearings": ["skf-240-600-bc", "tdo-main-bearing"],
        }
    )
    ended = run_study(study, tmp_path / "out")
    assert (ended.progress.computed, ended.progress.failed) == (2, 0)
    stored = open_study(tmp_path / "out")
    ribs = stored.rib_energy.sum(("row", "roller")).values
    assert np.isnan(ribs[0]) or ribs[0] == 0.0
    assert ribs[1] > 0.0
    compared = compare(stored, by="bearing")
    assert {"skf-240-600-bc", "tdo-main-bearing"} <= set(compared.design)
    assert any("ribs, rolling resistance" in note for note in compared.attrs["notes"])
