"""The synthetic year that comes with the program is the one its generator makes."""

from pathlib import Path

import pytest

from macroslip.scada import Scada
from macroslip.scada.synthetic import base_turbine_friction, synthetic_year
from tools.scada_example import EXAMPLE, RECORD

EXAMPLES = Path(__file__).parents[2] / "examples"
pytestmark = pytest.mark.slow


def test_the_example_is_whole_and_small():
    scada = Scada.read(EXAMPLES / "scada.yaml")
    assert len(scada.data) == 52_560 and scada.hours > 8700.0
    assert (EXAMPLES / RECORD.name).stat().st_size < 400_000


def test_the_example_is_that_of_its_generator():
    scada = Scada.read(EXAMPLES / "scada.yaml")
    made = synthetic_year(EXAMPLE, base_turbine_friction())
    assert made.index.equals(scada.data.index.rename(None))
    used = scada.kept.to_numpy()
    # The bearing follows from the friction table, whose making has tests of its own.
    steps = {"wind_speed": 0.051, "rotor_speed": 0.0053, "ambient_temperature": 0.251}
    for name, step in steps.items():
        recorded = scada.data[name].to_numpy()[used]
        assert abs(recorded - made[name].to_numpy()[used]).max() < step
