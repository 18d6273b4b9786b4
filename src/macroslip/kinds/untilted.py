"""What kinds of bearings share whose inner ring does not tilt, with a clearance across the shaft."""

from __future__ import annotations

from abc import ABC
from typing import TYPE_CHECKING

from macroslip.kinds.kind import Kind, RingBalance

if TYPE_CHECKING:
    from macroslip.arrays import FloatArray
    from macroslip.bearing import Bearing
    from macroslip.kinds.read_case import ReadCase
    from macroslip.loads import BearingLoads
    from macroslip.roller.model import RollerModel

#: Samples of the motion, about, of which the mean load is taken.
_SAMPLES = 200
#: A lubricant of the catalogue, for numbers of rollers that do not depend on it.
_ANY_LUBRICANT = "vg460-pao"


class UntiltedRing(Kind, ABC):
    """Kind of bearing whose inner ring moves and does not tilt."""

    def balance(
        self, case: ReadCase, model: RollerModel, thrust: FloatArray | None = None
    ) -> RingBalance:
        """As `Kind.balance`, by `macroslip.ring.motion`; each roller's own where loads are given."""
        from macroslip.contact.interface import highest_load, truncated_share, truncation_load
        from macroslip.loads import RollerLoads
        from macroslip.ring.motion import elastic_loads, own_motions, ring_motion
        from macroslip.ring.orbit import Motion
        from macroslip.roller.model import ring_geometry

        loads = case.ring_loads
        ring = ring_geometry(case.bearing, model)
        limit = highest_load(case.bearing, case.oil, case.laws)
        motion, largest = ring_motion(loads, case.bearing, ring, limit, thrust)
        every = max(1, motion.time.size // _SAMPLES)
        few = Motion(*(values[::every] for values in motion))
        truncation = truncation_load(case.bearing, case.oil)
        return RingBalance(
            motion=motion,
            own_motions=own_motions(loads, ring, motion) if isinstance(loads, RollerLoads) else [],
            largest=largest,
            mean_load=float(elastic_loads(loads, ring, few).mean()),
            truncated_share=truncated_share(largest, truncation),
        )

    def roller_loads(self, bearing: Bearing, model: RollerModel, force: FloatArray) -> FloatArray:
        """As `Kind.roller_loads`, by `macroslip.ring.balance`."""
        import numpy as np

        from macroslip.ring.balance import balance, roller_loads
        from macroslip.roller.model import ring_geometry

        ring = ring_geometry(bearing, model)
        angle = np.zeros(1)
        start = np.zeros((1, 3))
        displacement, _ = balance(ring, angle, force[None], start)
        return roller_loads(ring, angle, displacement)[0]

    def load_history(self, case: ReadCase) -> tuple[BearingLoads, FloatArray, None]:
        """As `Kind.load_history`, by `macroslip.rating.roller_load_history`."""
        from macroslip.rating import roller_load_history

        return *roller_load_history(case.bearing, case.oil, case.ring_loads), None

    def consequences(self, bearing: Bearing) -> list[list[str]]:
        """Stiffness of a roller, the limit or the profile of its contacts, and orbit ratio."""
        from macroslip.contact.interface import truncation_load
        from macroslip.lubricant import Lubricant
        from macroslip.roller.model import roller_model

        lubricant = Lubricant.read(_ANY_LUBRICANT)
        model = roller_model(bearing, lubricant, 1, tilt=0.0)
        orbit = [
            "orbit ratio",
            f"{model.orbit_ratio:.4f}",
            "orbital speed of rollers in pure rolling / shaft speed",
        ]
        if bearing.touches_along_line:
            return [
                [
                    "stiffness C",
                    f"{model.line_stiffness:.4g} N/m^(10/9)",
                    "load of a straight roller = C (half the approach of the raceways)^(10/9)",
                ],
                [
                    "profile depth d",
                    f"{1e6 * model.profile_depth:.4g} um",
                    "drop of the profile = d ln 1/(1 - (2 place/length)^2)",
                ],
                orbit,
            ]
        longest = truncation_load(bearing, lubricant)
        return [
            [
                "stiffness K",
                f"{model.stiffness:.4g} N/m^1.5",
                "roller load = K (approach of the raceways)^1.5",
            ],
            [
                "truncation load",
                f"{longest / 1e3:.4g} kN",
                "roller load at which a contact reaches the roller's ends",
            ],
            orbit,
        ]
