"""The code of the pages runs, and prints what they quote."""

import re
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "tests" / "data" / "sample14B.outb"
#: Makes what the pages name as the user's own files, then runs the code of every page given in a folder of its own, each
#: block of code in a namespace of its own. Pages share a process, which has imported and compiled what the others need.
RUNNER = """
import contextlib, os, pathlib, runpy, shutil, sys, traceback
from macroslip.cli import app

sample, own_film, *folders = map(pathlib.Path, sys.argv[1:])
prepared = pathlib.Path("prepared").resolve()
prepared.mkdir()
os.chdir(prepared)
app(["init", "case.yaml"], standalone_mode=False)
app(["run", "case.yaml", "-o", "case.nc", "--quiet"], standalone_mode=False)
shutil.copy(sample, "turbine.outb")
shutil.copy(own_film, "own_film.py")
for folder in folders:
    shutil.copytree(prepared, folder, dirs_exist_ok=True)
    os.chdir(folder)
    with open("printed.txt", "w", encoding="utf-8") as printed, contextlib.redirect_stdout(printed):
        try:
            for block in sorted(folder.glob("block*.py")):
                runpy.run_path(str(block))
        except BaseException:
            pathlib.Path("failure.txt").write_text(traceback.format_exc(), encoding="utf-8")
        else:
            pathlib.Path("done.txt").touch()
"""
#: This page registers laws, on which all kernels would depend that are compiled after it.
LAWS = ROOT / "docs" / "laws.md"


def python_blocks(page: Path) -> list[str]:
    """Code of the ```python blocks of a page."""
    return re.findall(r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


PAGES = [page for page in [*sorted((ROOT / "docs").glob("*.md")), ROOT / "README.md"] if python_blocks(page)]


@pytest.fixture(scope="module")
def pages(python, tmp_path_factory):
    """What the code of every page prints, or how it fails."""
    folders = {page: tmp_path_factory.mktemp(page.stem) for page in PAGES}
    for page, folder in folders.items():
        for number, code in enumerate(python_blocks(page)):
            (folder / f"block{number:02}.py").write_text(code, encoding="utf-8")
    own_film, ended = ROOT / "examples" / "own_film.py", []
    for these in ([page for page in folders if page != LAWS], [LAWS]):
        arguments = map(str, (SAMPLE, own_film, *(folders[page] for page in these)))
        ended.append(python("-c", RUNNER, *arguments, folder=tmp_path_factory.mktemp("pages")))

    def read(folder):
        if (folder / "done.txt").exists():
            return (folder / "printed.txt").read_text(encoding="utf-8"), None
        failure = folder / "failure.txt"
        return "", failure.read_text(encoding="utf-8") if failure.exists() else [one.stderr for one in ended]

    return {page: read(folder) for page, folder in folders.items()}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_code_of_page_runs(page, pages):
    _, failure = pages[page]
    assert failure is None, failure


def test_numbers_that_the_model_page_quotes(pages):
    printed, _ = pages[ROOT / "docs" / "model.md"]
    assert re.findall(r"([\d.]+) of the load", printed) == ["0.06", "0.14", "3.30", "47.11"]
    assert re.findall(r"([\d.]+) W", printed) == ["8.7", "7.1"]


NUMBER = r"[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


@pytest.mark.parametrize("name", ["physical.md", "physical-study.md"])
def test_pages_quote_what_their_code_prints(name, pages):
    page = ROOT / "docs" / name
    quoted = "".join(re.findall(r"^```text\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE))
    printed, _ = pages[page]
    assert re.sub(NUMBER, "#", quoted) == re.sub(NUMBER, "#", printed)
    for old, new in zip(re.findall(NUMBER, quoted), re.findall(NUMBER, printed), strict=True):
        last_digit = 10.0 ** -len(old.partition(".")[2])
        assert float(new) == pytest.approx(float(old), rel=5e-3, abs=1.01 * last_digit)
