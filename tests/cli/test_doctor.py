"""`macroslip doctor`: what it shows is what is there."""

import json
import platform
import shutil
import threading

import macroslip as package
from macroslip.cli import doctor


def test_versions_kernels_and_commands(macroslip):
    done = macroslip("doctor", "--json")
    assert (done.code, done.err) == (0, "")
    printed = json.loads(done.out)
    assert (
        printed["version"] == package.__version__
        and printed["machine"]["python"] == platform.python_version()
    )
    assert printed["machine"]["cores"] >= 1
    numba = next(package for package in printed["packages"] if package["package"] == "numba")
    assert numba["installed"] and numba["wanted"].startswith(">=")
    assert all(command["missing"] == [] for command in printed["commands"])


def test_what_the_folder_of_kernels_holds(macroslip, tmp_path, monkeypatch):
    from macroslip.storage import cache

    # A folder of the test's own: other processes may be compiling into the one in use.
    (tmp_path / "part").mkdir()
    (tmp_path / "part" / "a.nbc").write_bytes(bytes(2_000_000))
    monkeypatch.setattr(cache, "cache_folder", lambda: tmp_path)
    caches = json.loads(macroslip("doctor", "--json").out)["caches"]
    assert caches == {"folder": str(tmp_path), "files": 1, "megabytes": 2.0}


def test_no_folder_for_kernels_is_said(macroslip, monkeypatch):
    from macroslip.storage import cache

    monkeypatch.setattr(cache, "cache_folder", lambda: None)
    assert "NO FOLDER CAN BE WRITTEN" in macroslip("doctor").out


def test_the_same_for_people(macroslip):
    out = macroslip("doctor").out
    for word in (
        f"macroslip {package.__version__}",
        "numba",
        "caches",
        "macroslip report",
        "ready",
    ):
        assert word in out


def test_files_that_go_meanwhile_are_left_out(tmp_path):
    """Another process removes its folder of kernels when it ends."""
    (tmp_path / "stays").write_bytes(bytes(10))
    ended = threading.Event()

    def come_and_go():
        while not ended.is_set():
            for number in range(20):
                folder = tmp_path / f"process-{number}"
                folder.mkdir()
                (folder / "kernel").write_bytes(bytes(3))
            for number in range(20):
                shutil.rmtree(tmp_path / f"process-{number}")

    other = threading.Thread(target=come_and_go)
    other.start()
    try:
        listed = [doctor.sizes_of_files(tmp_path) for _ in range(300)]
    finally:
        ended.set()
        other.join()
    assert all(10 in sizes for sizes in listed)
    assert {size for sizes in listed for size in sizes} <= {0, 3, 10}
