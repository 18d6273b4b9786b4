"""Random damage to a valid file: what disks, networks, editors and people do to it."""

import json
import re
import struct

from hypothesis import strategies as st

_NUMBER = re.compile(rb"[-+]?\d[\d.]*(?:[eE][-+]?\d+)?")
_TOKEN = re.compile(rb"[^\s,\[\]{}]+")
_NUMBERS = [
    b"0", b"-1", b"1e308", b"-1e308", b"1e-308", b"1e999", b"nan", b"inf", b"-inf", b"9" * 400, b"9223372036854775808",
    b"4294967296", b"0x7fffffff", b"1_000", b"1,5", b"--1", b"1e", b"",
]  # fmt: skip
_PIECES = [
    b"\0", b"\xff\xfe", b"\r", b"\n", b"\n\n", b"\t", b"\x1b[31m", b"\xe9", b"\xe2\x80\xae", b"\xef\xbb\xbf", b"'", b'"', b"#",
    b": ", b"- ", b", ", b"? ", b"| ", b"&a [*a]", b"*a", b"<<: *a", b"!!python/object/apply:os.getcwd []", b"!!set {1, 2}",
    b"2001-02-31", b"[" * 3000, b"{a: " * 3000, b"k" * 50_000, b"1 " * 20_000, b"%s%n", b"$(id)", b"../../..",
]  # fmt: skip
_PACKED = [
    struct.pack(layout, value)
    for layout, values in (
        ("<h", (-1, 0, 2**15 - 1, -(2**15))),
        ("<i", (-1, 0, 2**31 - 1, -(2**31), 10**6)),
        ("<q", (-1, 2**63 - 1, 2**40)),
        ("<d", (float("nan"), float("inf"), -1.0, 0.0, 1e308, 5e-324)),
        ("<f", (float("nan"), float("inf"))),
    )
    for value in values
]
_ODD = [
    None, True, False, 0, -1, 1e308, -1e308, 5e-324, 10**400, 2**63, "", " ", "nan", "inf", ".nan", "auto", "all", "none", "0 m",
    "1e308 s", "1e-300 s", "-1 mm", "nan kN", "1 parsec", "1 kN kN", "kN", "a\0b", "a" * 10_000, "/dev/zero", "/", ".", "..", "~",
    "nothing.yaml", "nothing.csv", "\x1b[31m", "\u202e", "\ud7ff", [], [[]], [None], [0, 0], [-1], [10**9], list(range(2000)), {},
    {"": ""}, {"value": 1}, {"value": 1, "unit": "m"}, {"value": [1], "unit": {}}, {"a": {"a": {"a": {"a": {}}}}},
    {f"key_{number}": number for number in range(3000)},
]  # fmt: skip


def _place(draw, content):
    return draw(st.integers(0, len(content)))


def _flip(draw, content):
    position = min(_place(draw, content), len(content) - 1)
    return (
        content[:position]
        + bytes([content[position] ^ (1 << draw(st.integers(0, 7)))])
        + content[position + 1 :]
    )


def _cut(draw, content):
    return content[: _place(draw, content)]


def _insert(draw, content):
    position = _place(draw, content)
    return content[:position] + draw(st.sampled_from(_PIECES)) + content[position:]


def _remove(draw, content):
    position = _place(draw, content)
    return content[:position] + content[position + draw(st.sampled_from([1, 2, 7, 80, 1000])) :]


def _repeat(draw, content):
    first, last = sorted((_place(draw, content), _place(draw, content)))
    last = min(last, first + 2000)
    return content[:last] + content[first:last] * draw(st.sampled_from([1, 2, 20])) + content[last:]


def _overwrite(draw, content):
    position, new = _place(draw, content), draw(st.sampled_from(_PACKED))
    return content[:position] + new + content[position + len(new) :]


def _chosen(draw, pattern, content):
    spans = [match.span() for match in pattern.finditer(content[:200_000])]
    return draw(st.sampled_from(spans)) if spans else (0, 0)


def _number(draw, content):
    first, last = _chosen(draw, _NUMBER, content)
    return content[:first] + draw(st.sampled_from(_NUMBERS)) + content[last:]


def _swap(draw, content):
    (a, b), (c, d) = sorted((_chosen(draw, _TOKEN, content), _chosen(draw, _TOKEN, content)))
    return (
        content if b > c else content[:a] + content[c:d] + content[b:c] + content[a:b] + content[d:]
    )


@st.composite
def damaged(draw, content, binary=False, most=3):
    """Content with one to `most` kinds of damage."""
    kinds = [_flip, _cut, _insert, _remove, _repeat, _overwrite] + (
        [] if binary else [_number, _number, _swap]
    )
    for _ in range(draw(st.integers(1, most))):
        content = draw(st.sampled_from(kinds))(draw, content or b" ")
    return content


def _paths(data, path=()):
    yield path
    items = (
        data.items()
        if isinstance(data, dict)
        else enumerate(data)
        if isinstance(data, list)
        else ()
    )
    for key, value in items:
        yield from _paths(value, (*path, key))


def _changed(data, path, change):
    """A copy of data in which what stands at the path is what `change` makes of it; None leaves it out."""
    if not path:
        return change(data)
    items = dict(data) if isinstance(data, dict) else dict(enumerate(data))
    items[path[0]] = _changed(items[path[0]], path[1:], change)
    return items if isinstance(data, dict) else list(items.values())


@st.composite
def misshapen(draw, data):
    """Plain data, written as YAML, with values of another kind, keys renamed, added or left out."""
    for _ in range(draw(st.integers(1, 3))):
        path = draw(st.sampled_from(list(_paths(data))))
        odd = draw(st.sampled_from(_ODD))
        key = draw(
            st.sampled_from(
                ["", "a\0b", "loads", "file", "values", "1", "k" * 5000, "<<", "=", "__class__"]
            )
        )
        kind = draw(st.sampled_from(["replace", "replace", "wrap", "list", "add", "drop"]))
        change = {
            "replace": lambda value: odd,
            "wrap": lambda value: {key: value},
            "list": lambda value: [value, value],
            "add": lambda value: value | {key: odd} if isinstance(value, dict) else odd,
            "drop": lambda value: (
                dict(list(value.items())[1:]) if isinstance(value, dict) else None
            ),
        }[kind]
        data = _changed(data, path, change)
    return json.dumps(data, ensure_ascii=False).encode("utf-8", "surrogatepass")
