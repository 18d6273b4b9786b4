"""Residuals of the balances of momentum and energy."""

from __future__ import annotations

import numpy as np

from macroslip.whole_bearing.ledger import FLOWS, STOCKS
from macroslip.whole_bearing.record import BearingRecord

#: Flows that bring energy (+) or take it away (−).
_ENERGY_SIGNS = {
    "shaft_work": 1.0, "body_work": 1.0, "cage_weight_work": 1.0, "raceway_loss": -1.0, "friction_loss": -1.0,
    "guide_loss": -1.0, "pocket_work": -1.0, "support_work": -1.0,
}  # fmt: skip


def momentum_residual(record: BearingRecord) -> np.ndarray:
    """Change of angular momentum since the first output less the impulses of all torques [N m s], shape (m,)."""
    held = record.held[:, STOCKS.index("momentum")]
    impulse = record.flows[:, [FLOWS.index(name) for name in FLOWS if name.endswith("_impulse")]].sum(axis=1)
    return (held - held[0]) - (impulse - impulse[0])


def energy_residual(record: BearingRecord) -> np.ndarray:
    """Change of kinetic energy since the first output less what flowed in and out [J], shape (m,).

    Work into pockets and supports holds what they store and what they dissipate.
    """
    kinetic = record.held[:, STOCKS.index("kinetic_energy")]
    flow = record.flows[:, [FLOWS.index(name) for name in _ENERGY_SIGNS]] @ np.array(list(_ENERGY_SIGNS.values()))
    return (kinetic - kinetic[0]) - (flow - flow[0])


def pocket_loss(record: BearingRecord) -> np.ndarray:
    """Energy dissipated by impacts and squeeze films, and by the cage's radial stop, since the first output [J]."""
    stored = record.held[:, STOCKS.index("elastic_energy")]
    work = record.flows[:, FLOWS.index("pocket_work")] + record.flows[:, FLOWS.index("support_work")]
    return (work - work[0]) - (stored - stored[0])
