"""Figures and numbers of the page on tapered roller bearings: python docs/tapered_study.py."""

from pathlib import Path

import numpy as np

from macroslip.bearing.tapered import TaperedBearing
from macroslip.kinds.tapered.history import TaperedMount, TaperedState, tapered_history
from macroslip.loads.history import HubLoads
from macroslip.lubricant import Lubricant
from macroslip.report.style import BLUE, GREEN, ORANGE, finish, legend_above, new_figure

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
#: Pressure above which a roller counts as overloaded [GPa], half of that of the static rating.
OVERLOAD = 2.0
PRELOADS = np.linspace(-0.2, 0.5, 15)


def history(preload, load, temperature=35.0, *, supply=1.0, arrangement="O", **state):
    """Result of a constant load, preload in mm, temperature in °C, and what `TaperedState` takes."""
    (x, y, z), (mx, my) = load
    loads = HubLoads.constant(
        [1e3 * z, 1e3 * x, 1e3 * y], [0.0, 1e3 * mx, 1e3 * my], SHAFT_SPEED, 1.0, step=1.0
    )
    bearing = BEARING.replace(
        preload=1e-3 * preload, rib_oil_supply=supply, arrangement=arrangement
    )
    oil = Lubricant.read("vg460-pao").at(273.15 + temperature)
    result = tapered_history(bearing, oil, loads, TaperedMount(0.0), TaperedState(**state))
    return result.isel(time=0)


def loads_over_preload():
    """Largest load of both rows over preload, for three loads."""
    figure, (axes,) = new_figure(6.4, 4.2)
    for (name, load), colour in zip(LOADS.items(), COLOURS, strict=True):
        results = [history(preload, load).outer_load.max("roller") / 1e3 for preload in PRELOADS]
        carrying = [float(row[0]) for row in results]
        other = [float(row[1]) for row in results]
        axes.plot(PRELOADS, carrying, color=colour, label=name)
        axes.plot(PRELOADS, other, "--", color=colour)
    axes.plot([], [], "--", color="0.4", label="dashed: other row")
    axes.set_ylim(bottom=0.0)
    finish(axes, "axial preload [mm], negative is play", "largest roller load [kN]")
    legend_above(figure, axes, ncols=4)
    return figure


def window_of_preload():
    """Rollers below grip and largest pressure over preload, and the window with temperature."""
    figure, (grip, pressure, window) = new_figure(10.2, 3.8, columns=3)
    warm_preloads = np.linspace(-0.4, 0.75, 93)
    per_kelvin = float(history(0.2, LOADS["light"], temperature_difference=1.0).preload_change)
    differences = np.linspace(-15.0, 15.0, 61)
    for (name, load), colour in zip(LOADS.items(), COLOURS, strict=True):
        results = [history(preload, load) for preload in warm_preloads]
        below = np.array([float(result.below_grip.sum()) for result in results])
        largest = np.array([float(result.contact_pressure.max()) / 1e9 for result in results])
        grip.plot(warm_preloads, below, color=colour, label=name)
        pressure.plot(warm_preloads, largest, color=colour)
        gripped = warm_preloads[np.flatnonzero(below > 0.0)[-1] + 1]
        least = warm_preloads[int(largest.argmin())]
        beyond = warm_preloads >= least
        overloaded = np.interp(OVERLOAD, largest[beyond], warm_preloads[beyond])
        shift = 1e3 * per_kelvin * differences
        window.fill_betweenx(
            differences, gripped - shift, overloaded - shift, color=colour, alpha=0.25, lw=0
        )
        for edge in (gripped, overloaded):
            window.plot(edge - shift, differences, color=colour)
        print(
            f"{name}: all rollers grip from {gripped:.3f} mm, largest pressure least at "
            f"{least:.3f} mm with {largest.min():.3f} GPa, {OVERLOAD:g} GPa at {overloaded:.3f} mm"
        )
    grip.set_ylim(0, 68)
    window.set_xlim(-0.1, 0.9)
    window.set_ylim(-15, 15)
    finish(grip, "axial preload, warm [mm]", "rollers below grip, of 68")
    finish(pressure, "axial preload, warm [mm]", "largest contact pressure [GPa]")
    finish(window, "axial preload, mounted [mm]", "inner over outer ring [K]")
    pressure.axhline(OVERLOAD, color="0.5", lw=0.8, ls=":")
    window.axhline(0.0, color="0.5", lw=0.8)
    window.set_title(f"all grip, none above {OVERLOAD:g} GPa", fontsize="small")
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
            result = history(preload, load)
            loads = (result.outer_load.max("roller") / 1e3).values
            below = result.below_grip.values
            print(
                f"{name}, preload {preload} mm: largest loads {loads[0]:.0f} and {loads[1]:.0f} kN, "
                f"below grip {below[0]:.0f} and {below[1]:.0f}, "
                f"float {1e3 * float(result.axial_float.max()):.2f} mm, "
                f"torque {float(result.friction_torque):.0f} N m, of it ribs "
                f"{float(result.rib_torque):.0f}, "
                f"pressure {float(result.contact_pressure.max()) / 1e9:.2f}, at edges "
                f"{float(result.edge_pressure.max()) / 1e9:.2f} GPa, "
                f"edge share {float(result.edge_share.max()):.3f}, "
                f"microslip {1e6 * float(result.raceway_microslip.max()):.0f} um/s, "
                f"plane strain {float(result.other_line_law):.3f}"
            )
    print(f"load of grip {float(result.grip_load) / 1e3:.1f} kN")
    for supply in (1.0, 0.5, 0.2, 0.1):
        result = history(0.2, LOADS["force and moment"], supply=supply)
        work = result.rib_asperity_work.max("row").values
        print(
            f"rib film x {supply}: ribs {float(result.rib_power.sum()):.0f} W, "
            f"raceways {float(result.rolling_power.sum()):.0f} W, "
            f"film ratio {float(result.rib_film_ratio.min()):.1f}, "
            f"friction {float(result.rib_friction.max()):.4f}, "
            f"p v {float(result.rib_pressure_speed.max()) / 1e6:.1f} W/mm2, "
            f"pass {float(result.rib_pass_energy.max()) / 1e4:.0f}e4 J/m2, "
            f"flash {float(result.rib_flash_temperature.max()):.2f} K, "
            f"wear at 1e-17 m2/N: {work[0] * 1e-17 * 3.156e7 * 1e6:.2g} um a year on the rib, "
            f"{work[1] * 1e-17 * 3.156e7 * 1e6:.2g} on the rollers' ends"
        )
    alone = history(0.2, ((0.0, 0.0, 0.0), (0.0, 0.0)))
    print(f"preload alone, plane strain: {float(alone.other_line_law):.3f}")
    for law in ("palmgren", "plane-strain"):
        for name, load in LOADS.items():
            result = history(0.2, load, line_law=law)
            print(
                f"{law}, {name}: {float(result.outer_load.max()) / 1e3:.1f} kN, least "
                f"{float(result.least_load.min()) / 1e3:.1f} kN, "
                f"below grip {float(result.below_grip.sum()):.0f}"
            )


if __name__ == "__main__":
    for name, draw in (
        ("tapered_loads", loads_over_preload),
        ("tapered_window", window_of_preload),
        ("tapered_power", power_by_part),
    ):
        draw().savefig(FIGURES / f"{name}.svg", metadata={"Date": None})
    print_numbers()
