"""Files with laws of one's own, with random damage, as `--laws` reads them."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import Lubricant, plugins
from macroslip.bearing import Bearing
from macroslip.film import film_law
from macroslip.roller.model import interfaces
from macroslip.traction import traction_law
from tests.fuzz.mutations import damaged
from tests.fuzz.oracle import app_of, ends_well, examples

EXAMPLES = Path(__file__).parents[2] / "examples"
KINDS = film_law, traction_law


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("laws")


def _load(path):
    """Register the laws of a file, prepare them for all interfaces, and take them away again."""
    found = plugins.load_laws(path)
    try:
        for kind, names in zip(KINDS, found, strict=True):
            for name in names:
                for interface in interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")):
                    assert isinstance(kind.prepare(name, interface), tuple)
    finally:
        for kind, names in zip(KINDS, found, strict=True):
            for name in names:
                kind.remove(name)
        plugins._loaded.clear()


@pytest.mark.parametrize("name", ["own_film.py", "own_law.py"])
@examples(25)
@given(data=st.data())
def test_damaged(folder, name, data):
    content = data.draw(damaged((EXAMPLES / name).read_bytes()))
    (folder / "mine.py").write_bytes(content)
    ends_well(folder, folder / "mine.py", folder / "mine.py", app=app_of(_load))


@pytest.mark.parametrize("name", ["own_film.py", "own_law.py"])
def test_undamaged_is_accepted(folder, name):
    (folder / "mine.py").write_bytes((EXAMPLES / name).read_bytes())
    assert ends_well(folder, folder / "mine.py", folder / "mine.py", app=app_of(_load)) == ""
