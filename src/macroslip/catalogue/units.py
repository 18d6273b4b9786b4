"""Units a catalogue or case file may use, and their conversion to SI.

A value is converted as the decimal number that was typed and rounded once, so 70 mm is exactly the float 0.07.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction


def with_unit(value: object, unit: str) -> str:
    """A value as text with its unit behind it, if it has one.

    Examples
    --------
    >>> with_unit(70, "mm"), with_unit(28, "1")
    ('70 mm', '28')
    """
    return f"{value}" if unit == "1" else f"{value} {unit}"


@dataclass(frozen=True)
class Unit:
    """A unit by its distance from SI: SI value = (value + offset) * scale."""

    scale: Fraction
    offset: Fraction = Fraction(0)


@dataclass(frozen=True, eq=False, repr=False)
class Dimension:
    """A kind of quantity and the units it may be given in; the first one is SI.

    Parameters
    ----------
    units : Mapping[str, Unit]
        Units by their name in the file.
    """

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
        """Convert a finite number to SI.

        Parameters
        ----------
        value : float
            Number as written [unit].
        unit : str
            One of `units`.

        Returns
        -------
        float
            SI value; infinite if it is too large for a float.

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
        number = f"{float(Fraction(si_value) / chosen.scale - chosen.offset):.6g}"
        return with_unit(number, unit)


def _dimension(**scales: Fraction | int) -> Dimension:
    return Dimension({name: Unit(Fraction(scale)) for name, scale in scales.items()})


LENGTH = _dimension(m=1, mm=Fraction(1, 10**3), um=Fraction(1, 10**6))
TIME = _dimension(s=1, ms=Fraction(1, 10**3))
SPEED = _dimension(**{"rad/s": 1, "rpm": Fraction(math.pi) / 30})
FORCE = _dimension(N=1, kN=10**3)
MOMENT = _dimension(**{"N m": 1, "kN m": 10**3})
PRESSURE = _dimension(Pa=1, MPa=10**6, GPa=10**9)
INVERSE_PRESSURE = _dimension(**{"1/Pa": 1, "1/GPa": Fraction(1, 10**9)})
ANGLE = _dimension(rad=1, deg=Fraction(math.pi) / 180)
TEMPERATURE = Dimension({"K": Unit(Fraction(1)), "degC": Unit(Fraction(1), Fraction("273.15"))})
INVERSE_TEMPERATURE = _dimension(**{"1/K": 1})
KINEMATIC_VISCOSITY = _dimension(**{"m2/s": 1, "mm2/s": Fraction(1, 10**6), "cSt": Fraction(1, 10**6)})
VISCOSITY = _dimension(**{"Pa s": 1})
INVERSE_SPEED = _dimension(**{"s/m": 1})
CONDUCTIVITY = _dimension(**{"W/(m K)": 1})
CONDUCTANCE = _dimension(**{"W/K": 1})
SPECIFIC_HEAT = _dimension(**{"J/(kg K)": 1})
MASS = _dimension(kg=1)
DENSITY = _dimension(**{"kg/m3": 1})
NUMBER = _dimension(**{"1": 1})
