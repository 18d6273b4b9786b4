"""Numbers of damage.md: criteria of the 21 bundled cases under `physical`, three rollers a row, over temperature and oil supply.

python docs/damage_study.py 40          # oil at 40 degC
python docs/damage_study.py 40 0.5      # and an oil supply: flooded, skf or film / flooded film
python docs/damage_study.py 40 skf skew # of rollers that skew, guided by the default cage
python docs/damage_study.py oval        # an outer raceway out of round, three load cases of two minutes
python docs/damage_study.py figure      # figures/damage.svg, of 14B at 35 degC
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from macroslip import Bearing, Case, HubLoads, Laws, bundled_cases, simulate
from macroslip.constants import YEAR
from macroslip.result.criteria import CRITERIA
from macroslip.result.damage import damage

ROLLERS = [0, 9, 18]


def main(temperature: float, oil_supply: str | float = "skf", *, skew: bool = False) -> None:
    names = [criterion.name for criterion in CRITERIA]
    values, entries, wear = [], [], []
    for name in bundled_cases():
        case = Case(
            loads=HubLoads.bundled(name),
            oil_supply=oil_supply,
            laws=Laws.physical().but(skew="quasi-static" if skew else "none"),
            rollers=ROLLERS,
            temperature=temperature + 273.15,
        )
        criteria = damage(simulate(case))
        values.append(criteria.value.values)
        entries.append((criteria.entry_rate * YEAR).values)
        wear.append((criteria.wear_time.sel(depth=1e-5) / YEAR).min(("row", "surface")).values)
        print(
            name,
            *(
                f"{criterion}={value:.3g}"
                for criterion, value in zip(names, values[-1], strict=True)
            ),
            entries[-1],
            flush=True,
        )
    values = np.array(values)
    print(f"{temperature:g} degC, oil_supply {oil_supply}")
    for k, criterion in enumerate(names):
        if np.isnan(values[:, k]).all():
            continue
        low, middle, high = (
            np.nanmin(values[:, k]),
            np.nanmedian(values[:, k]),
            np.nanmax(values[:, k]),
        )
        print(
            f"{criterion:26s} {low:10.3g} {middle:10.3g} {high:10.3g}  {bundled_cases()[int(np.nanargmax(values[:, k]))]}"
        )
    print(
        "entries a year, downwind and upwind, least and most:",
        np.min(entries, axis=0),
        np.max(entries, axis=0),
    )
    print("years to 10 um, least of the cases, by k:", np.min(wear, axis=0))


def oval() -> None:
    """Print what an oval outer raceway does to energy, peak, e_a and entries, over the round one."""
    round_bearing = Bearing.read("skf-240-600-bc")
    for name in ("12C", "14B", "24A"):
        loads = HubLoads.bundled(name).window(0.0, 120.0)
        reference = None
        for wave in (0.0, 50e-6, -50e-6, 100e-6, -100e-6):
            bearing = round_bearing.replace(out_of_round_second=wave) if wave else round_bearing
            result = simulate(Case(loads=loads, bearing=bearing, rollers=ROLLERS))
            criteria = damage(result)
            raceways = ["inner", "outer"]
            values = np.array(
                [
                    float(result.energy.sel(interface=raceways).sum()),
                    float(result.window_peak_power.sel(interface=raceways).max()),
                    float(criteria.pressure_slip_rate.max()),
                    float(criteria.entry_rate.sum()),
                    float(criteria.entry_slide_roll_ratio.max()),
                ]
            )
            if reference is None:
                reference = values
            print(
                f"{name} {1e6 * wave:+5.0f} um: raceway energy, peak, e_a, entries, slip at entry",
                np.round(values / reference, 2),
                flush=True,
            )


def figure() -> None:
    from matplotlib import pyplot

    case = Case(loads=HubLoads.bundled("14B"), laws=Laws.physical(), rollers=ROLLERS)
    result = simulate(case)
    drawn, axes = pyplot.subplots(1, 2, figsize=(9.0, 3.2), layout="constrained")
    result.macroslip.plot.damage(axes=axes[0])
    result.macroslip.plot.wear(axes=axes[1])
    pyplot.rcParams["svg.hashsalt"] = "macroslip"
    drawn.savefig(Path(__file__).parent / "figures" / "damage.svg", metadata={"Date": None})


if __name__ == "__main__":
    if sys.argv[1:] == ["figure"]:
        figure()
    elif sys.argv[1:] == ["oval"]:
        oval()
    else:
        words = [word for word in sys.argv[2:] if word != "skew"]
        supplies = [word if word in ("flooded", "skf") else float(word) for word in words]
        main(float(sys.argv[1]), *supplies, skew="skew" in sys.argv)
