"""The examples run, say something, draw one figure, and stand in the gallery."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
NUMBERED = [path for path in EXAMPLES if path.name[0].isdigit()]


@pytest.mark.slow
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_script_runs_and_says_something(path, python, script, tmp_path):
    """In an empty folder; the first one imports the package as it does for a user."""
    run = python if path == NUMBERED[0] else script
    ended = run(str(path), folder=tmp_path)
    assert ended.returncode == 0, ended.stderr
    assert 1 <= len(ended.stdout.splitlines()) <= 15
    if path in NUMBERED:
        picture = tmp_path / f"{path.stem}.png"
        assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 2000


@pytest.mark.slow
def test_the_drawings_run(script, tmp_path):
    """They go to a folder of their own, so that a run of the tests changes no file."""
    ended = script(str(ROOT / "docs" / "drawings.py"), str(tmp_path), folder=tmp_path)
    assert ended.returncode == 0, ended.stderr


def test_numbers_run_from_one_without_a_gap():
    numbers = [int(path.name[:2]) for path in NUMBERED]
    assert numbers == list(range(1, len(numbers) + 1)) and len(numbers) >= 22


@pytest.mark.parametrize("path", NUMBERED, ids=lambda path: path.name)
def test_an_example_is_short_and_in_the_gallery(path):
    text = path.read_text(encoding="utf-8")
    assert 10 <= len(text.splitlines()) <= 45
    assert len(re.findall(rf"savefig\(\"{path.stem}\.png\"", text)) == 1
    gallery = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    assert f"(../examples/{path.name})" in gallery
    assert f"(figures/examples/{path.stem}.png)" in gallery
    assert (ROOT / "docs" / "figures" / "examples" / f"{path.stem}.png").exists()
