"""Numbers as pages and commands print them."""

from __future__ import annotations

import math
from typing import Any


def number(value: Any, digits: int = 4) -> str:
    """A number, or a dash where there is none; without a power of ten up to a thousand million.

    Examples
    --------
    >>> number(1234.56), number(0.5, 3), number(2605123.0, 3), number(float("nan")), number(None)
    ('1235', '0.5', '2,610,000', '–', '–')
    """
    if value is None or not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}g}"
    return f"{float(text):,.0f}" if "e+0" in text else text
