"""Criteria of damage of a result, each beside its published reference.

python examples/14_damage.py
"""

from macroslip import Case, HubLoads, simulate

loads = HubLoads.bundled("14B").window(0.0, 20.0)
result = simulate(Case(loads=loads, rollers=[0, 7, 14, 21]))
criteria = result.macroslip.damage
for title, ratio, factor in zip(
    criteria.title.values, criteria.ratio.values, criteria.factor.values, strict=True
):
    if ratio == ratio:  # others have no reference
        print(f"{title}: {ratio:.2g} of its reference, known to a factor of {factor:g}")
axes = result.macroslip.plot.damage()
axes.figure.savefig("14_damage.png", dpi=80)
