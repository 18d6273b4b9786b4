"""Station and forces of a roller by the addresses of its laws.

They are the same as `macroslip.roller.forces` gives, to the last bit: see tests/integrate/test_sealed.py. What a type of
roller compiles for them is what the integrators compile for it too; those functions themselves, called from Python with
the three hundred numbers of a roller, would take as long once more.
"""

from macroslip.integrate.sealed import forces_of, station_of

from macroslip.compiled import jit


@jit
def station_by_address(roller, angle, now):
    """`station` of a `SealedModel`."""
    return station_of(roller, angle, now)


@jit
def forces_by_address(roller, at, slip):
    """`slip_forces` of a `SealedModel`."""
    return forces_of(roller, at, slip)
