"""`python -m validation [NAME]`: the program beside what was measured, as one table and a figure for each comparison."""

from __future__ import annotations

import argparse
import os
from importlib import import_module
from pathlib import Path

from macroslip.report.style import program_style
from validation.comparison import table

#: Comparisons by name; each is a module with `compare`, which gives its lines of the table, and `draw`.
NAMES = (
    "thrust_friction",
    "skf_parts",
    "regime",
    "wear_lines",
    "heat",
    "cage_slip",
    "tapered_torque",
)


def main() -> None:
    """Print the lines of every comparison, and draw it."""
    os.environ["MPLBACKEND"] = "agg"  # figures become files, and need no window
    parser = argparse.ArgumentParser(prog="python -m validation", description=__doc__)
    parser.add_argument("name", nargs="?", choices=NAMES, help="one comparison; all if not given")
    parser.add_argument(
        "-o", "--output", type=Path, default=Path("docs/figures"), help="folder of the figures"
    )
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    rows = []
    for name in [options.name] if options.name else NAMES:
        module = import_module(f"validation.{name}")
        rows += module.compare()
        with program_style():
            module.draw(options.output / f"measured_{name}.png")
    print(table(rows), f"\nfigures: {options.output}", sep="\n")


if __name__ == "__main__":
    main()
