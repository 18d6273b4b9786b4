"""The fingerprint of the program: which sources change what is stored, and which do not."""

import shutil
from pathlib import Path

import pytest

from macroslip import BearingLoads, Case, Laws, fingerprint
from macroslip.fingerprint import KERNEL_PARTS, OTHER_PARTS, RESULT_PARTS, sources_of
from macroslip.study.work import case_key

ROOT = Path(fingerprint.__file__).parent
LOADS = BearingLoads.constant([0.0, -300e3, 10e3], 2.0, 10.0)


def test_every_part_of_the_package_is_in_exactly_one_list():
    listed = [*KERNEL_PARTS, *RESULT_PARTS, *OTHER_PARTS]
    modules = {path.stem for path in ROOT.glob("*.py")}
    folders = {
        path.parent.relative_to(ROOT).parts[0] for path in ROOT.rglob("*.py") if path.parent != ROOT
    }
    assert sorted(listed) == sorted(modules | folders)
    assert len(listed) == len(set(listed))


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the package, of which the fingerprint is taken."""
    place = tmp_path / "macroslip"
    shutil.copytree(
        ROOT,
        place,
        ignore=lambda _, names: [name for name in names if "." in name and name[-3:] != ".py"],
    )
    monkeypatch.setattr(fingerprint, "_ROOT", place)
    fingerprint.fingerprint.cache_clear()
    yield place
    fingerprint.fingerprint.cache_clear()


def key():
    fingerprint.fingerprint.cache_clear()
    return case_key(Case(loads=LOADS, laws=Laws.paper()), {})


@pytest.mark.parametrize(
    ("name", "counts"),
    [
        ("contact/traction.py", True), ("roller/forces.py", True), ("loads/openfast.py", True),
        ("result/simulate.py", True), ("study/summary.py", True), ("measures/totals.py", True),
        ("report/results_page.py", False), ("torque/handbooks.py", False),
        ("study/run.py", False), ("study/lifetime.py", False), ("cli/run.py", False),
    ],
)  # fmt: skip
def test_a_comment_changes_the_key_where_results_depend_on_it(copy, name, counts):
    before = key()
    with (copy / name).open("a") as file:
        file.write("\n# changed\n")
    assert (key() != before) == counts


def test_a_new_and_a_renamed_source_change_it(copy):
    before = key()
    (copy / "contact" / "another.py").write_text("")
    added = key()
    (copy / "contact" / "another.py").rename(copy / "contact" / "renamed.py")
    assert len({before, added, key()}) == 3


def test_a_part_that_does_not_exist_is_an_error():
    with pytest.raises(FileNotFoundError, match="'tractoin'"):
        sources_of("tractoin")
