"""Slip of cage and rollers in a cylindrical roller bearing of a gearbox, and where it jumps.

Measured in a wind turbine's gearbox (Guo and Keller, Tribol. Int. 149 (2020) 106347, abstract): at low wind and with cold oil
cage and rollers slip by up to 60 % in the loaded and 80 % in the unloaded zone; slip falls with temperature and with wind. Of
that bearing no geometry, load, clearance, cage or oil is public in the text at hand. Assumed is a bearing of a size that
fits a high-speed shaft (`data/cylindrical-160.yaml`), 1500 r/min, a mineral oil of VG 320 that fills all inlets, and a
cage of brass that the outer ring guides. Levels can therefore agree by chance; trends cannot.

A traction curve with a peak makes slip jump (Smith, Walowit and McGrew, J. Lubr. Technol. 95 (1973) 353 measured such
curves): where the brake on a roller passes the peak, nothing holds it, and it comes back at a higher load only. The
paper's law has a peak; Eyring's film, which heats, has a flat one.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
import xarray as xr

from macroslip import Bearing, BearingLoads, Cage, Case, Laws, Lubricant, Window, simulate
from macroslip.bearing.geometry import orbit_ratio
from macroslip.case.parts import Traces
from validation.comparison import Comparison, Range

BEARING = Bearing.read(Path(__file__).with_name("data") / "cylindrical-160.yaml")
OIL = Lubricant.read("vg320-mineral")
#: Speed of the shaft [rad/s].
SPEED = 1500.0 * math.pi / 30.0
CAGE = Cage(
    gap=3e-4,
    mass=4.0,
    guided_by="outer-ring",
    land_diameter=0.244,
    land_width=0.016,
    land_clearance=6e-4,
)
CELSIUS, LOADS = (20.0, 40.0, 60.0, 80.0), (2e3, 8e3, 20e3, 40e3)
#: Part of the largest roller load above which a roller is in the loaded zone.
LOADED = 0.05
#: Lightest and heaviest load of a ramp [N], and how long it takes each way [s].
LIGHT, HEAVY, RAMP = 1e3, 30e3, 10.0


class Slip(NamedTuple):
    """Mean slips, each 1 − speed/speed of pure rolling [-]."""

    cage: float
    loaded: float  #: Of rollers in the loaded zone
    unloaded: float


def _case(loads: BearingLoads, celsius: float, **choices) -> Case:
    defaults = {
        "oil_supply": "flooded",
        "cage": CAGE,
        "dynamics": "whole-bearing",
        "contact_details": False,
        "rating": False,
    }
    return Case(
        bearing=BEARING,
        lubricant=OIL,
        temperature=celsius + 273.15,
        loads=loads,
        **defaults | choices,
    )


def steady(load: float, celsius: float, **choices) -> Slip:
    """Under a constant radial load [N]; the first 0.7 s, in which rollers leave pure rolling, are left out."""
    loads = BearingLoads.constant([0.0, -load, 0.0], SPEED, 1.0)
    result = simulate(
        _case(
            loads, celsius, window=Window(start=0.7), traces=Traces(step=2e-3, start=0.7), **choices
        )
    )
    if result.status.any():
        raise RuntimeError(f"{load} N, {celsius} °C: status {int(result.status.max())}")
    slip = 1.0 - result.spin / result.spin_pure
    inside = result.roller_load > LOADED * result.roller_load.max()
    return Slip(
        -float(result.cage_slip[0]),
        float(slip.where(inside).mean()),
        float(slip.where(~inside).mean()),
    )


def ramp(laws: Laws) -> xr.Dataset:
    """Slip of the cage over a load that falls and rises again at 60 °C: `falling` and `rising` over `load` [N]."""
    time = np.linspace(0.0, 2.0 * RAMP, 401)
    load = np.exp(np.interp(time, [0.0, RAMP, 2.0 * RAMP], np.log([HEAVY, LIGHT, HEAVY])))
    force = np.column_stack([0.0 * time, -load, 0.0 * time])
    loads = BearingLoads(time, np.full(time.size, SPEED), force, "a load that falls and rises")
    asks = {"oil_supply": "flooded" if laws.asks_for_oil else None}
    case = _case(loads, 60.0, laws=laws, traces=Traces(step=0.025), **asks)
    result = simulate(case)
    if result.status.any():
        raise RuntimeError(f"ramp under {laws.name}: status {int(result.status.max())}")
    slip = 1.0 - result.cage_speed.values[0] / (orbit_ratio(BEARING) * SPEED)
    down = slice(0, result.time.size // 2 + 1)
    over = np.interp(result.time.values[down], time, load)
    return xr.Dataset(
        {"falling": ("load", slip[down]), "rising": ("load", slip[::-1][down])}, {"load": over}
    )


def jumps(slips: xr.Dataset, slip: float = 0.2) -> tuple[float, float]:
    """Loads [N] at which the cage's slip passes a value while the load falls, and while it rises."""
    lost, held = (
        float(slips["load"][np.flatnonzero(slips[name].values > slip)[0]])
        for name in ("falling", "rising")
    )
    return lost, held


def compare() -> list[Comparison]:
    """The lines of the table."""
    cold, warm, loaded = (
        steady(LOADS[0], CELSIUS[0]),
        steady(LOADS[2], CELSIUS[3]),
        steady(LOADS[3], CELSIUS[2]),
    )
    about = "trend: falls with temperature and load; level: bearing, load, oil and cage are assumed"
    rows = []
    for zone, measured in (("loaded", 0.6), ("unloaded", 0.8)):
        slip_when_cold, *others = (getattr(each, zone) for each in (cold, warm, loaded))
        rows.append(
            Comparison(
                f"largest slip of rollers, {zone} zone, cold and at light load", Range(measured, measured),
                Range(slip_when_cold, slip_when_cold), Range(slip_when_cold / measured, slip_when_cold / measured), about,
            )
        )  # fmt: skip
        rows.append(
            Comparison(
                f"the same, {CELSIUS[3]:.0f} °C at {1e-3 * LOADS[2]:.0f} kN and {CELSIUS[2]:.0f} °C at {1e-3 * LOADS[3]:.0f} kN",
                Range(0.0, measured), Range.of(others), Range.of(np.array(others) / measured), "measured: less",
            )
        )  # fmt: skip
    return rows


def draw(path: Path) -> None:
    """Slip over temperature and load, and over a load that falls and rises."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    colours = dict(zip(LOADS, ("#0072B2", "#009E73", "#D55E00", "#6E6E6E"), strict=True))
    for load, colour in colours.items():
        slips = [steady(load, celsius) for celsius in CELSIUS]
        left.plot(
            CELSIUS,
            [100.0 * slip.loaded for slip in slips],
            "o-",
            color=colour,
            label=f"{1e-3 * load:.0f} kN",
        )
        left.plot(CELSIUS, [100.0 * slip.unloaded for slip in slips], "s--", color=colour)
    left.set(xlabel="oil temperature [°C]", ylabel="slip of rollers [%]", ylim=(0.0, 100.0))
    left.set_title("loaded zone (lines), unloaded zone (dashes)", fontsize=9, loc="left")
    left.legend(frameon=False, fontsize="small")
    for laws, colour in ((Laws.paper(), "#D55E00"), (Laws.physical(), "#0072B2")):
        slips = ramp(laws)
        right.plot(
            1e-3 * slips["load"],
            100.0 * slips.falling,
            "-",
            color=colour,
            label=f"{laws.name}, load falls",
        )
        right.plot(
            1e-3 * slips["load"],
            100.0 * slips.rising,
            "--",
            color=colour,
            label=f"{laws.name}, load rises",
        )
    right.set(
        xlabel="radial load [kN]", ylabel="slip of the cage [%]", xscale="log", ylim=(0.0, 100.0)
    )
    right.legend(frameon=False, fontsize="small")
    figure.savefig(path, dpi=110)
