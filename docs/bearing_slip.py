"""Draws both rows of rollers in motion, coloured by slip, for the README and the first page.

python docs/bearing_slip.py
"""

from __future__ import annotations

import io
from pathlib import Path

import xarray as xr
from PIL import Image

from macroslip import Bearing, Case, HubLoads, Traces, simulate
from macroslip.report.bearing_figures import plot_bearing
from macroslip.report.style import new_figure
from macroslip.result.orbit import position

PICTURE = Path(__file__).parent / "figures" / "bearing_slip.gif"
#: First and last time of the motion [s], and time between its pictures [s]: it runs as fast as the bearing.
BEGIN, END, STEP = 10.0, 16.0, 0.1


def main() -> None:
    case = Case(
        loads=HubLoads.bundled("14B").window(0.0, 60.0),
        temperature=308.15,
        traces=Traces(step=0.05),
    )
    result = simulate(case)
    first, *others = pictures(result, case.bearing)
    first.save(
        PICTURE,
        save_all=True,
        append_images=others,
        duration=round(1e3 * STEP),
        loop=0,
    )


def pictures(result: xr.Dataset, bearing: Bearing) -> list[Image.Image]:
    """The bearing in steps of time, with one scale for slip and one for load."""
    moments = xr.Dataset(
        {
            "angle": position(result),
            "slip": 1.0 - result.spin / result.spin_pure,
            "roller_load": result.roller_load,
        }
    ).sel(time=slice(BEGIN, END))
    moments = moments.isel(
        time=slice(None, None, round(STEP / float(moments.time.diff("time")[0])))
    )
    largest = float(moments.roller_load.max())
    drawn = [drawing(moments.isel(time=k), bearing, largest) for k in range(moments.sizes["time"])]
    palette = drawn[0].quantize(48)
    return [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in drawn]


def drawing(moment: xr.Dataset, bearing: Bearing, largest: float) -> Image.Image:
    """A moment of the bearing, in pixels."""
    figure, (axes,) = new_figure(7.2, 4.0)
    plot_bearing(axes, moment, bearing, largest)
    pixels = io.BytesIO()
    figure.savefig(pixels, format="png", dpi=90)
    return Image.open(pixels).convert("RGB")


if __name__ == "__main__":
    main()
