"""What a maker publishes of a bearing."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from macroslip.errors import InputError


@dataclass(frozen=True)
class MakersPage:
    """What a maker publishes of a bearing, SI units.

    Parameters
    ----------
    bore, outside, width : float
        Boundary dimensions d, D, B [m].
    static_load_rating : float
        C0 [N].
    axial_factor_e : float
        e [-].
    shoulder : float | None
        Diameter of the outer ring's shoulder D1 [m].
    groove : float | None
        Width of the lubrication groove in the outer ring [m]; the raceways begin beside it.
    dynamic_load_rating, fatigue_load_limit : float | None
        C and C_u or P_u [N]; without them those of ISO 281 are used.
    axial_factor_y1, axial_factor_y2, axial_factor_y0 : float | None
        [-]; without them 0.45, 0.67 and 0.44 cot(alpha).
    mass : float | None
        Of the bearing [kg].
    bpfo, bpfi : float | None
        Overrolling frequencies of outer and inner ring per turn of the shaft [-]; both or none.

    Raises
    ------
    InputError
        If the values contradict each other. Their ranges are those of `Bearing`.
    """

    bore: float
    outside: float
    width: float
    static_load_rating: float
    axial_factor_e: float
    shoulder: float | None = None
    groove: float | None = None
    dynamic_load_rating: float | None = None
    fatigue_load_limit: float | None = None
    axial_factor_y1: float | None = None
    axial_factor_y2: float | None = None
    axial_factor_y0: float | None = None
    mass: float | None = None
    bpfo: float | None = None
    bpfi: float | None = None

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if value is not None and not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{field.name} is {value!r}", allowed="a finite number above 0")
        if not self.bore < self.outside:
            raise InputError(
                f"bore is {1e3 * self.bore:g} mm", allowed=f"below the outside diameter, {1e3 * self.outside:g} mm"
            )
        if self.shoulder is not None and not self.bore < self.shoulder < self.outside:
            raise InputError(
                f"shoulder is {1e3 * self.shoulder:g} mm",
                allowed=f"between bore and outside diameter, {1e3 * self.bore:g} mm and {1e3 * self.outside:g} mm",
                remedy="It is the diameter at the outer ring's faces, D1 in catalogues.",
            )
        if self.groove is not None and not self.groove < self.width:
            raise InputError(f"groove is {1e3 * self.groove:g} mm", allowed=f"below the width, {1e3 * self.width:g} mm")
        if (self.bpfo is None) != (self.bpfi is None):
            raise InputError(
                "only one overrolling frequency is given",
                allowed="both bpfo and bpfi, or none",
                remedy="Add the other.",
            )
        if self.bpfo is not None and self.bpfi is not None:
            self._check_frequencies(self.bpfo, self.bpfi)

    @staticmethod
    def _check_frequencies(bpfo: float, bpfi: float) -> None:
        count = bpfo + bpfi
        if abs(count - round(count)) > 0.05 or round(count) < 3 or not bpfo < bpfi:
            raise InputError(
                f"bpfo is {bpfo:g} and bpfi {bpfi:g} per turn of the shaft, together {count:g}",
                allowed="a sum that is the whole number of rollers in a row, within 0.05, and bpfo below bpfi",
                remedy="Divide frequencies in hertz by the shaft's speed in turns per second.",
            )
