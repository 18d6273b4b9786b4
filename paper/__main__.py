"""`python -m paper -o results`: the published study repeated, with a page, figures and numbers."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from macroslip import MacroslipError
from macroslip.cli.progress import command_progress


def main() -> int:
    """Exit code 0; 2 for bad input; 3 if an integration failed."""
    os.environ["MPLBACKEND"] = "agg"  # figures become files, and need no window
    from paper.reproduce import REPORT, reproduce

    parser = argparse.ArgumentParser(prog="python -m paper", description=__doc__)
    parser.add_argument(
        "-o", "--output", type=Path, default=Path("results"), help="folder to write to"
    )
    parser.add_argument("--threads", type=int, help="threads; all processors if not given")
    parser.add_argument(
        "--all", action="store_true", help="the sample over estimated values beside the study"
    )
    options = parser.parse_args()
    try:
        with command_progress(quiet=False) as report:
            summary = reproduce(
                options.output, threads=options.threads, progress=report, sampled=options.all
            )
    except MacroslipError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(
        *summary["headline"],
        f"written: {options.output}; the report: {options.output / REPORT}",
        sep="\n",
    )
    failed = [
        summary["failed_rollers"][part] for part in ("study", "single_rollers", "detailed_case")
    ]
    return 3 if any(failed) else 0


if __name__ == "__main__":
    sys.exit(main())
