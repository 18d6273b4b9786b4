"""The same loads with a thin, a middling and a thick oil.

python examples/04_compare_lubricants.py
"""

from macroslip import Case, HubLoads, Lubricant, simulate

loads = HubLoads.bundled("14B").window(0.0, 40.0)
base = Lubricant.read("vg460-pao")

print("viscosity   energy a roller [J]      lowest spin [% of pure rolling]")
print("[Pa s]      downwind    upwind       downwind    upwind")
for factor in (0.5, 1.0, 2.0):
    # Only the viscosity changes; a real oil changes its other values too.
    lubricant = base.replace(name=f"viscosity x {factor:g}", viscosity=factor * base.viscosity)
    result = simulate(Case(loads=loads, lubricant=lubricant))
    energy = result.energy.sum("interface", skipna=False).mean("roller", skipna=False)
    lowest = 100.0 * result.min_spin_ratio.min("roller", skipna=False)
    values = [float(one.sel(row=row)) for one in (energy, lowest) for row in ("downwind", "upwind")]
    print(
        f"{lubricant.viscosity:<8g} {values[0]:10.3f} {values[1]:10.3f} {values[2]:12.1f} {values[3]:10.1f}"
    )
