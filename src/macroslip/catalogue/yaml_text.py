"""Text of a catalogue file from its content."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from io import StringIO
from typing import TYPE_CHECKING, Any

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap
from ruamel.yaml.scalarstring import DoubleQuotedScalarString

from macroslip.catalogue.entry import TAGS

if TYPE_CHECKING:
    from pydantic.fields import FieldInfo

_WIDTH = 120


def yaml_text(entries: Mapping[str, Any], noun: str, fields: Mapping[str, FieldInfo]) -> str:
    """Write the content of a catalogue file, with what every key means in the line above it.

    Parameters
    ----------
    entries : Mapping[str, Any]
        As `Record.as_dict` gives them.
    noun : str
        What the file describes.
    fields : Mapping[str, FieldInfo]
        Fields of the record by key, for their description.

    Returns
    -------
    str
        YAML 1.2, one line an entry.
    """
    tags = ", ".join(f"{tag} {meaning}" for tag, meaning in TAGS.items())
    header = (
        f"A {noun} file of macroslip. Every quantity has a value and its unit; where it comes from (tag), a note and the "
        f"range of values it may have are optional. Tags: {tags}. Short form: width, say, as 272 mm."
    )
    lines = [f"# {line}" for line in textwrap.wrap(header, _WIDTH - 2)] + [""]
    for key, entry in entries.items():
        lines += [f"# {line}" for line in textwrap.wrap(_sentence(fields[key].description or key), _WIDTH - 2)]
        lines.append(_line(key, entry))
    return "\n".join(lines) + "\n"


def _sentence(description: str) -> str:
    return f"{description[0].upper()}{description[1:]}."


def _line(key: str, entry: Any) -> str:
    """One entry in flow style on one line; the library quotes what needs quotes."""
    if isinstance(entry, Mapping):
        entry = CommentedMap({name: _quoted(name, value) for name, value in entry.items()})
        entry.fa.set_flow_style()
    else:
        entry = _quoted(key, entry)
    writer, out = YAML(typ="rt", pure=True), StringIO()
    writer.width = 2**30  # never wrap
    writer.default_flow_style = False
    writer.dump(CommentedMap({key: entry}), out)
    return out.getvalue().rstrip("\n")


def _quoted(name: str, value: Any) -> Any:
    """Free text, and the unit of a pure number, get quotes, as the shipped files have them."""
    return DoubleQuotedScalarString(value) if name == "note" or value == "1" else value
