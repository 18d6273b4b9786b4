"""Tables of the variables of results and studies, for their pages, from the tables of the program.

python -m tools.variables_page      # writes them into the pages
"""

from __future__ import annotations

from pathlib import Path

from macroslip.kinds.tapered.history import HISTORY
from macroslip.rating.variables import RATING
from macroslip.result.damage import DAMAGE
from macroslip.result.orbit import AVERAGES, SCENE, STILL
from macroslip.result.stiffness import STIFFNESS
from macroslip.result.variables import VARIABLES
from macroslip.study.effects import EFFECTS
from macroslip.study.exceedance import EXCEEDANCE, LOAD_SPECTRUM
from macroslip.study.lifetime import LIFETIME, LIFETIME_MAPS, PERCENTILES
from macroslip.study.summary import CASE_VARIABLES, CYCLES, ROW_VARIABLES
from macroslip.study.year import YEAR_VARIABLES
from macroslip.torque.computed import TORQUE
from macroslip.variables import ALWAYS, Variable, VariableTable

DOCS = Path(__file__).parents[1] / "docs"
#: Tables of each page: those of the file of a result, and of what is computed from one; those of
#: `open_study`, and of what is computed from a study.
PAGES: dict[Path, tuple[VariableTable, ...]] = {
    DOCS / "results.md": (
        VARIABLES,
        RATING,
        DAMAGE,
        TORQUE,
        STIFFNESS,
        HISTORY,
        AVERAGES,
        SCENE,
        STILL,
    ),
    DOCS / "study-results.md": (
        ROW_VARIABLES,
        CASE_VARIABLES,
        CYCLES,
        YEAR_VARIABLES,
        LIFETIME,
        PERCENTILES,
        EXCEEDANCE,
        LIFETIME_MAPS,
        LOAD_SPECTRUM,
        EFFECTS,
    ),
}
BEGIN, END = "<!-- variables: written by tools/variables_page.py -->", "<!-- end of variables -->"


def section(table: VariableTable) -> str:
    """Heading of a table, and its variables by when they are there, in Markdown."""
    groups: dict[str, list[Variable]] = {ALWAYS: []}
    for variable in table.values():
        groups.setdefault(variable.when, []).append(variable)
    parts = [f"### {table.title}"]
    for when, variables in groups.items():
        if not variables:
            continue
        if when != ALWAYS or len(groups) > 1:
            parts.append(f"**{when[0].upper()}{when[1:]}:**")
        lines = ["| variable | over | unit | meaning |", "|---|---|---|---|"]
        for variable in variables:
            dims = ", ".join(variable.dims)
            meaning = variable.long_name.replace("|", "\\|")
            lines.append(f"| `{variable.name}` | {dims} | {variable.units} | {meaning} |")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)


def with_tables(path: Path) -> str:
    """The page at a path, with its tables between the two marks."""
    page = path.read_text(encoding="utf-8")
    before, _, from_begin = page.partition(BEGIN)
    after = from_begin.partition(END)[2]
    tables = "\n\n".join(section(table) for table in PAGES[path])
    return f"{before}{BEGIN}\n\n{tables}\n\n{END}{after}"


if __name__ == "__main__":
    for path in PAGES:
        path.write_text(with_tables(path), encoding="utf-8")
