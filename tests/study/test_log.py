"""The log: lines with times, nothing that steers a terminal, and no obstacle on a full disk."""

import re
from pathlib import Path

import pytest

from macroslip.study.log import Log


def test_lines_are_stamped_and_added_to_what_is_there(tmp_path):
    for text in ("first\nbelow 100 % \x1b[2J", "second"):
        log = Log(tmp_path / "log.txt")
        log.write(text)
        assert text.split("\n")[0] in (tmp_path / "log.txt").read_text(encoding="utf-8")  # before it is closed
        log.close()
    first, below, second = (tmp_path / "log.txt").read_text(encoding="utf-8").splitlines()
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ first", first)
    assert below == r"    below 100 % \x1b[2J" and second.endswith("Z second")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="this system has no device that is always full")
def test_a_full_disk_is_left_to_what_stores_results(capsys):
    log = Log(Path("/dev/full"))
    log.write("lost")
    log.close()
    assert capsys.readouterr() == ("", "")
