"""`python -m paper.archive results`: the study's inputs and outputs in one file with checksums, as a repository of data takes it.

The same files give the same archive to the byte: names are sorted, and times, owners and modes are left out.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import io
import platform
import re
import sys
import tarfile
from collections.abc import Iterator
from importlib.metadata import requires, version
from pathlib import Path

import macroslip
from macroslip.errors import InputError
from macroslip.storage.files import check_new_file, new_file
from paper.reproduce import REPORT, SUMMARY

ROOT = Path(__file__).parents[1]
#: What the study is computed by and from, beside the files at the top of the clone.
_FOLDERS = ("src", "paper", "docs", "examples", "tests", "tools", "validation", "benchmarks")
SUMS = "SHA256SUMS"
_README = """The study of roller slip that `make reproduce` of macroslip {version} computes.

program/          the program, with loads, bearings and oils as its data; README.md there says how to install it
results/          its output: report.html, figures, summary.json, tables, and every run under studies/
environment.txt   Python and packages it was computed with
SHA256SUMS        checksums of all files; `sha256sum -c SHA256SUMS` compares them

To compute it again: `make reproduce` in program/. Energies agree to 1e-4 on other machines; times of stages do not.
"""


def _program() -> Iterator[Path]:
    """Files of the clone that the study needs, or that check it."""
    yield from (path for path in ROOT.iterdir() if path.is_file())
    for folder in _FOLDERS:
        paths = (path for path in (ROOT / folder).rglob("*") if path.is_file())
        yield from (
            path
            for path in paths
            if not {"__pycache__", "build"} & set(path.parts[len(ROOT.parts) :])
        )


def _environment() -> str:
    """Versions of Python and of what the package needs."""
    needed = (line for line in requires("macroslip") or [] if "extra ==" not in line)
    names = sorted(re.split(r"[^\w.-]", line, maxsplit=1)[0] for line in needed)
    lines = [
        f"Python {platform.python_version()}, {platform.machine()}",
        *(f"{name}=={version(name)}" for name in names),
    ]
    return "\n".join(lines) + "\n"


def archive(results: Path, target: Path) -> None:
    """Write the archive of a finished study.

    Raises
    ------
    InputError
        If the folder of results is not complete, or the archive exists.
    """
    missing = [name for name in (SUMMARY, REPORT) if not (results / name).is_file()]
    if missing:
        raise InputError(
            f"it has no {' and no '.join(missing)}",
            where=str(results),
            allowed="the folder that `make reproduce` has written to the end",
            remedy="Run make reproduce first.",
        )
    made = {
        "README.md": _README.format(version=macroslip.__version__),
        "environment.txt": _environment(),
    }
    content = {name: text.encode() for name, text in made.items()}
    files = {f"program/{path.relative_to(ROOT).as_posix()}": path for path in _program()}
    files |= {
        f"results/{path.relative_to(results).as_posix()}": path
        for path in results.rglob("*")
        if path.is_file()
    }
    check_new_file(target, force=False)
    with (
        new_file(target, force=False) as aside,
        aside.open("wb") as plain,
        # Loads and results are compressed already.
        gzip.GzipFile("", "wb", compresslevel=1, mtime=0, fileobj=plain) as packed,
        tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as tar,
    ):
        sums = []
        for name in sorted(content.keys() | files.keys()):
            data = content[name] if name in content else files[name].read_bytes()
            sums.append(f"{hashlib.sha256(data).hexdigest()}  {name}\n")
            _add(tar, name, data)
        _add(tar, SUMS, "".join(sums).encode())


def _add(tar: tarfile.TarFile, name: str, data: bytes) -> None:
    entry = tarfile.TarInfo(name)
    entry.size = len(data)
    tar.addfile(entry, io.BytesIO(data))


def main() -> int:
    """Exit code 0; 2 for a study that is not complete."""
    parser = argparse.ArgumentParser(prog="python -m paper.archive", description=__doc__)
    parser.add_argument(
        "results",
        type=Path,
        nargs="?",
        default=Path("results"),
        help="folder that make reproduce has written",
    )
    parser.add_argument(
        "-o", "--output", type=Path, default=Path("macroslip-study.tar.gz"), help="file to write"
    )
    options = parser.parse_args()
    try:
        archive(options.results, options.output)
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"written: {options.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
