"""The load histories themselves: what they accept, what they refuse, and with which words."""

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.errors import InputError
from macroslip.loads import BearingLoads, HubLoads, bundled_cases


def _record(n=20, **changes):
    rng = np.random.default_rng(1)
    values = {
        "time": 60 + 0.05 * np.arange(n),
        "shaft_speed": np.full(n, 2.1),
        "force": 1e5 * rng.normal(size=(n, 3)),
        "moment": 1e5 * rng.normal(size=(n, 3)),
        "source": "run 7",
    }
    return values | changes


def _replace(values, index, value):
    values = np.array(values, dtype=float)
    values[index] = value
    return values


def test_arrays_are_read_only_float64_copies():
    raw = _record(force=np.asfortranarray(np.ones((20, 3), dtype=np.float32)))
    loads = HubLoads(**raw)
    for array in (loads.time, loads.shaft_speed, loads.force, loads.moment):
        assert array.dtype == np.float64 and array.flags.c_contiguous and not array.flags.writeable
    raw["time"][0] = -99.0
    assert loads.time[0] == 60.0
    with pytest.raises(AttributeError):
        loads.time = raw["time"]
    assert pickle.loads(pickle.dumps(loads)).source == copy.deepcopy(loads).source == "run 7"


@pytest.mark.parametrize("speed", [0.0, -2.0])
def test_standstill_and_reverse_rotation_are_legal(speed):
    assert HubLoads(**_record(shaft_speed=np.full(20, speed))).shaft_speed[0] == speed


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"time": np.array([1.0]), "shaft_speed": [1.0]},
            ["time has shape (1,)", "at least 2 samples"],
        ),
        ({"time": np.zeros((20, 1))}, ["time has shape (20, 1)"]),
        ({"shaft_speed": 2.0}, ["shaft_speed has shape ()", "(20,)", "20 time stamps"]),
        ({"force": np.zeros((3, 20))}, ["force has shape (3, 20)", "(20, 3)", "fx, fy, fz"]),
        ({"moment": [["a", "b", "c"]] * 20}, ["moment does not convert", "real numbers"]),
        ({"time": _replace(_record()["time"], 3, np.nan)}, ["time is nan at sample 3"]),
        (
            {"time": _replace(_record()["time"], 4, 60.15)},
            ["sample 3 (counted from 0) is at 60.15 s, sample 4 at 60.15 s"],
        ),
        (
            {"time": _replace(_record()["time"], 9, 60.0)},
            ["sample 8 (counted from 0) is at 60.4 s, sample 9 at 60 s"],
        ),
        (
            {"time": _record()["time"] + np.where(np.arange(20) > 6, 0.4, 0)},
            ["gap of 0.45 s after t = 60.3 s", "median step 0.05 s", "start=, end="],
        ),
        (
            {"shaft_speed": _replace(_record()["shaft_speed"], 5, np.nan)},
            ["run 7, t = 60.25 s", "shaft_speed is nan"],
        ),
        (
            {"force": _replace(_record()["force"], (7, 1), -np.inf)},
            ["t = 60.35 s", "fy is -inf (1 of 20"],
        ),
        ({"moment": _replace(_record()["moment"], (19, 2), np.nan)}, ["t = 60.95 s", "mz is nan"]),
        (
            {"shaft_speed": np.full(20, 1800.0)},
            ["shaft_speed is 1800 rad/s", "up to 100 rad/s", "rpm", "generator"],
        ),
        (
            {"force": _replace(_record()["force"], (2, 2), -2.6e8)},
            ["t = 60.1 s", "fz is -2.6e+08 N", "kN"],
        ),
        (
            {"moment": _replace(_record()["moment"], (2, 0), 7e9)},
            ["mx is 7e+09 N m", "up to 1e+09 N m"],
        ),
    ],
)
def test_bad_hub_loads_are_told_apart(changes, words):
    with pytest.raises(InputError) as caught:
        HubLoads(**_record(**changes))
    for word in ["run 7", "Allowed: ", *words]:
        assert word in str(caught.value)


def test_bearing_loads_share_the_checks():
    record = _record(force=_replace(np.zeros((20, 3)), (4, 2), np.nan))
    del record["moment"]
    with pytest.raises(InputError, match=r"run 7, t = 60\.2 s: F_Z0 is nan"):
        BearingLoads(**record)


@given(st.integers(0, 17), st.integers(2, 20))
def test_window_keeps_exactly_the_samples_inside(first, length):
    loads = HubLoads(**_record())
    last = min(first + length, 19)
    part = loads.window(loads.time[first] + 1e-12, loads.time[last] - 1e-12)
    assert np.array_equal(part.time, loads.time[first : last + 1])
    assert np.array_equal(part.moment, loads.moment[first : last + 1])
    assert part.duration == pytest.approx(0.05 * (last - first))


def test_window_sides_can_be_left_open():
    loads = HubLoads(**_record())
    assert np.array_equal(loads.window(None, 60.5).time, loads.time[:11])
    assert np.array_equal(loads.window(60.5, None).force, loads.force[10:])
    bearing = BearingLoads.constant([0, -1e5, 0], 2.0, 1.0)
    assert bearing.window(0.25, 0.5).time.tolist() == pytest.approx(
        [0.25, 0.3, 0.35, 0.4, 0.45, 0.5]
    )


@pytest.mark.parametrize(
    ("start", "end"),
    [(0.0, 60.5), (60.1, 61.01), (59.94, 60.5), (60.5, 60.1), (60.4, 60.4), (np.nan, 60.5)],
)
def test_window_outside_the_record(start, end):
    with pytest.raises(InputError, match=r"run 7: the window .* 60 s to 60\.95 s"):
        HubLoads(**_record()).window(start, end)


@pytest.mark.parametrize(("start", "end"), [(None, 61.0), (59.95, None), (59.96, 60.96)])
def test_a_window_may_end_one_step_outside_the_record(start, end):
    """600 s at 20 Hz end at 599.95 s."""
    loads = HubLoads(**_record())
    assert np.array_equal(loads.window(start, end).time, loads.time)


@pytest.mark.parametrize("start", ["60 s", True])
def test_window_in_other_things_than_seconds(start):
    with pytest.raises(
        InputError, match="run 7: start is .* Allowed: a number of seconds, or None"
    ):
        HubLoads(**_record()).window(start, None)


def test_window_between_two_samples():
    with pytest.raises(InputError, match=r"holds 0 sample\(s\)"):
        HubLoads(**_record()).window(60.01, 60.04)


@given(st.floats(0.01, 1000.0), st.floats(0.01, 100.0))
def test_constant_ends_at_the_duration(duration, step):
    loads = HubLoads.constant([1, 2, 3], [4, 5, 6], -1.5, duration, step=step)
    assert loads.time[0] == 0.0 and loads.time[-1] == duration == loads.duration
    assert np.diff(loads.time).max() <= step * (1 + 1e-9)
    assert (
        (loads.force == [1, 2, 3]).all()
        and (loads.moment == [4, 5, 6]).all()
        and (loads.shaft_speed == -1.5).all()
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([1, 2], [0, 0, 0], 2.0, 1.0), "the force has shape (2,)"),
        (([1, 2, 3], 0.0, 2.0, 1.0), "the moment has shape ()"),
        (([1, 2, 3], [0, 0, 0], 2.0, 0.0), "the duration of a constant load is 0.0 s"),
        (([1, 2, 3], [0, 0, 0], np.nan, 1.0), "shaft_speed is nan"),
    ],
)
def test_bad_constant(arguments, words):
    with pytest.raises(InputError) as caught:
        HubLoads.constant(*arguments)
    assert words in str(caught.value)
    with pytest.raises(InputError, match="the step of a constant load is -1"):
        BearingLoads.constant([0, 0, 0], 1.0, 1.0, step=-1)


def test_unknown_bundled_case():
    with pytest.raises(InputError, match=r"no bundled case '14D'.* 14A, 14B, 14C, 16A"):
        HubLoads.bundled("14D")
    assert len(set(bundled_cases())) == 21


def test_import_is_cheap():
    import subprocess
    import sys

    code = (
        "import sys, macroslip.loads; "
        "print([m for m in ('pandas', 'pyarrow', 'openfast_io', 'scipy', 'numba') if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("nothing.outb", None, ["nothing.outb: no such file", "current folder"]),
        ("empty.outb", b"", ["empty.outb: the file is empty"]),
        ("empty.csv", b"", ["empty.csv: the file is empty"]),
        ("loads.xlsx", b"x", ["loads.xlsx: it is damaged"]),
        ("loads.ods", b"x", ["'.ods' is not known", ".outb (OpenFAST binary output)", ".csv"]),
    ],
)
def test_files_that_cannot_be_read(tmp_path, name, content, words):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError) as caught:
        HubLoads.read(tmp_path / name)
    for word in words:
        assert word in str(caught.value)


def test_bearing_loads_do_not_come_from_openfast(tmp_path):
    (tmp_path / "run.outb").write_bytes(b"x")
    with pytest.raises(InputError, match=r"main_bearing_load\(HubLoads\.read\(path\)"):
        BearingLoads.read(tmp_path / "run.outb")
    with pytest.raises(InputError, match="is a folder"):
        BearingLoads.read(tmp_path)
