"""The examples run."""

from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "tests" / "data" / "sample14B.outb"
SCRIPTS = [*sorted((ROOT / "examples").glob("*.py")), ROOT / "docs" / "drawings.py"]


@pytest.fixture(scope="module")
def scripts(python, tmp_path_factory):
    """Outcome of every example and of the drawings, each run as a user does."""

    def run(path):
        # The drawings go to a folder of their own, so that a run of the tests changes no file.
        arguments = {
            "02_openfast_file.py": [str(SAMPLE)],
            "drawings.py": [str(tmp_path_factory.mktemp("pictures"))],
        }
        return python(
            str(path), *arguments.get(path.name, []), folder=tmp_path_factory.mktemp(path.stem)
        )

    return {path: run(path) for path in SCRIPTS}


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_script_runs_and_says_something(path, scripts):
    assert scripts[path].returncode == 0, scripts[path].stderr
    assert 1 <= len(scripts[path].stdout.splitlines()) <= 15
