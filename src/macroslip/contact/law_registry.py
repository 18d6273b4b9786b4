"""Laws of an interface by name: those that a case file may choose, and what to cite for each."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from macroslip.contact.interface import Interface
from macroslip.errors import InputError, MacroslipError


class LawList:
    """Names of the laws of one kind.

    Parameters
    ----------
    kind : str
        `film` or `traction`, the key in case files.
    reserved : tuple of str
        Names that mean something else under that key.
    """

    def __init__(self, kind: str, reserved: tuple[str, ...] = ()):
        self.kind = kind
        self._reserved = reserved
        self._entries: dict[str, tuple[Callable[[Interface], Any], str]] = {}

    def add(self, name: str, prepare: Callable[[Interface], Any], reference: str) -> None:
        """Add a law with what prepares it for an interface and what to cite for it.

        The module that registered a name may register it again, so that a law can be mended at a prompt.

        Raises
        ------
        InputError
            If the name is that of another module's law, or means something else.
        """
        owner = getattr(self._entries[name][0], "__module__", None) if name in self._entries else None
        if name in self._reserved or owner not in (None, getattr(prepare, "__module__", None)):
            raise InputError(
                f"the {self.kind} law '{name}' cannot be registered: the name is taken",
                allowed=f"a name other than {', '.join(sorted([*self.names(), *self._reserved]))}",
                remedy="Choose another name; a law that was changed in its file needs a new Python process",
            )
        self._entries[name] = (prepare, reference)

    def remove(self, name: str) -> None:
        """Take a law away again."""
        del self._entries[name]

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
            If there is no such law, with those that exist; or if it cannot be prepared.
        """
        if name not in self._entries:
            raise InputError(
                f"there is no {self.kind} law '{name}'",
                where=f"laws.{self.kind}",
                allowed=", ".join([*self._reserved, *self.names()]),
                remedy="Choose one of these, or register your own first: macroslip.load_laws(path of its file)",
            )
        law_of, remedy = f"{self.kind} law '{name}', {interface.name}", "Mend the law's function prepare."
        try:
            law = self._entries[name][0](interface)
        except MacroslipError:
            raise
        except Exception as error:
            reason = " ".join(str(error).split())[:200]
            raise InputError(f"{type(error).__name__} in prepare ({reason})", where=law_of, remedy=remedy) from error
        if not (isinstance(law, tuple) and hasattr(law, "_fields")):
            what = f"prepare gives {type(law).__name__} {law!r:.80}"
            raise InputError(what, where=law_of, allowed="a NamedTuple of the law's numbers", remedy=remedy)
        return law
