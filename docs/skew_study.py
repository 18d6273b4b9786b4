"""Numbers of skew.md: skew over the orbit of bundled cases, and what it adds to power and thrust.

python docs/skew_study.py 14B 24A 12A   # two rollers a row, the first 60 s
python docs/skew_study.py all           # the 21 cases
python docs/skew_study.py check 14B     # powers of a result against contacts at the slip that a skewed roller has
python docs/skew_study.py speed 14B
python docs/skew_study.py coupled 14B 24A   # imposed orbits, and the whole bearing
python docs/skew_study.py ends 14B          # what the friction at stops would do to rollers
python docs/skew_study.py damage 12B 14B    # wear and criteria of damage, three rollers a row, the whole case
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace

import numpy as np

from macroslip import Case, HubLoads, Laws, Traces, Window, bundled_cases, simulate
from macroslip.bearing.geometry import roller_radius
from macroslip.case.case import DYNAMICS, WHOLE_BEARING
from macroslip.compiled import jit
from macroslip.constants import ZERO_CELSIUS
from macroslip.contact.laws import prepare
from macroslip.contact.skewed import resultants
from macroslip.measures.skew import _power_of_ends
from macroslip.result.damage import damage as criteria
from macroslip.result.prepared import prepare as prepare_case
from macroslip.roller.model import with_tables
from macroslip.roller.skew import equilibrium, placed, raceways, skew_stop
from macroslip.whole.cage import Cage

END, ROLLERS = 60.0, [0, 14]
#: u2 at 20.463 rpm [m/s].
SPEED = -0.39594
SKEWED = Laws.physical().but(skew="quasi-static")
VARIANTS = {
    "eyring": {"laws": SKEWED},
    "limiting shear": {"laws": SKEWED.but(rheology="limiting-shear")},
    "half film": {"laws": SKEWED, "oil_supply": 0.5},
}
ORBITS = {
    "imposed": {}, "coupled": {"dynamics": WHOLE_BEARING},
    "coupled, cage braked by 10 N": {"dynamics": WHOLE_BEARING, "cage": Cage(guide_friction=10.0)},
}  # fmt: skip
CAGES = {"pressing spar": Cage(), "stop only": Cage(alignment="none")}


def main(names: list[str]) -> None:
    for name in names:
        loads = HubLoads.bundled(name)
        base = Case(
            loads=loads, rollers=ROLLERS, window=Window(end=loads.start + END), contact_details=False,
            traces=Traces(step=0.1),
        )  # fmt: skip
        for variant, changes in VARIANTS.items():
            straight = simulate(
                replace(base, **changes | {"laws": changes["laws"].but(skew="none")})
            )
            for cage, described in CAGES.items():
                skewed = simulate(replace(base, cage=described, **changes))
                energy = (
                    skewed.energy.sel(interface=["inner", "outer"])
                    .sum(("interface", "roller"))
                    .values
                )
                added = skewed.skew_energy.sum(("raceway", "roller")).values
                skew = 1e3 * skewed.skew_by_position.values
                on_ring, (start, end) = (
                    base.bearing_loads,
                    (skewed.attrs[f"window_{end_name}"] for end_name in ("start", "end")),
                )
                inside = (on_ring.time >= start) & (on_ring.time <= end)
                low, high = np.fmin.reduce(skew, axis=1), np.fmax.reduce(skew, axis=1)
                thrust, axial = (
                    skewed.frictional_thrust.values,
                    float(on_ring.force[inside, 2].mean()),
                )
                before = straight.energy.sel(interface=["inner", "outer"]).sum(
                    ("interface", "roller")
                )
                print(
                    f"{name} {variant:15s} {cage:14s} energy x {np.round(energy / (energy - added), 3)} of straight "
                    f"rollers under the same loads, {np.round(energy / before.values, 3)} of the case without skew  skew "
                    + " ".join(f"{a:.2f}..{b:.2f}" for a, b in zip(low, high, strict=True))
                    + f" mrad  ends {float(skewed.stop_force.max()):.1f} N  thrust {np.round(thrust)} N = {np.round(100 * thrust / axial, 2)} % of {axial / 1e3:.0f} kN"
                    f"  torque {torque(straight, base):.1f} to {torque(skewed, base):.1f} N m, loads of rows "
                    f"{loads_of_rows(straight)} to {loads_of_rows(skewed)} kN",
                    flush=True,
                )


def torque(result, case: Case) -> float:
    """Mean torque that friction and rolling resistance of all rollers ask of the shaft [N m]."""
    spent = (
        float((result.energy + result.rolling_energy).sum())
        * case.bearing.rollers_per_row
        / result.sizes["roller"]
    )
    time = np.linspace(result.attrs["window_start"], result.attrs["window_end"], 4001)
    turn = np.trapezoid(
        np.interp(time, case.bearing_loads.time, case.bearing_loads.shaft_speed), time
    )
    return spent / float(turn)


def loads_of_rows(result) -> str:
    """Mean load of a roller of either row [kN]."""
    return ", ".join(
        f"{1e-3 * mean:.2f}" for mean in result.roller_load.mean(("roller", "time")).values
    )


def speed(name: str) -> None:
    """Processor time of a case with all rollers, straight and skewed."""
    base = Case(loads=HubLoads.bundled(name), window=Window(end=2.0 * END), contact_details=False)
    for dynamics in DYNAMICS:
        seconds = []
        for laws in (Laws.physical(), SKEWED):
            case = replace(base, laws=laws, dynamics=dynamics)
            simulate(replace(case, rollers=[0], window=Window(end=20.0)))  # its tables
            began = time.process_time()
            simulate(case)
            seconds.append(time.process_time() - began)
        print(f"{name} {dynamics}: {seconds[0]:.2f} s straight, {seconds[1]:.2f} s with skew")


def check(name: str) -> None:
    """Compare powers at samples of a case with those of the contacts themselves, at the skewed roller's own slip.

    What the cage and inertia make of a roller's slip beside the equilibrium is taken over from the result.
    """
    case = Case(
        loads=HubLoads.bundled(name),
        rollers=ROLLERS,
        window=Window(end=END),
        laws=SKEWED,
        traces=Traces(step=0.71),
    )
    bearing = case.bearing
    samples = simulate(case).sel(row="downwind").stack(state=("roller", "time"))
    samples = samples.isel(state=np.flatnonzero(samples.roller_load.values > 2e3))
    load, slip, skew = (
        samples[name_of_trace].values for name_of_trace in ("roller_load", "slip", "skew_angle")
    )
    speed = samples.spin_pure.values * roller_radius(bearing)
    laws = prepare(SKEWED, bearing, case.oil, 1)
    pair = raceways(laws, bearing, 1)
    straight, turned = (
        equilibrium(pair, laws, load, speed, skew_held) for skew_held in (0.0, skew)
    )
    tilt, _, middles = placed(pair, load, turned.tractions)
    off = slip - straight.slip
    exact = np.array(
        [
            resultants(raceway, load, speed, turned.slip + off, skew, middles[i], tilt).power
            for i, raceway in enumerate(pair)
        ]
    )
    used = samples.power.sel(interface=["inner", "outer"]).transpose("interface", "state").values
    print(
        f"{name}: {load.size} states, power with skew {used.mean(axis=1)} W, by the contacts {exact.mean(axis=1)} W"
    )
    print(
        "sum is off by",
        used.sum() / exact.sum() - 1.0,
        "single states, median",
        np.median(np.abs(used / exact - 1.0)),
    )
    print(
        "slip over speed of the rings, straight and skewed, mean:",
        (straight.slip / speed).mean(),
        (turned.slip / speed).mean(),
    )


def coupled(names: list[str]) -> None:
    """Rollers above 1 kN on imposed orbits and in the whole bearing, what holds them, and what both make of energies."""
    for name in names:
        loads = HubLoads.bundled(name)
        start = loads.start + 20.0
        base = Case(
            loads=loads, laws=SKEWED, window=Window(start=start, end=start + 40.0), contact_details=False,
            traces=Traces(step=0.05, start=start),
        )  # fmt: skip
        for described, changes in ORBITS.items():
            result = simulate(replace(base, **changes))
            for row in result.row.values:
                of_row = result.sel(row=row)
                pressed = of_row.roller_load.values > 1e3
                if not pressed.any():
                    continue
                push, skew = (
                    np.abs(of_row.cage_force.values[pressed]),
                    1e3 * np.abs(of_row.skew_angle.values[pressed]),
                )
                inner, outer, cage = of_row.energy.sum("roller").values
                ends, raceways = float(of_row.stop_energy.sum()), inner + outer
                print(
                    f"{name} {described} {row}: spars press with {np.median(push):.2f} N (median; mean {push.mean():.2f}), skew "
                    f"{np.quantile(skew, [0.1, 0.5, 0.9]).round(2)} mrad (a tenth, half, nine tenths), at the stop "
                    f"{100.0 * (of_row.stop_force.values[pressed] > 0.0).mean():.0f} %, energy of raceways x "
                    f"{raceways / (raceways - float(of_row.skew_energy.sum())):.3f}; energies {raceways:.0f} J, cage {cage:.0f} J "
                    f"with {ends:.0f} J of ends; thrust {float(of_row.frictional_thrust):.0f} N",
                    flush=True,
                )


def ends(name: str) -> None:
    """What the friction of the ends that hold a roller at its stop would do to it, were it in the equations of motion."""
    for celsius in (35.0, 80.0):
        case = Case(loads=HubLoads.bundled(name), laws=SKEWED, temperature=celsius + ZERO_CELSIUS)
        ready = prepare_case(case)
        roller = with_tables(ready.models, ready.box)[0]["downwind"]
        pair, stop = (
            raceways(ready.model.laws, case.bearing, 1),
            skew_stop(case.bearing, "conforming-pocket", 0.5e-3),
        )
        for load in (5e3, 1e4, 2e4, 3.5e4, 5e4):
            at = equilibrium(pair, ready.model.laws, load, SPEED, stop.largest)
            force = abs(float(at.moment)) / stop.arm
            power = power_of_ends(roller.body, roller.tables.ctypes.data, force, 3.0, SPEED)
            brake = power / abs(SPEED)
            tilt, _, middles = placed(pair, np.array([load]), at.tractions.reshape(2, 1))
            # The roller's own slip, a little more for the slope of its spin, and as much less as the brake makes it lag.
            more = np.array([0.0, 1e-6])
            inner, outer = contacts(pair, load, at.slip + more, stop.largest, middles, tilt)
            slope = np.diff(inner.spin + outer.spin)[0] / 1e-6
            inner, outer = contacts(
                pair, load, at.slip - np.array([0.0, brake / slope]), stop.largest, middles, tilt
            )
            moment = inner.moment + inner.pressure_moment + outer.moment + outer.pressure_moment
            raceway = inner.power + outer.power
            print(
                f"{name} {celsius:.0f} degC {load / 1e3:.0f} kN: {force:.2f} N an end, brake {brake:.2f} N = "
                f"{100 * brake / (0.04 * load):.2f} % of 4 % of the load; slip by {-1e3 * brake / slope:.4f} mm/s, moment by "
                f"{100 * (moment[1] / moment[0] - 1):.2f} %, power of raceways by {100 * (raceway[1] / raceway[0] - 1):.2f} %; "
                f"ends {power:.2f} W, raceways {raceway[0]:.2f} W"
            )


def contacts(pair, load, slip, skew, middles, tilt) -> list:
    """Resultants of both raceways at several slips [m/s]."""
    load, speed = np.full(slip.shape, load), np.full(slip.shape, SPEED)
    return [
        resultants(raceway, load, speed, slip, skew, middle, tilt)
        for raceway, middle in zip(pair, middles, strict=True)
    ]


@jit
def power_of_ends(body, tables, stop, push, speed):
    """`_power_of_ends` from Python."""
    return _power_of_ends((body[0], tables), stop, push, speed)[0]


def damage(names: list[str]) -> None:
    """Criteria of damage of straight and skewed rollers, and of the downwind raceways energy, asperities' energy and ∫ p |v|."""
    for name in names:
        base = Case(loads=HubLoads.bundled(name), rollers=[0, 9, 18])
        straight = None
        for described, cage in {"straight": Cage(), **CAGES}.items():
            laws = Laws.physical() if described == "straight" else SKEWED
            result = simulate(replace(base, laws=laws, cage=cage))
            told, down = criteria(result), result.sel(row="downwind")
            sums = [
                down[kind].sel(interface=["inner", "outer"]).sum()
                for kind in ("energy", "asperity_energy")
            ]
            worst = [
                told[rate].sel(row="downwind").max("station")
                for rate in ("pressure_slip_rate", "asperity_work_rate")
            ]
            least = [
                told.asperity_work_rate.sel(row="downwind", surface=raceway)[10:14].min()
                / worst[1].sel(surface=raceway)
                for raceway in ("inner", "outer")
            ]
            values = [
                *sums,
                down.surface_work.sum(),
                *(rate.max() for rate in worst),
                told.wear_time[0, :, 1, 1].min(),
            ]
            values = np.array([float(value) for value in values])
            straight = values if straight is None else straight
            print(
                name,
                described,
                "energy, asperities, work, most p|v|, most wear, time to 10 um x",
                (values / straight).round(3),
            )
            print(
                "  least wear of the four middle stations over the most, inner and outer:",
                np.round(least, 3),
            )
            for criterion in told.criterion.values:
                print(f"  {criterion:26s} {float(told.value.sel(criterion=criterion)):.4g}")


if __name__ == "__main__":
    if sys.argv[1:2] in (["damage"], ["coupled"]):
        {"damage": damage, "coupled": coupled}[sys.argv[1]](sys.argv[2:])
    elif sys.argv[1:2] in (["check"], ["speed"], ["ends"]):
        {"check": check, "speed": speed, "ends": ends}[sys.argv[1]](sys.argv[2])
    else:
        main(bundled_cases() if sys.argv[1:] == ["all"] else sys.argv[1:] or ["14B", "24A", "12A"])
