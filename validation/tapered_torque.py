"""Friction torque of a tapered roller bearing under thrust.

Measured was a bearing 32216 under 6 kN of thrust, without preload, with FVA3 at 50 °C and oil to the
middle of a roller (`data/tapered_torque.csv`). Computed are the rolling resistance of both raceways
by two formulas and the ribs with a full film, with flooded inlets and nothing fitted. The rib's
geometry is an estimate, and hardly counts while its film is full; churning is left out.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pandas as pd

from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.line_rolling import ROLLING_LAWS, line_contacts, rolling_resistance
from macroslip.contact.rib import rib_contact, rib_state
from macroslip.lubricant.estimate import estimate_lubricant
from macroslip.report.style import BLACK, BLUE, ORANGE, finish, legend_above, new_figure
from macroslip.ring.tapered import tapered_balance, tapered_ring
from validation.comparison import Comparison, Range

BEARING = TaperedBearing.read("32216-pair")
#: FVA3, reference oil of the German Research Association for Drive Technology: 95 mm²/s at 40 °C and
#: 10.7 mm²/s at 100 °C.
OIL = estimate_lubricant(95e-6, 10.7e-6, "mineral", name="fva3").at(323.15)
THRUST = 6000.0
DATA = Path(__file__).with_name("data") / "tapered_torque.csv"
NAMES = {"zhou-hoeprich": "Zhou and Hoeprich", "goksem-hargreaves": "Goksem and Hargreaves"}


def torque(speed: float, law: str) -> float:
    """Torque of raceways and ribs [N m] at a speed of the inner ring [rad/s]."""
    row = tapered_geometry(BEARING)
    force = np.array([[0.0, 0.0, THRUST]])
    balance = tapered_balance(tapered_ring(BEARING), np.zeros(1), force, np.zeros((1, 2)))
    surface = float(row.surface_speed(speed))
    power = 0.0
    for contact, load in zip(
        line_contacts(BEARING, OIL), (balance.inner_load, balance.outer_load), strict=True
    ):
        power += float(2.0 * surface * rolling_resistance(contact, load[0], surface, law).sum())
    rib = rib_state(
        rib_contact(BEARING, OIL),
        balance.rib_force[0],
        row.rib_entrainment_speed(speed),
        row.rib_sliding_speed(speed),
    )
    return (power + float(rib.power.sum())) / speed


def measured() -> pd.DataFrame:
    """Speeds [r/min] and torques [N mm]."""
    return pd.read_csv(DATA, comment="#")


def compare() -> list[Comparison]:
    """One line for each formula of the rolling resistance."""
    data = measured()
    rows = []
    for law in ROLLING_LAWS:
        computed = [1e3 * torque(rpm * math.pi / 30.0, law) for rpm in data.speed_rpm]
        rows.append(
            Comparison(
                f"torque of a tapered bearing [N mm], {NAMES[law]}",
                Range.of(data.torque_Nmm),
                Range.of(computed),
                Range.of(np.array(computed) / data.torque_Nmm),
                "rolling resistance of tapered rollers",
            )
        )
    return rows


def draw(path: Path) -> None:
    """Torque over speed, measured and computed."""
    figure, (axes,) = new_figure(5.6, 3.6)
    data = measured()
    axes.errorbar(
        data.speed_rpm, data.torque_Nmm, yerr=100.0, fmt="o", color=BLACK, label="measured"
    )
    speeds = np.linspace(300.0, 4200.0, 20)
    for law, colour in zip(ROLLING_LAWS, (BLUE, ORANGE), strict=True):
        computed = [1e3 * torque(rpm * math.pi / 30.0, law) for rpm in speeds]
        axes.plot(speeds, computed, color=colour, label=NAMES[law])
    axes.set_ylim(bottom=0.0)
    finish(axes, "speed [r/min]", "friction torque [N mm]")
    legend_above(figure, axes)
    figure.savefig(path, dpi=150)
