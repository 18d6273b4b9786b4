"""What an oil supply means for the base bearing under the mean load of 14B: `python -m benchmarks.inlets`.

Films and resistances are over those of flooded inlets, at the inner raceway: loaded with 23 kN at 0.4 m/s, and idle with 10 N
at 0.2 m/s. `--idle` simulates two rollers of each row over the first 40 s instead, with and without a grease of 300 Pa, and
without any oil at contacts that carry nothing.
"""

import sys
from dataclasses import replace

from macroslip import Case, HubLoads, Laws, simulate
from macroslip.contact.laws import PreparedLaws, prepare
from macroslip.contact.rolling import light_contact, replenishment

LOADED, IDLE = (2.3e4, 0.4), (10.0, 0.2)


def contacts(case: Case) -> PreparedLaws:
    """The contacts of a case's downwind rollers."""
    return prepare(case.laws, case.bearing, case.oil, 1)


def idle() -> None:
    """Print how far rollers slow, and the energy of the upwind row's, by the supply and the grease."""
    loads = HubLoads.bundled("14B").window(0.0, 40.0)
    base = Case(loads=loads, laws=Laws.physical(), rollers=[0, 14])
    stiff = base.lubricant.replace(grease_yield_stress=300.0)
    cases = {"no oil": replace(base, laws=base.laws.but(rolling="none"))}
    for supply in ("skf", "flooded", 0.7, 0.5):
        cases[f"{supply}"] = replace(base, oil_supply=supply)
        cases[f"{supply}, grease"] = replace(base, oil_supply=supply, lubricant=stiff)
    for name, case in cases.items():
        result = simulate(case)
        spin, energy = result.min_spin_ratio.values, result.energy.sum("interface")
        print(
            f"{name}: spin {spin[0].min():.3f} {spin[1].min():.3f}, energy {energy[1].mean():.3g} J",
            flush=True,
        )


def main() -> None:
    """Print the table."""
    loads = HubLoads.bundled("14B")
    print(
        "oil_supply, degC: replenishment, gap [um], S, film, rolling; idle: film [um] of [um], resistance"
    )
    for supply in ("skf", 0.9, 0.7, 0.5, 0.3):
        for celsius in (10, 20, 35, 50, 65):
            case = Case(
                loads=loads, laws=Laws.physical(), oil_supply=supply, temperature=273.15 + celsius
            )
            flooded = Case(
                loads=loads,
                laws=Laws.physical(),
                oil_supply="flooded",
                temperature=273.15 + celsius,
            )
            oil, speed = case.oil, float(abs(loads.shaft_speed).mean())
            here, full = contacts(case).inner, contacts(flooded).inner
            film, height = here.film_thickness(*LOADED), full.film_thickness(*LOADED)
            rolling, most = (
                light_contact(interface.rolling, *LOADED)[1] for interface in (here, full)
            )
            (_, held, thin), (_, flood, thick) = (
                light_contact(interface.rolling, *IDLE) for interface in (here, full)
            )
            bore, outside = case.bearing.bore_diameter, case.bearing.outside_diameter
            filled = replenishment(oil.viscosity / oil.density, speed, bore, outside)
            print(
                f"{supply}, {celsius}: {filled:.3f}, {1e6 * oil.oil_gap:.3g}, {oil.oil_gap / film:.3g}, {film / height:.3f}, "
                f"{rolling / most:.3f}; {1e6 * thin:.3g} of {1e6 * thick:.3g}, {held / flood:.3f}"
            )


if __name__ == "__main__":
    idle() if "--idle" in sys.argv else main()
