"""Rollers around the downwind row, coloured by slip, as an animated picture: GIF, or MP4 with ffmpeg.

python examples/20_animation.py
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation

from macroslip import Case, HubLoads, Traces, simulate
from macroslip.result.orbit import position

loads = HubLoads.bundled("14B").window(0.0, 8.0)
result = simulate(Case(loads=loads, rollers=list(range(0, 28, 2)), traces=Traces(step=0.1)))
row = result.sel(row="downwind")
angle = np.radians(position(result).sel(row="downwind").transpose("roller", "time").values - 90.0)
slip = (100.0 * (1.0 - row.spin / row.spin_pure)).transpose("roller", "time").values

figure, axes = plt.subplots(figsize=(3.6, 3.6), layout="constrained")
dots = axes.scatter(np.cos(angle[:, 0]), np.sin(angle[:, 0]), s=300, c=slip[:, 0], vmin=0, vmax=100)
axes.set(aspect="equal", xlim=(-1.3, 1.3), ylim=(-1.3, 1.3), xticks=[], yticks=[])
figure.colorbar(dots, label="slip / speed [%]", shrink=0.7)


def show(frame):
    dots.set_offsets(np.column_stack([np.cos(angle[:, frame]), np.sin(angle[:, frame])]))
    dots.set_array(slip[:, frame])
    axes.set_title(f"{result.time.values[frame]:.1f} s")


frames = range(0, result.sizes["time"], 2)
FuncAnimation(figure, show, frames).save("20_animation.gif", writer="pillow", fps=10, dpi=60)
figure.savefig("20_animation.png", dpi=80)
print(f"20_animation.gif: {len(frames)} pictures; save('bearing.mp4') makes an MP4 where ffmpeg is")
