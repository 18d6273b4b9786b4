"""A scene as compact data for the page's moving bearing: numbers of 16 bits in base64."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from macroslip.bearing import Bearing, geometry

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

#: Code of an unknown value.
MISSING = 65535
_TOP = 65534
#: Power below which the scale does not distinguish values [W].
LEAST_POWER = 1e-5


class Quantity(NamedTuple):
    """A quantity that colours the rollers."""

    name: str  #: In a scene
    heading: str
    unit: str
    factor: float  #: From SI to the unit
    logarithmic: bool = False  #: True if its scale is
    signed: bool = False  #: True if it may be negative


QUANTITIES = (
    Quantity("slip", "Slip", "mm/s", 1e3, signed=True),
    Quantity("roller_load", "Load", "kN", 1e-3),
    Quantity("power", "Frictional power", "W", 1.0, logarithmic=True),
    Quantity("cage_force", "Force of the spars", "N", 1.0, signed=True),
)
#: Way of the rollers in their pockets in the drawing over the true one, at most.
_ENLARGED = 25.0
#: Colours of a scale from least to most, whose lightness rises evenly.
_COLOURS = 16


def quantise(values: NDArray, low: float, high: float) -> bytes:
    """Values from `low` to `high` as little-endian 16 bit numbers 0 to 65534; 65535 for NaN.

    Only values that are not above `low` become 0, so that a load of zero differs from a small one.

    Examples
    --------
    >>> list(np.frombuffer(quantise(np.array([0.0, 0.5, 1.0, np.nan]), 0.0, 1.0), "<u2"))
    [np.uint16(0), np.uint16(32767), np.uint16(65534), np.uint16(65535)]
    """
    span = high - low or 1.0
    known = np.nan_to_num(values, nan=low)
    inside = np.clip(known, low, high)
    codes = np.round((inside - low) / span * _TOP)
    codes = np.where(values > low, np.maximum(codes, 1), codes)
    codes = np.where(np.isnan(values), MISSING, codes)
    return codes.astype("<u2").tobytes()


def scene_data(scene: xr.Dataset, bearing: Bearing) -> dict[str, Any]:
    """Plain data of a `macroslip.result.orbit.scene` for the script that draws the bearing.

    Geometry [mm], times [s], angles [degrees], and for each quantity its unit, range and codes.
    """
    from matplotlib import colormaps

    time = scene.time.values
    powers = scene.power.transpose("row", "roller", "time").values
    known_powers = np.nan_to_num(powers, nan=-1.0)
    power = known_powers.max(axis=(0, 1))
    quantities = [
        _quantity(scene[quantity.name], quantity)
        for quantity in QUANTITIES
        if quantity.name in scene
    ]
    shades = np.linspace(0.0, 1.0, _COLOURS)
    ramp = colormaps["cividis"](shades)[:, :3]
    duration = time[-1] - time[0]
    largest = int(np.argmax(power))
    return {
        "rows": scene.row.values.tolist(),
        "rollers": scene.roller.values.tolist(),
        "start": float(time[0]),
        "step": float(duration / (time.size - 1)) if time.size > 1 else 0.0,
        "count": int(time.size),
        # A little before the largest power.
        "first": max(0, largest - power.size // 60),
        "angle": np.round(scene.angle.values, 3).tolist(),
        "travelled": _text(scene.travelled.values.astype("<f4").tobytes()),
        "radii": {
            "roller": 1e3 * geometry.roller_radius(bearing),
            "pitch": 1e3 * bearing.pitch_radius,
            "inner": 1e3 * geometry.inner_contact_radius(bearing),
            "outer": 1e3 * geometry.outer_contact_radius(bearing),
        },
        "colours": [[round(255 * part) for part in colour] for colour in ramp.tolist()],
        "quantities": quantities,
        "pockets": _pockets(scene, bearing) if "pocket_offset" in scene else None,
    }


def _quantity(values: xr.DataArray, quantity: Quantity) -> dict[str, Any]:
    """Heading, unit, range and codes of a quantity."""
    by_roller = values.transpose("row", "roller", "time").values
    shown = quantity.factor * by_roller.astype(float)
    finite = shown[np.isfinite(shown)]
    if quantity.logarithmic:
        low = np.log10(LEAST_POWER)
        largest = finite.max(initial=0.0)
        high = np.log10(max(2.0 * LEAST_POWER, largest))
        with np.errstate(divide="ignore"):
            known = np.where(shown <= 0.0, LEAST_POWER, shown)
            shown = np.log10(known)
    elif quantity.signed:
        largest = np.abs(finite).max(initial=0.0)
        high = max(1e-6, largest)
        low = -high
    else:
        low = 0.0
        high = max(1e-6, finite.max(initial=0.0))
    return {
        "heading": quantity.heading,
        "unit": quantity.unit,
        "logarithmic": quantity.logarithmic,
        "low": float(low),
        "high": float(high),
        "codes": _text(quantise(shown, low, high)),
    }


def _text(content: bytes) -> str:
    return base64.b64encode(content).decode("ascii")


def _pockets(scene: xr.Dataset, bearing: Bearing) -> dict[str, Any]:
    """Offsets of the rollers in their pockets, enlarged so that pockets do not meet."""
    by_roller = scene.pocket_offset.transpose("row", "roller", "time").values
    offsets = 1e3 * by_roller.astype(float)
    reach = float(np.nanmax(np.abs(offsets), initial=1e-6))
    between_rollers = 2.0 * np.pi * bearing.pitch_radius / bearing.rollers_per_row
    free = 1e3 * (between_rollers - bearing.roller_diameter)
    names = [quantity.name for quantity in QUANTITIES if quantity.name in scene]
    return {
        "reach": reach,
        "enlarged": float(min(_ENLARGED, 0.35 * free / reach)),
        "codes": _text(quantise(offsets, -reach, reach)),
        "lead": _text(scene.cage_lead.values.astype("<f4").tobytes()),
        "force": names.index("cage_force"),
    }
