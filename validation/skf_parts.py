"""Rolling and sliding torque of the base bearing beside the two parts of the SKF model, over temperature, speed, load, thrust.

The SKF model is fitted to measured torques of whole bearings. Its M_rr without the replenishment factor φ_rs is the rolling
torque of full inlets, and so is compared with the program's full inlets; both with φ_rs are compared as totals.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np

from benchmarks.friction_torque import (
    BEARING,
    RADIAL,
    ROLLERS,
    SPEED,
    SWEEPS,
    TEMPERATURE,
    THRUST,
    torque,
)
from macroslip import BearingLoads, Case, Laws, Lubricant
from macroslip.contact.rolling import replenishment
from validation.comparison import Comparison, Range

OIL = Lubricant.read("vg460-pao")
COLD, WARM = 283.15, 338.15


class Parts(NamedTuple):
    """Torques of full inlets [N m], own and SKF's, and φ_rs [-]."""

    rolling: float
    sliding: float
    rest: float
    skf_rolling: float
    skf_sliding: float
    replenishment: float

    @property
    def total(self) -> float:
        """Own, with SKF's replenishment factor on the rolling part."""
        return self.replenishment * self.rolling + self.sliding + self.rest

    @property
    def skf_total(self) -> float:
        """SKF's, with replenishment."""
        return self.replenishment * self.skf_rolling + self.skf_sliding


@lru_cache
def parts(rolling: str = "whole-film", **changed: float) -> Parts:
    """Torques under a steady load, the mean load of a turbine at rated speed but for what is changed [N, rad/s, K]."""
    operation = {
        "radial": RADIAL,
        "thrust": THRUST,
        "speed": SPEED,
        "temperature": TEMPERATURE,
    } | changed
    orbit = 2.0 * np.pi / (0.455 * operation["speed"])
    loads = BearingLoads.constant(
        [0.0, -operation["radial"], operation["thrust"]], operation["speed"], 2.2 * orbit
    )
    laws = Laws.physical().but(rolling=rolling)
    case = Case(
        loads=loads,
        rollers=ROLLERS,
        laws=laws,
        oil_supply="flooded",
        temperature=operation["temperature"],
    )
    torques, oil = torque(case, loads), OIL.at(operation["temperature"])
    filled = replenishment(
        oil.viscosity / oil.density, operation["speed"], BEARING.bore_diameter, BEARING.outside_diameter
    )  # fmt: skip
    return Parts(
        torques.rolling,
        torques.sliding,
        torques.cage + torques.drag,
        torques.skf_rolling / float(filled),
        torques.skf_sliding,
        float(filled),
    )


def sweep(key: str, rolling: str = "whole-film") -> list[Parts]:
    """Parts over the values of one sweep."""
    return [parts(rolling, **{key: float(value)}) for value in SWEEPS[key][1]]


def compare() -> list[Comparison]:
    """The lines of the table."""
    rows = []

    def add(quantity: str, own: list[float], skf: list[float], decides: str) -> None:
        ratio = np.array(own) / np.array(skf)
        rows.append(Comparison(quantity, Range.of(skf), Range.of(own), Range.of(ratio), decides))

    level = (
        "level of rolling resistance: nothing fitted, full inlets, φ_rs in place of a fixed inlet"
    )
    for rolling in ("whole-film", "inlet"):
        every = sweep("temperature", rolling)
        add(
            f"rolling torque of full inlets, `{rolling}`, 65 to 10 °C, SKF's M_rr without φ_rs [N m]",
            [at_point.rolling for at_point in every], [at_point.skf_rolling for at_point in every], level,
        )  # fmt: skip
    for key in ("speed", "radial", "thrust"):
        every, (name, values, unit, factor) = sweep(key), SWEEPS[key]
        add(
            f"the same, `whole-film`, {name} {values[0] * factor:g} to {values[-1] * factor:g} {unit} [N m]",
            [at_point.rolling for at_point in every], [at_point.skf_rolling for at_point in every], "powers of load and speed",
        )  # fmt: skip
    every = sweep("temperature")
    add(
        "sliding torque, 10 to 65 °C, SKF's M_sl [N m]",
        [at_point.sliding for at_point in every], [at_point.skf_sliding for at_point in every],
        "open: SKF's coefficient is of a whole bearing and does not fall with viscosity",
    )  # fmt: skip
    add(
        "friction torque with φ_rs on both, 10 to 65 °C, SKF's [N m]",
        [at_point.total for at_point in every], [at_point.skf_total for at_point in every], "heat of the bearing",
    )  # fmt: skip
    return rows


def draw(path: Path) -> None:
    """Both parts over each sweep, and their ratios."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13, 5.6), layout="constrained")
    axes = figure.subplots(2, len(SWEEPS), sharex="col", sharey="row", height_ratios=(3, 2))
    for (upper, lower), (key, (name, values, unit, factor)) in zip(
        axes.T, SWEEPS.items(), strict=True
    ):
        abscissa = values - 273.15 if unit == "degC" else values * factor
        every = sweep(key)
        filled = np.array([at_point.replenishment for at_point in every])
        for part, colour in (("rolling", "C1"), ("sliding", "C0")):
            own, skf = (
                np.array([getattr(at_point, f"{who}{part}") for at_point in every])
                for who in ("", "skf_")
            )
            upper.plot(
                abscissa, own, color=colour, label=f"{part}, full" if part == "rolling" else part
            )
            upper.plot(
                abscissa,
                skf,
                "--",
                color=colour,
                label=f"SKF {'M_rr, K_rs = 0' if part == 'rolling' else 'M_sl'}",
            )
            if part == "rolling":
                upper.plot(abscissa, own * filled, color="C3", label="rolling, φ_rs")
                upper.plot(abscissa, skf * filled, "--", color="C3", label="SKF M_rr, φ_rs")
            lower.plot(abscissa, own / skf, color=colour, label=part)
        lower.plot(
            abscissa,
            [at_point.total / at_point.skf_total for at_point in every],
            color="k",
            label="all, φ_rs",
        )
        lower.axhline(1.0, color="0.7", lw=0.8)
        lower.set_xlabel(f"{name} [{unit.replace('degC', '°C')}]")
        upper.set_yscale("log")
    axes[0, 0].set_ylabel("torque [N m]")
    axes[1, 0].set(ylabel="over SKF's", ylim=(0.0, 1.6))
    axes[0, -1].legend(fontsize="x-small")
    axes[1, -1].legend(fontsize="x-small")
    figure.savefig(path, dpi=110)
