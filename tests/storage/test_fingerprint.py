"""The hash of the sources: any change of them changes it, and what is filed under it."""

import shutil

import pytest

from macroslip import BearingLoads, Case, Laws
from macroslip.storage import fingerprint as module
from macroslip.storage.tables import table_key
from macroslip.study.work import case_key

ROOT = module._ROOT
LOADS = BearingLoads.constant([0.0, -300e3, 10e3], 2.0, 10.0)


@pytest.fixture
def copy(tmp_path, monkeypatch):
    """A copy of the package, of which the hash is taken."""
    folder = tmp_path / "macroslip"
    shutil.copytree(
        ROOT,
        folder,
        ignore=lambda _, names: [name for name in names if "." in name and name[-3:] != ".py"],
    )
    monkeypatch.setattr(module, "_ROOT", folder)
    module.fingerprint.cache_clear()
    yield folder
    module.fingerprint.cache_clear()


def keys():
    module.fingerprint.cache_clear()
    return {
        module.fingerprint(),
        case_key(Case(loads=LOADS, laws=Laws.paper()), {}),
        table_key(1.0),
    }


@pytest.mark.parametrize("name", ["contact/traction.py", "study/summary.py", "errors.py"])
def test_a_comment_in_any_source_changes_every_key(copy, name):
    before = keys()
    with (copy / name).open("a") as file:
        file.write("\n# changed\n")
    assert not keys() & before


def test_a_new_a_renamed_and_a_tables_source_change_it(copy):
    seen = keys()
    (copy / "contact" / "another.py").write_text("")
    seen |= keys()
    (copy / "contact" / "another.py").rename(copy / "contact" / "renamed.py")
    seen |= keys()
    (copy / "contact" / "numbers.csv").write_text("1,2\n")
    seen |= keys()
    assert len(seen) == 4 * 3
