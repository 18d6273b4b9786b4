"""Compiling ahead, and making the tables of a case: for containers, clusters and runs of tests."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from macroslip.bearing.kinds import read_bearing
from macroslip.case.case import BALANCE, WHOLE_BEARING, Case
from macroslip.case.parts import BackwardEuler, ExplicitEuler, Radau, Traces, Window
from macroslip.contact.line_approach import line_loads
from macroslip.contact.mechanisms import Laws
from macroslip.errors import InputError
from macroslip.loads import BearingLoads, Drivetrain
from macroslip.result.prepared import prepare
from macroslip.result.rating import with_rating
from macroslip.result.simulate import bearing_of, simulate
from macroslip.result.skew import skewing
from macroslip.roller.model import with_tables
from macroslip.whole.model import with_tables as assembled

#: Force on the inner ring [N] and shaft speed [rad/s] of the cases that compile, and their length
#: [s]: both rows carry load at the bottom only, so little that tables are small, and a roller enters
#: its zone in an orbit.
_FORCE = (3e3, -65e3, 5e3)
_SHAFT_SPEED = 1.8
_LENGTH = 10.0
#: Tolerance from which on tables are the coarsest.
_TOLERANCE = 2e-3


def compile_all() -> None:
    """Compile everything that cases of the bundled laws call, and keep it.

    Cases of every engine, model, integrator and kind of bearing are computed and rated, with traces
    and details; the coarsest tables serve. Rollers that touch along a line share all but the ring's
    balance with those of a tapered bearing.
    """
    for case in _cases():
        with_rating(simulate(case), case)
    line_loads(1.0, 0.0, np.zeros(1))


def _cases() -> Iterator[Case]:
    """Small cases that call every compiled function."""
    loads = BearingLoads.constant(list(_FORCE), _SHAFT_SPEED, _LENGTH)
    physical = Laws.physical()
    # The window has the orbit, in which the roller leaves its load zone and enters it again.
    common = {
        "loads": loads,
        "rollers": [0],
        "traces": Traces(step=0.5),
        "window": Window(start=0.0),
    }
    radau = common | {"integrator": Radau(tolerance=_TOLERANCE)}
    for laws in (physical, Laws.paper(), physical.but(skew="quasi-static")):
        yield Case(**radau, laws=laws)
    for integrator in (BackwardEuler(step=0.01), ExplicitEuler(step=1e-4)):
        yield Case(**common, laws=Laws.paper(), integrator=integrator)
    for laws in (physical, Laws.paper()):
        yield Case(**radau, laws=laws, dynamics=WHOLE_BEARING)
    yield Case(
        **radau,
        laws=physical,
        bearing=read_bearing("tdo-main-bearing"),
        drivetrain=Drivetrain(mount="alone"),
        oil_supply="flooded",
    )


def make_tables(case: Case) -> None:
    """Make the tables of a case and keep them; nothing is computed with them.

    Parameters
    ----------
    case : Case

    Raises
    ------
    InputError
        For a case whose temperature follows from its own friction: its oil is not known before.
    """
    if case.temperature == BALANCE:
        raise InputError(
            "the oil's temperature follows from the friction of the case itself, so its tables are "
            "not known before it is computed",
            where="temperature",
            allowed="a temperature, to make tables ahead",
            remedy="Give the temperature that you expect, or compute the case once.",
        )
    ready = prepare(case)
    skewing(case, ready.model.laws, ready.box)
    if case.dynamics == WHOLE_BEARING:
        assembled(bearing_of(case), ready.box)
    else:
        with_tables(ready.models, ready.box)
