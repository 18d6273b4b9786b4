"""The paper's figures and findings beside converged results, and what the numerical method does to them.

The paper's own figures cannot be copied; its findings are quoted as statements, and drawn as shaded bands where they
are numbers. A band of "about" reaches from half to twice the number.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from macroslip.report import orbit_figures
from macroslip.report.page import Beside, Block, Paragraph, Pictures, Section
from macroslip.report.pictures import Picture, picture
from macroslip.report.wording import energy_text
from macroslip.reproduction import solver_figures
from macroslip.reproduction import wind_speed_figures as winds
from macroslip.reproduction.headline import step_line, tolerance_line
from macroslip.reproduction.marks import mark_level, mark_wind_speeds
from macroslip.reproduction.model_run import DETAILED_CASE, STATIC_LOADS

if TYPE_CHECKING:
    import xarray as xr

    from macroslip.reproduction.model_run import ModelRun


def sections(runs: Mapping[str, ModelRun], experiments: Mapping[str, xr.Dataset]) -> list[Section]:
    """The figures of the paper under every model, and the numerical experiment."""
    found: list[Section] = []
    for name, run in runs.items():
        of = f" (model {name})" if len(runs) > 1 else ""
        suffix = "" if name == next(iter(runs)) else f"-{name}"
        parts = (
            ("turns", "One roller over a turn", _turns(run, of) if run.turns else (), "figure 3: spin and energy"),
            ("winds", "Over wind speed", _over_wind_speed(run, of), "figures 4 and 5: energy and peak power"),
        )
        group = f"The paper's figures{of}"
        found += [
            Section(f"{one}{suffix}", title, tuple(blocks), gist, group) for one, title, blocks, gist in parts if blocks
        ]
    return [*found, _numerical(experiments)]


def _stability(stability: xr.Dataset) -> Beside:
    return Beside(
        "Figure A1: explicit and backward Euler",
        ("Explicit Euler is unstable in the load zone; backward Euler is not.",),
        (
            picture(
                lambda axes: _near_limit(solver_figures.plot_stability(axes, stability), stability),
                "Spin over pure rolling entering the load zone, by both Euler methods and converged",
                legend="above",
            ),
            picture(
                lambda axes: _near_limit(solver_figures.plot_deviation(axes, stability), stability),
                "Distance of both Euler methods from the converged spin",
                legend="above",
            ),
        ),
        f"At a step of {1e3 * stability.attrs['step_s']:g} ms. At the dash-dotted line the step exceeds twice the "
        f"relaxation time of slip, the limit of explicit Euler, at {stability.attrs['limit_load_N'] / 1e3:.2g} kN.",
    )


def _turns(run: ModelRun, of: str) -> list[Block]:
    blocks: list[Block] = []
    static = {f"{name} load": run.turns["static"][f"{name}, downwind"] for name in STATIC_LOADS}
    groups = (
        (
            f"Figure 3a: constant load and speed{of}",
            static,
            (
                "An unloaded roller is slowed by friction at the cage, with an inflexion at the top.",
                "It snaps back to pure rolling on entering the load zone.",
            ),
            "Grey: the rings press on the roller. The load is the mean of case 14B, with and without its thrust.",
        ),
        (
            f"Figure 3b: time-varying load{of}",
            run.turns["typical"],
            (
                "The same roller under the loads of 14 m/s, turbulence B.",
                "Time-varying loads give about 100 times the energy of the static ones.",
            ),
            "The turns whose energy is nearest the median of the row.",
        ),
        (
            f"Figure 3b, the turns with the largest power{of}",
            run.turns["peak"],
            ("Brief forces in the load zone make up the large energies.",),
            "The turns with the row's largest power at any interface.",
        ),
    )
    for title, turns, stated, caption in groups:
        pictures: list[Picture] = []
        for name, turn in turns.items():
            pictures.append(
                picture(
                    lambda axes, turn=turn, name=name: orbit_figures.plot_spin(axes, turn, name),
                    f"Spin speed over a turn, {name}",
                    legend="above",
                )
            )
            pictures.append(
                picture(
                    lambda axes, turn=turn, name=name: orbit_figures.plot_cumulative_energy(axes, turn, name),
                    f"Cumulative energy over a turn, {name}",
                    height=2.8,
                )
            )
        energies = ", ".join(
            f"{name} {energy_text(turn.attrs['energy_J'])} and at most {turn.attrs['peak_power_W']:.3g} W"
            for name, turn in turns.items()
        )
        blocks.append(Beside(title, stated, tuple(pictures), f"{caption} Whole turn: {energies}."))
    return [*blocks, _over_static(run, of)]


def _over_static(run: ModelRun, of: str) -> Beside:
    rows = run.study.row.values.tolist()
    varying = run.numbers.orbit_energy.sel(case=DETAILED_CASE)
    ratios = {
        name: {
            row: float(varying.sel(row=row)) / run.turns["static"][f"{name}, {row}"].attrs["energy_J"] for row in rows
        }
        for name in STATIC_LOADS
    }

    def draw(axes):
        return mark_level(orbit_figures.plot_varying_over_static(axes, ratios), 50.0, 200.0, "paper: about 100")

    return Beside(
        f"Time-varying over static load{of}",
        ("Time-varying loads give about 100 times the energy of the static ones.",),
        (picture(draw, "Energy per orbit under time-varying over that under static load, by row", legend="above"),),
        f"Energy per orbit in case {DETAILED_CASE}, mean over rollers and orbits, over that of a turn under its mean load.",
    )


def _over_wind_speed(run: ModelRun, of: str) -> list[Block]:
    numbers = run.numbers

    def energy(axes, row):
        return mark_wind_speeds(winds.plot_energy(axes, numbers, row), (12.0, 14.0), "paper: highest")

    def energy_ratio(axes):
        winds.plot_energy_ratio(axes, numbers)
        axes.set_yscale("log")
        return _plain(mark_level(axes, 5.0, 20.0, "paper: about 10"))

    def peak_ratio(axes):
        winds.plot_peak_power_ratio(axes, numbers)
        mark_wind_speeds(axes, (12.0,), "")
        return mark_level(axes, 2.5, 10.0, "paper: up to 5, highest at 12 m/s")

    rows = (*run.study.row.values.tolist(), None)
    ratio, peaks = numbers.energy_ratio, numbers.peak_power_ratio
    return [
        Beside(
            f"Figure 4a: energy over mean wind speed{of}",
            ("Energy is highest at mean wind speeds of 12 and 14 m/s.",),
            tuple(
                picture(
                    lambda axes, row=row: energy(axes, row),
                    f"Energy over that in case 12C, {row or 'both rows'}",
                    legend="above",
                )
                for row in rows
            ),
            "Turbulence classes A, B and C; bars: range over the rollers. Each row over its own value in 12C.",
        ),
        Beside(
            f"Figure 4b: energy, downwind over upwind{of}",
            ("The downwind row spends about 10 times the energy of the upwind row.",),
            (picture(energy_ratio, "Ratio of energies of the rows over wind speed", legend="above"),),
            f"{float(ratio.min()):.3g} to {float(ratio.max()):.3g} in the 21 cases.",
        ),
        Beside(
            f"Figure 5a: largest power per orbit{of}",
            ("No trend over wind speed.", "High variance."),
            tuple(
                picture(
                    lambda axes, row=row: winds.plot_peak_power(axes, numbers, row),
                    f"Largest power per orbit over its mean in 14A, {row} row",
                    legend="above",
                )
                for row in run.study.row.values.tolist()
            ),
            "Mean and standard deviation over all rollers and orbits, bars cut at zero.",
        ),
        Beside(
            f"Figure 5b: largest power per orbit, downwind over upwind{of}",
            ("The ratio is up to 5, highest at 12 m/s.",),
            (picture(peak_ratio, "Ratio of mean largest powers of the rows over wind speed", legend="above"),),
            f"{float(peaks.min()):.2g} to {float(peaks.max()):.2g} in the 21 cases.",
        ),
    ]


def _numerical(experiments: Mapping[str, xr.Dataset]) -> Section:
    tolerances, steps = experiments["nonlinear_tolerance"], experiments["step_size"]
    loosest = tolerances.sel(row="downwind").isel(
        stopping_tolerance=int(np.argmax(tolerances.stopping_tolerance.values))
    )
    share = 100.0 * float(loosest.cage_energy / loosest.energy)
    converged = float(loosest.cage_energy_converged)
    return Section(
        "numerics",
        "What the numerical method does",
        (
            _stability(experiments["A1"]),
            Paragraph(
                "Two properties of backward Euler on the spin, measured with this program's own implementation. An "
                "iteration that stops on a relative change of spin leaves force unbalanced in a gripped contact, where "
                "a micrometre per second of slip is kilonewtons; the cage has to carry it, and its friction becomes "
                "energy. And a fixed step does not resolve the milliseconds in which a roller is gripped again."
            ),
            Pictures(
                (
                    picture(
                        lambda axes: solver_figures.plot_cage_energy(axes, tolerances),
                        "Cage energy per orbit against the tolerance at which the iteration stops",
                        height=3.6,
                        legend="upper left",
                    ),
                    picture(
                        lambda axes: solver_figures.plot_step_size(axes, steps),
                        "Mean largest power per orbit against the fixed step",
                        height=3.6,
                        legend="center left",
                    ),
                ),
                "Left: energy at the cage per orbit, time-varying load of case 14B, one roller of each row. Right: "
                f"mean largest power per orbit, {steps.attrs['start_s']:.4g} s to {steps.attrs['end_s']:.4g} s of case 14B, "
                f"four rollers of each row. Lines: converged (Radau at {tolerances.attrs['converged_tolerance']:g}).",
            ),
            Paragraph(f"{tolerance_line(tolerances)} {step_line(steps)}"),
            Paragraph(
                "What this shows: large energies and powers that depend on the method can come out of these equations, "
                "and where the iteration stops late enough (the smallest tolerances) the cage energy is the converged "
                f"one, {converged:.3g} J an orbit downwind. At the loosest tolerance the cage takes {share:.0f} % of "
                "the energy. What it does not show: that the paper's authors stopped there or used such a step. What "
                "they did is not known."
            ),
        ),
        "figure A1, and what an early stop of the iteration and a fixed step do to energy and power",
    )


def _near_limit(axes, stability: xr.Dataset):
    limit = stability.attrs["limit_angle_deg"]
    if np.isfinite(limit):
        axes.set_xlim(limit - 6.0, limit + 6.0)
    return axes


def _plain(axes):
    from matplotlib.ticker import LogLocator, NullFormatter

    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    return axes
