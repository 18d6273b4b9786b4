"""Where compiled kernels are kept between processes: a folder for each state of the sources.

A kernel that outlives the sources it came from would be a wrong number without a sign. Numba notices a change in the
file of the function it compiled, but not in the files of the functions that were inlined into it. The folder is
therefore named by a hash of all sources a kernel can be made of.
"""

from __future__ import annotations

import contextlib
import functools
import os
import re
import shutil
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numba
import platformdirs

from macroslip.fingerprint import KERNEL_PARTS, fingerprint

#: Folders of other sources that stay: enough for a few versions, and for a few laws of one's own.
KEPT = 12
#: A folder that was used within this time may be in use still [s].
_IN_USE = 3600.0
#: Free space below which nothing is stored [bytes]; the kernels of one state of the sources take about 11 MB.
_SPACE = 64 * 2**20
_NAME = re.compile(r"[0-9a-f]{16}(-[0-9a-f]{12})?")


@functools.cache
def kernel_folder(laws: str = "") -> Path | None:
    """Folder for the kernels of the present sources, which is made if it is not there.

    It is in `macroslip` in the folder of the environment variable NUMBA_CACHE_DIR, or else in the cache folder of the
    user, or in a folder of the user's own among the temporary files. Of other states of the sources the newest stay.

    Parameters
    ----------
    laws : str
        Twelve hexadecimal digits that identify the user's own laws; none without such laws.

    Returns
    -------
    Path or None
        None where no folder can be written, or the disk is full: then every process compiles for itself.
    """
    name = fingerprint(*KERNEL_PARTS)[:16] + (f"-{laws}" if laws else "")
    for home in _homes():
        folder = home / name
        with contextlib.suppress(OSError):
            folder.mkdir(parents=True, exist_ok=True)
            os.utime(folder)
            tempfile.TemporaryFile(dir=folder).close()
            if shutil.disk_usage(folder).free >= _SPACE:
                _remove_old(home)
                return folder
    return None


def _homes() -> Iterator[Path]:
    """Folders for all states of the sources, best first."""
    if numba.config.CACHE_DIR:
        yield Path(numba.config.CACHE_DIR).absolute() / "macroslip"
        return
    user = Path(platformdirs.user_cache_path("macroslip", appauthor=False))
    if user.is_absolute():  # it is not where the user has no home folder
        yield user / "kernels"
    with contextlib.suppress(OSError):
        # Kernels are programs. Among the temporary files, which others may write, only a folder that is the user's own
        # and closed to others will do.
        number = os.getuid() if hasattr(os, "getuid") else None
        temporary = Path(tempfile.gettempdir()) / ("macroslip" if number is None else f"macroslip-{number}")
        temporary.mkdir(mode=0o700, exist_ok=True)
        status = temporary.lstat()
        if number is None or (status.st_uid == number and status.st_mode & 0o170077 == 0o040000):
            yield temporary


def _remove_old(home: Path) -> None:
    """Remove the folders of other sources but for the newest."""
    used = {}
    for folder in home.iterdir():
        # Another process may remove it at the same time.
        with contextlib.suppress(OSError):
            if _NAME.fullmatch(folder.name) and folder.is_dir():
                used[folder] = folder.stat().st_mtime
    for folder in sorted(used, key=used.__getitem__, reverse=True)[KEPT:]:
        if used[folder] < time.time() - _IN_USE:
            shutil.rmtree(folder, ignore_errors=True)
