"""CPU time of the ring balance of a tapered bearing: python -m benchmarks.tapered_ring."""

from __future__ import annotations

import time

import numpy as np

from macroslip.bearing.tapered import TaperedBearing
from macroslip.loads import HubLoads
from macroslip.loads.moment_bearing import moment_bearing_load
from macroslip.ring.orbit import shaft_angle
from macroslip.ring.tapered import gearbox_support, tapered_balance, tapered_ring

#: Preloads [mm], negative is play; factors on the loads; stiffness of the gearbox's support [N/m].
PRELOADS = (0.4, 0.2, 0.1, 0.0, -0.2, -0.5)
FACTORS = (1.0, 4.0)
SUPPORTS = (0.0, 1e8)


def main() -> None:
    """Solve 600 s of 14B at 20 Hz, 12,000 samples of 68 rollers, in every state."""
    bearing = TaperedBearing.read("tdo-main-bearing")
    loads = HubLoads.bundled("14B")
    angle = shaft_angle(loads.time, loads.shaft_speed)
    force, moment = moment_bearing_load(loads, 1.26)
    warm = tapered_ring(bearing)
    tapered_balance(warm, angle[:2], force[:2], moment[:2])
    for support in SUPPORTS:
        for factor in FACTORS:
            for preload in PRELOADS:
                ring = tapered_ring(
                    bearing.replace(preload=1e-3 * preload), support=gearbox_support(support, 2.2)
                )
                begin = time.process_time()
                balance = tapered_balance(ring, angle, factor * force, factor * moment)
                spent = time.process_time() - begin
                size = factor * np.linalg.norm(force, axis=1)
                idle = (balance.outer_load <= 1.0).mean()
                print(
                    f"support {support:g} N/m, loads x {factor:g}, preload {preload:+.1f} mm: "
                    f"{angle.size} samples in {spent:.1f} s, {balance.iterations.mean():.1f} steps, "
                    f"at most {balance.iterations.max()}, idle {idle:.0%}, unbalanced at most "
                    f"{(balance.unbalanced / size).max():.0e} of the load"
                )


if __name__ == "__main__":
    main()
