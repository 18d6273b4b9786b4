"""The site builds, and its notebooks run."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
NUMBER = r"[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"


def test_the_site_builds_without_a_warning_and_asks_no_network(tmp_path):
    # Without Python's own warnings as errors: Sphinx's extensions warn of each other's versions.
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "-W",
        "--keep-going",
        "-q",
        "-b",
        "html",
        ROOT / "docs",
        tmp_path,
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    pages = list(tmp_path.glob("*.html"))
    assert {"index.html", "first-run.html", "search.html", "api.html"} <= {
        page.name for page in pages
    }
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="https?://[^"]*"', text) == [], (
            page.name
        )
    assert (tmp_path / "searchindex.js").stat().st_size > 10_000


NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_notebook_runs_and_shows_what_is_stored(path):
    """Every number in the stored output of text comes out again; pictures have tests of their own."""
    import nbformat
    from nbclient import NotebookClient

    stored = nbformat.read(path, as_version=4)
    fresh = nbformat.read(path, as_version=4)
    NotebookClient(fresh, timeout=600, kernel_name="python3").execute()
    cells = [cell for cell in stored.cells if cell.cell_type == "code"]
    again = [cell for cell in fresh.cells if cell.cell_type == "code"]
    for old, new in zip(cells, again, strict=True):
        before, after = (
            [
                out.data["text/plain"]
                for out in cell.outputs
                if "image/png" not in out.get("data", {})
            ]
            for cell in (old, new)
        )
        for left, right in zip(before, after, strict=True):
            numbers = [
                [float(number) for number in re.findall(NUMBER, text)] for text in (left, right)
            ]
            assert numbers[1] == pytest.approx(numbers[0], rel=5e-3, abs=2e-3), left


def test_pictures_of_the_user_show_after_one_of_the_program():
    from nbclient import NotebookClient
    from nbformat.v4 import new_code_cell, new_notebook

    cells = [
        "from macroslip import BearingLoads, Case, Laws, Traces, simulate\n"
        "loads = BearingLoads.constant([0.0, -300e3, 50e3], 2.0, 8.0)\n"
        "case = Case(loads=loads, rollers=[0], traces=Traces(step=0.1), laws=Laws.paper())\n"
        "result = simulate(case)",
        "result.macroslip.plot.orbit('upwind');",
        "from matplotlib import pyplot\npyplot.plot([1.0, 2.0]);",
    ]
    notebook = new_notebook(cells=[new_code_cell(text) for text in cells])
    NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
    shown = [
        [out for out in cell.outputs if "image/png" in out.get("data", {})]
        for cell in notebook.cells
    ]
    assert [len(pictures) for pictures in shown] == [0, 1, 1]
