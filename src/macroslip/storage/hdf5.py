"""Check of HDF5 files of unknown origin in a child process: the library may hang on damaged ones.

A flipped byte can make a list within the file point at itself, which HDF5 follows for ever, without
reacting to an interrupt, or it may end the whole process. So a process of its own reads the file
first, with bounds on its time and memory. A link leads to another file, a pipe, or many times to
the same numbers, past these bounds: a file whose content is not all in itself, once, is refused.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from macroslip.errors import InputError
from macroslip.machine import process_environment

#: Processor time [s] for a file; time by the clock is ten times longer.
_SECONDS = 5.0
#: Bytes read in a second beside it.
_RATE = 10e6
#: Bytes that a file may announce for each byte it has: well beyond what compression gains.
_MOST_EXPANSION = 200
#: Bytes that any file may announce.
_MOST_SMALL = 50_000_000

_READER = f"""
import os, sys
seconds, *paths = sys.argv[1:]
try:
    import resource
    resource.setrlimit(resource.RLIMIT_CPU, (int(float(seconds)) + 1,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
except (ImportError, ValueError, OSError):
    pass
import h5py
expansion, small = {_MOST_EXPANSION!r}, {_MOST_SMALL!r}
for path in paths:
    print(flush=True)  # names of files need not be text
    most = max(small, expansion * os.path.getsize(path))
    with h5py.File(path, "r") as file:
        announced = 0
        def name_of_link(name, link):
            return None if isinstance(link, h5py.HardLink) else name
        link = file.visititems_links(name_of_link)
        if link is not None:
            raise ValueError(f"{{link}} is a link to another place")
        def visit(name, found):
            global announced
            if name != "/" and h5py.h5o.get_info(found.id).rc > 1:
                raise ValueError(f"{{name}} has a second name")
            dict(found.attrs)
            if isinstance(found, h5py.Dataset):
                if found.external or found.is_virtual:
                    raise ValueError(f"the numbers of {{name}} are in another place")
                announced += found.size * found.dtype.itemsize
                if announced > most:
                    raise ValueError(f"it announces more than {{most}} bytes")
                found[()]
        visit("/", file)
        file.visititems(visit)
"""


def check_hdf5(paths: Sequence[Path], remedy: str) -> None:
    """Refuse the first of files that HDF5 cannot read to its end in bounds, or that holds links."""
    seconds = sum(_SECONDS + path.stat().st_size / _RATE for path in paths)
    command = [
        sys.executable,
        "-P",
        "-c",
        _READER,
        str(seconds),
        *(str(path.absolute()) for path in paths),
    ]
    try:
        done = subprocess.run(
            command,
            stdin=subprocess.DEVNULL,
            env=process_environment(),
            capture_output=True,
            text=True,
            timeout=60.0 + 10.0 * seconds,
            check=False,
        )
        if done.returncode == 0:
            return
        begun = done.stdout
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        reason = (
            lines[-1]
            if done.returncode == 1 and lines
            else "the HDF5 library did not finish reading it"
        )
    except subprocess.TimeoutExpired as late:
        begun = (late.stdout or b"").decode(errors="replace")
        reason = "the HDF5 library did not finish reading it"
    number = max(0, len(begun.splitlines()) - 1)
    raise InputError(
        f"the file cannot be read as netCDF or HDF5 ({reason})",
        where=str(paths[number]),
        remedy=remedy,
    )
