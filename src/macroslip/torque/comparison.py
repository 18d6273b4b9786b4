"""Computed friction torque beside the handbooks' over the same loads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from macroslip.bearing import Bearing
from macroslip.lubricant import Lubricant
from macroslip.torque.palmgren import palmgren_torque
from macroslip.torque.skf import skf_torque

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.loads import BearingLoads


class TorqueHistory(NamedTuple):
    """A torque [N m], against the rotation, at times [s]."""

    time: NDArray[np.float64]
    torque: NDArray[np.float64]


def torque_histories(
    computed: Mapping[str, xr.Dataset], loads: BearingLoads, bearing: Bearing, lubricant: Lubricant
) -> dict[str, TorqueHistory]:
    """Torque under every model and by the handbooks' formulas, over the times the computed ones have.

    Parameters
    ----------
    computed : mapping
        From `computed_torque`, by model, under these loads.
    loads : BearingLoads
    bearing : Bearing
        With the catalogue data the handbooks need.
    lubricant : Lubricant

    Returns
    -------
    dict
        By name: the models, "SKF, sliding", "SKF, all" and "Palmgren, all".

    Raises
    ------
    InputError
        As `skf_torque` and `palmgren_torque`.

    Notes
    -----
    The handbooks' formulas hold for steady running; over time they are a chain of steady states.

    Examples
    --------
    >>> from macroslip import BearingLoads
    >>> loads = BearingLoads.constant([0.0, -344e3, 164e3], 2.143, 1.0)
    >>> found = torque_histories({}, loads, Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
    >>> [f"{name}: {history.torque[0]:.0f} N m" for name, history in found.items()]
    ['SKF, sliding: 83 N m', 'SKF, all: 353 N m', 'Palmgren, all: 298 N m']
    """
    found = {f"model {name}": TorqueHistory(one.time.values, one.torque.values) for name, one in computed.items()}
    start = max((float(one.time[0]) for one in computed.values()), default=float(loads.time[0]))
    end = min((float(one.time[-1]) for one in computed.values()), default=float(loads.time[-1]))
    here = (loads.time >= start) & (loads.time <= end)
    force, time = loads.force[here], loads.time[here]
    given = bearing, lubricant, np.hypot(force[:, 0], force[:, 1]), force[:, 2], loads.shaft_speed[here]
    skf = skf_torque(*given)
    by_handbook = {"SKF, sliding": skf.sliding, "SKF, all": skf.total, "Palmgren, all": palmgren_torque(*given).total}
    return found | {name: TorqueHistory(time, torque) for name, torque in by_handbook.items()}
