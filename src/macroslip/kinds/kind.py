"""What differs between kinds of bearings, as cases, results, pages and commands ask for it.

Modules that need NumPy or compiled code are imported where they are used, so that commands which
compute nothing start quickly.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from macroslip.kinds.checks import moments_without_carrier, temperature_difference_without_preload
from macroslip.kinds.makers_page import PageOption
from macroslip.variables import Variable

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from macroslip.arrays import FloatArray
    from macroslip.bearing.sampled import Estimated
    from macroslip.errors import InputError
    from macroslip.kinds.read_case import ReadCase
    from macroslip.loads import BearingLoads
    from macroslip.rating.tapered import StripRating
    from macroslip.ring.orbit import Motion
    from macroslip.roller.model import RollerModel


@dataclass(frozen=True)
class RingBalance:
    """Balance of the inner ring over the loads of a case."""

    motion: Motion  #: Of the inner ring
    #: Motion of the ring for every roller of all rows, where each has its own
    own_motions: list[Motion]
    largest: float  #: Largest elastic load of a roller in the history [N]
    mean_load: float  #: Mean elastic load of all rollers in the history [N]
    truncated_share: float  #: Load of the hardest roller beyond its ends over its load [-]


class Kind(ABC):
    """A kind of bearing; one is made for all bearings of it."""

    name: ClassVar[str]  #: As `Bearing.kind` gives it
    #: K_Z, factor of the kind in the replenishment of the SKF model [-].
    replenishment_factor: ClassVar[float]
    #: True if it carries an axial load.
    carries_thrust: ClassVar[bool] = True
    #: True if it carries moments about axes across the shaft.
    carries_moments: ClassVar[bool] = False
    #: True if all contact normals pass through its middle, about which it turns freely.
    aligns_itself: ClassVar[bool] = False
    #: True if it carries rotors only, so that a faster shaft is a mistake.
    carries_rotors_only: ClassVar[bool] = False
    #: True if rollers on free orbits are computed.
    has_free_orbits: ClassVar[bool] = True
    #: True if `temperature_difference` of a case changes its preload.
    is_preloaded_by_heat: ClassVar[bool] = False
    #: Axis along which stations of a contact lie.
    station_axis: ClassVar[str] = "the roller's axis z'"
    #: Variables of a result that bearings of this kind alone have.
    variables: ClassVar[tuple[Variable, ...]] = ()
    #: Numbers of a maker's page from which its inside is estimated, in the order of a page; none if
    #: it is not estimated. The names of those that are needed.
    page: ClassVar[tuple[PageOption, ...]] = ()
    needed_of_page: ClassVar[tuple[str, ...]] = ()

    def check(self, case: ReadCase) -> Iterator[InputError]:
        """Yield what a case of this kind cannot have.

        Parameters
        ----------
        case : ReadCase

        Yields
        ------
        InputError
            The base yields a temperature difference without preload, and mounts that need a bearing
            which carries moments.
        """
        if not self.is_preloaded_by_heat:
            yield from temperature_difference_without_preload(case)
        if not self.carries_moments:
            yield from moments_without_carrier(case)

    @abstractmethod
    def balance(
        self, case: ReadCase, model: RollerModel, thrust: FloatArray | None = None
    ) -> RingBalance:
        """Balance of the inner ring of a case at its samples.

        Parameters
        ----------
        case : ReadCase
            At a known temperature.
        model : RollerModel
            A roller of the first row.
        thrust : ndarray, shape (n, 3), optional
            Force on the ring beside its load at the n samples of its motion [N], of skewed rollers.

        Returns
        -------
        RingBalance

        Raises
        ------
        InputError
            If the load of a roller is beyond what its contacts can have.
        MacroslipError
            If a balance was not found.
        """

    @abstractmethod
    def roller_loads(self, bearing: Any, model: RollerModel, force: FloatArray) -> FloatArray:
        """Elastic loads of all rollers of all rows under a force on the ring [N], shape (k,).

        Parameters
        ----------
        bearing : Bearing
            Of this kind.
        model : RollerModel
            A roller of the first row.
        force : ndarray, shape (3,)
            On the inner ring [N]; moments are left out.
        """

    @abstractmethod
    def load_history(self, case: ReadCase) -> tuple[BearingLoads, FloatArray, StripRating | None]:
        """Loads of a case for its rating.

        Parameters
        ----------
        case : ReadCase

        Returns
        -------
        loads : BearingLoads
            Load on the inner ring at the n samples of its balance.
        roller_load : ndarray, shape (rows, Z, n)
            Elastic load of every roller [N].
        strips : StripRating or None
            Damage and pressures by strips, where the balance of the ring knows them.
        """

    def raceway_radii(
        self, bearing: Any, sign: int, radius: float, stations: FloatArray
    ) -> FloatArray:
        """Distance of a raceway's stations along the roller from the bearing's axis [m].

        Parameters
        ----------
        bearing : Bearing
            Of this kind.
        sign : int
            Axial sign s of the row.
        radius : float
            Distance of the contact at the roller's middle [m].
        stations : ndarray, shape (k,)
            Places along the roller from its middle [m].

        Returns
        -------
        ndarray, shape (k,)
        """
        import math

        return radius - sign * stations * math.sin(bearing.contact_angle)

    def values(
        self, case: ReadCase, balance: RingBalance, window: tuple[float, float], ribs: FloatArray
    ) -> dict[str, Any]:
        """Values of `variables` by name, but for those of traces, which all rollers have.

        Parameters
        ----------
        case : ReadCase
        balance : RingBalance
            Of the case.
        window : tuple of float
            Start and end of the window [s].
        ribs : ndarray, shape (row, roller, orbits + 1, 3)
            As `rib` of `macroslip.measures.totals.Totals`.
        """
        return {}

    def coordinates(self, case: ReadCase) -> dict[str, Any]:
        """Coordinates of the dimensions that these variables have."""
        return {}

    def sentences(self, result: xr.Dataset, bearing: Mapping[str, Any]) -> list[str]:
        """Sentences of a page on a result of this kind; none of another one.

        Parameters
        ----------
        result : xarray.Dataset
            From `macroslip.simulate`.
        bearing : mapping
            Entries of its bearing's file; empty if they are not known.
        """
        return []

    def doubts(self, result: xr.Dataset) -> list[str]:
        """Sentences on numbers of a result of this kind that mislead; none of another one."""
        return []

    @abstractmethod
    def consequences(self, bearing: Any) -> list[list[str]]:
        """Quantity, value and meaning of what follows from a bearing's inside.

        Parameters
        ----------
        bearing : Bearing
            Of this kind.
        """

    @abstractmethod
    def draw(self, axes: Axes, bearing: Any, colours: Mapping[str, str]) -> None:
        """Draw the section of a bearing above its axis to scale, with its dimensions.

        Parameters
        ----------
        axes : Axes
            Empty and of equal aspect.
        bearing : Bearing
            Of this kind.
        colours : mapping
            Colours of rows by their names.
        """

    def estimate(self, page: dict[str, Any], name: str, title: str, seed: int) -> Estimated:
        """Estimate the inside of a bearing from its maker's page.

        Parameters
        ----------
        page : dict
            Values in SI by the names of fields of `page`; None where the page does not have one.
        name, title : str
            Of the bearing.
        seed : int
            Of the random numbers.

        Returns
        -------
        Estimated
        """
        raise NotImplementedError(f"the inside of a {self.name} roller bearing is not estimated")

    def about_estimated_rating(self, ratio: float | None) -> str:
        """Sentence on C by ISO 281 of an estimated inside over the published one, None if unknown."""
        raise NotImplementedError(f"the inside of a {self.name} roller bearing is not estimated")
