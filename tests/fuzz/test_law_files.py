"""Files with laws of one's own, with random damage, as `--laws` reads them."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip import InputError, Lubricant, plugins
from macroslip.bearing import Bearing
from macroslip.contact.interface import interfaces
from macroslip.contact.registry import FILM_LAWS, TRACTION_LAWS
from tests.fuzz.mutations import damaged
from tests.fuzz.oracle import app_of, ends_well, examples

LOADS = np.array([2e2, 2e4])
EXAMPLES = Path(__file__).parents[2] / "examples"
KINDS = FILM_LAWS, TRACTION_LAWS


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("laws")


def _load(path):
    """Register the laws of a file, ask them at all interfaces, and take them away again."""
    laws = plugins.load_laws(path)
    try:
        for kind, names in zip(KINDS, laws, strict=True):
            for name in names:
                for interface in interfaces(
                    Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
                ):
                    states = (LOADS, 0.4) if kind is FILM_LAWS else (LOADS, 1e-6, 1e-4)
                    try:
                        assert (kind.named(name)(interface, *states) > 0.0).all()
                    except InputError as problem:
                        # A law that is wrong when it is asked is named, with the interface.
                        assert f"law '{name}', {interface.name}" in problem.where
    finally:
        for kind, names in zip(KINDS, laws, strict=True):
            for name in names:
                kind.remove(name)
        plugins._loaded.clear()


@pytest.mark.deep
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
