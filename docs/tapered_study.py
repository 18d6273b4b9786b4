"""Figures and numbers of the page on tapered roller bearings: python docs/tapered_study.py."""

from pathlib import Path

import numpy as np

from macroslip.bearing.tapered import TaperedBearing
from macroslip.loads.history import HubLoads
from macroslip.lubricant import Lubricant
from macroslip.report.style import BLUE, GREEN, ORANGE, finish, legend_above, new_figure
from macroslip.result.tapered import TaperedMount, TaperedState, tapered_history

FIGURES = Path(__file__).parent / "figures"
BEARING = TaperedBearing.read("tdo-main-bearing")
SHAFT_SPEED = 12.0 * 2.0 * np.pi / 60.0
#: Force along X0, Y0, Z0 [kN] and moment about X0, Y0 [kN m] in the bearing's middle.
LOADS = {
    "force only": ((50.0, -1300.0, 700.0), (0.0, 0.0)),
    "force and moment": ((50.0, -1300.0, 700.0), (-700.0, 200.0)),
    "light": ((0.0, -300.0, 300.0), (0.0, 0.0)),
}
COLOURS = (BLUE, ORANGE, GREEN)
PRELOADS = np.linspace(-0.2, 0.5, 15)


def history(preload, load, temperature=35.0, *, difference=0.0, supply=1.0):
    """Result of two samples of a constant load, preload in mm, temperature in °C."""
    (x, y, z), (mx, my) = load
    loads = HubLoads.constant(
        [1e3 * z, 1e3 * x, 1e3 * y], [0.0, 1e3 * mx, 1e3 * my], SHAFT_SPEED, 1.0, step=1.0
    )
    bearing = BEARING.replace(preload=1e-3 * preload, rib_oil_supply=supply)
    oil = Lubricant.read("vg460-pao").at(273.15 + temperature)
    state = TaperedState(temperature_difference=difference)
    return tapered_history(bearing, oil, loads, TaperedMount(0.0), state).isel(time=0)


def loads_over_preload():
    """Largest load of both rows over preload, for three loads."""
    figure, (axes,) = new_figure(6.4, 4.2)
    for (name, load), colour in zip(LOADS.items(), COLOURS, strict=True):
        found = [history(preload, load).outer_load.max("roller") / 1e3 for preload in PRELOADS]
        carrying = [float(row[0]) for row in found]
        other = [float(row[1]) for row in found]
        axes.plot(PRELOADS, carrying, color=colour, label=f"{name}: row that carries the thrust")
        axes.plot(PRELOADS, other, "--", color=colour, label=f"{name}: other row")
    axes.set_ylim(bottom=0.0)
    finish(axes, "axial preload [mm], negative is play", "largest roller load [kN]")
    legend_above(figure, axes, ncols=2)
    return figure


def window_of_preload():
    """Rollers below grip and largest pressure over preload and temperature difference."""
    figure, (grip, pressure) = new_figure(7.6, 3.8, columns=2)
    load = LOADS["force and moment"]
    for difference, colour in zip((-10.0, 0.0, 10.0), COLOURS, strict=True):
        found = [history(preload, load, difference=difference) for preload in PRELOADS]
        label = f"inner ring {difference:+.0f} K" if difference else "equal temperatures"
        below = [float(result.below_grip.sum()) for result in found]
        largest = [float(result.contact_pressure.max()) / 1e9 for result in found]
        grip.plot(PRELOADS, below, color=colour, label=label)
        pressure.plot(PRELOADS, largest, color=colour)
    grip.set_ylim(0, 68)
    finish(grip, "axial preload, mounted [mm]", "rollers below grip, of 68")
    finish(pressure, "axial preload, mounted [mm]", "largest contact pressure [GPa]")
    legend_above(figure, grip, ncols=3)
    return figure


def power_by_part():
    """Power of raceways and ribs over temperature, inlets of the ribs full and a tenth full."""
    figure, (axes,) = new_figure(6.4, 3.8)
    temperatures = np.linspace(20.0, 70.0, 11)
    load = LOADS["force and moment"]
    full = [history(0.2, load, temperature) for temperature in temperatures]
    tenth = [history(0.2, load, temperature, supply=0.1) for temperature in temperatures]
    lines = (
        ("raceways, rolling resistance, flooded", full, "rolling_power", BLUE, "-"),
        ("ribs, full film", full, "rib_power", ORANGE, "-"),
        ("ribs, a tenth of the film", tenth, "rib_power", ORANGE, "--"),
    )
    for label, results, name, colour, style in lines:
        power = [float(result[name].sum()) for result in results]
        axes.plot(temperatures, power, style, color=colour, label=label)
    axes.set_ylim(bottom=0.0)
    finish(axes, "temperature of the oil [°C]", "power [W] at 12 r/min")
    legend_above(figure, axes, ncols=1)
    return figure


def print_numbers():
    """Print the numbers that the page quotes."""
    for name, load in LOADS.items():
        for preload in (0.0, 0.2, 0.4):
            found = history(preload, load)
            loads = (found.outer_load.max("roller") / 1e3).values
            below = found.below_grip.values
            print(
                f"{name}, preload {preload} mm: largest loads {loads[0]:.0f} and {loads[1]:.0f} kN, "
                f"below grip {below[0]:.0f} and {below[1]:.0f}, "
                f"torque {float(found.friction_torque):.0f} N m, of it ribs "
                f"{float(found.rib_power.sum()) / SHAFT_SPEED:.0f}, "
                f"pressure {float(found.contact_pressure.max()) / 1e9:.2f} GPa"
            )
    print(f"load of grip {float(found.grip_load) / 1e3:.1f} kN")
    for supply in (1.0, 0.5, 0.2, 0.1):
        found = history(0.2, LOADS["force and moment"], supply=supply)
        print(
            f"rib film x {supply}: ribs {float(found.rib_power.sum()):.0f} W, "
            f"raceways {float(found.rolling_power.sum()):.0f} W, film ratio {float(found.rib_film_ratio.min()):.1f}"
        )


if __name__ == "__main__":
    for name, draw in (
        ("tapered_loads", loads_over_preload),
        ("tapered_window", window_of_preload),
        ("tapered_power", power_by_part),
    ):
        draw().savefig(FIGURES / f"{name}.svg", metadata={"Date": None})
    print_numbers()
