"""The numbers of `tools/golden.py` hold: each case within its bounds, and the paper's verdicts as they were."""

import pytest

from tools import golden

#: Tables that reach down to standstill take minutes at the tolerance of the numbers; shorter tests have both.
LONG = ("short-physical-reversal", "short-physical-standstill")


@pytest.mark.slow
@pytest.mark.parametrize(
    "case",
    [
        pytest.param(name, marks=[pytest.mark.deep] if name in LONG else [])
        for name in golden.cases()
    ],
)
def test_numbers_are_what_they_were(case):
    ratio, name = golden.check(case)[case]
    assert ratio <= 1.0, f"{name} of {case} is off by {ratio:.3g} times its bound"


def test_every_case_is_stored():
    assert set(golden.json.loads(golden.FILE.read_text())) == set(golden.cases())
