"""A quantity written as text: a number and its unit, such as "75 mm"."""

from __future__ import annotations

import math
import re

from macroslip.catalogue.problems import shown
from macroslip.catalogue.units import NUMBER, Dimension
from macroslip.errors import InputError

NUMBER_PATTERN = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
"""Regular expression of a decimal number."""


def parse_quantity(text: str, dimension: Dimension, what: str = "", where: str = "") -> tuple[float, str]:
    """Split text into number and unit, and check both.

    Parameters
    ----------
    text : str
        Number and unit; a pure number has no unit.
    dimension : Dimension
        Units that are allowed.
    what : str
        Name of the quantity, for messages that do not begin with the text itself.
    where : str
        File and line, for messages.

    Returns
    -------
    tuple[float, str]
        The number as written, an integer where it was written as one, and the unit, "1" for a pure number.

    Raises
    ------
    InputError
        If the text is no number, has no unit or another one, or is too large for a float.

    Examples
    --------
    >>> from macroslip.catalogue.units import LENGTH, NUMBER
    >>> parse_quantity("75 mm", LENGTH), parse_quantity("0.98", NUMBER)
    ((75, 'mm'), (0.98, '1'))
    """
    pure, subject = dimension is NUMBER, f"{what} is {shown(text)}, which" if what else shown(text)
    allowed = "a number" if pure else f"a number with its unit, {dimension.choices}"
    # What follows the number must not be more of it; a unit may begin with a digit, as 1/GPa does.
    match = re.fullmatch(rf"\s*(?P<number>{NUMBER_PATTERN})(?=[^\d.,]|$)\s*(?P<unit>.*?)\s*", text)
    if match is None:
        decimal = re.match(r"\s*[+-]?\d+,\d", text)
        example = "1" if pure else f"1 {dimension.si_unit}"
        remedy = "Use a decimal point, not a comma." if decimal else f"Write {example}, for example."
        raise InputError(f"{subject} is not a quantity", where=where, allowed=allowed, remedy=remedy)
    number, unit = match["number"], match["unit"] or ("1" if pure else None)
    if unit is None:
        # Whoever left the unit out may mean any of them: a tilt of 5 is hardly one of 5 rad.
        examples = [f"{number} {name}" for name in dimension.units]
        remedy = f"Write {' or '.join(map(shown, examples) if what else examples)}, whichever it is."
        raise InputError(
            f"{subject} {'does not give its' if what else 'has no'} unit", where=where, allowed=allowed, remedy=remedy
        )
    if unit not in dimension.units:
        remedy = "Write the number alone." if pure else "Convert it to one of these units."
        raise InputError(
            f"{what or shown(text)} has the unit {shown(unit)}", where=where, allowed=allowed, remedy=remedy
        )
    value = float(number)
    if not math.isfinite(value) or not math.isfinite(dimension.to_si(value, unit)):
        raise InputError(f"{subject} is too large for a number", where=where, allowed=allowed)
    return (int(value) if re.fullmatch(r"[+-]?\d{1,15}", number) else value), unit


def quantity_pattern(dimension: Dimension) -> str:
    """Regular expression, as JSON Schema has it, of the text that `parse_quantity` accepts.

    Examples
    --------
    >>> from macroslip.catalogue.units import MASS
    >>> import re
    >>> bool(re.search(quantity_pattern(MASS), "519 kg")), bool(re.search(quantity_pattern(MASS), "519"))
    (True, False)
    """
    if dimension is NUMBER:
        return rf"^\s*{NUMBER_PATTERN}\s*$"
    units = "|".join(re.escape(unit).replace("\\ ", " ") for unit in dimension.units)
    return rf"^\s*{NUMBER_PATTERN}\s*({units})\s*$"
