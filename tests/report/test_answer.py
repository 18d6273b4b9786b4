"""The sentences that open a page: every number in them is the result's own, for results of every kind."""

import re

import numpy as np
import pytest
import xarray as xr

from macroslip import BearingLoads, Case, HubLoads, Laws, Traces, simulate
from macroslip.measures.along import FILM_EDGES, SLIP_EDGES
from macroslip.report.answer import RowSlip, answer, row_sentence
from macroslip.result.damage import lines
from macroslip.result.orbit import in_window
from macroslip.result.rating import with_rating
from tests.quick import COARSE


def traced(spin, load, *, failed=0):
    """A result of one row of rollers over 5 samples, whose shaft turns at one speed but hardly at the end."""
    spin, load = np.atleast_2d(spin), np.atleast_2d(load)
    rolling = np.broadcast_to([10.0, 10.0, 10.0, 10.0, 0.5], spin.shape)
    status = np.zeros((1, len(spin)), dtype=int)
    status[0, :failed] = 1
    over = ("row", "roller", "time")
    return xr.Dataset(
        {
            "spin": (over, spin[None] * rolling[None]),
            "spin_pure": (over, rolling[None]),
            "roller_load": (over, load[None]),
            "min_spin_ratio": (over[:2], spin[None, :, :4].min(axis=-1)),
            "status": (over[:2], status),
        },
        {"row": ["upwind"], "time": np.arange(5.0)},
        {"window_start": 0.0, "window_end": 4.0},
    )


def test_a_row_with_a_load_zone():
    # Half of the time under load at .99 and 1.01 of rolling, else at .4 and .2; the shaft that hardly turns does not count.
    result = traced([0.99, 1.01, 0.4, 0.2, 0.0], [1.0, 1.0, 0.0, 0.0, 1.0])
    assert answer(result) == [
        "Upwind row: loaded 60 % of the time; loaded rollers turn at rolling speed (0 % below it in the "
        "mean), between load zones they slow down to 20 % of it."
    ]


def test_a_row_that_is_always_loaded_and_slips():
    result = traced([0.9, 0.9, 0.94, 0.9, 1.0], np.ones(5))
    assert answer(result) == [
        "Upwind row: loaded all the time; its rollers turn 9 % below rolling speed in the mean."
    ]


def test_a_row_without_load_skids_or_does_not():
    skids = traced([[0.1] * 5, [0.3] * 5], np.zeros((2, 5)))
    (sentence,) = answer(skids)
    assert (
        sentence
        == "Upwind row: never loaded; its rollers turn at 10 to 30 % of rolling speed: it skids."
    )
    follows = traced(np.full(5, 0.999), np.zeros(5))
    assert answer(follows) == [
        "Upwind row: never loaded; its rollers turn at 100 % of rolling speed."
    ]


def test_rollers_that_turn_backwards():
    result = traced([1.0, 1.0, -0.1, 0.2, 1.0], [1.0, 1.0, 0.0, 0.0, 0.0])
    assert "between load zones they even turn backwards, at up to 10 % of it" in answer(result)[0]
    bare = result.drop_dims("time")
    assert answer(bare) == [
        "Upwind row: its slowest roller turns backwards, at up to 10 % of rolling speed."
    ]


def test_a_roller_that_is_slowest_under_load_does_not_slow_down_between_load_zones():
    result = traced([0.5, 1.5, 0.9, 0.8, 1.0], [1.0, 1.0, 0.0, 0.0, 0.0])
    assert "between load zones they slow down to 80 % of it" in answer(result)[0]


def test_traces_of_a_part_say_so():
    result = traced(np.ones(5), np.ones(5)).assign_attrs(window_end=600.0)
    assert answer(result)[0].endswith(" (speeds in the 4 s that are traced).")


def test_failed_rollers_come_first():
    result = traced(np.ones((2, 5)), np.ones((2, 5)), failed=1)
    assert answer(result)[0] == "1 of 2 rollers FAILED; every mean they enter is missing."


def test_a_share_just_below_all_of_the_time_is_not_rounded_to_it():
    assert "loaded 99.7 % of the time" in row_sentence(RowSlip("downwind", 0.9968, 0.9, None, None))
    assert "loaded 0.068 % of" in row_sentence(RowSlip("downwind", 0.000685, 0.9, None, None))


def with_films(result, share_mixed, least):
    time = np.zeros((1, 2, len(FILM_EDGES) + 1, len(SLIP_EDGES) + 1))
    time[..., -1, 3] = 10.0
    time[0, 1, -1, 3] = 10.0 * (1.0 - share_mixed)
    time[0, 1, 0, 3] = 10.0 * share_mixed
    names = ["inner", "outer"]
    return result.assign(
        film_slip_time=(("row", "raceway", "film_class", "slip_class"), time),
        min_film_ratio=(("row", "roller", "orbit", "interface"), [[[[least, least, 0.1]]]]),
    ).assign_coords(raceway=names, interface=[*names, "cage"])


def test_films_full_and_mixed():
    result = traced(np.ones(5), np.ones(5))
    full = answer(with_films(result, 0.0, 3.7))
    assert (
        full[-1]
        == "Loaded contacts run on a full film (Λ above 3, 3.7 at least in complete orbits)."
    )
    mixed = answer(with_films(result, 0.25, 0.3))
    assert mixed[-1] == (
        "At the outer raceway films are mixed (Λ below 3) for 25 % of the loaded time, and at least 0.3 in "
        "complete orbits."
    )


def criterion(title, value, reference, factor, *, is_time=False, in_answer=True):
    ratio = reference / value if is_time else value / reference
    mechanism, quantity = title.split(": ")
    return {"mechanism": mechanism, "quantity": quantity, "in answer": in_answer, "value": value, "reference": reference, "ratio": ratio,
            "factor": factor, "compared with": "a rig"}  # fmt: skip


def test_the_criterion_furthest_beyond_its_reference_and_all_others_beyond_theirs():
    result = traced(np.ones(5), np.ones(5))
    slip = criterion("smearing: slip", 1.0, 0.05, 3.0)
    year = criterion("friction energy: a year", 2.0, 1.0, 1.3)
    wear = criterion("wear: time", 100.0, 20.0, 10.0, is_time=True)
    unknown = criterion("smearing: power", 1.0, np.nan, 3.0)
    assert answer(result, [unknown, wear, year, slip])[-1] == (
        "Furthest beyond its reference is smearing, slip: 20 times the reference (a rig), known to a factor of 3, "
        "so beyond it in any case; also beyond: friction energy, a year (2 times the reference)."
    )
    assert answer(result, [wear])[-1] == (
        "Nearest to its reference is wear, time: the reference is 0.2 of it (a rig), known to a factor of 10, "
        "so not distinguishable from it."
    )
    assert answer(result, [unknown]) == answer(result)
    # A sum over a year beside a test of hours is left to the table.
    other = criterion("friction energy: a year", 90.0, 1.0, 1.3, in_answer=False)
    assert answer(result, [wear, other]) == answer(result, [wear])


def numbers_in(sentence):
    return [float(number) for number in re.findall(r"-?\d+\.?\d*(?:e-\d+)?", sentence)]


def check(result):
    """Compare the sentences on the rows with the dataset, counted here in another way; returns them."""
    criteria, _ = lines(result)
    sentences = answer(result, criteria)
    assert 1 <= len(sentences) <= 5
    window = in_window(result)
    for row, sentence in zip(result.row.values, sentences, strict=False):
        of_row = window.sel(row=row)
        load, rolling = of_row.roller_load.values, abs(of_row.spin_pure.values)
        known = np.isfinite(load)
        turns = (rolling > 0.0) & (rolling >= 0.1 * rolling.max())
        ratio = of_row.spin.values[turns & known] / of_row.spin_pure.values[turns & known]
        pressed = load[turns & known] > 0.0
        told = numbers_in(sentence)
        loaded = float(result.loaded_share.sel(row=row))
        if "never loaded" in sentence:
            assert loaded == 0.0
        elif "loaded all the time" in sentence:
            assert loaded > 0.9995
        else:
            assert told.pop(0) == pytest.approx(100.0 * loaded, rel=0.05)
        if "% of rolling speed" in sentence:
            low, high = np.quantile(ratio[~pressed], [0.05, 0.95])
            assert told[0] == pytest.approx(100.0 * low, rel=0.05, abs=0.1)
            assert told[-1] == pytest.approx(100.0 * high, rel=0.05, abs=0.1)
            assert ("skids" in sentence) == (high < 0.9)
        elif "in the mean" in sentence:
            sign = 1.0 if "below" in sentence else -1.0
            assert sign * told.pop(0) == pytest.approx(
                100.0 - 100.0 * ratio[pressed].mean(), rel=0.5, abs=0.5
            )
            if told:
                assert told[0] == pytest.approx(100.0 * abs(ratio[~pressed].min()), rel=0.05)
    return sentences


def computed(loads, **options):
    case = Case(
        loads=loads,
        traces=Traces(step=0.05),
        integrator=COARSE,
        **{"rollers": [0, 14]} | options,
    )
    return with_rating(simulate(case), case)


@pytest.mark.slow
def test_an_idling_turbine():
    sentences = check(computed(HubLoads.bundled("idle-6").window(0.0, 20.0)))
    assert sentences[0].startswith("Downwind row: ") and sentences[1].startswith("Upwind row: ")


@pytest.mark.slow
def test_a_shaft_at_standstill():
    result = computed(BearingLoads.constant([0.0, -340e3, 100e3], 0.0, 5.0))
    assert all("stands still" in sentence for sentence in check(result)[:2])


@pytest.mark.slow
@pytest.mark.parametrize("duration", [14.0, 3.0])
def test_one_orbit_or_less(duration):
    result = computed(BearingLoads.constant([0.0, -340e3, 100e3], 2.143, duration))
    assert result.sizes["orbit"] == (duration == 14.0)
    sentences = check(result)
    assert sentences[0].startswith("Downwind row: loaded ")
    films = [sentence for sentence in sentences if "Λ" in sentence]
    if films and not result.sizes["orbit"]:
        assert "complete orbits" not in films[0]


@pytest.mark.slow
def test_rollers_under_the_papers_model_have_no_films_to_tell_of():
    case = {"laws": Laws.paper()}
    assert len(check(computed(HubLoads.bundled("14B").window(0.0, 12.0), **case))) == 2
