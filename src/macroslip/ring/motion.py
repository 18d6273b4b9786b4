"""Motion of the inner ring under a load history: the ring balance at every sample.

Roller loads above the permissible one are refused. Given roller loads take the place of the
balance; every roller then has a motion of its own, whose displacement is the one that gives the
roller its elastic approach at its position.
"""

from __future__ import annotations

import math

import numpy as np

from macroslip.bearing import Bearing
from macroslip.errors import InputError, MacroslipError
from macroslip.loads import BearingLoads, RollerLoads
from macroslip.ring.balance import RingGeometry, balance_series, radial_clearance, roller_loads
from macroslip.ring.orbit import Motion, shaft_angle, travel

#: Largest part of a roller pitch turned between samples of the ring balance; loads sampled more
#: coarsely get samples in between, because the ring moves with every roller that passes.
_SAMPLED_PITCH = 0.25
#: The same where roller loads are given: between samples the approach of a roller on its way is
#: then off by 1e-5 of it.
_SAMPLED_GIVEN = 1.0 / 16.0
#: Part of the load that the ring balance may leave unbalanced, and the force [N] below which that
#: does not matter.
_BALANCE_TOLERANCE = 1e-8
_NEGLIGIBLE_FORCE = 1e-3
#: Samples balanced between two checks for an interrupt: a few tenths of a second.
_SAMPLES_AT_A_TIME = 20_000


def largest_load(
    ring: RingGeometry, angle: np.ndarray, displacement: np.ndarray
) -> tuple[float, int]:
    """Largest roller load in a series.

    Parameters
    ----------
    ring : RingGeometry
    angle : ndarray, shape (n,)
        Shaft angles [rad].
    displacement : ndarray, shape (n, 3)
        Displacements of the ring [m].

    Returns
    -------
    load : float
        Largest load [N].
    sample : int
        Index of its sample.

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0]), np.array([-1.0]), np.zeros(1), 1.0, 1e-4, 1e11, 0.45)
    >>> load, sample = largest_load(ring, np.zeros(2), np.array([[0.0, 0.0, 0.0], [0.0, -2e-4, 0.0]]))
    >>> round(load, 6), sample
    (100000.0, 1)
    """
    largest = roller_loads(ring, angle, displacement).max(axis=1)
    sample = int(largest.argmax())
    return float(largest[sample]), sample


def ring_motion(
    loads: BearingLoads | RollerLoads,
    bearing: Bearing,
    ring: RingGeometry,
    highest_load: float,
    more: np.ndarray | None = None,
) -> tuple[Motion, float]:
    """Ring displacement at every load sample, by the balance with the rollers at their positions.

    With loads of the rollers the ring is left in the middle.

    Parameters
    ----------
    loads : BearingLoads or RollerLoads
    bearing : Bearing
    ring : RingGeometry
    highest_load : float
        Largest permissible load of a roller [N].
    more : ndarray, shape (n, 3), optional
        Force on the ring beside its load, at the n samples of its motion [N].

    Returns
    -------
    motion : Motion
        With samples close enough for the balance.
    largest : float
        Largest elastic load of a roller in the history [N].

    Raises
    ------
    InputError
        If the load of a roller exceeds `highest_load`.
    MacroslipError
        If a balance did not converge.
    """
    time, speed = finely_sampled(loads, ring.orbit_ratio, bearing.rollers_per_row)
    angle = shaft_angle(time, speed)
    if isinstance(loads, RollerLoads):
        motion = Motion(time, speed, angle, np.zeros((time.size, 3)))
        elastic = elastic_loads(loads, ring, motion)
        largest = float(elastic.max())
        sample = int(elastic.max(axis=1).argmax())
        _refuse(largest, highest_load, f"{loads.source}, t = {time[sample]:g} s", bearing)
        return motion, largest
    components = [np.interp(time, loads.time, component) for component in loads.force.T]
    force = np.column_stack(components)
    if more is not None:
        force += more
    displacement = np.empty_like(force)
    unbalanced = np.empty(time.size)
    largest = 0.0
    sample = 0
    # In pieces, so that an interrupt need not wait for the end of a long history.
    for start in range(0, time.size, _SAMPLES_AT_A_TIME):
        piece = slice(start, start + _SAMPLES_AT_A_TIME)
        angles = angle[piece]
        displacement[piece], unbalanced[piece] = balance_series(ring, angles, force[piece])
        load, sample_in_piece = largest_load(ring, angles, displacement[piece])
        if load > largest:
            largest = load
            sample = start + sample_in_piece
    allowed = _BALANCE_TOLERANCE * np.linalg.norm(force, axis=1)
    excess = unbalanced - allowed - _NEGLIGIBLE_FORCE
    worst = int(np.argmax(excess))
    if not excess[worst] <= 0.0:
        raise MacroslipError(
            f"{loads.source}, t = {time[worst]:g} s: the ring balance did not converge, {unbalanced[worst]:g} N of the load "
            f"{force[worst]} N are unbalanced. This is a defect of the solver; please report it with the bearing and this "
            "load."
        )
    _refuse(largest, highest_load, f"{loads.source}, t = {time[sample]:g} s", bearing)
    return Motion(time, speed, angle, displacement), largest


def _refuse(largest: float, highest_load: float, where: str, bearing: Bearing) -> None:
    if largest > highest_load:
        if bearing.touches_along_line:
            raise InputError(
                f"a roller carries {largest / 1e3:.4g} kN, with a contact pressure above the range "
                "of the oil's shear laws",
                where=where,
                allowed=f"roller loads up to {highest_load / 1e3:.4g} kN for {bearing.name}",
                remedy="Check units and signs of the loads, and the bearing's size.",
            )
        waves = abs(bearing.out_of_round_second or 0.0) + abs(bearing.out_of_round_third or 0.0)
        shape = f"out_of_round, whose waves reach {1e6 * waves:.4g} um, " if waves else ""
        raise InputError(
            f"a roller carries {largest / 1e3:.4g} kN, at which its contact ellipse would reach beyond the roller's "
            "ends",
            where=where,
            allowed=f"roller loads up to {highest_load / 1e3:.4g} kN for {bearing.name}",
            remedy=f"Check {shape}units and signs of the loads, the bearing's size and its osculation. Loads a little higher are "
            "taken with laws: {model: physical}, whose microslip cuts the contact off at the roller's ends.",
        )


def elastic_loads(
    loads: BearingLoads | RollerLoads, ring: RingGeometry, motion: Motion
) -> np.ndarray:
    """Elastic load of every roller of both rows at the samples of a motion.

    Parameters
    ----------
    loads : BearingLoads or RollerLoads
    ring : RingGeometry
    motion : Motion
        With n samples.

    Returns
    -------
    ndarray, shape (n, rollers)
        Loads [N], ≥ 0.

    Examples
    --------
    >>> ring = RingGeometry(np.array([0.0]), np.array([-1.0]), np.zeros(1), 1.0, 1e-4, 1e11, 0.45)
    >>> down = Motion(np.zeros(1), np.zeros(1), np.zeros(1), np.array([[0.0, -2e-4, 0.0]]))
    >>> elastic_loads(BearingLoads.constant([0.0, -1e5, 0.0], 2.0, 1.0), ring, down).round(6).tolist()
    [[100000.0]]
    """
    if isinstance(loads, RollerLoads):
        approach = np.maximum(_given_approach(loads, ring, motion), 0.0)
        return ring.stiffness * approach**1.5
    return roller_loads(ring, motion.shaft_angle, motion.displacement)


def own_motions(loads: RollerLoads, ring: RingGeometry, motion: Motion) -> list[Motion]:
    """Motions that give every roller of both rows the given load at its position.

    Parameters
    ----------
    loads : RollerLoads
    ring : RingGeometry
    motion : Motion
        Of the shaft, as `ring_motion` returns it for given roller loads.

    Returns
    -------
    list of Motion
        One a roller, downwind row first.
    """
    approach = _given_approach(loads, ring, motion)
    start = np.arctan2(ring.sine, ring.cosine)
    motions = []
    for roller in range(start.size):
        angle = start[roller] + ring.orbit_ratio * motion.shaft_angle
        cosine = np.cos(angle)
        sine = np.sin(angle)
        radial_approach = approach[:, roller] / ring.cos_contact_angle
        reach = radial_approach + radial_clearance(ring, cosine, sine)
        axial = np.zeros(sine.size)
        displacement = np.column_stack([reach * cosine, reach * sine, axial])
        motions.append(motion._replace(displacement=displacement))
    return motions


def _given_approach(loads: RollerLoads, ring: RingGeometry, motion: Motion) -> np.ndarray:
    """Approach of every roller [m], shape (n, rollers), linear in angle and time.

    It is given at the samples of a motion.
    """
    count = ring.cosine.size // 2
    full = 2.0 * math.pi
    play = max(ring.radial_play, 0.0) * ring.cos_contact_angle
    known = loads.approach(ring.stiffness, play)
    last_before = np.searchsorted(loads.time, motion.time, side="right") - 1
    before = np.clip(last_before, 0, loads.time.size - 2)
    span = loads.time[before + 1] - loads.time[before]
    share = (motion.time - loads.time[before]) / span
    start = np.arctan2(ring.sine, ring.cosine)
    approach = np.empty((motion.time.size, 2 * count))
    for k, (line, at, part) in enumerate(zip(approach, before, share, strict=True)):
        angles = start + ring.orbit_ratio * motion.shaft_angle[k]
        for row in range(2):
            here = slice(row * count, (row + 1) * count)
            of_row = angles[here]
            near, far = (
                np.interp(of_row, loads.angle[i, row], known[i, row], period=full)
                for i in (at, at + 1)
            )
            line[here] = near + part * (far - near)
    return approach


def finely_sampled(
    loads: BearingLoads | RollerLoads, orbit_ratio: float, rollers_per_row: int
) -> tuple[np.ndarray, np.ndarray]:
    """Times and shaft speeds of the same loads, sampled finely enough for the balance.

    Parameters
    ----------
    loads : BearingLoads or RollerLoads
    orbit_ratio : float
        Ω/Ω_in [-].
    rollers_per_row : int

    Returns
    -------
    time : ndarray, shape (n,)
        Rising times [s], with those of the loads among them.
    shaft_speed : ndarray, shape (n,)
        Ω_in [rad/s].

    Examples
    --------
    >>> time, _ = finely_sampled(BearingLoads.constant([0.0, -1e5, 0.0], 2.0, 1.0), 0.45, 28)
    >>> time.size
    21
    """
    part = _SAMPLED_GIVEN if isinstance(loads, RollerLoads) else _SAMPLED_PITCH
    path = np.diff(travel(loads.time, loads.shaft_speed, orbit_ratio))
    longest = part * 2.0 * np.pi / rollers_per_row
    pieces = np.ceil(path / longest * (1.0 - 1e-9)).astype(int)
    if pieces.max() <= 1:
        # Copies: the loads are read-only, which would be another type to the compiler and compile
        # everything twice.
        return loads.time.copy(), loads.shaft_speed.copy()
    starts = loads.time[:-1]
    ends = loads.time[1:]
    counts = np.maximum(pieces, 1)
    samples = [
        np.linspace(start, end, count, endpoint=False)
        for start, end, count in zip(starts, ends, counts, strict=True)
    ]
    time = np.concatenate([*samples, ends[-1:]])
    return time, np.interp(time, loads.time, loads.shaft_speed)
