"""Load files of every format with random damage, in the command that shows them."""

import io
import itertools
import os
import re
from pathlib import Path

import pyarrow.csv
import pyarrow.parquet
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.loads import HubLoads
from tests.fuzz.mutations import damaged
from tests.fuzz.oracle import ends_well, examples
from tests.loads import test_bladed, test_hawc2

DATA = Path(__file__).parents[1] / "data"
BEARING = "time_s,shaft_speed_rpm,F_X0_kN,F_Y0_kN,F_Z0_kN\n0,20,0,-300,80\n1,20,0,-310,80\n2,20,0,-300,80\n"
HUB = "time_s,rotor_speed_rpm,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm\n0,20,1e5,0,-2e5,7e5,1e5,1e4\n1,20,1e5,0,-2e5,7e5,1e5,1e4\n"
#: Of each kind of file: the files that belong together, and the one that a user names.
KINDS = {
    "out": (["run.out"], "run.out"),
    "outb": (["run.outb"], "run.outb"),
    "bladed text": (["demo.%23", "demo.$23", "demo.%05", "demo.$05"], "demo.%23"),
    "bladed binary": (["demo.%23", "demo.$23", "demo.%05", "demo.$05"], "demo.$23"),
    "hawc2 text": (["run.sel", "run.dat"], "run.sel"),
    "hawc2 binary": (["run.sel", "run.dat"], "run.sel"),
    "gtsdf": (["run.hdf5"], "run.hdf5"),
    "hub table": (["run.csv"], "run.csv"),
    "bearing table": (["run.csv"], "run.csv"),
    "parquet": (["run.parquet"], "run.parquet"),
}
_BINARY = re.compile(r"\.(outb|\$\d+|dat|hdf5|parquet)$")


def _write(kind, folder):
    """A small valid file of a kind."""
    whole = HubLoads.read(DATA / "sample14B.outb")
    short = HubLoads(
        whole.time[:30], whole.shaft_speed[:30], whole.force[:30], whole.moment[:30], "short"
    )
    if kind == "out":
        lines = (DATA / "sample14B.out").read_bytes().splitlines(keepends=True)
        (folder / "run.out").write_bytes(b"".join(lines[:40]))
    elif kind == "outb":
        (folder / "run.outb").write_bytes((DATA / "sample14B.outb").read_bytes())
    elif kind.startswith("bladed"):
        test_bladed._run(folder, short, "F" if kind.endswith("text") else "U")
    elif kind.startswith("hawc2"):
        test_hawc2._write_sel(folder, test_hawc2._channels(short), binary=kind.endswith("binary"))
    elif kind == "gtsdf":
        test_hawc2._write_gtsdf(folder, test_hawc2._channels(short), packed=True)
    elif kind == "parquet":
        table = pyarrow.csv.read_csv(io.BytesIO(HUB.encode()))
        pyarrow.parquet.write_table(table, folder / "run.parquet")
    else:
        (folder / "run.csv").write_text(HUB if kind == "hub table" else BEARING)


@pytest.fixture(scope="module", params=KINDS)
def files(request, tmp_path_factory):
    """Folder, content of each file by name, and the file to name in the command."""
    folder = tmp_path_factory.mktemp("loads")
    _write(request.param, folder)
    names, named = KINDS[request.param]
    return folder, {name: (folder / name).read_bytes() for name in names}, folder / named


def _inspect(folder, named):
    return ends_well(folder, named, "loads", "inspect", named, "--json")


@pytest.mark.slow
@examples(10)
@given(data=st.data())
def test_damaged(files, data):
    folder, contents, named = files
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    name = data.draw(st.sampled_from(list(contents)))
    content = data.draw(damaged(contents[name], binary=bool(_BINARY.search(name))))
    (folder / name).write_bytes(content)
    _inspect(folder, named)


def test_undamaged_is_accepted(files):
    folder, contents, named = files
    for name, content in contents.items():
        (folder / name).write_bytes(content)
    assert _inspect(folder, named) == ""


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
@pytest.mark.parametrize("put", ["pipe", "folder", "nothing", "empty"])
@pytest.mark.timeout(30)
def test_something_else_in_place_of_a_file(files, put):
    folder, contents, named = files
    for name in contents:
        for other, content in contents.items():
            (folder / other).write_bytes(content)
        (folder / name).unlink()
        if put == "pipe":
            os.mkfifo(folder / name)
        elif put == "folder":
            (folder / name).mkdir()
        elif put == "empty":
            (folder / name).touch()
        try:
            assert _inspect(folder, named) != ""
        finally:
            (folder / name).rmdir() if put == "folder" else (folder / name).unlink(missing_ok=True)


@pytest.mark.deep
def test_prefixes(files):
    folder, contents, named = files
    name = named.name
    for other, content in contents.items():
        (folder / other).write_bytes(content)
    for length in itertools.chain(
        range(1, 60, 3), range(60, len(contents[name]), max(1, len(contents[name]) // 10))
    ):
        (folder / name).write_bytes(contents[name][:length])
        _inspect(folder, named)
    (folder / name).write_bytes(contents[name])
    assert _inspect(folder, named) == ""
