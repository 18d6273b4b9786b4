"""An oil of one's own: single values of a shipped one replaced, and its viscosity over temperature.

python examples/07_own_oil.py
"""

import matplotlib.pyplot as plt
import numpy as np

from macroslip import Lubricant
from macroslip.constants import ZERO_CELSIUS

base = Lubricant.read("vg320-mineral")
# In SI units; values that are not named stay those of the shipped oil, and keep their sources.
own = base.replace(name="my oil", viscosity=1.1 * base.viscosity)
print(f"{own.name}: {own.viscosity:.4g} Pa s, {base.name}: {base.viscosity:.4g} Pa s")

temperature = np.linspace(10.0, 70.0, 25)
figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
for oil in (own, base, Lubricant.read("vg460-pao")):
    viscosity = [oil.at(degrees + ZERO_CELSIUS).viscosity for degrees in temperature]
    axes.semilogy(temperature, viscosity, label=oil.name)
axes.set(xlabel="oil at the inlets [°C]", ylabel="viscosity [Pa s]")
axes.legend()
figure.savefig("07_own_oil.png", dpi=80)
