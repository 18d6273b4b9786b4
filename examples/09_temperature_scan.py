"""How the oil's temperature changes film and slip: one case at four temperatures.

python examples/09_temperature_scan.py
"""

import matplotlib.pyplot as plt

from macroslip import Case, HubLoads, simulate
from macroslip.constants import ZERO_CELSIUS

loads = HubLoads.bundled("14B").window(0.0, 14.0)
temperatures = (20.0, 35.0, 50.0, 65.0)
film, spin = [], []
for degrees in temperatures:
    result = simulate(Case(loads=loads, temperature=degrees + ZERO_CELSIUS, rollers=[0]))
    row = result.sel(row="downwind")
    film.append(float(row.min_film_ratio.sel(interface="inner").min()))
    spin.append(100.0 * float(row.min_spin_ratio.min()))
    print(f"{degrees:g} °C: film ratio {film[-1]:.2f} at least, lowest spin {spin[-1]:.0f} %")

figure, (above, below) = plt.subplots(2, figsize=(6, 4.2), sharex=True, layout="constrained")
above.plot(temperatures, film, marker="o")
above.axhline(3.0, color="grey", linestyle=":")  # full film above
above.set_ylabel("least film ratio Λ")
below.plot(temperatures, spin, marker="o")
below.set(xlabel="oil at the inlets [°C]", ylabel="lowest spin [%]")
figure.savefig("09_temperature_scan.png", dpi=80)
