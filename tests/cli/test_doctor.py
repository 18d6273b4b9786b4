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


def test_the_folder_of_kernels_is_the_one_in_use(macroslip):
    from macroslip.kernel_cache import kernel_folder

    kernels = json.loads(macroslip("doctor", "--json").out)["kernels"]
    assert kernels["folder"] == str(kernel_folder())
    sizes = [path.stat().st_size for path in kernel_folder().rglob("*") if path.is_file()]
    assert (kernels["files"], kernels["megabytes"]) == (len(sizes), sum(sizes) / 1e6)


def test_no_folder_for_kernels_is_said(macroslip, monkeypatch):
    from macroslip import kernel_cache

    monkeypatch.setattr(kernel_cache, "kernel_folder", lambda laws="": None)
    assert "NO FOLDER CAN BE WRITTEN" in macroslip("doctor").out


def test_the_same_for_people(macroslip):
    out = macroslip("doctor").out
    for word in (f"macroslip {package.__version__}", "numba", "kernels", "macroslip reproduce", "ready"):
        assert word in out
