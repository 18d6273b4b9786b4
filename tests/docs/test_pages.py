"""The code of the pages runs, and prints what they quote."""

import re
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "tests" / "data" / "sample14B.outb"
#: Makes what the pages name as the user's own files, then runs the code of every page given in a folder of its own, each
#: block of code in a namespace of its own. Pages share a process, which has imported and compiled what the others need;
#: a second process in the same folder finds the user's files made.
RUNNER = """
import contextlib, os, pathlib, runpy, shutil, sys, traceback
from macroslip.cli.commands import app

sample, own_film, *folders = map(pathlib.Path, sys.argv[1:])
prepared = pathlib.Path("prepared").resolve()
if not prepared.exists():
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
                runpy.run_path(str(block), run_name="__main__")
        except BaseException:
            pathlib.Path("failure.txt").write_text(traceback.format_exc(), encoding="utf-8")
        else:
            pathlib.Path("done.txt").touch()
"""
#: This page registers laws, on which all kernels would depend that are compiled after it.
LAWS = ROOT / "docs" / "laws.md"


def python_blocks(page: Path) -> list[str]:
    """Code of the ```python blocks of a page."""
    return re.findall(
        r"^```python\n(.*?)^```$", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


PAGES = [
    page
    for page in [*sorted((ROOT / "docs").glob("*.md")), ROOT / "README.md"]
    if python_blocks(page)
]


@pytest.fixture(scope="module")
def pages(python, tmp_path_factory):
    """What the code of every page prints, or how it fails."""
    folders = {page: tmp_path_factory.mktemp(page.stem) for page in PAGES}
    for page, folder in folders.items():
        for number, code in enumerate(python_blocks(page)):
            (folder / f"block{number:02}.py").write_text(code, encoding="utf-8")
    own_film, ended = ROOT / "examples" / "own_film.py", []
    shared = tmp_path_factory.mktemp("pages")
    for these in ([page for page in folders if page != LAWS], [LAWS]):
        arguments = map(str, (SAMPLE, own_film, *(folders[page] for page in these)))
        ended.append(python("-c", RUNNER, *arguments, folder=shared))

    def read(folder):
        if (folder / "done.txt").exists():
            return (folder / "printed.txt").read_text(encoding="utf-8"), None
        failure = folder / "failure.txt"
        return "", failure.read_text(encoding="utf-8") if failure.exists() else [
            process.stderr for process in ended
        ]

    return {page: read(folder) for page, folder in folders.items()}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_code_of_page_runs(page, pages):
    _, failure = pages[page]
    assert failure is None, failure


def test_numbers_that_the_model_page_quotes(pages):
    printed, _ = pages[ROOT / "docs" / "model.md"]
    matches = re.findall(r"([\d.]+) of the load", printed)
    assert matches == ["0.06", "0.14", "3.30", "47.11", "0.03", "0.04", "0.05", "0.05"]


def quoted_by(name):
    """Text of a page without breaks of lines."""
    return " ".join((ROOT / "docs" / name).read_text(encoding="utf-8").split())


def test_energies_that_the_page_on_mechanisms_quotes(pages):
    printed, _ = pages[ROOT / "docs" / "physical.md"]
    every = re.findall(r"inner ([\d.]+) J, outer ([\d.]+) J, cage ([\d.]+) J", printed)
    default, starved, limited, rolling_only = (
        [float(number) for number in three] for three in every
    )
    page = quoted_by("physical.md")
    assert (
        "Inner and outer raceway dissipate {:.1f} and {:.1f} J, the cage {:.1f} J.".format(*default)
        in page
    )
    assert "With `oil_supply: 0.7` they have {:.1f}, {:.1f} and {:.0f} J,".format(*starved) in page
    assert "with limiting shear the raceways {:.1f} and {:.1f} J,".format(*limited) in page
    assert max(rolling_only[:2]) < 0.05 and "without microslip below 0.05 J each" in page


def test_ratios_that_the_page_on_the_study_quotes(pages):
    printed, _ = pages[ROOT / "docs" / "published-study.md"]
    none, fifth, whole = np.reshape(
        [float(number) for number in re.findall(r"over upwind ([\d.]+)", printed)], (3, 2)
    )
    assert none == pytest.approx([1.0, 1.0], abs=5e-3)
    words = f"with a fifth of it {fifth[0]:.1f} under `paper` and {fifth[1]:.1f} under `physical`"
    assert f"{words}, with all of it {whole[0]:.1f} and {whole[1]:.0f}." in quoted_by(
        "published-study.md"
    )


def test_the_readme_quotes_what_the_case_that_init_writes_gives():
    from macroslip import read_case, simulate
    from macroslip.cli.run import with_motion
    from macroslip.report.answer import answer
    from macroslip.result.damage import lines
    from macroslip.result.rating import with_rating

    case = with_motion(read_case(ROOT / "src" / "macroslip" / "cli" / "case_template.yaml"))
    result = with_rating(simulate(case), case)
    criteria, _ = lines(result)
    sentences = answer(result, criteria)
    assert len(sentences) == 4
    assert "\n".join(sentences) in (ROOT / "README.md").read_text(encoding="utf-8")
    first_run = (ROOT / "docs" / "first-run.md").read_text(encoding="utf-8")
    assert "\n".join(sentences[:3]) in first_run
