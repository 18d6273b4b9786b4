"""Motion of the inner ring under a load history: the ring balance at every sample, and loads it must not exceed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from macroslip.compiled import jit
from macroslip.errors import InputError, MacroslipError
from macroslip.ring.balance import RingGeometry, balance_series, roller_loads
from macroslip.ring.orbit import Motion, shaft_angle, travel

if TYPE_CHECKING:
    from macroslip.bearing import Bearing
    from macroslip.loads import BearingLoads

#: Largest part of a roller pitch turned between samples of the ring balance; loads sampled more coarsely get samples
#: in between, because the ring moves with every roller that passes.
_SAMPLED_PITCH = 0.25
#: Part of the load that the ring balance may leave unbalanced, and the force [N] below which that does not matter.
_BALANCE_TOLERANCE = 1e-8
_NEGLIGIBLE_FORCE = 1e-3
#: Samples balanced between two checks for an interrupt: a few tenths of a second.
_SAMPLES_AT_A_TIME = 20_000


@jit
def largest_load(ring, angle, displacement):
    """Largest roller load in a series [N], and the index of its sample."""
    loads = np.empty(ring.cosine.size)
    largest, sample = 0.0, 0
    for k in range(angle.size):
        roller_loads(ring, angle[k], displacement[k], loads)
        for j in range(loads.size):
            if loads[j] > largest:
                largest, sample = loads[j], k
    return largest, sample


def ring_motion(loads: BearingLoads, bearing: Bearing, ring: RingGeometry, highest_load: float) -> tuple[Motion, float]:
    """Ring displacement at every load sample, with rollers where they are then.

    Parameters
    ----------
    loads : BearingLoads
        Load on the inner ring.
    bearing : Bearing
    ring : RingGeometry
    highest_load : float
        Roller load [N] that must not be exceeded.

    Returns
    -------
    motion : Motion
    largest : float
        Largest elastic roller load of the history [N].

    Raises
    ------
    InputError
        If a roller load exceeds `highest_load`.
    MacroslipError
        If a balance did not converge.
    """
    time, speed, force = _finely_sampled(loads, ring.orbit_ratio, bearing.rollers_per_row)
    angle = shaft_angle(time, speed)
    displacement, unbalanced = np.empty_like(force), np.empty(time.size)
    largest, sample, current = 0.0, 0, np.zeros(3)
    # In pieces, so that an interrupt need not wait for the end of a long history.
    for start in range(0, time.size, _SAMPLES_AT_A_TIME):
        piece = slice(start, start + _SAMPLES_AT_A_TIME)
        balance_series(ring, angle[piece], force[piece], current, displacement[piece], unbalanced[piece])
        load, place = largest_load(ring, angle[piece], displacement[piece])
        if load > largest:
            largest, sample = load, start + place
    excess = unbalanced - _BALANCE_TOLERANCE * np.linalg.norm(force, axis=1) - _NEGLIGIBLE_FORCE
    worst = int(np.argmax(excess))
    if not excess[worst] <= 0.0:
        raise MacroslipError(
            f"{loads.source}, t = {time[worst]:g} s: the ring balance left {unbalanced[worst]:g} N of the load "
            f"{force[worst]} N unbalanced. This is a defect of the solver; please report it with the bearing and this "
            "load."
        )
    if largest > highest_load:
        raise InputError(
            f"a roller carries {largest / 1e3:.4g} kN, at which its contact ellipse would reach beyond the roller's "
            "ends",
            where=f"{loads.source}, t = {time[sample]:g} s",
            allowed=f"roller loads up to {highest_load / 1e3:.4g} kN for {bearing.name}",
            remedy="Check units and signs of the loads, the bearing's size and its osculation. Loads a little higher are "
            "taken with laws: {model: physical}, whose microslip cuts the contact off at the roller's ends.",
        )
    return Motion(time, speed, angle, displacement), largest


def _finely_sampled(
    loads: BearingLoads, orbit_ratio: float, rollers_per_row: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, shaft speed and force of the same piecewise linear loads, with samples close enough for the balance."""
    path = np.diff(travel(loads.time, loads.shaft_speed, orbit_ratio))
    pieces = np.ceil(path / (_SAMPLED_PITCH * 2.0 * np.pi / rollers_per_row) * (1.0 - 1e-9)).astype(int)
    if pieces.max() <= 1:
        # Copies: the loads are read-only, which would be another type to the compiler and compile everything twice.
        return loads.time.copy(), loads.shaft_speed.copy(), loads.force.copy()
    spans = zip(loads.time[:-1], loads.time[1:], np.maximum(pieces, 1), strict=True)
    pieces = [np.linspace(start, end, count, endpoint=False) for start, end, count in spans]
    time = np.concatenate([*pieces, loads.time[-1:]])
    force = np.column_stack([np.interp(time, loads.time, component) for component in loads.force.T])
    return time, np.interp(time, loads.time, loads.shaft_speed), force
