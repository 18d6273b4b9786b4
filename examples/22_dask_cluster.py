"""A study on the workers of a Dask scheduler: here one on this machine, in earnest one of a cluster.

python examples/22_dask_cluster.py
"""

from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
from distributed import LocalCluster

from macroslip import open_study, read_study, run_study

STUDY = """
case: {rollers: [0], laws: {model: paper}, loads: {start: 0 s, end: 8 s}}
loads: {bundled: [12A, 14A, 24A]}
"""

if __name__ == "__main__":
    with open("study.yaml", "w", encoding="utf-8") as file:
        file.write(STUDY)
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as cluster,
        TemporaryDirectory() as folder,
    ):
        run_study(read_study("study.yaml"), folder, scheduler=cluster.scheduler_address)
        study = open_study(folder)
        power = (study.energy_mean / study.window_length).sum("row").to_series()
    for name, watt in zip(study.loads.values, power, strict=True):
        print(f"{name}: {watt:.3g} W of a mean roller in both rows")
    figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
    axes.bar(study.loads.values.tolist(), power)
    axes.set_ylabel("friction of a mean roller [W]")
    figure.savefig("22_dask_cluster.png", dpi=80)
