"""Laws of an interface by name: what a case file may ask for, and what to cite for it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from macroslip.contact.interface import Interface
from macroslip.errors import InputError


class LawList:
    """Names of the laws of one kind.

    Parameters
    ----------
    kind : str
        `film` or `traction`, the key in case files.
    """

    def __init__(self, kind: str):
        self.kind = kind
        self._entries: dict[str, tuple[Callable[[Interface], Any], str]] = {}

    def add(self, name: str, prepare: Callable[[Interface], Any], reference: str) -> None:
        """Add a law with what prepares it for an interface and what to cite for it."""
        self._entries[name] = (prepare, reference)

    def names(self) -> list[str]:
        """Names of the laws."""
        return sorted(self._entries)

    def reference(self, name: str) -> str:
        """What to cite where the law called `name` was used."""
        return self._entries[name][1]

    def prepare(self, name: str, interface: Interface) -> Any:
        """The law called `name`, prepared for an interface.

        Raises
        ------
        InputError
            If there is no such law; the message lists those that exist.
        """
        if name not in self._entries:
            raise InputError(
                f"there is no {self.kind} law '{name}'",
                where=f"laws.{self.kind}",
                allowed=", ".join(self.names()),
                remedy="Choose one of these",
            )
        return self._entries[name][0](interface)
