"""Print the figures that the documentation quotes and no other command prints.

python -m benchmarks.claims                              all of them, three minutes
python -m benchmarks.claims exponents compliance         some of them
"""

from __future__ import annotations

import argparse
import itertools
from typing import Any

import numpy as np
from scipy.optimize import brentq

from macroslip import Bearing, BearingLoads, Case, HubLoads, Laws, Lubricant, Traces, simulate
from macroslip.bearing.geometry import AXIAL_SIGNS
from macroslip.contact.table import table_box
from macroslip.mechanics.spin import CONDITIONS, FORCES, powers, slip_forces
from macroslip.roller.model import roller_model, with_tables

BEARING, OIL = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
SPEED = 20.463 * np.pi / 30
#: Oil supplies, the default first.
SUPPLIES = ("skf", "flooded", 0.7, 0.5)
#: Mean load of case 14B [N].
STEADY = BearingLoads.constant([-20.3e3, -343.5e3, 164.4e3], shaft_speed=SPEED, duration=14.0)


#: Raceway speed of a downwind roller without tilt at that speed of the shaft [m/s].
_MODEL = roller_model(
    BEARING, OIL, AXIAL_SIGNS["downwind"], tilt=0.0, laws=Laws.physical().but(rolling="none")
)
RING = -SPEED * _MODEL.orbit_ratio * _MODEL.outer_radius


def exponents() -> None:
    """Power of both raceways of a gripped roller over its load, without the oil beside the ellipse."""
    box = table_box(np.array([RING]), 100e3, 2e-5)
    roller = with_tables({"downwind": _MODEL}, box)[0]["downwind"]
    at, forces, power_parts = np.zeros(1, CONDITIONS), np.zeros(1, FORCES), np.zeros(3)
    at["ring_speed"] = RING

    def raceways(load: float, slip: float) -> float:
        at["inner_load"] = at["outer_load"] = load
        slip_forces(roller.body[0], roller.tables, at[0], slip, forces[0])
        return float(forces["inner"][0] + forces["outer"][0])

    def power(load: float) -> float:
        slip = brentq(lambda v: raceways(load, v), -0.1, 0.1, xtol=1e-13)
        raceways(load, slip)
        powers(roller.body[0], at[0], forces[0], slip, power_parts)
        return power_parts[0] + power_parts[1]

    powers_at = {load: power(load) for load in (10e3, 50e3, 100e3)}
    for low, high in itertools.pairwise(powers_at):
        exponent = np.log(powers_at[high] / powers_at[low]) / np.log(high / low)
        print(
            f"raceway power from {low / 1e3:.0f} to {high / 1e3:.0f} kN: load to the power {exponent:.1f}"
        )


def compliance() -> None:
    """What elastic tangential strain of the bodies takes off the power of microslip, by Carter's law in strips.

    A strip of half width b under Coulomb friction γ p transmits 1 − (1 − |v|/v_s)² of γ p below v_s = γ u b/R, and all of it
    above (Carter, Proc. R. Soc. A 112 (1926) 151); without strain all of it at any slip. The film's own viscosity, which
    softens it as well, is left out, so that this is the most that strain can do.
    """
    for load in (10e3, 20e3, 50e3, 100e3):
        for contact in (_MODEL.laws.inner, _MODEL.laws.outer):
            side = contact.interface
            off = 100.0 * (1.0 - _strained_power(contact.shape, side, load, RING))
            print(f"elastic strain, {load / 1e3:.0f} kN, {side.name}: {off:.2f} % off the power")


def _strained_power(shape, side, load: float, ring: float) -> float:
    """Power of a contact by Carter's law over that without strain, each at the slip at which its force vanishes."""
    across, along = (
        getattr(side.hertz, f"semi_axis_{way}") * load ** (1.0 / 3.0) for way in ("across", "along")
    )
    position = min(across, shape.half_length) * np.linspace(-1.0, 1.0, 40_001)
    root = np.sqrt(np.maximum(1.0 - (position / across) ** 2, 0.0))
    base = ring * (
        shape.curvature_ratio * position**2 / (2.0 * shape.contour_radius)
        - shape.spin_ratio * position
    )
    saturating = OIL.limiting_shear * abs(ring) * along * root / side.rolling_radius

    def strip(slip):
        part = np.minimum(np.abs(slip) / np.maximum(saturating, 1e-30), 1.0)
        return root**2 * np.sign(slip) * (1.0 - (1.0 - part) ** 2)

    rigid = base + brentq(lambda v: np.sum(root**2 * np.sign(base + v)), -0.1, 0.1)
    strained = base + brentq(lambda v: np.sum(strip(base + v)), -0.1, 0.1)
    return float(np.sum(strip(strained) * strained) / np.sum(root**2 * np.abs(rigid)))


def asperities() -> None:
    """Share of the downwind row's sliding energy that asperities take."""
    for celsius, roughness in ((35.0, 0.3e-6), (35.0, 0.5e-6), (50.0, 0.3e-6), (50.0, 0.5e-6)):
        bearing = BEARING.replace(composite_roughness=roughness)
        case = Case(
            loads=STEADY,
            rollers=[0],
            laws=Laws.physical(),
            bearing=bearing,
            temperature=celsius + 273.15,
        )
        down = simulate(case).sel(row="downwind")
        raceways = down.energy.sel(interface=["inner", "outer"]).sum()
        share = float(down.asperity_energy.sum() / raceways)
        print(
            f"asperities at {celsius:.0f} °C and {1e6 * roughness:.1f} µm: {100.0 * share:.1f} % of the raceways' energy"
        )


def drag() -> None:
    """Drag of the oil on a roller, per orbit."""
    result = simulate(Case(loads=STEADY, laws=Laws.paper(), rollers=[0]))
    orbit = float((result.orbit_end - result.orbit_start)[0])
    print(
        f"drag: {result.attrs['drag_power'] * orbit / (2 * BEARING.rollers_per_row):.2f} J an orbit a roller"
    )


def rows() -> None:
    """An unloaded roller of the upwind row and the energies of both rows, by oil supply."""
    for supply in SUPPLIES:
        case = Case(
            loads=STEADY,
            rollers=[0],
            laws=Laws.physical(),
            oil_supply=supply,
            traces=Traces(step=0.02, start=7.0, end=13.5),
        )
        result = simulate(case)
        energy = result.orbit_energy.sum("interface").isel(roller=0, orbit=0)
        down, up = (float(energy.sel(row=row)) for row in ("downwind", "upwind"))
        turning = (result.spin / result.spin_pure).sel(row="upwind")
        print(
            f"{supply}: unloaded roller at {float(turning.min()):.2f} to {float(turning.max()):.2f} of pure rolling, "
            f"{up:.1f} J an orbit; loaded {down:.1f} J, {down / up:.1f} times as much"
        )


def thrust() -> None:
    """Sliding torque over thrust at 200 kN radial load, beside SKF's."""
    from benchmarks.friction_torque import steady

    low, high = (steady(radial=200e3, thrust=axial) for axial in (100e3, 250e3))
    print(
        f"sliding from 100 to 250 kN thrust at 200 kN: {low.sliding:.0f} to {high.sliding:.0f} N m, "
        f"{high.sliding / low.sliding:.1f} times; SKF {high.skf_sliding / low.skf_sliding:.1f} times"
    )


#: What is changed, one at a time: choice of laws, value of the oil [SI], "kept" is that at 35 degC, or oil supply.
_ASSUMPTIONS: tuple[tuple[str, dict[str, Any], dict[str, float | str], str | float], ...] = (
    ("as it is", {}, {}, "skf"),
    ("limiting shear", {"rheology": "limiting-shear"}, {}, "skf"),
    ("Eyring stress of 3.3 MPa at 35 °C", {}, {"eyring_stress": 3.3e6}, "skf"),
    ("Eyring stress kept", {}, {"eyring_stress": "kept"}, "skf"),
    ("pressure-viscosity coefficient kept", {}, {"pressure_viscosity": "kept"}, "skf"),
    ("density kept", {}, {"density": "kept"}, "skf"),
    ("no asperities", {"asperities": "none"}, {}, "skf"),
    *((f"oil supply {supply}", {}, {}, supply) for supply in SUPPLIES[1:]),
    ("no rolling resistance, no films of play", {"rolling": "none"}, {}, "skf"),
    (
        "limiting shear, no asperities, no rolling resistance",
        {"rheology": "limiting-shear", "asperities": "none", "rolling": "none"},
        {},
        "skf",
    ),
)


def temperature() -> None:
    """Sliding energy of the downwind row over temperature, and with one assumption changed at a time."""
    loads = HubLoads.bundled("12B").window(0.0, 40.0)
    for name, choices, values, supply in _ASSUMPTIONS:
        whole, raceways = [], []
        for celsius in (20.0, 35.0, 50.0):
            fixed = {key: value for key, value in values.items() if not isinstance(value, str)}
            kept = {key: getattr(OIL, key) for key, value in values.items() if value == "kept"}
            oil = OIL.replace(**fixed).at(f"{celsius} degC").replace(**kept)
            laws = Laws.physical().but(**choices)
            case = Case(loads=loads, rollers=[0, 14], laws=laws, lubricant=oil, oil_supply=supply)
            down = simulate(case).orbit_energy.sel(row="downwind").mean(("roller", "orbit"))
            whole.append(float(down.sum()))
            raceways.append(float(down.sel(interface=["inner", "outer"]).sum()))
        print(
            f"12B, {name}: "
            + ", ".join(f"{energy:.0f}" for energy in whole)
            + " J an orbit at 20, 35 and 50 °C, of which "
            "raceways " + ", ".join(f"{energy:.0f}" for energy in raceways),
            flush=True,
        )


def rheology() -> None:
    """Energy of the loaded raceways under Eyring's law over that under limiting shear."""
    for celsius, stress in ((35.0, 6.7e6), (50.0, 6.7e6), (35.0, 3.3e6)):
        # The stress is that at 35 degC, and moves with temperature.
        oil = OIL.replace(eyring_stress=stress)
        energies = []
        for law in ("eyring", "limiting-shear"):
            laws = Laws.physical().but(rheology=law)
            result = simulate(
                Case(
                    loads=STEADY,
                    rollers=[0],
                    laws=laws,
                    lubricant=oil,
                    temperature=celsius + 273.15,
                )
            )
            energies.append(
                float(result.energy.sel(row="downwind", interface=["inner", "outer"]).sum())
            )
        print(
            f"Eyring, {stress / 1e6:g} MPa, over limiting shear at {celsius:.0f} °C: {energies[0] / energies[1]:.2f}"
        )


CLAIMS = {
    claim.__name__: claim
    for claim in (exponents, compliance, asperities, drag, rows, thrust, temperature, rheology)
}

if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("which", nargs="*", metavar="CLAIM", help=", ".join(CLAIMS))
    chosen = parser.parse_args().which or list(CLAIMS)
    unknown = [name for name in chosen if name not in CLAIMS]
    if unknown:
        parser.error(f"{unknown[0]} is none of {', '.join(CLAIMS)}")
    for name in chosen:
        CLAIMS[name]()
