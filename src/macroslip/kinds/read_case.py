"""What a kind of bearing reads of a case, which is made in a folder above."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from macroslip.arrays import FloatArray
    from macroslip.contact.mechanisms import Laws
    from macroslip.loads import BearingLoads, Drivetrain, HubLoads, RollerLoads
    from macroslip.lubricant import Lubricant
    from macroslip.whole.cage import Cage


class ReadCase(Protocol):
    """A case, as `macroslip.Case` has it."""

    @property
    def bearing(self) -> Any:
        """The bearing, of the kind that reads the case."""

    @property
    def loads(self) -> HubLoads | BearingLoads | RollerLoads:
        """Load history as it is given."""
        ...

    @property
    def drivetrain(self) -> Drivetrain:
        """Mount of the shaft."""
        ...

    @property
    def laws(self) -> Laws:
        """Mechanisms in the contacts."""
        ...

    @property
    def dynamics(self) -> str:
        """Whether orbits are imposed or free."""
        ...

    @property
    def cage(self) -> Cage:
        """The cage of a whole bearing."""
        ...

    @property
    def temperature(self) -> float | str | None:
        """Of the oil at the inlets [K], the word for a balance, or None for its own."""
        ...

    @property
    def temperature_difference(self) -> float:
        """Inner ring and rollers over outer ring [K]."""
        ...

    @property
    def oil(self) -> Lubricant:
        """The lubricant at that temperature."""
        ...

    @property
    def ring_loads(self) -> Any:
        """Load on the inner ring, or loads of the rollers that are given."""

    @property
    def ring_moments(self) -> FloatArray:
        """Moments on the inner ring about X0 and Y0 [N m], shape (n, 2)."""
        ...
