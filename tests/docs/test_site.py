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
            numbers = [[float(one) for one in re.findall(NUMBER, text)] for text in (left, right)]
            assert numbers[1] == pytest.approx(numbers[0], rel=5e-3, abs=2e-3), left
