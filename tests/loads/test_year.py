"""The bundled cases of a year: what each holds, and that what is assumed of an event is said wherever it is used."""

import numpy as np
import pyarrow.parquet as pq
import pytest

from macroslip import Case, HubLoads
from macroslip.errors import InputError
from macroslip.loads import bundled_cases, main_bearing_load
from macroslip.loads.bundled import ASSUMED, EVENTS, bundled_case
from macroslip.loads.statics import Drivetrain
from macroslip.study.loads_list import load_list

NEW = [name for name in bundled_cases("year") if name not in bundled_cases()]
RPM = np.pi / 30.0


def test_the_paper_keeps_its_21_and_a_year_has_all():
    assert len(bundled_cases()) == 21 and len(NEW) == 25
    assert bundled_cases("year")[:21] == bundled_cases()
    assert set(EVENTS) == set(RECORDED) < set(NEW)
    with pytest.raises(InputError, match="there is no set of bundled cases 'month'"):
        bundled_cases("month")


@pytest.mark.parametrize("name", NEW)
def test_every_new_case_is_whole(name):
    known, loads = bundled_case(name), HubLoads.bundled(name)
    assert np.array_equal(loads.time, np.arange(loads.time.size) / 20)
    metadata = {
        key.decode(): text.decode() for key, text in pq.read_schema(known.path).metadata.items()
    }
    assert metadata["case"] == name and "OpenFAST v3.5.5" in metadata["source"]
    # The weight of the rotor, 26 886 kg on a shaft tilted by 5 degrees, is in every load.
    assert loads.force[:, 2].mean() == pytest.approx(-262.65e3, rel=0.07)
    assert loads.event == bool(known.event) == (ASSUMED in loads.source) == ("control" in metadata)
    if not known.event:
        wind = pq.read_table(known.path)["wind_mps"].to_numpy()
        assert loads.time.size == 12000
        assert wind.mean() == pytest.approx(known.wind_speed, abs=0.3)
        intensity = {"A": 0.16, "B": 0.14}[known.turbulence]
        # The spectrum has slow gusts that ten minutes of a calm wind do not sample.
        assert wind.std() == pytest.approx(intensity * (0.75 * wind.mean() + 5.6), rel=0.2)


#: Mean and largest shaft speed [rpm] and mean thrust [kN] of the source records at 50 Hz.
RECORDED = {
    "start-8": (12.40, 19.58, 127.0), "start-14": (15.74, 21.50, 116.5), "stop-14": (6.75, 20.82, 59.5),
    "stop-24": (6.59, 21.56, 46.1), "estop-20": (7.48, 22.37, 57.0), "gridloss-14": (6.98, 21.71, 56.1),
    "idle-6": (0.14, 0.32, 22.9), "idle-25": (0.58, 1.15, 26.2), "parked-12": (0.0, 0.0, 23.3),
    "eog-14": (20.47, 22.89, 159.4), "ecd-14": (15.22, 22.47, 102.1), "yaw20-14": (20.37, 21.79, 177.5),
}  # fmt: skip


@pytest.mark.parametrize(("name", "recorded"), RECORDED.items())
def test_thinned_events_have_the_statistics_of_their_records(name, recorded):
    loads = HubLoads.bundled(name)
    speed = loads.shaft_speed / RPM
    statistics = speed.mean(), speed.max(), loads.force[:, 0].mean() / 1e3
    # Samples at the ends weigh more at 20 Hz, and a stop has other loads at one end than at the other.
    assert statistics == pytest.approx(recorded, rel=3e-3, abs=0.02)


@pytest.mark.parametrize("name", [name for name in NEW if name.endswith("-2") and "B" in name])
def test_second_seeds_are_other_winds_of_the_same_kind(name):
    first, two = HubLoads.bundled(name.removesuffix("-2")), HubLoads.bundled(name)
    assert two.force[:, 2].mean() == pytest.approx(first.force[:, 2].mean(), rel=0.01)
    # Thrust follows slow gusts, of which ten minutes hold few; the tilting moment is renewed in every turn.
    assert abs(np.corrcoef(first.moment[:, 1], two.moment[:, 1])[0, 1]) < 0.15


def test_an_event_says_that_its_supervisor_is_assumed_wherever_it_goes():
    hub = HubLoads.bundled("stop-14")
    bearing = main_bearing_load(hub.window(30.0, 60.0), Drivetrain())
    assert (
        bearing.event
        and ASSUMED in bearing.source
        and ASSUMED in repr(hub)
        and ASSUMED in hub._repr_html_()
    )
    case = Case(loads=hub)
    assert ASSUMED in repr(case) and "window at the first sample" in repr(case)
    assert (
        case.as_dict()["loads"]["event"] is True
        and "event" not in Case(loads=HubLoads.bundled("14B")).as_dict()["loads"]
    )


def test_labels_in_a_study():
    labels = {
        load.name: load.fields for load in load_list(None, kind="hub", bundled=["year"]).loads
    }
    assert list(labels) == bundled_cases("year")
    assert labels["8B-2"] == {"wind_speed": 8.0, "turbulence": "B", "seed": 2, "event": ""}
    assert labels["eog-14"] == {"wind_speed": 14.0, "turbulence": "-", "seed": 1, "event": "eog-14"}
    assert load_list(None, kind="hub", bundled=["14B"]).loads[0].fields == {
        "wind_speed": 14.0,
        "turbulence": "B",
    }
