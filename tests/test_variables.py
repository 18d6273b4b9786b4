"""Tables of variables: one row each, one way into a dataset, and a place on a page."""

import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import macroslip
from macroslip.variables import ALWAYS, Variable, VariableTable
from tools import variables_page

SOURCES = Path(macroslip.__file__).parent
LOAD = Variable("load", ("row",), "N", ALWAYS, "largest load")


def tables():
    """All tables of the package, by module and name."""
    found = {}
    for module in pkgutil.walk_packages([str(SOURCES)], "macroslip."):
        if re.search(r"VariableTable\(", _source(module.name)):
            loaded = importlib.import_module(module.name)
            for name, value in vars(loaded).items():
                if isinstance(value, VariableTable):
                    found[f"{module.name}.{name}"] = value
    return found


def _source(module):
    path = SOURCES.joinpath(*module.split(".")[1:])
    path = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    return path.read_text(encoding="utf-8")


def test_every_variable_of_every_table_is_on_a_page():
    on_pages = {
        variable
        for of_page in variables_page.PAGES.values()
        for table in of_page
        for variable in table.values()
    }
    every = tables()
    assert len(every) > 15
    lacking = [
        f"{name}: {variable.name}"
        for name, table in every.items()
        for variable in table.values()
        if variable not in on_pages
    ]
    assert lacking == []


def test_attributes_of_variables_are_written_in_one_place():
    """Nothing but `described` writes a unit and a meaning."""
    writing = []
    for path in SOURCES.rglob("*.py"):
        if path.name != "variables.py" and '"long_name":' in path.read_text(encoding="utf-8"):
            writing.append(path.name)
    assert writing == []


def test_a_name_that_the_table_lacks_is_refused():
    table = VariableTable("Example", [LOAD])
    with pytest.raises(KeyError, match="the table of variables has no power"):
        table.put({"load": [1.0], "power": [2.0]})


def test_a_name_stands_once():
    with pytest.raises(ValueError, match="load stands twice"):
        VariableTable("Example", [LOAD, LOAD])
