"""Unknowns and work space of an integration, allocated once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from macroslip.whole_bearing.arrow import Arrow, new_arrow
from macroslip.whole_bearing.station import Stations, new_stations
from macroslip.whole_bearing.traction import new_sheets

#: Columns of forces: S_i, S_o, P_i, P_o, F_c, N [N], slip against the cage and x' [m/s] …
SPIN_INNER, SPIN_OUTER, PULL_INNER, PULL_OUTER, FRICTION, PUSH, CAGE_SLIDING, POCKET_SPEED = range(8)
#: … and, once a stage is solved, rolling resistance in S_i, S_o and F_c [N].
SHEAR_INNER, SHEAR_OUTER, SHEAR_CAGE = range(8, 11)


class Unknowns(NamedTuple):
    """A state, or its rates.

    Attributes
    ----------
    rollers : ndarray, shape (n, 3)
        Slips v_in, v_out [m/s] and pocket offset x [m].
    cages : ndarray, shape (c, 6)
        Lead w [m/s], lag ∫w dt [m], translation speeds p, q [m/s] and translations a, b [m].
    """

    rollers: np.ndarray
    cages: np.ndarray


class Moment(NamedTuple):
    """All rollers at one time.

    Attributes
    ----------
    values : Unknowns
    stations : Stations
    force : ndarray, shape (n, 11)
        See the columns above.
    powers : ndarray, shape (n, 3, 6)
        Of every interface [W], see `macroslip.whole_bearing.record.stage_powers`.
    """

    values: Unknowns
    stations: Stations
    force: np.ndarray
    powers: np.ndarray


class Tractions(NamedTuple):
    """Evaluations of the raceway contacts.

    Attributes
    ----------
    sheets, known : ndarray, shape (n, 44)
        Those of the step under way, and those kept from before it, see `macroslip.whole_bearing.traction`.
    rest : ndarray, shape (n,)
        Time [s] for which those kept serve.
    ratio : ndarray, shape (n,)
        Error of the last predicted values, over what is allowed.
    fresh, settled, marked, due : ndarray of bool, shape (n,)
        Whether a roller is evaluated in every iteration; needs no further evaluation in this stage; is evaluated now; has
        new values to keep after the step.
    """

    sheets: np.ndarray
    known: np.ndarray
    rest: np.ndarray
    ratio: np.ndarray
    fresh: np.ndarray
    settled: np.ndarray
    marked: np.ndarray
    due: np.ndarray


class Space(NamedTuple):
    """All arrays.

    Attributes
    ----------
    state, slope : Unknowns
        At the step's start.
    star : Unknowns
        y*, the part of a stage that is known.
    first, last : Moment
        The stages.
    first_rate, last_rate : Unknowns
        Their slopes.
    tractions : Tractions
    arrow : Arrow
    work : ndarray of int, shape (3,)
        Evaluations of a raceway contact, Newton iterations, and rollers evaluated after a rest so far.
    """

    state: Unknowns
    slope: Unknowns
    star: Unknowns
    first: Moment
    last: Moment
    first_rate: Unknowns
    last_rate: Unknowns
    tractions: Tractions
    arrow: Arrow
    work: np.ndarray


def new_space(count: int, cages: int) -> Space:
    """Work space for `count` rollers."""

    def unknowns() -> Unknowns:
        return Unknowns(np.zeros((count, 3)), np.zeros((cages, 6)))

    def moment() -> Moment:
        return Moment(unknowns(), new_stations(count), np.zeros((count, 11)), np.zeros((count, 3, 6)))

    flags = [np.zeros(count, dtype=np.bool_) for _ in range(4)]
    return Space(
        state=unknowns(),
        slope=unknowns(),
        star=unknowns(),
        first=moment(),
        last=moment(),
        first_rate=unknowns(),
        last_rate=unknowns(),
        tractions=Tractions(new_sheets(count), new_sheets(count), np.zeros(count), np.zeros(count), *flags),
        arrow=new_arrow(count, cages),
        work=np.zeros(3, dtype=np.int64),
    )
