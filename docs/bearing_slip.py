"""Draws the picture of the README, rollers coloured by slip, beside this file: python docs/bearing_slip.py"""

from __future__ import annotations

from pathlib import Path

from macroslip import Case, HubLoads, Traces, simulate
from macroslip.report.bearing_figures import plot_bearing
from macroslip.report.style import new_figure
from macroslip.result.orbit import still

PICTURE = Path(__file__).parent / "figures" / "bearing_slip.svg"


def main() -> None:
    case = Case(
        loads=HubLoads.bundled("14B").window(0.0, 60.0),
        temperature=308.15,
        traces=Traces(step=0.05),
    )
    figure, (axes,) = new_figure(7.2, 4.0)
    plot_bearing(axes, still(simulate(case)), case.bearing)
    figure.savefig(PICTURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
