"""One process at a time in a folder."""

import os
import subprocess
import sys

import pytest

from macroslip import InputError
from macroslip.study.lock import locked

pytestmark = pytest.mark.slow

HOLD = (
    "import sys; from pathlib import Path; from macroslip.study.lock import locked\n"
    "with locked(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read()"
)


@pytest.fixture
def holder(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.communicate()


def test_a_second_process_is_refused_and_told_who_holds_it(tmp_path, holder):
    with (
        pytest.raises(InputError, match=f"another process is at work in this folder .process {holder.pid} on "),
        locked(tmp_path),
    ):
        pass


def test_the_lock_ends_with_its_process(tmp_path, holder):
    holder.kill()
    holder.wait()
    assert (tmp_path / "lock").read_text() != ""  # what it left behind holds nothing
    with locked(tmp_path):
        assert f'"process": {os.getpid()}' in (tmp_path / "lock").read_text()


def test_a_lock_file_with_anything_in_it_is_no_lock(tmp_path):
    (tmp_path / "lock").write_text('{"process": 1}')
    with locked(tmp_path), pytest.raises(InputError, match="another process"), locked(tmp_path):
        pass
    with locked(tmp_path):
        pass
