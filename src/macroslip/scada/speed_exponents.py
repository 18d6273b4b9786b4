"""Exponents e of the friction torque of the base bearing by the speed of the shaft, M ∝ n^e.

A study has one speed for each wind; a turbine of another rated speed, or one that idles, has others.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd

from macroslip.constants import ZERO_CELSIUS

#: Temperatures of the oil [degC] of `EXPONENTS`.
TEMPERATURES = (5.0, 20.0, 35.0, 50.0)
#: e [-] by supply of oil: mean of the histories 6B and 12B of the base turbine, with their own speeds
#: and with half of them. `python -m tools.friction_tables` computes them.
EXPONENTS: Mapping[str, tuple[float, ...]] = {
    "skf": (0.28, 0.50, 0.52, 0.34),
    "flooded": (0.70, 0.68, 0.62, 0.39),
    "0.7": (0.59, 0.53, 0.40, 0.05),
    "0.5": (0.56, 0.49, 0.35, 0.00),
}
SKF = "skf"
_FLOODED = "flooded"


def speed_exponents(supplies: Iterable[str]) -> tuple[dict[str, pd.Series], tuple[str, ...]]:
    """Exponents of the speed over the temperature [K] by supply, and the assumptions.

    Parameters
    ----------
    supplies : iterable of str
        `skf`, `flooded`, or the film over the flooded film as text. A number between two of the
        table has a mean of theirs, weighted by its distance; `flooded` counts as 1.

    Returns
    -------
    dict of str to Series, tuple of str
        Exponents [-]; a sentence for each supply beyond the table.

    Examples
    --------
    >>> exponents, notes = speed_exponents(["skf"])
    >>> round(float(exponents["skf"].loc[308.15]), 2), notes
    (0.52, ())
    """
    kelvin = ZERO_CELSIUS + np.array(TEMPERATURES)
    numbers = {}
    for name in EXPONENTS:
        if name != SKF:
            number = 1.0 if name == _FLOODED else float(name)
            numbers[number] = name
    known = sorted(numbers)
    curves = np.array([EXPONENTS[numbers[number]] for number in known])
    exponents = {}
    notes = []
    for supply in supplies:
        if supply in EXPONENTS:
            values = np.array(EXPONENTS[supply])
        else:
            film = float(supply)
            interpolated = [np.interp(film, known, curve) for curve in curves.T]
            values = np.array(interpolated)
            if not known[0] <= film <= known[-1]:
                notes.append(
                    f"The supply {supply} has the exponent of speed of the supply {known[0]:g}."
                )
        exponents[supply] = pd.Series(values, kelvin)
    return exponents, tuple(notes)
