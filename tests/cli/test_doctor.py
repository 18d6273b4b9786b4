"""`macroslip doctor`: what it shows is what is there."""

import json
import platform

import macroslip as package


def test_versions_kernels_and_commands(macroslip):
    done = macroslip("doctor", "--json")
    assert (done.code, done.err) == (0, "")
    found = json.loads(done.out)
    assert found["version"] == package.__version__ and found["machine"]["python"] == platform.python_version()
    assert found["machine"]["cores"] >= 1
    numba = next(one for one in found["packages"] if one["package"] == "numba")
    assert numba["installed"] and numba["wanted"].startswith(">=")
    assert all(one["missing"] == [] for one in found["commands"])


def test_a_folder_of_kernels_of_ones_own(macroslip, tmp_path, monkeypatch):
    (tmp_path / "a.nbc").write_bytes(bytes(2_000_000))
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    kernels = json.loads(macroslip("doctor", "--json").out)["kernels"]
    assert kernels == {"folder": str(tmp_path), "files": 1, "megabytes": 2.0, "writable": True}


def test_the_same_for_people(macroslip):
    out = macroslip("doctor").out
    for word in (f"macroslip {package.__version__}", "numba", "kernels", "macroslip reproduce", "ready"):
        assert word in out
