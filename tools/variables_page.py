"""Tables of the variables of a result, for docs/results.md, from the table of the program.

python -m tools.variables_page      # writes them into the page
"""

from __future__ import annotations

from pathlib import Path

from macroslip.result.variables import VARIABLES, Variable

PAGE = Path(__file__).parents[1] / "docs" / "results.md"
BEGIN, END = "<!-- variables: written by tools/variables_page.py -->", "<!-- end of variables -->"


def tables() -> str:
    """A table for every state in which variables are there, in Markdown."""
    groups: dict[str, list[Variable]] = {}
    for variable in VARIABLES.values():
        groups.setdefault(variable.when, []).append(variable)
    parts = []
    for when, variables in groups.items():
        rows = [
            f"| `{variable_shown.name}` | {', '.join(variable_shown.dims)} | {variable_shown.units} | {variable_shown.long_name} |"
            for variable_shown in variables
        ]
        heading = f"**{when[0].upper()}{when[1:]}:**"
        parts.append(
            "\n".join(
                [heading, "", "| variable | over | unit | meaning |", "|---|---|---|---|", *rows]
            )
        )
    return "\n\n".join(parts)


def with_tables(page: str) -> str:
    """The page with the tables between its two marks."""
    before, _, from_begin = page.partition(BEGIN)
    after = from_begin.partition(END)[2]
    return f"{before}{BEGIN}\n\n{tables()}\n\n{END}{after}"


if __name__ == "__main__":
    PAGE.write_text(with_tables(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
