"""The page of equations is complete and in order, and all that the program says of an equation agrees with it."""

import ast
import importlib
import io
import re
import tokenize
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "src/macroslip"
PAGE = (ROOT / "docs/model.md").read_text(encoding="utf-8")
#: Equations that no function of the package computes are derived here.
DERIVATION = "tests.whole.test_equations"
#: `(18)-(20)` is a range; a group of citations has nothing but commas or "and" between them.
NUMBERS = re.compile(r"\((\d{1,2})\)(?:-\((\d{1,2})\))?")
GROUP = re.compile(rf"(?<![\w.])(?:{NUMBERS.pattern})(?:(?:,| and) {NUMBERS.pattern})*")
#: Sections of the page whose tables have equations.
SECTIONS = (
    "The paper's equations",
    "The coupled pair",
    "What lies before and between",
    "Physical additions",
)
#: A letter, with what follows it as an index or in another direction: `F_n,cage`, `r~_in`, `I_x'`.
SYMBOL = re.compile(r"[^\W\d_](?:[\w~']|,(?=x'|y'|cage))*")
#: Names of functions in equations, and differentials of what has an entry of its own.
OPERATORS = {"cos", "sin", "sign", "min", "ln", "exp", "asinh", "tanh", "dt", "dA", "Σ", "π"}


class Row(NamedTuple):
    """A row of the page's table of the paper's equations."""

    numbers: frozenset[int]
    keys: tuple[str, ...]  #: Words and symbols by which the program may call the equation
    equation: str
    functions: tuple[str, ...]


def numbers_in(text: str) -> set[int]:
    """Numbers of equations in a text, ranges in full."""
    numbers = set()
    for first, last in NUMBERS.findall(text):
        numbers |= set(range(int(first), int(last or first) + 1))
    return numbers


def section(name: str) -> str:
    return PAGE.split(f"## {name}")[1].split("\n## ")[0]


def tables(text: str) -> list[list[list[str]]]:
    """Tables of a text as lists of rows of cells, without heads."""
    found = []
    for block in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE):
        cells = [
            [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            for line in block.splitlines()
        ]
        found.append(cells[2:])
    return found


@cache
def rows() -> list[Row]:
    """Rows of the paper's equations, in the page's order."""
    return [
        Row(
            frozenset(numbers_in(number)),
            tuple(key.lower() for key in re.findall(r"\*\*(.+?)\*\*", subject)),
            equation,
            tuple(re.findall(r"`([\w.]+)`", functions)),
        )
        for number, subject, equation, functions in tables(section(SECTIONS[0]))[0]
    ]


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
    files = {
        ".".join(path.relative_to(PACKAGE).with_suffix("").parts): path
        for path in sorted(PACKAGE.rglob("*.py"))
    }
    files[DERIVATION] = ROOT / f"{DERIVATION.replace('.', '/')}.py"
    return {
        (number, f"{module}.{function}")
        for module, path in files.items()
        for function, summary in functions_of(path).items()
        for group in GROUP.finditer(summary)
        for number in numbers_in(group[0])
    }


def texts_of(path: Path) -> list[str]:
    """Docstrings without their examples, and comments of a file; those of following lines in one."""
    source = path.read_text(encoding="utf-8")
    texts = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            docstring = ast.get_docstring(node) or ""
            texts += re.sub(
                r"^ *>>>(?:.|\n)*?(?:\n\n|\Z)", "\n", docstring, flags=re.MULTILINE
            ).split("\n\n")
    last = -1
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            comment = token.string.lstrip("#: ")
            continues = token.start[0] == last + 1 and not token.line[: token.start[1]].strip()
            if continues and texts:
                texts[-1] += f" {comment}"
            else:
                texts.append(comment)
            last = token.start[0]
    return [" ".join(text.split()) for text in texts]


def wrong_citations(text: str) -> list[str]:
    """Citations in a text whose words just before them are not those of the page's rows.

    A citation has the whole number of a row, `(24)-(26)` and not `(24)`, and one of the row's bold
    words or symbols between the one before it, or the start of the sentence, and itself. That of
    several rows at once needs those of one. Equations of standards are not the paper's.
    """
    wrong = []
    if re.search(r"\bISO\b", text):
        return wrong
    for sentence in re.split(r"(?<=[.;:])\s+", text):
        start = 0
        for group in GROUP.finditer(sentence):
            numbers = numbers_in(group[0])
            cited = [row for row in rows() if row.numbers & numbers]
            before = sentence[start : group.start()].lower()
            is_whole = set().union(*(row.numbers for row in cited)) == numbers
            is_named = any(
                re.search(rf"(?<![\w_]){re.escape(key)}", before)
                for row in cited
                for key in row.keys
            )
            if not (is_whole and is_named):
                wrong.append(sentence)
            start = group.end()
    return wrong


def test_every_equation_of_the_paper_has_a_row_in_rising_order():
    numbers = [sorted(row.numbers) for row in rows()]
    assert [number for row in numbers for number in row] == list(range(2, 35))


def test_every_row_names_its_subject_and_a_function():
    assert all(row.keys and row.equation and row.functions for row in rows())


def test_every_number_on_the_page_is_in_the_docstring_of_its_function_and_the_other_way_round():
    page = {(number, name) for row in rows() for name in row.functions for number in row.numbers}
    assert page == in_docstrings()


@pytest.mark.parametrize(
    "path", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE))
)
def test_every_comment_and_docstring_calls_equations_by_their_subjects(path):
    assert [wrong for text in texts_of(path) for wrong in wrong_citations(text)] == []


@pytest.mark.parametrize(
    ("text", "is_wrong"),
    [
        ("times Ω² it is the centrifugal force (21)-(23)", False),
        ("times Ω² it is the centrifugal force (18)", True),
        ("times Ω² it is the drag (24)-(26)", False),
        ("times Ω² it is the drag (24)", True),
        ("Weight (18)-(20) and centrifugal force (21)-(23).", False),
        ("Weight (21)-(23) and centrifugal force (18)-(20).", True),
        ("Power over speed (33). Drag (24)-(26).", False),
        ("Body forces (18)-(26) of a roller.", False),
        ("ISO 76:2006, equation (15).", False),
        ("Range of the steps (3)", True),
    ],
)
def test_a_wrong_number_is_found(text, is_wrong):
    assert bool(wrong_citations(text)) == is_wrong


@pytest.mark.parametrize("name", SECTIONS)
def test_every_symbol_of_an_equation_has_an_entry(name):
    equations, symbols = tables(section(name))
    known = symbols_in(" ".join(row[0] for row in symbols))
    if name != SECTIONS[0]:
        known |= symbols_in(" ".join(row[0] for row in tables(section(SECTIONS[0]))[1]))
    used = symbols_in(" ".join(row[-2] for row in equations if row[0] != "tables"))
    assert used - known == set()


def symbols_in(text: str) -> set[str]:
    """Symbols in equations, without powers, dots and the d of a differential."""
    plain = re.sub(r"[½²³√\u0307]|\^[\w_]*", " ", text)
    names = set(SYMBOL.findall(plain)) - OPERATORS
    return {re.sub(r"^d(?=[^\W_])", "", name) for name in names}


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
