"""Files that are not what they should be: endless, deep, large, somebody else's."""

import os
import stat
import threading
import time

import pytest

from macroslip import Bearing
from macroslip.errors import InputError
from macroslip.input.files import MOST_BYTES, MOST_LEVELS, MOST_NODES, parse, read_text

QUICK = 5.0
"""Seconds that no refusal takes."""


def refusal(text):
    """The message for a text, which has to come soon and be short."""
    start = time.perf_counter()
    with pytest.raises(InputError) as caught:
        parse(text, "mine.yaml")
    assert time.perf_counter() - start < QUICK
    message = str(caught.value)
    assert message.startswith("mine.yaml") and "\n" not in message and len(message) < 5000
    return message


def nested_aliases(levels, width):
    lines = ["a0: &a0 [1, 2]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * width)}]" for n in range(1, levels)]
    return "\n".join(lines) + "\n"


def test_nested_aliases_are_counted_before_they_are_written_out():
    message = refusal(nested_aliases(levels=12, width=10))  # 2e11 nodes
    assert f"more than {MOST_NODES} keys and values" in message and message.endswith(
        "Is it the file you meant?"
    )
    assert (
        len(parse(nested_aliases(levels=3, width=10), "mine.yaml")[0]["a2"]) == 10
    )  # 100 nodes are fine


def test_merged_aliases_are_counted_too():
    keys = ", ".join(f"k{n}: {n}" for n in range(100))
    merges = "".join(f"m{n}: {{<<: *base}}\n" for n in range(100))
    assert "keys and values" in refusal(f"base: &base {{{keys}}}\n{merges}")


@pytest.mark.parametrize("text", ["a: &x [*x]\n", "a: &x {b: *x}\n", "&x {? *x : 1}\n"])
def test_an_alias_that_contains_itself(text):
    assert "an alias that contains itself" in refusal(text)


@pytest.mark.parametrize(
    "text", ["a: " + "[" * 2000, "a: " + "{b: " * 2000, "[" * 2000 + "]" * 2000]
)
def test_two_thousand_brackets(text):
    assert f"more than {MOST_LEVELS} levels" in refusal(text)


def test_deep_indentation():
    text = "".join(" " * n + f"k{n}:\n" for n in range(200))
    assert f"more than {MOST_LEVELS} levels" in refusal(text)


def test_sixty_thousand_unknown_keys():
    assert "keys and values" in refusal("".join(f"k{n}: {n}\n" for n in range(60_000)))


def test_as_many_unknown_keys_as_a_file_may_have():
    entries = {f"key_{n}": n for n in range(MOST_NODES // 2)} | {"name": "mine"}
    start = time.perf_counter()
    with pytest.raises(
        InputError,
        match=r"^5000 problems: \(1\) the key 'key_0' is unknown.* And 49[0-9]{2} more.$",
    ) as caught:
        Bearing.from_dict(entries)
    assert time.perf_counter() - start < 20 and len(str(caught.value)) < 30_000


def test_a_long_key_is_compared_and_shown_in_part():
    with pytest.raises(InputError) as caught:
        Bearing.from_dict({"name": "mine", "k" * 100_000: 1})
    assert len(str(caught.value)) < 5000


@pytest.mark.slow
def test_a_file_in_the_bounds_is_read_whole():
    text = "".join(f"k{n}: [{n}, {{v: {n}}}]\n" for n in range(MOST_NODES // 6))
    data, source = parse(text, "mine.yaml")
    assert (
        len(data) == MOST_NODES // 6
        and data["k7"] == [7, {"v": 7}]
        and source.where("k7") == "mine.yaml, line 8"
    )


def test_a_long_file(tmp_path):
    (tmp_path / "mine.yaml").write_bytes(b"#" * (MOST_BYTES + 1))
    with pytest.raises(
        InputError, match=f"the file is too long. Allowed: at most {MOST_BYTES} bytes"
    ):
        Bearing.read(tmp_path / "mine.yaml")
    (tmp_path / "mine.yaml").write_bytes(b"#" * MOST_BYTES)
    assert len(read_text(tmp_path / "mine.yaml", "no file")) == MOST_BYTES


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="named pipes are a thing of Unix")
def test_pipes_and_devices_are_refused_without_waiting(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    messages = []

    def read():
        try:
            Bearing.read(tmp_path / "pipe")
        except InputError as error:
            messages.append(str(error))

    thread = threading.Thread(target=read, daemon=True)
    thread.start()
    thread.join(QUICK)
    assert len(messages) == 1 and "(it is a pipe, a socket or a device, not a file)" in messages[0]
    assert stat.S_ISCHR(os.stat("/dev/zero").st_mode)
    with pytest.raises(InputError, match="it is a pipe, a socket or a device, not a file"):
        Bearing.read("/dev/zero")


def test_a_key_that_cannot_be_looked_up():
    with pytest.raises(
        InputError, match=r"mine\.yaml: this is not valid YAML \(a key is a mapping of mappings\)"
    ):
        parse("title: mine\n? {a: {b: 1}}\n: 2\n", "mine.yaml")


@pytest.mark.parametrize("name", ["a\0b.yaml", "a\ud800.yaml"])
def test_a_name_that_no_file_can_have(name):
    with pytest.raises(
        InputError, match=r"no bearing can be read from 'a\\.*\(no file can have this name\)"
    ) as caught:
        Bearing.read(name)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("text", ['"a\\0b"', '"a\\nb"', '"\\ud800"', '"' + "a" * 3000 + '"'])
def test_text_that_results_cannot_hold(text, tmp_path):
    good = Bearing.read("skf-240-600-bc").as_yaml()
    for old, new in (
        ("name: skf-240-600-bc", f"name: {text}"),
        ('note: "catalogue, d"', f"note: {text}"),
    ):
        assert good.count(old) == 1
        (tmp_path / "mine.yaml").write_text(good.replace(old, new), encoding="utf-8")
        with pytest.raises(
            InputError,
            match="Allowed: at most 2000 characters on one line|Allowed: non-empty text|zero byte|not valid YAML",
        ) as caught:
            Bearing.read(tmp_path / "mine.yaml")
        assert str(caught.value).isprintable()


@pytest.mark.parametrize(
    "text",
    [
        "root:x:0:0:root:/root:/bin/bash\nsecret:x:1:1::/:/bin/sh\n",
        "secret=hunter2\nother=secret\n",
        "password: secret\nuser: secret\n",
        "- secret\n",
        "secret",
        "12345\n",
        "# comment\nsecret\n",
        "-----BEGIN KEY-----\nsecret\n-----END KEY-----\n",
    ],
)
def test_another_file_is_not_shown_to_whoever_reads_the_message(text, tmp_path):
    (tmp_path / "other").write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Bearing.read(tmp_path / "other")
    message = str(caught.value).replace(str(tmp_path), "")
    assert not any(word in message for word in ("secret", "hunter2", "password", "root", "12345"))


def test_a_range_beyond_what_the_quantity_may_be():
    entries = Bearing.read("skf-240-600-bc").as_dict()
    entries["osculation_inner"]["range"] = [0.97, 1.01]
    with pytest.raises(
        InputError, match="^osculation_inner.range: it goes to 1.01. Allowed: above 0.9 and below 1"
    ):
        Bearing.from_dict(entries)
