"""The base bearing, its lubricant, and rollers of both rows."""

import math

import pytest

from macroslip.bearing import Bearing
from macroslip.lubricant import Lubricant
from macroslip.roller.model import roller_model


@pytest.fixture(scope="session")
def bearing():
    return Bearing.read("skf-240-600-bc")


@pytest.fixture(scope="session")
def lubricant():
    return Lubricant.read("vg460-pao")


@pytest.fixture(scope="session")
def models(bearing, lubricant):
    """Rollers of both rows by axial sign, tilt 5°."""
    return {sign: roller_model(bearing, lubricant, sign, tilt=math.radians(5.0)) for sign in (1, -1)}
