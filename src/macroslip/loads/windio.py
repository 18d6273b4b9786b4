"""Tilt, distances and bearings of the shaft from a turbine file of windIO, version 2.

windIO is the format in which WEIS and WISDEM describe a turbine; its schema is
`turbine_schema.yaml` of https://github.com/IEAWindSystems/windIO. Of it are read, under
`components`:

===============================================  ====================================  =====
`drivetrain.outer_shape.uptilt`                  `tilt`                                [deg]
`hub.diameter`, half of it, and                  `hub_to_bearing`                      [m]
`drivetrain.outer_shape.distance_hub_mb`
`drivetrain.outer_shape.distance_mb_mb`          `front_to_rear`                       [m]
`drivetrain.other_components.mb1Type, mb2Type`   `locating`, where one carries thrust
===============================================  ====================================  =====

`distance_hub_mb` begins at the hub's flange, which WISDEM has half a hub diameter behind the hub
centre (`wisdem/drivetrainse/layout.py`).
"""

from __future__ import annotations

import functools
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from macroslip.errors import InputError
from macroslip.input.units import is_finite_number
from macroslip.storage.files import check_regular, reading

#: Bytes that a turbine file may have; those of the IEA have 0.8 MB.
_MOST_BYTES = 20_000_000
_AGAIN = "Name a turbine file of windIO, version 2, such as those of WEIS and WISDEM."
_SHAPE = ("components", "drivetrain", "outer_shape")
_OTHER = ("components", "drivetrain", "other_components")
#: Bearings that carry thrust, by windIO's names: spherical and tapered rollers; toroidal (CARB) and
#: cylindrical ones (CRB) do not.
_CARRY_THRUST = ("SRB", "TRB")
#: Keys of a case that a shaft on two main bearings needs, and on one.
_NEEDED = {
    "four-point": ("tilt", "hub_to_bearing", "front_to_rear", "locating", "bearing"),
    "three-point": ("tilt", "hub_to_bearing", "bearing_to_gearbox"),
}
#: Keys of windIO by the key of a case that needs them.
_PLACES = {
    "tilt": "components.drivetrain.outer_shape.uptilt",
    "hub_to_bearing": "components.drivetrain.outer_shape.distance_hub_mb and components.hub.diameter",
    "front_to_rear": "components.drivetrain.outer_shape.distance_mb_mb",
    "locating": "components.drivetrain.other_components.mb1Type and mb2Type, one SRB or TRB",
}
_EXAMPLES = {
    "tilt": "6 deg",
    "hub_to_bearing": "5 m",
    "front_to_rear": "1.2 m",
    "bearing_to_gearbox": "2.2 m",
    "locating": "rear",
    "bearing": "rear",
}


@dataclass(frozen=True, slots=True)
class WindioShaft:
    """Data of the shaft in a turbine file; None or empty where the file has none."""

    file: str  #: Name of the file
    tilt: float | None  #: [rad], positive with the hub end up
    hub_to_bearing: float | None  #: Hub centre to the first main bearing [m]
    front_to_rear: float | None  #: First to second main bearing [m]
    front_type: str  #: Type of the first main bearing: CARB, CRB, SRB or TRB
    rear_type: str  #: Type of the second one

    @property
    def locating(self) -> str | None:
        """Bearing that carries all thrust, where the types leave one."""
        types = {"front": self.front_type, "rear": self.rear_type}
        carrying = [name for name, kind in types.items() if kind in _CARRY_THRUST]
        known = all(types.values())
        if not known or len(carrying) != 1:
            return None
        return carrying[0]

    @property
    def description(self) -> str:
        """File and bearings in words."""
        types = (
            f"front bearing {self.front_type or 'not given'}, rear {self.rear_type or 'not given'}"
        )
        return f"{self.file}: {types}"


def windio_values(path: str | os.PathLike[str], own: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a drivetrain that a turbine file has and the user has not given.

    Parameters
    ----------
    path : path
        Turbine file of windIO, version 2.
    own : mapping
        Values that the user gives, by the keys of a drivetrain; they come first. Without a `mount`
        the shaft is on a four-point mount, as windIO has two main bearings.

    Returns
    -------
    dict
        Of the keys of `macroslip.Drivetrain` those that `own` lacks, in SI units: mount, tilt,
        hub_to_bearing, front_to_rear, locating; and `windio`, the file with the types of the
        bearings.

    Raises
    ------
    InputError
        If the file cannot be read, is of another version, holds something that is no number, or if
        a value is neither in it nor in `own`: it is asked for by name.
    """
    shaft = read_windio(path)
    mount = own.get("mount", "four-point")
    needed = _NEEDED.get(mount, ())  # another mount is refused with its key
    values = {}
    for key in needed:
        if key not in own and getattr(shaft, key, None) is not None:
            values[key] = getattr(shaft, key)
    missing = [key for key in needed if key not in own and key not in values]
    if missing:
        named = []
        for key in missing:
            place = _PLACES.get(key, "windIO does not have it")
            named.append(f"{key} ({place})")
        examples = ", ".join(f"{key}: {_EXAMPLES[key]}" for key in missing)
        raise InputError(
            f"the file does not tell {'; '.join(named)}. Its main bearings: {shaft.description}",
            where=str(path),
            remedy=f"Add what is missing beside windio, such as {examples}.",
        )
    return {"mount": mount} | values | {"windio": shaft.description}


def read_windio(path: str | os.PathLike[str]) -> WindioShaft:
    """Read the shaft's values of a turbine file of windIO, version 2.

    Raises InputError if it cannot be read, is of another version, or has a value that is no number.
    """
    path = Path(path)
    check_regular(path, _AGAIN)
    if not path.is_file():
        raise InputError("there is no such turbine file", where=str(path), remedy=_AGAIN)
    stamp = path.stat()
    return _read(path, stamp.st_size, stamp.st_mtime_ns)


@functools.lru_cache(maxsize=16)
def _read(path: Path, size: int, changed: int) -> WindioShaft:
    """Read a file once for the many cases of a study, and again when size or time change."""
    del changed
    if size > _MOST_BYTES:
        raise InputError(
            f"the file has {size} bytes",
            where=str(path),
            allowed=f"up to {_MOST_BYTES}",
            remedy=_AGAIN,
        )
    from ruamel.yaml import YAML

    with reading(path, _AGAIN):
        text = path.read_text(encoding="utf-8")
        data = YAML(typ="safe").load(text)
    version = ""
    if isinstance(data, Mapping):
        version = str(data.get("windIO_version", ""))
    if not version.startswith("2."):
        raise InputError(
            f"windIO_version is {version}" if version else "the file has no windIO_version",
            where=str(path),
            allowed="2.0 or a later 2",
            remedy="Of version 1 angles are in radians and sections elsewhere: convert the file with "
            "windIO's own converter, windIO.converters.windIO2windIO.",
        )
    where = str(path)
    uptilt = _number(data, (*_SHAPE, "uptilt"), where)
    hub_diameter = _number(data, ("components", "hub", "diameter"), where)
    from_flange = _number(data, (*_SHAPE, "distance_hub_mb"), where)
    hub_to_bearing = None
    if hub_diameter is not None and from_flange is not None:
        hub_to_bearing = 0.5 * hub_diameter + from_flange
    tilt = None
    if uptilt is not None:
        tilt = math.radians(uptilt)
    front_type = _value(data, (*_OTHER, "mb1Type"))
    rear_type = _value(data, (*_OTHER, "mb2Type"))
    return WindioShaft(
        path.name,
        tilt=tilt,
        hub_to_bearing=hub_to_bearing,
        front_to_rear=_number(data, (*_SHAPE, "distance_mb_mb"), where),
        front_type=str(front_type or ""),
        rear_type=str(rear_type or ""),
    )


def _value(data: Any, keys: tuple[str, ...]) -> Any:
    """A value by its keys from the outermost inwards; None where one of them is missing."""
    for key in keys:
        data = data.get(key) if isinstance(data, Mapping) else None
    return data


def _number(data: Any, keys: tuple[str, ...], where: str) -> float | None:
    value = _value(data, keys)
    if value is None:
        return None
    if not is_finite_number(value) or value < 0.0:
        raise InputError(
            f"{'.'.join(keys)} is {value!r}",
            where=where,
            allowed="a number, 0 or more",
            remedy="Correct it in the file, or give the distance or angle in the case file after "
            "removing it there.",
        )
    return float(value)
