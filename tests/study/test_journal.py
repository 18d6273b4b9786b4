"""The journal: what was written is read, what was torn or damaged counts as never written."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from macroslip.study import journal as module
from macroslip.study.journal import Journal, decode, encode, records

RECORDS = [
    {"run": f"{number:032x}", "reason": "ä\n\t" * number, "values": {"energy": [0.1 * number, float("nan")]}}
    for number in range(4)
]


def written(path, some=RECORDS):
    log = Journal(path)
    log.append(some)
    log.close()


def same(found, expected):
    return repr(found) == repr(expected)  # NaN is not equal to itself


def test_what_was_written_is_read(tmp_path):
    path = tmp_path / "journal"
    written(path, RECORDS[:2])
    written(path, RECORDS[2:])
    assert same(list(records(path)), RECORDS)
    assert list(records(tmp_path / "none")) == []


def test_a_journal_cut_anywhere_keeps_its_whole_lines_and_goes_on(tmp_path):
    whole = b"".join(encode(record) for record in RECORDS)
    ends = [len(b"".join(encode(record) for record in RECORDS[:count])) for count in range(len(RECORDS) + 1)]
    for cut in range(len(whole)):
        path = tmp_path / "journal"
        path.write_bytes(whole[:cut])
        kept = sum(end <= cut for end in ends) - 1
        assert same([record for record in records(path) if record is not None], RECORDS[:kept])
        written(path, RECORDS[3:])
        assert same(list(records(path)), [*RECORDS[:kept], RECORDS[3]])


@given(st.integers(0, 10**6), st.integers(1, 255))
def test_a_changed_byte_is_found(place, change):
    line = bytearray(encode(RECORDS[2]))
    line[place % (len(line) - 1)] ^= change
    assert decode(bytes(line)) is None


def test_a_batch_that_cannot_be_flushed_is_taken_back(tmp_path, monkeypatch):
    path = tmp_path / "journal"
    log = Journal(path)
    log.append(RECORDS[:1])

    def full(descriptor):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module, "flush", full)
    with pytest.raises(OSError):
        log.append(RECORDS[1:])
    log.close()
    assert same(list(records(path)), RECORDS[:1])
