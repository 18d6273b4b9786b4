"""Cases made in Python: NumPy's numbers are numbers, and what is wrong is reported in one paragraph."""

import dataclasses
import pickle
from dataclasses import replace

import numpy as np
import pytest

from macroslip import (
    BackwardEuler,
    BearingLoads,
    Case,
    Drivetrain,
    ExplicitEuler,
    InputError,
    Laws,
    Radau,
    Traces,
    Window,
)
from macroslip.loads import HubLoads
from macroslip.result.simulate import simulate

LOADS = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 1.0)


def test_numbers_of_numpy_are_welcome():
    case = Case(
        loads=LOADS,
        laws=Laws.paper(),
        rollers=np.arange(3),
        integrator=Radau(tolerance=np.float32(1e-4), max_steps=np.int64(1000)),
        window=Window(end=np.float64(1.0)),
        drivetrain=Drivetrain(tilt=np.float32(0.05)),
        traces=Traces(step=np.int32(1)),
    )
    assert case.rollers == (0, 1, 2) and {type(number) for number in case.rollers} == {int}
    assert type(case.integrator.tolerance) is float and case.integrator.max_steps == 1000
    assert pickle.loads(pickle.dumps(case.integrator)) == case.integrator
    assert (
        BearingLoads.constant(np.array([0, -1, 0]), np.float32(2), np.int64(1)).shaft_speed[0]
        == 2.0
    )


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (
            lambda: Radau(tolerance=0.5),
            "integrator.tolerance: it is 0.5. Allowed: 1e-10 to 0.01. 2e-4 gives energies",
        ),
        (
            lambda: Radau(tolerance="1e-4"),
            "integrator.tolerance: it is '1e-4'. Allowed: a finite number.",
        ),
        (
            lambda: Radau(max_steps=10**30),
            "integrator.max_steps: it is 1000000000000000000000000000000. Allowed: a whole",
        ),
        (
            lambda: Radau(max_steps=1e30),
            "integrator.max_steps: it is 1e+30. Allowed: a whole number, 1 to 1e15.",
        ),
        (
            lambda: Radau(max_steps=0),
            "integrator.max_steps: it is 0. Allowed: a whole number, 1 to 1e15. It is the number of",
        ),
        (
            lambda: Radau(tolerence=1e-4),
            "the key 'tolerence' inside integrator is unknown. Did you mean 'tolerance'?",
        ),
        (lambda: ExplicitEuler(), "integrator: 'step' is missing"),
        (
            lambda: BackwardEuler(step=3.0),
            "integrator.step: it is 3.0. Allowed: 1e-7 to 1 s. It is the fixed time step",
        ),
        (lambda: Traces(step=-1.0), "traces.step: it is -1.0. Allowed: a number above 0 s."),
        (lambda: Window(start=np.nan), "window.start: it is nan. Allowed: a finite number."),
        (
            lambda: replace(Drivetrain(), tilt=5.0),
            "Angles are in radians: math.radians(5.0) for 5 degrees.",
        ),
        (
            lambda: Radau(tables=True),
            "the key 'tables' inside integrator is unknown. Allowed: tolerance, max_steps. Remove it.",
        ),
        (
            lambda: replace(Drivetrain(), tilt=5.0),
            "drivetrain.tilt: it is 5.0. Allowed: -0.3 to 0.3 rad. It is the shaft tilt",
        ),
        (
            lambda: Case(loads=LOADS, laws=Laws.paper(), rollers=[0, 28]),
            "rollers: rollers is [0, 28]. Allowed: all, or a list",
        ),
        (
            lambda: Case(loads=LOADS, laws=Laws.paper(), rollers=3),
            "rollers: it is 3. Allowed: all, or a list",
        ),
        (
            lambda: Case(loads=LOADS, laws=Laws.paper(), rollers={0: 1, 7: 2}),
            "rollers: it is {0: 1, 7: 2}. Allowed: all, or a list",
        ),
        (
            lambda: Case(loads=LOADS, laws=Laws.paper(), rollers=b"\x00\x07"),
            "rollers: it is b'\\x00\\x07'. Allowed: all, or a list",
        ),
        (
            lambda: Case(loads=LOADS, laws=Laws.paper(), rollers=[True]),
            "rollers: it is [True]. Allowed: all, or a list",
        ),
        (
            lambda: BearingLoads.constant([0, -1, 0], "2", 1.0),
            "the shaft_speed is '2'. Allowed: a finite number.",
        ),
        (
            lambda: BearingLoads.constant([0, -1, 0], 2.0, 1e308),
            "the duration of a constant load is 1e+308 s",
        ),
        (
            lambda: HubLoads.constant(["1", 0, 0], [0, 0, 0], 2.0, 1.0),
            "constant load: force does not convert",
        ),
        (
            lambda: simulate(Case(loads=LOADS, laws=Laws.paper(), traces=Traces(step=1e-300))),
            "traces: a step of 1e-300 s makes 1e+300",
        ),
    ],
)
def test_what_is_wrong_is_said_in_words(make, words):
    with pytest.raises(InputError) as caught:
        make()
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_every_field_of_a_case_is_in_its_input():
    """A key is declared once: whatever field the class has, the input of a result has its value."""
    loads = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 1.0)
    case = Case(loads=loads, dynamics="whole-bearing", gravity=False)
    settings = case.as_dict()
    names = {field.name for field in dataclasses.fields(Case)} - {"gravity", "drag"} | {"forces"}
    # Only a tapered roller bearing has it.
    assert settings.keys() == names - {"temperature_difference"}
    assert settings["forces"] == {"gravity": False, "drag": True}
    assert settings["cage"] == dataclasses.asdict(case.cage)
    # What has no effect is left out.
    assert {"dynamics", "cage"}.isdisjoint(Case(loads=loads).as_dict())
