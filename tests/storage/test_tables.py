"""Stored tables: found again, made again where they are not what was written, and never in the way."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, Laws, Lubricant
from macroslip.contact.laws import prepare
from macroslip.contact.look_up import TRACTION
from macroslip.contact.table import Tables, table_box, write_traction
from macroslip.storage import cache
from macroslip.storage import tables as store


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty store on the disk, and no tables in memory."""
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    forget(monkeypatch)
    return cache.cache_folder()


class Maker:
    def __init__(self):
        self.count = 0

    def __call__(self):
        self.count += 1
        return [np.arange(1000.0), np.ones((2, 3), dtype=np.bool_)]


def forget(monkeypatch):
    monkeypatch.setattr(store, "_in_memory", store.LRUCache(1e9, getsizeof=store._size))


def test_a_table_is_found_on_the_disk(folder, monkeypatch):
    make = Maker()
    made = store.stored("ab12", make)
    forget(monkeypatch)
    stored = store.stored("ab12", make)
    assert make.count == 1 and len(stored) == 2
    for array, other in zip(stored, made, strict=True):
        np.testing.assert_array_equal(array, other)
        assert (
            array.dtype == other.dtype and not array.flags.writeable and not other.flags.writeable
        )


@pytest.mark.parametrize(
    "damage", [lambda c: c[:-1], lambda c: c[:500] + b"x" + c[501:], lambda c: b""]
)
def test_a_damaged_file_is_made_again(folder, monkeypatch, damage):
    make = Maker()
    store.stored("ab12", make)
    path = folder / "ab12.cache"
    path.write_bytes(damage(path.read_bytes()))
    forget(monkeypatch)
    store.stored("ab12", make)
    forget(monkeypatch)
    store.stored("ab12", make)
    assert make.count == 2


def test_files_that_were_exchanged_are_made_again(folder, monkeypatch):
    make = Maker()
    for key in ("ab12", "cd34"):
        store.stored(key, make)
    first, other = folder / "ab12.cache", folder / "cd34.cache"
    first.rename(folder / "aside")
    other.rename(first)
    (folder / "aside").rename(other)
    forget(monkeypatch)
    for key in ("ab12", "cd34"):
        store.stored(key, make)
    assert make.count == 4


@pytest.mark.slow
def test_processes_that_write_one_table_find_it_whole(folder):
    code = (
        "import time, numpy as np\nfrom macroslip.storage import tables as store\n"
        "made = store.stored('ab12', lambda: (time.sleep(0.2), [np.arange(1e5)])[1])\n"
        "print(int(made[0].sum()))"
    )
    started = [
        subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE) for _ in range(4)
    ]
    assert {process.communicate(timeout=60)[0] for process in started} == {b"4999950000\n"}
    assert [path.name for path in folder.glob("*.cache")] == ["ab12.cache"]
    assert store._arrays(cache.read_cache("ab12"))[0].size == 10**5


def test_a_place_that_is_no_folder_leaves_tables_in_memory(tmp_path, monkeypatch):
    forget(monkeypatch)
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file"))
    make = Maker()
    for _ in range(2):
        assert store.stored("cd34", make)[0].size == 1000
    assert make.count == 1


def test_without_a_home_folder_nothing_is_written(tmp_path, monkeypatch):
    forget(monkeypatch)
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(cache, "user_cache_path", lambda *_, **__: Path("~/.cache/macroslip"))
    monkeypatch.setattr(cache.tempfile, "gettempdir", lambda: str(tmp_path / "temporary"))
    (tmp_path / "temporary").mkdir()
    own = cache.cache_folder()
    assert own.parent == tmp_path / "temporary" and own.stat().st_mode & 0o077 == 0
    assert store.stored("ab78", Maker())[0].size == 1000
    own.chmod(0o770)  # others might put programs into it
    assert cache.cache_folder() is None
    assert store.stored("ab79", Maker())[0].size == 1000
    assert [path.name for path in tmp_path.iterdir()] == ["temporary"]
    assert [path.name for path in own.iterdir()] == ["ab78.cache"]


@pytest.mark.parametrize("kind", ["pipe", "folder"])
@pytest.mark.timeout(60)
def test_what_is_no_file_under_the_name_of_a_table_is_passed_by(folder, kind):
    path = folder / "ab12.cache"
    os.mkfifo(path) if kind == "pipe" else path.mkdir()
    assert store.stored("ab12", Maker())[0].size == 1000


def test_threads_make_a_table_once(folder):
    make = Maker()
    threads = [threading.Thread(target=store.stored, args=("ef56", make)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert make.count == 1


def test_the_store_is_bounded(folder, monkeypatch):
    monkeypatch.setattr(cache, "_MOST_BYTES", 30_000)
    for number in range(8):
        store.stored(f"{number:04}", Maker())
    files = list(folder.glob("*.cache"))
    assert 1 <= len(files) <= 3 and sum(path.stat().st_size for path in files) <= 30_000


def test_what_a_process_uses_until_it_ends_is_not_removed_for_tables(folder, monkeypatch):
    """The archive of kernels is read once, as a process begins, and then by the next one."""
    monkeypatch.setattr(cache, "_MOST_BYTES", 30_000)
    monkeypatch.setattr(cache, "_in_use", {"kernels"})
    cache.write_cache("kernels", bytes(10_000))
    os.utime(folder / "kernels.cache", (0, 0))
    for number in range(8):
        store.stored(f"{number:04}", Maker())
    assert cache.read_cache("kernels") == bytes(10_000)
    assert sum(path.stat().st_size for path in folder.glob("*.cache")) <= 30_000


def test_keys_differ_with_any_value():
    contacts = prepare(
        Laws.physical(), Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1
    )
    key = store.table_key(contacts.inner.fluid, 1.0, np.arange(3.0))
    assert key == store.table_key(contacts.inner.fluid, 1.0, np.arange(3.0))
    others = [
        (contacts.inner.fluid, 1.0 + 1e-15, np.arange(3.0)),
        (contacts.inner.fluid, 1.0, np.arange(3)),
        (contacts.inner.fluid, 1.0, np.arange(3.0).reshape(3, 1)),
        (contacts.inner.fluid._replace(heating=0.0), 1.0, np.arange(3.0)),
        (contacts.inner.interface.hertz, 1.0, np.arange(3.0)),
    ]
    assert len({key, *(store.table_key(*parts) for parts in others)}) == 6


def test_a_damaged_table_of_a_contact_is_made_again(folder, monkeypatch):
    """A sheet of a raceway's traction, cut in the middle: the table is the same, and the file is whole again."""
    box = table_box(np.array([-0.41, -0.40]), 1e3, 2e-4)._replace(fineness=2.0)
    contact = prepare(
        Laws.physical(), Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1
    ).inner

    def made():
        forget(monkeypatch)
        record, tables = np.zeros(1, TRACTION), Tables()
        write_traction(record[0], tables, contact, box)
        return tables.flat()

    first = made()
    # Not the oil's table of stresses, which a process makes once.
    sheets = [path for path in folder.glob("*.cache") if path.stat().st_size < 500_000]
    assert len(sheets) >= 5
    sizes = [path.stat().st_size for path in sheets]
    for path, size in zip(sheets, sizes, strict=True):
        path.write_bytes(path.read_bytes()[: size // 2])
    np.testing.assert_array_equal(made(), first)
    assert [path.stat().st_size for path in sheets] == sizes


def test_cases_share_their_sheets(folder, monkeypatch):
    slower, faster = (
        table_box(np.array(speeds), 1e3, 2e-4)._replace(fineness=2.0)
        for speeds in ([-0.41, -0.3], [-0.43, -0.35])
    )
    contact = prepare(
        Laws.physical(), Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"), 1
    ).inner
    forget(monkeypatch)
    counts = []
    for box in (slower, faster):
        write_traction(np.zeros(1, TRACTION)[0], Tables(), contact, box)
        counts.append(len(list(folder.glob("*.cache"))))
    assert counts[1] - counts[0] < 4
