"""Units of files and options, their conversion to SI, and quantities written as text: "75 mm".

A value is converted as the decimal number that was typed and rounded once, so 70 mm is exactly the
float 0.07.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from numbers import Real

from macroslip.errors import InputError
from macroslip.input.messages import shown

#: Regular expression of a decimal number.
NUMBER_PATTERN = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"


def is_finite_number(value: object) -> bool:
    """True if a value is a real, finite number; a truth value is none."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return False
    try:
        return math.isfinite(value)
    except OverflowError:  # an integer beyond the largest float
        return False


def with_unit(value: object, unit: str) -> str:
    """A value as text with its unit behind it, if it has one.

    Examples
    --------
    >>> with_unit(70, "mm"), with_unit(28, "1"), with_unit(0.3614820474579369, "Pa s")
    ('70 mm', '28', '0.361482 Pa s')
    """
    text = f"{value}"
    if len(text) > 12 and isinstance(value, float):
        text = f"{value:.6g}"
    return text if unit == "1" else f"{text} {unit}"


@dataclass(frozen=True)
class Unit:
    """A unit by its distance from SI: SI value = (value + offset) * scale."""

    scale: Fraction
    offset: Fraction = Fraction(0)


@dataclass(frozen=True, eq=False, repr=False)
class Dimension:
    """Kind of quantity and its units, by their names in a file; the first one is SI."""

    units: Mapping[str, Unit]

    def __repr__(self) -> str:
        return f"Dimension({self.choices})"

    @property
    def choices(self) -> str:
        """The units as a file has them: a pure number's "1" needs its quotes."""
        return " or ".join('"1"' if unit == "1" else unit for unit in self.units)

    @property
    def si_unit(self) -> str:
        """Name of the SI unit."""
        return next(iter(self.units))

    def to_si(self, value: float, unit: str) -> float:
        """Convert a finite number in one of `units` to SI; infinite if it is too large for a float.

        Examples
        --------
        >>> LENGTH.to_si(70, "mm"), TEMPERATURE.to_si(35, "degC"), PRESSURE.to_si(210, "GPa")
        (0.07, 308.15, 210000000000.0)
        """
        chosen = self.units[unit]
        typed = Fraction(value) if isinstance(value, int) else Fraction(repr(value))
        try:
            return float((typed + chosen.offset) * chosen.scale)
        except OverflowError:
            return math.copysign(math.inf, value)

    def text(self, si_value: float, unit: str) -> str:
        """Write a finite SI value in one of the units.

        Examples
        --------
        >>> LENGTH.text(0.07, "mm"), ANGLE.text(0.25, "rad"), NUMBER.text(28, "1")
        ('70 mm', '0.25 rad', '28')
        """
        chosen = self.units[unit]
        value = float(Fraction(si_value) / chosen.scale - chosen.offset)
        return with_unit(f"{value:.6g}", unit)


def _dimension(**scales: Fraction | int) -> Dimension:
    return Dimension({name: Unit(Fraction(scale)) for name, scale in scales.items()})


LENGTH = _dimension(m=1, mm=Fraction(1, 10**3), um=Fraction(1, 10**6))
TIME = _dimension(s=1, ms=Fraction(1, 10**3), min=60)
SPEED = _dimension(**{"rad/s": 1, "rpm": Fraction(math.pi) / 30, "r/min": Fraction(math.pi) / 30})
WIND_SPEED = _dimension(**{"m/s": 1, "km/h": Fraction(10, 36)})
POWER = _dimension(W=1, kW=10**3, MW=10**6)
FORCE = _dimension(N=1, kN=10**3)
MOMENT = _dimension(**{"N m": 1, "kN m": 10**3})
PRESSURE = _dimension(Pa=1, MPa=10**6, GPa=10**9)
INVERSE_PRESSURE = _dimension(**{"1/Pa": 1, "1/GPa": Fraction(1, 10**9)})
ANGLE = _dimension(rad=1, mrad=Fraction(1, 10**3), deg=Fraction(math.pi) / 180)
TEMPERATURE = Dimension({"K": Unit(Fraction(1)), "degC": Unit(Fraction(1), Fraction("273.15"))})
#: What records of others are in too.
RECORDED_TEMPERATURE = Dimension(
    {**TEMPERATURE.units, "degF": Unit(Fraction(5, 9), Fraction("459.67"))}
)
TEMPERATURE_DIFFERENCE = _dimension(K=1)
STIFFNESS = _dimension(**{"N/m": 1, "kN/mm": 10**6, "MN/m": 10**6})
INVERSE_TEMPERATURE = _dimension(**{"1/K": 1})
KINEMATIC_VISCOSITY = _dimension(
    **{"m2/s": 1, "mm2/s": Fraction(1, 10**6), "cSt": Fraction(1, 10**6)}
)
VISCOSITY = _dimension(**{"Pa s": 1})
INVERSE_SPEED = _dimension(**{"s/m": 1})
CONDUCTIVITY = _dimension(**{"W/(m K)": 1})
CONDUCTANCE = _dimension(**{"W/K": 1})
SPECIFIC_HEAT = _dimension(**{"J/(kg K)": 1})
MASS = _dimension(kg=1, t=1000)
DENSITY = _dimension(**{"kg/m3": 1})
NUMBER = _dimension(**{"1": 1})


def number_advice(text: str) -> str:
    """Advice for a number that is not written as it has to be, by its likely cause; empty if none.

    Where a comma or a space may separate thousands or decimals, the advice is right for both.

    Examples
    --------
    >>> number_advice("17 600 kN")
    'Write 17600, without marks between thousands.'
    >>> number_advice("1,08 mm"), number_advice("75 mm")
    ('Use a decimal point, not a comma.', '')
    """
    if re.search(r"[\u2010-\u2015\u2212]\s*[\d.]", text):
        return "Its minus sign is another character (U+2212, for example); write a hyphen, -."
    number = re.match(r"\s*[+-]?(\d[\d.,'\u2019\s]*\d)", text)
    if number is None:
        return ""
    digits = re.sub(r"\D", "", number[1])
    marks = set(re.sub(r"\d", "", number[1]))
    groups = re.fullmatch(r"\d{1,3}(\D\d{3})+", number[1])
    if groups and marks <= {","}:
        return (
            f"Write {digits} if the comma separates thousands, "
            "and a decimal point if it separates decimals."
        )
    if groups and not marks & {",", "."}:
        return f"Write {digits}, without marks between thousands."
    if len(marks) > 1:
        return "Write a decimal point, and no marks between thousands."
    return "Use a decimal point, not a comma." if "," in marks else ""


def parse_quantity(
    quantity: str | float, dimension: Dimension, subject: str = "it", where: str = ""
) -> tuple[float, str]:
    """Number and unit of a quantity that is written as text.

    Parameters
    ----------
    quantity : str or float
        Text of number and unit; spaces of any kind may stand around and in the unit.
    dimension : Dimension
        Its units.
    subject, where : str
        Name and place of the quantity, for errors.

    Returns
    -------
    tuple
        The number as written, an integer where it was written as one, and the unit, "1" for a pure
        number.

    Raises
    ------
    InputError
        If the text is no number, has no unit or another one, or is too large for a float.

    Examples
    --------
    >>> parse_quantity("75 mm", LENGTH), parse_quantity("0.98", NUMBER)
    ((75, 'mm'), (0.98, '1'))
    """
    pure = dimension is NUMBER
    text = " ".join(str(quantity).split())

    def problem(why: str, remedy: str = "") -> InputError:
        allowed = "a number" if pure else f"a number with its unit, {dimension.choices}"
        return InputError(
            f"{subject} is {shown(quantity)}, which {why}",
            where=where,
            allowed=allowed,
            remedy=remedy,
        )

    # The text after the number must not be more of it; a unit may begin with a digit, as 1/GPa
    # does.
    match = re.fullmatch(rf"\s*(?P<number>{NUMBER_PATTERN})(?=[^\d.,]|$)\s*(?P<unit>.*?)\s*", text)
    if match is None:
        example = f"Write {with_unit(1, dimension.si_unit)}, for example."
        raise problem("is not a quantity", number_advice(text) or example)
    number = match["number"]
    unit = match["unit"] or ("1" if pure else "")
    if not unit:
        # Whoever left the unit out may mean any of them: a tilt of 5 is hardly one of 5 rad.
        examples = " or ".join(f"{number} {name}" for name in dimension.units)
        raise problem("does not give its unit", f"Write {examples}, whichever it is.")
    if unit not in dimension.units:
        remedy = "Write the number alone." if pure else "Convert it to one of these units."
        if re.match(r"['\u2019\d]", unit) and (advice := number_advice(text)):
            raise problem("is not a quantity", advice)
        raise problem(f"has the unit {shown(unit)}", remedy)
    value = float(number)
    is_finite = math.isfinite(value) and math.isfinite(dimension.to_si(value, unit))
    if not is_finite:
        raise problem("is too large for a number")
    return (int(value) if re.fullmatch(r"[+-]?\d{1,15}", number) else value), unit


def quantity_pattern(dimension: Dimension) -> str:
    """Regular expression, as JSON Schema has it, of the text that `parse_quantity` accepts.

    Examples
    --------
    >>> pattern = quantity_pattern(MASS)
    >>> bool(re.search(pattern, "519 kg")), bool(re.search(pattern, "519"))
    (True, False)
    """
    if dimension is NUMBER:
        return rf"^\s*{NUMBER_PATTERN}\s*$"
    units = "|".join(re.escape(unit).replace("\\ ", " ") for unit in dimension.units)
    return rf"^\s*{NUMBER_PATTERN}\s*({units})\s*$"
