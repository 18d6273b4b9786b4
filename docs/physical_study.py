"""Print the tables of published-study.md and of notes/physical-study.md, from the results of `make reproduce`.

make reproduce
PYTHONPATH=. python docs/physical_study.py results
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from paper.reproduce import STUDIES
from paper.studies import dissipation, paper_numbers, paper_study
from paper.uncertainty import drivers, robust, strongest, uncertainty, uncertainty_summary
from paper.values import VALUES

ROWS = ("downwind", "upwind")


def by_speed(values):
    """Mean over the turbulence classes."""
    return values.groupby("wind_speed").mean(skipna=False)


def study_tables(physical: Path, paper: Path | None) -> None:
    """The table over wind speed, and what the text quotes of it."""
    study = paper_study(physical)
    numbers, parts = paper_numbers(study), dissipation(study)
    energy = by_speed(study.energy.mean("roller") / study.orbits)
    thrust, load = by_speed(study.thrust), by_speed(study.roller_load.sel(row="downwind"))
    other = paper_study(paper) if paper else None
    print(
        "| wind [m/s] | thrust [kN] | roller load [kN] | downwind: inner, outer, cage [J] | upwind: inner, outer, cage [J]",
        end="",
    )
    print(" | paper's equations: downwind, upwind [J] |" if paper else " |")
    print("|---" * (6 if paper else 5) + "|")
    for speed in energy.wind_speed.values:
        at_speed = energy.sel(wind_speed=speed)
        cells = [
            f"{speed:g}",
            f"{1e-3 * thrust.sel(wind_speed=speed):.0f}",
            f"{1e-3 * load.sel(wind_speed=speed):.1f}",
        ]
        cells += [
            ", ".join(
                f"{value:.3g}"
                for value in at_speed.sel(row=row, interface=["inner", "outer", "cage"]).values
            )
            for row in ROWS
        ]
        if other is not None:
            per_orbit = by_speed(other.energy.mean("roller").sum("interface") / other.orbits)
            cells.append(
                ", ".join(f"{per_orbit.sel(wind_speed=speed, row=row):.3f}" for row in ROWS)
            )
        print("| " + " | ".join(cells) + " |")
    total = energy.sum("interface")
    print(
        f"energy of both rows over 12C: {[round(float(v), 3) for v in by_speed(numbers.both_rows_normalised)]}"
    )
    down = total.sel(row="downwind")
    print(f"downwind energy an orbit, 12 over 24 m/s: {float(down[0] / down[-1]):.2f}")
    print(
        f"downwind over upwind energy: {float(numbers.energy_ratio.min()):.3g} to {float(numbers.energy_ratio.max()):.3g}"
    )
    print(f"  by wind speed: {[round(float(v), 1) for v in by_speed(numbers.energy_ratio)]}")
    ratio = by_speed(numbers.peak_power_ratio)
    print(f"ratio of mean peak powers, by wind speed: {[float(f'{float(v):.3g}') for v in ratio]}")
    for row in ROWS:
        mean = numbers.peak_power_mean.sel(row=row)
        variation = float((numbers.peak_power_std.sel(row=row) / mean).median())
        print(
            f"mean peak power {row}: {[float(f'{float(v):.3g}') for v in by_speed(mean)]} W; scatter {variation:.2f} times it"
        )
    for row in ROWS:
        all_of = study.energy.sel(row=row).sum("roller")
        share = 100.0 * all_of.sel(interface="cage") / all_of.sum("interface")
        print(
            f"cage, {row}: {float(share.min()):.2g} to {float(share.max()):.2g} % of the sliding energy"
        )
    shares = (parts.part_energy / parts.part_energy.sum("part")).sel(row="downwind").mean("case")
    print(
        "downwind parts: "
        + ", ".join(
            f"{name} {100 * float(shares.sel(part=name)):.1f} %" for name in shares.part.values
        )
    )
    print(
        f"asperities downwind: {100 * float(parts.asperity_share.sel(row='downwind').mean()):.2g} %"
    )
    print(
        f"energy over mean load, downwind: to the power {float(parts.load_exponent.sel(row='downwind')):.2f}"
    )
    line = np.polyfit(np.log(study.roller_load.sel(row="downwind")), np.log(per_orbit_of(study)), 1)
    off = np.exp(
        np.log(per_orbit_of(study))
        - np.polyval(line, np.log(study.roller_load.sel(row="downwind")))
    )
    print(f"  each case over that fit: {float(off.min()):.2f} to {float(off.max()):.2f}")
    loaded = 100.0 * study.loaded_share.sel(row="upwind")
    print(
        f"upwind rollers under load: {float(loaded.min()):.2g} to {float(loaded.max()):.2g} % of the time"
    )
    for row in ROWS:
        for raceway in ("inner", "outer"):
            at = study.sel(row=row, interface=raceway)
            largest = (
                float(at[name].max())
                for name in ("flash_temperature", "power_density", "slide_roll_ratio")
            )
            print(
                "{}, {}: flash {:.3g} K, power {:.3g} W/m2, slide-roll ratio {:.2g}, ".format(
                    row, raceway, *largest
                )
                + f"least film ratio {float(at.min_film_ratio.min()):.2g}"
            )


def per_orbit_of(study):
    """Energy of a downwind roller in an orbit [J], by case."""
    return (study.energy.mean("roller").sum("interface") / study.orbits).sel(row="downwind")


def uncertainty_tables(folder: Path) -> None:
    """Ranges, drivers and indices, and what is robust."""
    summary = uncertainty_summary(uncertainty(folder))
    print(", ".join(f"{name}: {count}" for name, count in summary.attrs.items()))
    print("| value | range | why |\n|---|---|---|")
    for uncertain in VALUES:
        print(f"| {uncertain.name} | {uncertain.range_text} | {uncertain.reason} |")
    print(
        "| result | base | median | 5 to 95 % | rank correlation | Sobol' index of first order (total) | predicted |"
    )
    print("|---|---|---|---|---|---|---|")
    for k, name in enumerate(summary.quantity.values.tolist()):
        of_quantity = summary.isel(quantity=k)
        unit = "" if str(of_quantity.units.values) == "1" else f" {of_quantity.units.values}"
        low, middle, high = (f"{value:.3g}" for value in of_quantity.range.values)
        driven = ", ".join(
            f"{parameter} {value:+.2f}" for parameter, value in drivers(summary, name)
        )
        indices = ", ".join(
            f"{parameter} {first:.2f} ({total:.2f})"
            for parameter, first, total in strongest(summary, name)
        )
        print(
            f"| {name} | {float(of_quantity.base):.3g}{unit} | {middle} | {low} to {high}{unit} | {driven or '–'} | {indices or '–'} | "
            f"{float(of_quantity.explained):.2f} |"
        )
    print("| statement | samples that show it | |\n|---|---|---|")
    for (name, word), share in zip(robust(summary), summary.trend_share.values, strict=True):
        print(f"| {name} | {100.0 * float(share):.0f} % | {word} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("results", type=Path, help="folder that make reproduce has written")
    folder = parser.parse_args().results / STUDIES
    paper = folder / "study_paper"
    study_tables(folder / "study_physical", paper if paper.is_dir() else None)
    uncertainty_tables(folder / "uncertainty_physical")
