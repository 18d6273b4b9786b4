"""Optional packages: which command needs which, and the line that installs them."""

from __future__ import annotations

import importlib.util
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

from macroslip.errors import MacroslipError


class Need(NamedTuple):
    """Packages that a use of the program needs, by the name of their import, and their extra."""

    use: str
    packages: tuple[str, ...]
    extra: str


FIGURES = Need("a page or a picture", ("matplotlib", "jinja2"), "figures")
PICTURE = Need("a picture", ("matplotlib",), "figures")
EXCEL = Need("a workbook of Excel", ("openpyxl",), "excel")
SCHEDULER = Need("--scheduler", ("dask", "distributed"), "cluster")

#: Packages that the commands need beyond the package's own dependencies.
COMMANDS: Mapping[str, Need] = MappingProxyType(
    {
        "macroslip report": FIGURES,
        "macroslip scada year": FIGURES,
        "macroslip loads inspect -o": PICTURE,
        "macroslip bearing draw": PICTURE,
        "macroslip scada heat": FIGURES,
        "macroslip study --scheduler": SCHEDULER,
        "--xlsx, loads in .xlsx": EXCEL,
    }
)


def missing_packages(need: Need) -> list[str]:
    """Packages of a need that are not installed.

    Examples
    --------
    >>> missing_packages(Need("nothing", ("json",), "all"))
    []
    >>> missing_packages(Need("more", ("json", "no_such_package"), "all"))
    ['no_such_package']
    """
    return [name for name in need.packages if importlib.util.find_spec(name) is None]


def require(*needs: Need) -> None:
    """Refuse a use of the program that lacks a package, or whose figures cannot be drawn.

    Raises MacroslipError with the packages and the line that installs them, or with what keeps
    Matplotlib from starting.
    """
    for need in needs:
        if lacking := ", ".join(missing_packages(need)):
            remedy = f"Install with: pip install 'macroslip[{need.extra}]'"
            raise MacroslipError(f"not installed, but needed for {need.use}: {lacking}. {remedy}")
    if any("matplotlib" in need.packages for need in needs):
        try:
            importlib.import_module("matplotlib")
        except (OSError, ValueError) as error:
            raise MacroslipError(
                f"Matplotlib, which draws the pictures, does not start: {error}. It reads a file "
                "'matplotlibrc' of the current folder or of your home; move that file away, or "
                "write it as UTF-8 text."
            ) from None
