"""The page of equations and the docstrings of the functions it names carry the same numbers."""

import ast
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/model.md").read_text(encoding="utf-8")
#: Folders whose functions compute the paper's equations.
FOLDERS = ("bearing", "mechanics", "ring", "roller", "imposed", "whole", "measures")
#: Equations that no function of the package computes are derived here.
DERIVATION = "tests.whole.test_equations"
#: `(18)-(20)` is a range; equations of other sources are named with their author.
NUMBERS = re.compile(r"\((\d{1,2})\)(?:-\((\d{1,2})\))?")


def numbers_in(text: str) -> set[int]:
    """Numbers of equations in a text, ranges in full."""
    numbers = set()
    for first, last in NUMBERS.findall(text):
        numbers |= set(range(int(first), int(last or first) + 1))
    return numbers


def on_the_page() -> set[tuple[int, str]]:
    """Number and function of every row of the page's first table."""
    table = PAGE.split("## The paper's equations")[1].split("| symbol |")[0]
    pairs = set()
    for row in table.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", row)]
        if len(cells) == 5 and cells[1].startswith("("):
            for name in re.findall(r"`([\w.]+)`", cells[3]):
                pairs |= {(number, name) for number in numbers_in(cells[1])}
    return pairs


def functions_of(path: Path) -> dict[str, str]:
    """Functions of a file, without tests, with the first paragraphs of their docstrings."""
    nodes = ast.walk(ast.parse(path.read_text(encoding="utf-8")))
    return {
        node.name: (ast.get_docstring(node) or "").split("\n\n")[0]
        for node in nodes
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("test_")
    }


def in_docstrings() -> set[tuple[int, str]]:
    """Number and function wherever the first paragraph of a function's docstring cites equations."""
    package = ROOT / "src/macroslip"
    files = {
        f"{folder}.{path.stem}": path
        for folder in FOLDERS
        for path in sorted((package / folder).glob("*.py"))
    }
    files[DERIVATION] = ROOT / f"{DERIVATION.replace('.', '/')}.py"
    return {
        (number, f"{module}.{function}")
        for module, path in files.items()
        for function, summary in functions_of(path).items()
        for number in numbers_in(summary)
    }


def test_every_number_on_the_page_is_in_the_docstring_of_its_function_and_the_other_way_round():
    page, docstrings = on_the_page(), in_docstrings()
    assert len(page) > 20
    assert page == docstrings


def test_every_equation_of_the_paper_is_on_the_page():
    section = PAGE.split("## The paper's equations")[1].split("\n## ")[0]
    assert numbers_in(section) == set(range(2, 35))


@pytest.mark.parametrize("name", sorted(set(re.findall(r"`((?:\w+\.)+\w+)`", PAGE))))
def test_every_name_on_the_page_exists(name):
    if name.endswith((".py", ".md")) or name.startswith("laws."):
        return
    if name.startswith(f"{DERIVATION}."):
        assert name.rpartition(".")[2] in functions_of(ROOT / f"{DERIVATION.replace('.', '/')}.py")
        return
    module, _, member = f"macroslip.{name}".rpartition(".")
    try:
        importlib.import_module(f"macroslip.{name}")
    except ModuleNotFoundError:
        assert hasattr(importlib.import_module(module), member)
