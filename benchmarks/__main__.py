"""`make bench`: the integrator against its rivals, measured here and now."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

import typer

from macroslip.cli.failure import command
from macroslip.cli.progress import command_progress


def bench(
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            help="The folder to write to; what it holds of an earlier run is replaced.",
        ),
    ] = Path("bench"),
    quick: Annotated[bool, typer.Option("--quick", help="A smaller set, in two minutes.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", help="Show nothing but errors.")] = False,
) -> None:
    """Measure speed and accuracy against general ODE solvers, on this machine."""
    from benchmarks.run import run_bench

    with command_progress(quiet=quiet) as report:
        summary = run_bench(output, quick=quick, progress=report)
    if quiet:
        return
    _rivals(summary)
    _limits(summary)
    _mechanisms(summary)
    typer.echo(f"written: {output}")


def _rivals(summary: dict[str, Any]) -> None:
    from benchmarks.rivals import INSTALL, OWN
    from macroslip.cli.printing import print_table

    methods, rows, missing = summary["methods"], [], False
    for key, method in methods.items():
        if key == OWN:
            continue
        target = f"{method['target']:.0f} x"
        if not method["installed"]:
            rows.append([method["title"], "not installed", "", "", target, "", ""])
            missing = True
            continue
        ratio, entries = method["ratio"], method["histories"].values()
        median = ratio["median"]
        extrapolated = sum(entry["extrapolated"] for entry in entries)
        notes = (
            [f"{len(method['not_reached'])} of {len(entries)} not reached"]
            if method["not_reached"]
            else []
        )
        notes += [f"{extrapolated} of {len(entries)} extrapolated"] if extrapolated else []
        verdict = "-" if math.isnan(median) else ("yes" if median >= method["target"] else "NO")
        reached = [entry["seconds"] for entry in entries if entry["reached"]]
        time = f"{1e3 * sum(reached) / len(reached):.3g}" if reached else "-"
        between = f"{ratio['min']:.3g} to {ratio['max']:.3g}"
        rows.append(
            [method["title"], f"{median:.3g} x", between, time, target, verdict, ", ".join(notes)]
        )
    headings = ["rival", "ahead by, median", "least to most", "mean time [ms]", "target"]
    headings += ["reached", ""]
    own = [entry["seconds"] for entry in methods[OWN]["histories"].values()]
    title = f"CPU time at the same accuracy, {summary['asked_accuracy']:g} in total energy and mid-coast spin, over "
    title += f"{len(own)} histories; macroslip takes {1e3 * sum(own) / len(own):.3g} ms on average"
    print_table(title, headings, rows, "lrrrrll")
    agreement = summary["reference"]
    worst = max([*agreement["energy_error"].values(), *agreement["spin_error"].values()])
    typer.echo(f"the reference and a converged {agreement['method']} differ by {worst:.1e} at most")
    if missing:
        typer.echo(f"the rivals that are not installed come with: {INSTALL}")
    typer.echo()


def _limits(summary: dict[str, Any]) -> None:
    from macroslip.cli.printing import number, print_table

    targets, evaluation, quadrature = (
        summary["targets"],
        summary["evaluation"],
        summary["quadrature"],
    )
    speed, threads = summary["real_time"], summary["threads"]
    nanoseconds = evaluation["force_evaluation_ns"]
    factor, share = (
        evaluation["overhead_factor"],
        f"{evaluation['integration_ns']:.0f} ns per evaluation in all",
    )
    states = f"gripped {number(evaluation['force_evaluation_gripped_ns'])}, "
    states += f"coasting {number(evaluation['force_evaluation_coasting_ns'])}"
    patch = f"{quadrature['quadrature_ns']:.0f} ns against {quadrature['closed_form_ns']:.0f} ns"
    rows = [
        _line(
            "traction by 32 nodes over closed form",
            quadrature["ratio"],
            targets["quadrature_ratio"],
            patch,
        ),
        _line(
            "one force evaluation [ns]",
            nanoseconds,
            targets["force_evaluation_ns"],
            states,
            least=False,
        ),
        _line(
            "total time over evaluations alone",
            factor,
            targets["overhead_factor"],
            share,
            least=False,
        ),
    ]
    for model, numbers in speed.items():
        prefix = "" if model == "paper" else f"{model}_"
        errors = f"errors up to {numbers['largest_energy_error']:.1e} (energy), {numbers['largest_spin_error']:.1e} (spin); "
        name = f"{model} model, simulated over CPU time"
        rows.append(
            _line(
                name,
                numbers["factor"],
                targets[f"{prefix}real_time_factor"],
                f"{errors}median {number(numbers['median'])}",
            )
        )
    slow = speed["physical"]
    note = f"with details of contacts {number(slow['slowest_detailed'])}"
    rows.append(
        _line("physical model, slowest history", slow["slowest"], targets["physical_slowest"], note)
    )
    if threads is not None:
        both = f"rollers alone {threads['rollers']:.3g}; the machine itself, by hashing, {threads['hashing']:.3g}"
        rows.append(
            _line(
                "two threads over one, simulate()",
                threads["simulate"],
                targets["thread_speedup"],
                both,
            )
        )
    for kind, growth in summary["linearity"].items():
        rows.append([f"growth with {kind}, exponent", number(growth["exponent"]), "1", "", ""])
    headings = ["", "measured", "target", "reached", ""]
    print_table("against the limit", headings, rows, "lrrll")


def _mechanisms(summary: dict[str, Any]) -> None:
    from macroslip.cli.printing import number, print_table

    rows = []
    for name, row in summary["mechanisms"].items():
        loaded, unloaded = row["downwind"], row["upwind"]
        rows.append(
            [
                name,
                number(loaded["real_time_factor"]),
                number(loaded["force_evaluations"]),
                number(loaded["evaluation_us"]),
                number(unloaded["real_time_factor"]),
            ]
        )
    headings = ["model", "downwind roller, simulated over CPU time", "force evaluations"]
    headings += ["time of one [us]", "upwind roller"]
    print_table("cost of mechanisms", headings, rows, "lrrrr")


def _line(name: str, value: float, target: float, note: str, *, least: bool = True) -> list[str]:
    from macroslip.cli.printing import number

    good = value >= target if least else value <= target
    asked = f"{'at least' if least else 'at most'} {number(target)}"
    return [name, number(value), asked, "yes" if good else "NO", note]


app = typer.Typer(add_completion=False, rich_markup_mode=None)
command(app, bench)

if __name__ == "__main__":
    app()
