"""The kind of tapered roller bearings, as cases, results, pages and commands ask for it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from macroslip.errors import InputError
from macroslip.input.units import LENGTH
from macroslip.kinds.checks import traction_along_line
from macroslip.kinds.kind import Kind, RingBalance
from macroslip.kinds.makers_page import (
    AXIAL_FACTOR_E,
    BEARING_MASS,
    BORE,
    DYNAMIC_RATING,
    FATIGUE_LIMIT,
    OUTSIDE,
    STATIC_RATING,
    WIDTH,
    PageOption,
)
from macroslip.kinds.tapered import case_checks
from macroslip.kinds.tapered.variables import VARIABLES

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

    from macroslip.arrays import FloatArray
    from macroslip.bearing.sampled import Estimated
    from macroslip.bearing.tapered import TaperedBearing
    from macroslip.kinds.read_case import ReadCase
    from macroslip.loads import BearingLoads
    from macroslip.rating.tapered import StripRating
    from macroslip.ring.tapered_motion import TaperedMotion
    from macroslip.roller.model import RollerModel


@dataclass(frozen=True)
class TiltingRingBalance(RingBalance):
    """Balance of an inner ring that tilts under moments and preload."""

    tapered: TaperedMotion  #: The balance with the loads of strips and ribs


class Tapered(Kind):
    """Double-row tapered roller bearings, and two single-row ones on one shaft."""

    name = "tapered"
    replenishment_factor = 6.0
    carries_moments = True
    has_free_orbits = False
    is_preloaded_by_heat = True
    variables = VARIABLES
    station_axis = "the roller from its middle to its large end"
    page = (
        BORE,
        OUTSIDE,
        WIDTH,
        STATIC_RATING,
        AXIAL_FACTOR_E,
        DYNAMIC_RATING,
        FATIGUE_LIMIT,
        BEARING_MASS,
        PageOption(
            "rows", "rows", "Tapered: rows of the page's bearing, 1 or 2.", type=int, range=(1, 2)
        ),
        PageOption("arrangement", "arrangement", "Tapered: O or X.", type=str),
        PageOption(
            "y", "axial_factor_y", "Tapered: axial factor Y of a single, Y1 of a double row."
        ),
        PageOption(
            "a",
            "load_centre",
            "Tapered: load centre from the back face of the inner ring; double row: distance of "
            "both load centres.",
            LENGTH,
        ),
        PageOption(
            "distance",
            "distance",
            "Tapered: distance of two single rows' rollers on one shaft.",
            LENGTH,
        ),
    )
    needed_of_page = ("c0",)

    def check(self, case: ReadCase) -> Iterator[InputError]:
        """Yield dynamics, laws, temperatures, loads and mounts that are not computed."""
        yield from super().check(case)
        yield from case_checks.mechanisms(case)
        yield from traction_along_line(case, "tapered roller")
        yield from case_checks.mount(case)

    def balance(
        self, case: ReadCase, model: RollerModel, thrust: FloatArray | None = None
    ) -> TiltingRingBalance:
        """As `Kind.balance`, by `macroslip.ring.tapered`; every roller has a motion of its own."""
        from macroslip.kinds.tapered.of_case import tapered_ring_motion
        from macroslip.ring.tapered_motion import tapered_own_motions

        assert thrust is None, "rollers that a rib guides do not skew"
        tapered = tapered_ring_motion(case)
        loads = tapered.balance.outer_load
        return TiltingRingBalance(
            motion=tapered.motion,
            own_motions=tapered_own_motions(tapered, model.stiffness, case.bearing.contact_angle),
            largest=float(loads.max()),
            mean_load=float(loads.mean()),
            truncated_share=0.0,
            tapered=tapered,
        )

    def roller_loads(
        self, bearing: TaperedBearing, model: RollerModel, force: FloatArray
    ) -> FloatArray:
        """As `Kind.roller_loads`: moments hardly change the mean load of the rollers."""
        import numpy as np

        from macroslip.ring.tapered import tapered_balance, tapered_ring

        ring = tapered_ring(bearing)
        no_moment = np.zeros((1, 2))
        return tapered_balance(ring, np.zeros(1), force[None], no_moment).outer_load[0]

    def load_history(self, case: ReadCase) -> tuple[BearingLoads, FloatArray, StripRating]:
        """As `Kind.load_history`, with the damage of strips."""
        import numpy as np

        from macroslip.kinds.tapered.of_case import tapered_ring_motion
        from macroslip.rating.tapered import strip_rating

        ring_motion = tapered_ring_motion(case)
        motion = ring_motion.motion
        loads = case.ring_loads.resampled(motion.time, motion.shaft_speed)
        balance = ring_motion.balance
        pressed = np.moveaxis(balance.outer_load, 0, -1)
        strips = strip_rating(case.bearing, ring_motion.ring, balance, motion.shaft_angle)
        by_row = pressed.reshape(case.bearing.rows, case.bearing.rollers_per_row, -1)
        return loads, by_row, strips

    def raceway_radii(
        self, bearing: TaperedBearing, sign: int, radius: float, stations: FloatArray
    ) -> FloatArray:
        """As `Kind.raceway_radii`: raceways are cones that share their apex with the rollers.

        Parameters
        ----------
        bearing : TaperedBearing
        sign : int
            Axial sign s of the row, which does not count.
        radius : float
            Distance of the contact at the roller's middle [m].
        stations : ndarray, shape (k,)
            Places along the roller from its middle [m].
        """
        from macroslip.bearing.tapered import tapered_geometry

        return radius * (1.0 + stations / tapered_geometry(bearing).apex_distance)

    def values(
        self, case: ReadCase, balance: RingBalance, window: tuple[float, float], ribs: FloatArray
    ) -> dict[str, Any]:
        """Energies at the ribs, preload, tilt, grip, and pressure and films of the ribs.

        Parameters
        ----------
        case : ReadCase
        balance : TiltingRingBalance
            Of the case.
        window : tuple of float
            Start and end of the window [s].
        ribs : ndarray, shape (row, roller, orbits + 1, 3)
            As `rib` of `macroslip.measures.totals.Totals`.
        """
        from macroslip.kinds.tapered.of_case import rib_energies, ring_values

        assert isinstance(balance, TiltingRingBalance)
        return rib_energies(ribs) | ring_values(case, balance.tapered, window)

    def coordinates(self, case: ReadCase) -> dict[str, Any]:
        """Surfaces of the ribs that wear, where asperities touch."""
        from macroslip.kinds.tapered.ribs import RIB_SURFACES

        if case.laws.asperities == "none":
            return {}
        return {"rib_surface": list(RIB_SURFACES)}

    def sentences(self, result: xr.Dataset, bearing: Mapping[str, Any]) -> list[str]:
        """Sentences on rows, preload, grip and ribs."""
        from macroslip.kinds.tapered.sentences import tapered_sentences

        return tapered_sentences(result, bearing)

    def doubts(self, result: xr.Dataset) -> list[str]:
        """A sentence on preload or moments far beyond the equivalent load."""
        from macroslip.kinds.tapered.sentences import preload_and_moments

        return preload_and_moments(result)

    def consequences(self, bearing: TaperedBearing) -> list[list[str]]:
        """Apex, rib, preload by heat, and orbit ratio."""
        from macroslip.bearing.tapered import tapered_geometry
        from macroslip.kinds.tapered.history import STEEL_EXPANSION

        row = tapered_geometry(bearing)
        warmer = row.preload_per_kelvin(STEEL_EXPANSION, bearing.row_offset, bearing.arrangement)
        sliding = 1e3 * row.inner_rolling_ratio * row.rib_contact_height
        return [
            ["apex", f"{1e3 * row.apex_distance:.4g} mm", "distance from the middle of a roller"],
            ["rib share", f"{row.rib_share:.4f}", "force of the rib / load of the outer raceway"],
            ["rib sliding", f"{sliding:.4g} mm", "sliding speed at the rib / shaft speed"],
            [
                "preload by heat",
                f"{1e6 * warmer:.4g} um",
                "for each kelvin of temperature_difference",
            ],
            [
                "orbit ratio",
                f"{row.orbit_ratio:.4f}",
                "orbital speed of rollers in pure rolling / shaft speed",
            ],
        ]

    def draw(self, axes: Axes, bearing: TaperedBearing, colours: Mapping[str, str]) -> None:
        """As `Kind.draw`, by `macroslip.kinds.tapered.drawing`."""
        from macroslip.kinds.tapered.drawing import draw_tapered_section

        draw_tapered_section(axes, bearing, colours)

    def estimate(
        self, page: dict[str, Any], name: str, title: str, seed: int
    ) -> Estimated[TaperedBearing]:
        """As `Kind.estimate`: two rows in O arrangement if the page's are not told.

        Parameters
        ----------
        page : dict
            Values in SI by the names of fields of `page`.
        name, title : str
            Of the bearing.
        seed : int
            Of the random numbers.
        """
        from macroslip.bearing.tapered.estimate import TaperedPage, estimate_tapered_bearing

        told = {key: value for key, value in page.items() if value is not None}
        rows = 1 if "distance" in told else 2
        return estimate_tapered_bearing(
            TaperedPage(**({"rows": rows} | told)), name, title, seed=seed
        )

    def about_estimated_rating(self, ratio: float | None) -> str:
        """Sentence on C, rib and preload, none of which the page decides."""
        return (
            "C is no check of a tapered bearing: makers publish up to 40 % more than ISO 281. Rib and "
            "preload are on no maker's page, and they decide friction and slip."
        )
