"""The page prints what it says it prints."""

import contextlib
import io
import re
from pathlib import Path

import numpy as np
import pytest

from macroslip import Bearing, Lubricant
from macroslip.torque import OilBath, skf_torque
from macroslip.torque.handbooks import SKF_SERIES as SERIES

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "friction-torque.md").read_text(encoding="utf-8")
NOTES = (DOCS / "notes" / "friction-torque.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```python\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def printed(code):
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(code, {})
    return out.getvalue()


SHOWN = re.findall(r"^prints\n\n```\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def test_numbers_of_the_base_bearing():
    assert printed(BLOCKS[0]) == SHOWN[0]


@pytest.mark.slow
def test_numbers_of_the_computed_torque():
    # Digits may turn over from one processor to the next.
    computed, shown = (re.findall(r"[\d.]+", text) for text in (printed(BLOCKS[1]), SHOWN[1]))
    assert [float(number) for number in computed] == pytest.approx(
        [float(number) for number in shown], rel=5e-3, abs=0.011
    )


def test_numbers_of_the_oil_bath():
    case = (
        Bearing.read("skf-240-600-bc"),
        Lubricant.read("vg460-pao"),
        344.1e3,
        164.4e3,
        20.463 * np.pi / 30,
    )
    grease, bath = (
        skf_torque(*case),
        skf_torque(*case, bath=OilBath(level=0.441, drag_variable=0.0)),
    )
    assert f"up to {bath.rolling - grease.rolling:.0f} N m of rolling torque here" in PAGE
    assert f"the drag is {bath.drag:.0f} N m if the oil reaches the shaft's axis" in PAGE


@pytest.mark.parametrize("viscosity", [500, 600])
def test_numbers_at_the_edge_of_the_range(viscosity):
    oil = Lubricant.read("vg460-pao")
    oil = oil.replace(viscosity=viscosity * 1e-6 * oil.density)
    total = skf_torque(
        Bearing.read("skf-240-600-bc"), oil, 344.07e3, 164.36e3, 20.463 * 3.141593 / 30
    ).total
    assert f"{total:.0f} N m at {viscosity} mm²/s" in PAGE


def test_constants_of_the_table():
    for row, constants in zip(("R1, R2, R3, R4", "S1, S2, S3, S4"), SERIES["240"], strict=True):
        (values,) = re.findall(rf"^\| {row} \| (.*?) \|", NOTES, re.MULTILINE)
        assert tuple(map(float, values.split(", "))) == constants
