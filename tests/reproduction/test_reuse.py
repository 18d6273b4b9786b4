"""Parts of an earlier run: used again only where nothing they depend on has changed and every byte is as written."""

import json

import numpy as np
import pytest
import xarray as xr

from macroslip.reproduction import reuse as module
from macroslip.reproduction.reuse import FOLDER, LIST, Reuse, key_of


@pytest.fixture
def data():
    return xr.Dataset(
        {"energy": (("row", "time"), np.array([[1.0, np.nan], [3.0, 0.1]]), {"units": "J"})},
        {"row": ["downwind", "upwind"], "time": ("time", [0.0, 0.5], {"units": "s"})},
        {"energy_J": 0.25, "text": "ä <b>"},
    )


@pytest.fixture
def run(tmp_path, data):
    """One run into the folder `results`, which replaces what stands there; gives what was reused and what it gave."""

    def one(inputs="the same", computed=None):
        folder = tmp_path / "new"
        folder.mkdir()
        reuse = Reuse(tmp_path / "results", folder)
        calls = []

        def compute():
            calls.append(1)
            return {"a table": data if computed is None else computed, "another": data * 2.0}

        found = reuse.part("part", inputs, compute)
        if (tmp_path / "results").exists():
            (tmp_path / "results").rename(tmp_path / f"old{len(list(tmp_path.iterdir()))}")
        folder.rename(tmp_path / "results")
        assert reuse.reused == ([] if calls else ["part"])
        return bool(calls), found

    return one


def test_a_second_run_reads_exactly_what_the_first_computed(run, data):
    assert run()[0]
    computed, found = run()
    assert not computed
    xr.testing.assert_identical(found["a table"], data)
    assert list(found) == ["a table", "another"]
    assert not run()[0], "what was read is stored again for the next run"


def test_other_inputs_are_computed(run):
    run()
    assert run("others")[0]


def test_another_program_computes(run, monkeypatch):
    run()
    monkeypatch.setattr(module, "_program_hash", lambda: "another")
    assert run()[0]


def test_the_key_depends_on_every_source_that_can_change_a_result(tmp_path, monkeypatch):
    for name in ("study", "report"):
        (tmp_path / name).mkdir()
    path = tmp_path / "study" / "reuse.py"
    path.write_text("")
    (tmp_path / "report" / "page.py").write_text("")
    monkeypatch.setattr(module, "__file__", str(path))

    def key():
        module._program_hash.cache_clear()
        return key_of("inputs")

    try:
        first = key()
        (tmp_path / "report" / "page.py").write_text("other words")
        assert key() == first
        (tmp_path / "study" / "kernel.py").write_text("another kernel")
        assert key() != first
    finally:
        module._program_hash.cache_clear()


@pytest.mark.parametrize("fault", ["flipped", "cut", "gone", "list", "list of another kind", "entry"])
def test_whatever_is_not_as_written_is_computed_again(run, tmp_path, fault, data):
    run()
    folder = tmp_path / "results" / FOLDER
    file, listed = folder / "part-0.nc", folder / LIST
    content = bytearray(file.read_bytes())
    if fault == "flipped":
        content[len(content) // 2] ^= 1
        file.write_bytes(content)
    elif fault == "cut":
        file.write_bytes(content[:-1])
    elif fault == "gone":
        file.unlink()
    elif fault == "list":
        listed.write_text(listed.read_text()[:-5])
    elif fault == "list of another kind":
        listed.write_text("[1]")
    else:
        entry = json.loads(listed.read_text())
        entry["part"]["files"] = [{"file": "part-0.nc"}]
        listed.write_text(json.dumps(entry))
    computed, found = run()
    assert computed
    xr.testing.assert_identical(found["a table"], data)


def test_a_list_that_names_other_files_leads_nowhere_else(run, tmp_path):
    run()
    listed = tmp_path / "results" / FOLDER / LIST
    (tmp_path / "elsewhere.nc").write_bytes((tmp_path / "results" / FOLDER / "part-1.nc").read_bytes())
    entry = json.loads(listed.read_text())
    entry["part"]["files"][0] |= {"file": "../../elsewhere.nc", "sha256": entry["part"]["files"][1]["sha256"]}
    listed.write_text(json.dumps(entry))
    assert run()[0]
