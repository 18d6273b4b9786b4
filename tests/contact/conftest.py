"""The contacts of the base bearing, and the numerical references of `benchmarks/`."""

import importlib.util
import sys
from pathlib import Path

import pytest

from macroslip import Bearing, Lubricant
from macroslip.bearing import geometry
from macroslip.contact.gap import GapShape
from macroslip.contact.interface import interfaces


def _load(name):
    path = Path(__file__).parents[2] / "benchmarks" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def line_contact():
    return _load("line_contact")


@pytest.fixture(scope="session")
def gap_solution():
    return _load("gap_solution")


@pytest.fixture(scope="session")
def base():
    """Interfaces of the base bearing: inner, outer, cage."""
    return interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))


@pytest.fixture(scope="session")
def contacts(base):
    """Interface, shape of the gap and roller radius of the base bearing's contacts, by name."""
    bearing = Bearing.read("skf-240-600-bc")
    by_name = {}
    for interface, curvature in zip(
        base,
        (
            geometry.inner_curvatures(bearing),
            geometry.outer_curvatures(bearing),
            geometry.cage_curvatures(bearing),
        ),
        strict=True,
    ):
        shape = GapShape(1.0 / curvature.rolling, 1.0 / curvature.lateral, bearing.roller_length)
        by_name[interface.name] = interface, shape, geometry.roller_radius(bearing)
    return by_name
