"""A criterion of damage is one file: result, study, year, comparison and command line read it from the list."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

CRITERION = '''
"""A criterion of the test: how often rollers pass a sector of a raceway."""

from macroslip.result.criteria.criterion import Criterion, Yearly, largest_of
from macroslip.variables import ALWAYS, Variable


def _passes(evaluation):
    passes = evaluation.result.surface_passes.transpose("row", "raceway", "angle")
    most = passes.max("angle").values
    return {"most_passes": most}


CRITERIA = (
    Criterion(
        order=50,
        name="most_passes",
        mechanism="test",
        quantity="most passes of a sector",
        unit="1",
        declares=(
            Variable("most_passes", ("row", "raceway"), "1", ALWAYS, "most passes of a sector"),
        ),
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
from macroslip.report.real_year_page import real_year_page
from macroslip.report.study_page import study_page
from macroslip.result.damage import lines
from macroslip.result.stored import to_netcdf
from macroslip.study.aggregation import Aggregation
from macroslip.study.real_year import real_year
from macroslip.study.study_file import study_of
from macroslip.study.weights import Weibull
from macroslip.study.year import year
from tests.quick import COARSE
from tests.study.made_up_study import made_up_study
from tests.study.test_real_year import months, turbine

folder = Path(sys.argv[2])
content = {"case": {"rollers": [0], "loads": {"end": "2 s"}, "window": {"start": "0 s"},
                    "integrator": {"tolerance": COARSE.tolerance}},
           "loads": {"bundled": ["12A"]}, "lubricants": ["vg460-pao", "vg320-pao"]}
run_study(study_of(content), folder)
study = open_study(folder)
passes = study.sector_passes.values
assert (passes >= 1.0).all() and study.sector_passes.attrs["units"] == "1/s"
found = year(study, Aggregation())
assert "passes" in found and found.passes.attrs["units"] == "1"
page = study_page(study, title="passes", weights=Weibull(9.0, 2.0))
# A column of the designs, and one of the situations of a year.
assert "passes of a sector, both rows [1/year]" in page and ">passes<" in page
made_up = made_up_study()
made_up["sector_passes"] = made_up.entry_rate * 3.0
real = real_year(turbine(*months()), made_up)
of_passes = real.table.set_index("quantity").loc["passes"]
assert of_passes["real"] > 0.0 and of_passes["factor"] == 1.0 and "passes [1]" in real.bins
assert "passes of a sector, both rows" in real_year_page(real)
compared = compare(folder, by="lubricant")
assert "passes of a sector, both rows" in set(compared["quantity"])
result = simulate(
    Case(
        loads=HubLoads.bundled("12A").window(0.0, 1.0),
        rollers=[0],
        window=Window(start=0.0),
        integrator=COARSE,
    )
)
told, _ = lines(result)
assert told[-1]["criterion"] == "most_passes" and told[-1]["reference"] == 2.0
(folder / "case.nc").write_bytes(to_netcdf(result))
damage(folder / "case.nc", threshold=["most_passes=7, the test"], as_json=True)
"""


def with_tests():
    root = str(Path(__file__).parents[2])
    return os.environ | {"PYTHONPATH": os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])}


def test_a_file_is_all_that_a_criterion_takes(tmp_path):
    folder = tmp_path / "more"
    folder.mkdir()
    (folder / "passes.py").write_text(CRITERION)
    program = tmp_path / "program.py"
    program.write_text(textwrap.dedent(PROGRAM))
    command = [sys.executable, str(program), str(folder), str(tmp_path / "study")]
    # The made-up year is one of the tests.
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=600, check=False, env=with_tests()
    )
    assert done.returncode == 0, done.stderr
    printed = {row["criterion"]: row for row in json.loads(done.stdout)["criteria"]}
    assert printed["most_passes"]["reference"] == 7.0
    assert printed["most_passes"]["compared with"] == "your threshold: the test"
