"""Friction torque of the base bearing beside the handbooks': over load, thrust, speed and temperature, and over the wind.

    python benchmarks/friction_torque.py curves -o docs/figures/friction_torque_curves.png     two minutes
    python benchmarks/friction_torque.py wind                                                  three minutes
    python benchmarks/friction_torque.py inlets                                                one minute
    python benchmarks/friction_torque.py supplies                                              ten minutes

Few rollers stand for all, over short windows: `curves` takes two rollers of each row over an orbit of steady load, `wind`
two rollers of each row over 60 s of each of the 21 load cases.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from macroslip import (
    Bearing,
    BearingLoads,
    Case,
    HubLoads,
    Laws,
    Lubricant,
    main_bearing_load,
    simulate,
)
from macroslip.report.style import new_figure, program_style
from macroslip.torque import palmgren_torque, skf_torque

BEARING = Bearing.read("skf-240-600-bc")
#: Mean load of a turbine at rated speed: radial and thrust [N], speed [rad/s], temperature [K].
RADIAL, THRUST, SPEED, TEMPERATURE = 344e3, 164e3, 2.143, 308.15
ROLLERS = [0, 14]
WINDOW = 60.0


class Torque(NamedTuple):
    """Parts of the friction torque [N m]: sliding and rolling at the raceways, cage, drag; and the handbooks'."""

    sliding: float
    rolling: float
    cage: float
    drag: float
    skf_sliding: float
    skf_rolling: float
    skf_drag: float
    skf: float
    palmgren: float

    @property
    def total(self) -> float:
        """Of the model."""
        return self.sliding + self.rolling + self.cage + self.drag


def torque(case: Case, loads: BearingLoads) -> Torque:
    """Mean torque over the window of a case, and the handbooks' over the same loads."""
    result = simulate(case)
    first, last = result.attrs["window_start"], result.attrs["window_end"]
    inside = (loads.time >= first) & (loads.time <= last)
    force, speed = loads.force[inside], loads.shaft_speed[inside]
    scale = (
        BEARING.rollers_per_row / result.sizes["roller"] / (last - first) / float(np.mean(speed))
    )
    energy, rolling = (
        result[name].sum(("row", "roller")) * scale for name in ("energy", "rolling_energy")
    )
    raceways = ["inner", "outer"]
    operation = BEARING, case.oil, np.hypot(force[:, 0], force[:, 1]), force[:, 2], speed
    skf, palmgren = skf_torque(*operation), palmgren_torque(*operation)
    return Torque(
        float(energy.sel(interface=raceways).sum()),
        float(rolling.sel(interface=raceways).sum()),
        float(energy.sel(interface="cage") + rolling.sel(interface="cage")),
        result.attrs["drag_power"] / float(np.mean(speed)),
        *(
            float(np.mean(part))
            for part in (skf.sliding, skf.rolling, skf.drag, skf.total, palmgren.total)
        ),
    )


def steady(radial=RADIAL, thrust=THRUST, speed=SPEED, temperature=TEMPERATURE, **laws) -> Torque:
    """Torque under a steady load over an orbit."""
    orbit = 2.0 * np.pi / (0.455 * speed)
    loads = BearingLoads.constant([0.0, -radial, thrust], speed, 2.2 * orbit)
    case = Case(
        loads=loads, rollers=ROLLERS, laws=Laws.physical().but(**laws), temperature=temperature
    )
    return torque(case, loads)


#: Name, values, unit and factor to it of each curve.
SWEEPS = {
    "radial": ("radial load", np.array([150e3, 250e3, 344e3, 450e3, 600e3]), "kN", 1e-3),
    "thrust": ("thrust", np.array([50e3, 100e3, 164e3, 250e3]), "kN", 1e-3),
    "speed": ("speed", np.array([0.5, 1.0, 1.5, 2.143, 2.8]), "rad/s", 1.0),
    "temperature": ("temperature", np.array([283.15, 293.15, 308.15, 323.15, 338.15]), "degC", 1.0),
}


def curves(output: str | None) -> None:
    """Print and draw the four curves."""
    torques = {
        key: [steady(**{key: float(value)}) for value in values]
        for key, (_, values, _, _) in SWEEPS.items()
    }
    print(
        "| | | sliding | rolling | cage | drag | total | SKF M_sl | M_rr | M_drag | all | Palmgren |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    for key, (name, values, unit, factor) in SWEEPS.items():
        for value, at_point in zip(values, torques[key], strict=True):
            shown = value - 273.15 if unit == "degC" else value * factor
            own = (at_point.sliding, at_point.rolling, at_point.cage, at_point.drag, at_point.total)
            others = (
                at_point.skf_sliding,
                at_point.skf_rolling,
                at_point.skf_drag,
                at_point.skf,
                at_point.palmgren,
            )
            print(
                f"| {name} | {shown:g} {unit} | "
                + " | ".join(f"{part:.0f}" for part in (*own, *others))
                + " |"
            )
    if output:
        _draw(torques, output)


@program_style()
def _draw(torques: dict[str, list[Torque]], output: str) -> None:
    figure, axes = new_figure(13.0, 3.6, 1, 4, sharey=True)
    for axis, (key, (name, values, unit, factor)) in zip(axes, SWEEPS.items(), strict=True):
        abscissa = values - 273.15 if unit == "degC" else values * factor
        lines = (
            ("sliding", "C0", "-"), ("rolling", "C1", "-"), ("cage", "C2", "-"), ("total", "k", "-"),
            ("skf_sliding", "C0", "--"), ("skf_rolling", "C1", "--"), ("skf", "k", "--"), ("palmgren", "C4", ":"),
        )  # fmt: skip
        for part, colour, style in lines:
            label = (
                part.replace("skf_sliding", "SKF M_sl")
                .replace("skf_rolling", "SKF M_rr")
                .replace("skf", "SKF, all")
            )
            axis.plot(
                abscissa,
                [getattr(at_point, part) for at_point in torques[key]],
                style,
                color=colour,
                label=label,
            )
        axis.set_xlabel(f"{name} [{unit.replace('degC', '°C')}]")
    axes[0].set_ylabel("friction torque [N m]")
    axes[0].legend(fontsize="x-small")
    figure.savefig(output, dpi=120)


class OverWind(NamedTuple):
    """Torques of one load case, and the mean friction power [W]."""

    name: str
    speed: int
    torque: Torque
    power: float


def over_wind(oil_supply: str | float) -> Iterator[OverWind]:
    """The 21 load cases with an oil supply."""
    for speed in range(12, 25, 2):
        for turbulence in "ABC":
            hub = HubLoads.bundled(f"{speed}{turbulence}").window(0.0, WINDOW)
            case = Case(loads=hub, rollers=ROLLERS, laws=Laws.physical(), oil_supply=oil_supply)
            loads = main_bearing_load(hub, case.drivetrain)
            parts_of_torque = torque(case, loads)
            yield OverWind(
                f"{speed}{turbulence}",
                speed,
                parts_of_torque,
                parts_of_torque.total * float(np.mean(loads.shaft_speed)),
            )


def print_ratios(every: list[OverWind]) -> None:
    """Print the model's torques over SKF's: mean over the load cases, and range; and the trend of the power."""
    for name, own, other in (
        ("sliding over M_sl", "sliding", "skf_sliding"),
        ("rolling over M_rr", "rolling", "skf_rolling"),
        ("total over SKF's", "total", "skf"),
    ):
        ratio = np.array(
            [getattr(of_case.torque, own) / getattr(of_case.torque, other) for of_case in every]
        )
        print(f"{name}: {ratio.mean():.2f}, {ratio.min():.2f} to {ratio.max():.2f}")
    speeds = sorted({of_case.speed for of_case in every})
    mean = [
        float(np.mean([of_case.power for of_case in every if of_case.speed == speed]))
        for speed in speeds
    ]
    print(
        "power [W] over wind speed: "
        + ", ".join(f"{v} m/s {p:.0f}" for v, p in zip(speeds, mean, strict=True))
    )
    at = {speed: float(np.interp(speed, speeds, mean)) for speed in (12, 13, 15)}
    print(
        f"12 over 15 m/s: {at[12] / at[15]:.2f}; 12 over 13 m/s: {at[12] / at[13]:.2f}", flush=True
    )


def wind() -> None:
    """Print the 21 cases, and means over turbulence classes by wind speed."""
    print(
        "| case | sliding | rolling | cage | drag | total | SKF M_sl | M_rr | all | Palmgren | power [W] |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    every = []
    for of_case in over_wind("skf"):
        every.append(of_case)
        parts_of_torque = of_case.torque
        parts = (
            parts_of_torque.sliding,
            parts_of_torque.rolling,
            parts_of_torque.cage,
            parts_of_torque.drag,
            parts_of_torque.total,
        )
        others = (
            parts_of_torque.skf_sliding,
            parts_of_torque.skf_rolling,
            parts_of_torque.skf,
            parts_of_torque.palmgren,
            of_case.power,
        )
        print(
            f"| {of_case.name} | " + " | ".join(f"{part:.0f}" for part in (*parts, *others)) + " |",
            flush=True,
        )
    print_ratios(every)


def supplies() -> None:
    """Print the ratios over the 21 cases for inlets from starved to flooded."""
    for supply in (0.5, 0.7, "skf", "flooded"):
        print(f"oil supply {supply}")
        print_ratios(list(over_wind(supply)))


def compare_inlets() -> None:
    """Print what oil supply and rheology make of the torque under the mean load."""
    oil = Lubricant.read("vg460-pao")
    orbit = 2.0 * np.pi / (0.455 * SPEED)
    loads = BearingLoads.constant([0.0, -RADIAL, THRUST], SPEED, 2.2 * orbit)
    for name, lubricant, supply, changes in (
        *(
            (f"oil supply {supply}", oil, supply, {})
            for supply in (0.3, 0.5, 0.7, 0.9, "skf", "flooded")
        ),
        *(
            (f"oil supply {supply}, {celsius} °C", oil.at(f"{celsius} degC"), supply, {})
            for supply in (0.5, 0.7, "skf", "flooded")
            for celsius in (10, 65)
        ),
        ("`skf`, rolling by `inlet`", oil, "skf", {"rolling": "inlet"}),
        ("`skf`, Eyring, 3.3 MPa", oil.replace(eyring_stress=3.3e6), "skf", {}),
        ("`skf`, limiting shear", oil, "skf", {"rheology": "limiting-shear"}),
    ):
        laws = Laws.physical().but(**changes)
        parts_of_torque = torque(
            Case(loads=loads, rollers=ROLLERS, laws=laws, lubricant=lubricant, oil_supply=supply),
            loads,
        )
        print(
            f"| {name} | {parts_of_torque.sliding:.0f} | {parts_of_torque.rolling:.0f} | {parts_of_torque.cage:.0f} | {parts_of_torque.total:.0f} | "
            f"{parts_of_torque.rolling / parts_of_torque.skf_rolling:.2f} | {parts_of_torque.total / parts_of_torque.skf:.2f} |",
            flush=True,
        )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("part", choices=("curves", "wind", "inlets", "supplies"))
    parser.add_argument("-o", "--output", help="picture of the curves")
    options = parser.parse_args()
    if options.part == "curves":
        curves(options.output)
    else:
        {"wind": wind, "inlets": compare_inlets, "supplies": supplies}[options.part]()
