"""The numbers of `tools/golden.py` hold: each case within its bounds, and the paper's verdicts as they were."""

import pytest

from tools import golden


@pytest.mark.slow
@pytest.mark.parametrize("case", golden.cases())
def test_numbers_are_what_they_were(case):
    ratio, name = golden.check(case)[case]
    assert ratio <= 1.0, f"{name} of {case} is off by {ratio:.3g} times its bound"


def test_every_case_is_stored():
    assert set(golden.json.loads(golden.FILE.read_text())) == set(golden.cases())
