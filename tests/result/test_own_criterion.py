"""A criterion of damage is one file: result, study, year, comparison and command line read it from the list."""

import json
import subprocess
import sys
import textwrap

import pytest

pytestmark = pytest.mark.slow

CRITERION = '''
"""A criterion of the test: how often rollers pass a sector of a raceway."""

from macroslip.result.criteria.criterion import Criterion, Yearly, largest_of
from macroslip.result.variables import described


def _passes(evaluation):
    passes = evaluation.result.surface_passes.transpose("row", "raceway", "angle")
    most = passes.max("angle").values
    return {"most_passes": (("row", "raceway"), most, described("1", "most passes of a sector"))}


CRITERIA = (
    Criterion(
        order=50,
        name="most_passes",
        mechanism="test",
        quantity="most passes of a sector",
        unit="1",
        variables=_passes,
        value=largest_of("most_passes"),
        reference=2.0,
        compared_with="nothing",
        factor=1.0,
        reason="counted",
        yearly=(
            Yearly(
                run_name="sector_passes",
                run_unit="1/s",
                run_meaning="passes of a sector",
                of_run=lambda criteria, result: criteria.most_passes.max("raceway"),
                name="passes",
                drawn="sum",
                year_unit="1",
                year_meaning="passes of a sector",
                unit="1/year",
                meaning="passes of a sector, both rows",
            ),
        ),
    ),
)
'''

PROGRAM = """
import importlib.util
import sys

# As if the file lay in the folder of criteria.
spec = importlib.util.find_spec("macroslip.result.criteria")
spec.submodule_search_locations.append(sys.argv[1])
package = importlib.util.module_from_spec(spec)
sys.modules[spec.name] = package
spec.loader.exec_module(package)

from pathlib import Path

from macroslip import Case, HubLoads, Window, open_study, run_study, simulate
from macroslip.cli.damage import damage
from macroslip.report.comparison import compare
from macroslip.result.damage import lines
from macroslip.result.stored import to_netcdf
from macroslip.study.aggregation import Aggregation
from macroslip.study.study_file import study_of
from macroslip.study.year import year

folder = Path(sys.argv[2])
content = {"case": {"rollers": [0], "loads": {"end": "2 s"}, "window": {"start": "0 s"}},
           "loads": {"bundled": ["12A"]}, "lubricants": ["vg460-pao", "vg320-pao"]}
run_study(study_of(content), folder)
study = open_study(folder)
passes = study.sector_passes.values
assert (passes >= 1.0).all() and study.sector_passes.attrs["units"] == "1/s"
found = year(study, Aggregation())
assert "passes" in found and found.passes.attrs["units"] == "1"
compared = compare(folder, by="lubricant")
assert "passes of a sector, both rows" in set(compared["quantity"])
result = simulate(
    Case(loads=HubLoads.bundled("12A").window(0.0, 1.0), rollers=[0], window=Window(start=0.0))
)
told, _ = lines(result)
assert told[-1]["criterion"] == "most_passes" and told[-1]["reference"] == 2.0
(folder / "case.nc").write_bytes(to_netcdf(result))
damage(folder / "case.nc", threshold=["most_passes=7, the test"], as_json=True)
"""


def test_a_file_is_all_that_a_criterion_takes(tmp_path):
    folder = tmp_path / "more"
    folder.mkdir()
    (folder / "passes.py").write_text(CRITERION)
    program = tmp_path / "program.py"
    program.write_text(textwrap.dedent(PROGRAM))
    command = [sys.executable, str(program), str(folder), str(tmp_path / "study")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr
    printed = {row["criterion"]: row for row in json.loads(done.stdout)["criteria"]}
    assert printed["most_passes"]["reference"] == 7.0
    assert printed["most_passes"]["compared with"] == "your threshold: the test"
