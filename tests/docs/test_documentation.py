"""The documentation cannot go stale: its links resolve, and it names every key and every variable."""

import re
import shutil
from pathlib import Path

import pytest

from macroslip import (
    BearingLoads,
    Case,
    Laws,
    Traces,
    bundled_cases,
    open_study,
    read_study,
    run_study,
    simulate,
)
from macroslip.case.parts import INTEGRATORS
from macroslip.imposed.status import Status
from macroslip.input.fields import Choice
from macroslip.input.section import fields_of, form_of, keys_of
from macroslip.study.aggregation import Aggregation
from macroslip.study.database import Outcome
from macroslip.study.export import tables
from macroslip.study.settings import METHODS, SCALES
from macroslip.study.study_file import KINDS, StudyFile, study_of
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES
from macroslip.study.weights import Weibull
from tools import variables_page

ROOT = Path(__file__).parents[2]
SAMPLE = ROOT / "tests" / "data" / "sample14B.outb"
PAGES = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "README.md"]
STUDIES = "".join(
    (ROOT / "docs" / name).read_text(encoding="utf-8")
    for name in ("studies.md", "study-results.md")
)
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
OURS = [*(ROOT / "docs").glob("*.md"), *(ROOT / "docs").glob("*.py"), *EXAMPLES]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_relative_links_resolve(page):
    links = re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8"))
    broken = [link for link in links if "://" not in link and not (page.parent / link).exists()]
    assert broken == []


def test_index_names_every_page_and_every_example():
    index = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    pages = [path.name for path in (ROOT / "docs").glob("*.md") if path.name != "index.md"]
    assert [name for name in pages if f"{name})" not in index] == []
    gallery = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8")
    assert [path.name for path in EXAMPLES if f"{path.name})" not in gallery] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_page_begins_with_what_the_reader_can_do_after_it(page):
    if page.name in ("index.md", "README.md"):
        pytest.skip("begins with what the program is")
    _, first, *_ = page.read_text(encoding="utf-8").split("\n\n")
    assert re.match(r"After this page you (can|have|know) ", first)


def test_case_file_page_names_every_key_of_a_case():
    quoted = re.findall(
        r"`([^`\n]+)`", (ROOT / "docs" / "case-file.md").read_text(encoding="utf-8")
    )
    sections = {"drivetrain", "forces", "heat", "laws", "cage", "integrator", "window"}
    names = [key for key, _ in keys_of(Case) if key not in sections]
    # Keys of the constant loads stand together in the row of their section.
    names = [key.removeprefix("loads.hub.").removeprefix("loads.main_bearing.") for key in names]
    assert [name for name in names if name not in quoted] == []


def test_studies_page_names_every_key_of_a_study():
    quoted = re.findall(r"`([^`\n]+)`", STUDIES)
    names = [key for key, _ in keys_of(StudyFile) if key != "variations"]
    assert [name for name in names if name not in quoted] == []
    choices = [*METHODS, *SCALES, *KINDS, "values", "low", "high", "unit", "scale"]
    assert [name for name in choices if name not in quoted] == []


def test_studies_page_has_a_line_for_every_outcome():
    text = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    assert [outcome for outcome in Outcome if f"| `{outcome}` |" not in text] == []


def test_studies_pages_name_every_file_every_table_and_every_variable(tmp_path):
    study = {
        "case": {"laws": {"model": "paper"}, "rollers": [0], "loads": {"end": "8 s"}},
        "loads": {"bundled": ["14B"]},
        "cycles": True,
    }
    run_study(study_of(study), tmp_path / "out")
    opened = open_study(tmp_path / "out")
    sheets = tables(opened, Aggregation(Weibull(9.0, 2.0)))
    files = [
        f"{path.name}/" if path.is_dir() else path.name for path in (tmp_path / "out").iterdir()
    ]
    labels = [name for name, coordinate in opened.coords.items() if coordinate.dims == ("case",)]
    names = [
        *files,
        *sheets,
        *ROW_VARIABLES,
        *CASE_VARIABLES,
        *labels,
        "load_cycles",
        *opened.load_cycles.dims,
    ]
    assert [name for name in names if f"`{name}`" not in STUDIES] == []


def test_studies_page_gives_the_units_of_the_summary():
    rows = re.findall(r"^\|(.*)\|$", STUDIES, re.MULTILINE)
    cells = [[cell.strip() for cell in row.split("|")] for row in rows]
    for name, variable in {**ROW_VARIABLES, **CASE_VARIABLES}.items():
        named = [row for row in cells if f"`{name}`" in row[0]]
        assert any(variable.units == row[2] for row in named), name


def test_study_files_of_page_and_examples_are_right(tmp_path, monkeypatch):
    assert len(read_study(ROOT / "examples" / "study.yaml")) == 96
    text = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    block, balance = re.findall(r"^```yaml\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)
    (tmp_path / "balance.yaml").write_text(balance, encoding="utf-8")
    balanced = read_study(tmp_path / "balance.yaml")
    assert (len(balanced), balanced.heat.conductance, balanced.weights.year.wind.shape) == (
        21,
        60.0,
        2.0,
    )
    (tmp_path / "dlc12").mkdir()
    shutil.copy(SAMPLE, tmp_path / "dlc12" / "14mps_seed1.outb")
    shutil.copy(
        ROOT / "src/macroslip/bearing/catalogue/skf-240-600-bc.yaml",
        tmp_path / "other-bearing.yaml",
    )
    (tmp_path / "study.yaml").write_text(block, encoding="utf-8")
    assert len(read_study(tmp_path / "study.yaml")) == 2 * 2 * 3 * 16


def test_case_file_page_names_every_law_and_method():
    text = (ROOT / "docs" / "case-file.md").read_text(encoding="utf-8")
    laws = [form_of(field) for field in fields_of(Laws).values()]
    choices = [name for choice in laws if isinstance(choice, Choice) for name in choice.names()]
    names = [*choices, *INTEGRATORS, bundled_cases()[0], bundled_cases()[-1]]
    missing = [name for name in names if f"`{name}`" not in text]
    assert missing == []


def test_input_page_shows_the_lines_that_the_program_asks_for():
    from macroslip.loads.openfast import _MEANING

    text = (ROOT / "docs" / "input.md").read_text(encoding="utf-8")
    missing = [
        name
        for name, meaning in _MEANING.items()
        if not re.search(rf'"{name}" +- {re.escape(meaning)}', text)
    ]
    assert missing == []


#: Variables of a result stand on its page, and what criteria of damage need on theirs.
RESULTS = "\n".join(
    (ROOT / "docs" / name).read_text(encoding="utf-8") for name in ("results.md", "damage.md")
)


@pytest.fixture(scope="module")
def dataset():
    """A result of the physical model, which has all variables of the paper's and more."""
    loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.2)
    return simulate(Case(loads=loads, rollers=[0], traces=Traces(step=0.1), laws=Laws.physical()))


def test_results_page_names_every_variable_coordinate_and_attribute(dataset):
    text = RESULTS
    labels = [*dataset.interface.values, *dataset.row.values, *dataset.mechanism.values]
    names = [*dataset.variables, *dataset.attrs, *labels]
    assert [name for name in names if f"`{name}`" not in text] == []


def test_results_page_gives_the_units_of_every_variable(dataset):
    rows = re.findall(r"^\|(.*)\|$", RESULTS, re.MULTILINE)
    cells = [[cell.strip() for cell in re.split(r"(?<!\\)\|", row)] for row in rows]
    for name, variable in dataset.data_vars.items():
        matching = [row for row in cells if f"`{name}`" in row[0]]
        assert any(
            variable.units in re.split(", ", cell) for row in matching for cell in row[1:]
        ), name


def test_results_page_has_the_sentence_of_every_status():
    text = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
    assert [
        status for status in Status if f"| {int(status)} | {status.sentence} |" not in text
    ] == []


def test_the_page_of_the_physical_model_names_modules_that_exist():
    """Names on the page of equations are tested with them, in `test_equations.py`."""
    text = (ROOT / "docs" / "physical.md").read_text(encoding="utf-8")
    modules = re.findall(r"`((?!src/|tests/)[a-z_]+/[a-z_]*(?:\.py)?)`", text)
    assert len(modules) >= 10
    assert [name for name in modules if not (ROOT / "src" / "macroslip" / name).exists()] == []


@pytest.mark.parametrize("path", sorted(OURS), ids=lambda path: path.name)
def test_page_or_script_names_no_machine(path):
    text = path.read_text(encoding="utf-8")
    assert (
        re.findall(r"(?:^|[\s\"'`(=])(?:/(?:home|root|tmp|work|Users|mnt|opt)/|[A-Z]:\\)\S*", text)
        == []
    )


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_example_says_what_it_is_and_how_to_run_it(path):
    assert re.match(
        rf'""".+\n(.*\n)*? *python (examples/)?{re.escape(path.name)}',
        path.read_text(encoding="utf-8"),
    )


def test_readme_for_a_package_index_has_no_link_into_the_repository():
    """The substitutions of pyproject.toml, applied as the build does."""
    import tomllib

    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for substitution in settings["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"][
        "substitutions"
    ]:
        text = re.sub(substitution["pattern"], substitution["replacement"], text)
    assert "](" not in text and "bearing_slip" not in text and re.search(r"first\srun", text)


@pytest.mark.parametrize("path", variables_page.PAGES, ids=lambda path: path.name)
def test_variables_of_pages_are_those_of_the_tables(path):
    page = path.read_text(encoding="utf-8")
    assert page == variables_page.with_tables(path), "run python -m tools.variables_page"
