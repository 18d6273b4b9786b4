"""Friction torque of a tapered roller bearing under thrust.

Measured was a bearing 32216 under 6 kN of thrust, without preload, with FVA3 at 50 °C and oil to the
middle of a roller (`data/tapered_torque.csv`). Computed are the rolling resistance of both raceways
and the ribs with a full film, with nothing fitted: by two formulas for flooded inlets, and by the
law of cases, flooded and with 0.7 of the film of full inlets. The rib's geometry is an estimate, and
hardly counts while its film is full; churning is left out.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from macroslip import Laws
from macroslip.bearing.tapered import TaperedBearing, tapered_geometry
from macroslip.contact.laws import prepare
from macroslip.contact.line_rolling import line_contacts, rolling_resistance
from macroslip.contact.rib import rib_contact, rib_state
from macroslip.contact.rolling import at_oil_gap
from macroslip.contact.starvation import inlet_for_film
from macroslip.lubricant.estimate import estimate_lubricant
from macroslip.report.style import BLACK, BLUE, GREEN, ORANGE, finish, legend_above, new_figure
from macroslip.ring.tapered import tapered_balance, tapered_ring
from validation.comparison import Comparison, Range

BEARING = TaperedBearing.read("32216-pair")
#: FVA3, reference oil of the German Research Association for Drive Technology: 95 mm²/s at 40 °C and
#: 10.7 mm²/s at 100 °C.
OIL = estimate_lubricant(95e-6, 10.7e-6, "mineral", name="fva3").at(323.15)
THRUST = 6000.0
DATA = Path(__file__).with_name("data") / "tapered_torque.csv"
NAMES = {"zhou-hoeprich": "Zhou and Hoeprich", "goksem-hargreaves": "Goksem and Hargreaves"}
#: Film over that of full inlets, by the line that a case computes.
SUPPLIES = {"whole film, flooded": 1.0, "whole film, starved": 0.7}
LINES = (*NAMES.values(), *SUPPLIES)


def supplied(law: Any, load: float, speed: float, supply: float) -> Any:
    """Laws of a raceway whose film is `supply` of that of full inlets at a load [N] and speed [m/s]."""
    if supply == 1.0:
        return law
    film = float(law.film_thickness(load, speed))
    gap = inlet_for_film(supply) * supply * film
    return replace(law, rolling=at_oil_gap(law.rolling, gap))


def rolling_forces(line: str, loads: tuple[np.ndarray, np.ndarray], surface_speed: float) -> float:
    """Rolling resistance of all contacts [N] under loads of rollers at both raceways [N]."""
    if line in SUPPLIES:
        laws = prepare(Laws.physical(), BEARING, OIL, 1)
        forces = [
            supplied(law, load.max(), surface_speed, SUPPLIES[line]).light(
                load[load > 0.0], surface_speed
            )[1]
            for law, load in zip((laws.inner, laws.outer), loads, strict=True)
        ]
    else:
        formula = next(law for law, name in NAMES.items() if name == line)
        forces = [
            rolling_resistance(contact, load, surface_speed, formula)
            for contact, load in zip(line_contacts(BEARING, OIL), loads, strict=True)
        ]
    return float(np.concatenate(forces).sum())


def torque(speed: float, line: str) -> float:
    """Torque of raceways and ribs [N m] at a speed of the inner ring [rad/s], by a line of `LINES`."""
    row = tapered_geometry(BEARING)
    force = np.array([[0.0, 0.0, THRUST]])
    balance = tapered_balance(tapered_ring(BEARING), np.zeros(1), force, np.zeros((1, 2)))
    surface = float(row.surface_speed(speed))
    loads = balance.inner_load[0], balance.outer_load[0]
    power = 2.0 * surface * rolling_forces(line, loads, surface)
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
    """One line for each formula of the rolling resistance and supply of oil."""
    data = measured()
    rows = []
    for line in LINES:
        computed = [1e3 * torque(rpm * math.pi / 30.0, line) for rpm in data.speed_rpm]
        rows.append(
            Comparison(
                f"torque of a tapered bearing [N mm], {line}",
                Range.of(data.torque_Nmm),
                Range.of(computed),
                Range.of(np.array(computed) / data.torque_Nmm),
                "rolling resistance of tapered rollers",
            )
        )
    return rows


def draw(path: Path) -> None:
    """Torque over speed, measured and computed."""
    figure, (axes,) = new_figure(5.6, 4.0)
    data = measured()
    axes.errorbar(
        data.speed_rpm, data.torque_Nmm, yerr=100.0, fmt="o", color=BLACK, label="measured"
    )
    speeds = np.linspace(300.0, 4200.0, 20)
    styles = ((BLUE, "-"), (ORANGE, "-"), (GREEN, "-"), (GREEN, "--"))
    for line, (colour, style) in zip(LINES, styles, strict=True):
        computed = [1e3 * torque(rpm * math.pi / 30.0, line) for rpm in speeds]
        axes.plot(speeds, computed, color=colour, linestyle=style, label=line)
    axes.set_ylim(bottom=0.0)
    finish(axes, "speed [r/min]", "friction torque [N mm]")
    legend_above(figure, axes, ncols=2)
    figure.savefig(path, dpi=150)
