"""Film, rolling resistance and sliding shear of a lubricated line contact, from Reynolds' equation and elasticity.

The reference for the rolling laws of `macroslip.contact.rolling`: a Newtonian film between elastic half-spaces, pure rolling,
isothermal, incompressible, flooded. In x = b X, p = p0 P, h = b² H/(2R) with Hertz' half-width b and pressure p0,

    d/dX [H³ e^(−ln η̄(P))/Λ · dP/dX − H] = 0 where P > 0,   P ≥ 0,   Λ = 3π²/(2M²),
    H = H0 + X² − (2/π) ∫ P(S) ln|X − S| dS,   ∫ P dX = π/2.

With Barus' law ln η̄ = L √(M/2π) P. Moes' groups are M = W (2U)^(−½) and L = G (2U)^¼. The pressure is piecewise linear
and its deformation exact; flows are those of finite volumes, Couette's upwind of second order. Newton's method solves
for all pressures and H0 at once; the set of nodes without pressure changes between its steps.

Run `python benchmarks/line_contact.py` for the errors of the laws of `macroslip.contact.rolling` (five minutes).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class LineContact(NamedTuple):
    """A solution, in groups that need neither radius nor modulus.

    Attributes
    ----------
    position, pressure, gap : Array
        X, P and H at the nodes.
    film : float
        Film of the volume flow, (h*/R) (2U)^(−½).
    rolling : float
        Rolling force of one surface per length F_R/(E' R l) (2U)^(−¾), from the centre of pressure.
    rolling_by_shear : float
        The same from the shear at the surfaces, ½ ∫ h dp/dx dx.
    gap_integral : float
        ∫dx/h (2U)^¼ over the film with pressure.
    """

    position: Array
    pressure: Array
    gap: Array
    film: float
    rolling: float
    rolling_by_shear: float
    gap_integral: float


def grid(half_width: float, nodes: int) -> Array:
    """Nodes X: over the contact, finer where pressure rises and ends; geometrically wider to 2,000 half-widths."""
    fine = np.linspace(-1.0, 1.0, 20001)
    density = np.ones_like(fine)
    if half_width < 1.5:
        density += 4.0 / np.cosh((fine * half_width - 0.93) / 0.1) ** 2
        density += 1.0 / np.cosh((fine * half_width + 1.0) / 0.15) ** 2
    share = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    core = np.interp(np.linspace(0.0, share[-1], nodes // 2), share, fine)
    first, last = core[1] - core[0], core[-1] - core[-2]
    count = nodes - nodes // 2 - nodes // 16
    low, high = 1.0 + 1e-6, 2.0
    for _ in range(200):
        ratio = 0.5 * (low + high)
        reach = first * ratio * (ratio**count - 1.0) / (ratio - 1.0)
        low, high = (ratio, high) if reach < 2000.0 else (low, ratio)
    inlet = -1.0 - np.cumsum(first * ratio ** np.arange(1, count + 1))
    outlet = 1.0 + np.cumsum(last * 1.06 ** np.arange(1, nodes // 16 + 1))
    return half_width * np.concatenate([inlet[::-1], core, outlet])


def deformation(position: Array) -> Array:
    """Matrix of (2/π) ∫ φ_j(S) ln|X_i − S| dS for the hat functions φ_j of the nodes."""

    def zeroth(t: Array) -> Array:
        return t * np.log(np.abs(t) + (t == 0.0)) - t

    def first(t: Array) -> Array:
        return 0.5 * t * t * (np.log(np.abs(t) + (t == 0.0)) - 0.5)

    left, right = position[:-1], position[1:]
    width = right - left
    t_left = left[None, :] - position[:, None]
    t_right = right[None, :] - position[:, None]
    whole = zeroth(t_right) - zeroth(t_left)
    moment = first(t_right) - first(t_left) - t_left * whole
    matrix = np.zeros((position.size, position.size))
    matrix[:, 1:] += moment / width
    matrix[:, :-1] += whole - moment / width
    return 2.0 / math.pi * matrix


def solve_line(
    load: float,
    material: float,
    nodes: int = 700,
    log_viscosity: Callable[[Array], tuple[Array, Array]] | None = None,
    density: Callable[[Array], tuple[Array, Array]] | None = None,
    start: LineContact | None = None,
) -> LineContact:
    """The contact at load M and lubricant parameter L.

    Parameters
    ----------
    load : float
        M, > 0.
    material : float
        L, ≥ 0; not used where `log_viscosity` is given.
    nodes : int
        Number of nodes.
    log_viscosity : callable
        ln η̄ and its derivative over P; Barus' law by default.
    density : callable
        ρ̄ and its derivative over P; incompressible by default.
    start : LineContact
        A solution nearby, to start from.

    Raises
    ------
    ArithmeticError
        If Newton's method does not converge.
    """
    rigid = math.sqrt(2.448 * math.pi / (4.0 * load * load))  # √(2 R h0)/b of Martin's contact
    half_width = max(1.3, 2.0 * rigid)
    x = grid(half_width, nodes)
    step = np.diff(x)
    weight = np.zeros_like(x)
    weight[:-1] += 0.5 * step
    weight[1:] += 0.5 * step
    kernel = deformation(x)
    exponent = material * math.sqrt(load / (2.0 * math.pi))
    barus = log_viscosity or (lambda p: (exponent * p, np.full_like(p, exponent)))
    weigh = density or (lambda p: (np.ones_like(p), np.zeros_like(p)))
    poiseuille = load * load / (1.5 * math.pi**2)
    # H at the middle of each cell for Couette's flow: H_i + (H_i − H_{i−1}) (step to the middle)/(step behind).
    ratio = np.zeros_like(step)
    ratio[1:] = 0.5 * step[1:] / step[:-1]

    if start is None:
        if load < 1.0:
            shape = np.clip(1.0 - (x / rigid + 0.4) ** 2 / 1.2, 0.0, None) ** 2
        else:
            shape = np.sqrt(np.clip(1.0 - x * x, 0.0, None))
        p = shape * (0.5 * math.pi / (weight @ shape))
        offset = rigid**2 if load < 1.0 else 0.5
    else:
        p = np.interp(x, start.position, start.pressure)
        p *= 0.5 * math.pi / (weight @ p)
        offset = float(
            np.min(start.gap + deformation(start.position) @ start.pressure - start.position**2)
        )

    def evaluate(p, offset):
        gap = offset + x * x - kernel @ p
        middle = 0.5 * (gap[1:] + gap[:-1])
        log_eta, by_pressure = barus(0.5 * (p[1:] + p[:-1]))
        rho, rho_slope = weigh(p)
        rho_middle, rho_middle_slope = weigh(0.5 * (p[1:] + p[:-1]))
        mobility = poiseuille * rho_middle * np.exp(-log_eta) / step
        by_pressure = by_pressure - rho_middle_slope / rho_middle
        flow = mobility * middle**3 * np.diff(p)
        couette = (rho * gap)[:-1] * (1.0 + ratio)
        couette[1:] -= ratio[1:] * (rho * gap)[:-2]
        return gap, middle, mobility, by_pressure, flow, couette, rho, rho_slope

    for _ in range(60):
        gap, middle, mobility, by_pressure, flow, couette, rho, rho_slope = evaluate(p, offset)
        residual = np.zeros_like(x)
        residual[1:-1] = np.diff(couette - flow)
        fluid = (p > 0.0) | (residual < 0.0)
        fluid[0] = fluid[-1] = False
        inside = np.flatnonzero(fluid)
        # Derivatives of the flows over pressures: through the gap (dense) and directly (two diagonals).
        gap_rows = -kernel
        middle_rows = 0.5 * (gap_rows[1:] + gap_rows[:-1])
        mass_rows = rho[:, None] * gap_rows
        mass_rows[np.arange(x.size), np.arange(x.size)] += rho_slope * gap
        cells = (1.0 + ratio)[:, None] * mass_rows[:-1]
        cells[1:] -= ratio[1:, None] * mass_rows[:-2]
        cells -= (3.0 * mobility * middle**2 * np.diff(p))[:, None] * middle_rows
        index = np.arange(step.size)
        conduct = mobility * middle**3
        cells[index, index + 1] -= conduct - 0.5 * by_pressure * flow
        cells[index, index] += conduct + 0.5 * by_pressure * flow
        by_offset = (1.0 + ratio) * rho[:-1] - 3.0 * mobility * middle**2 * np.diff(p)
        by_offset[1:] -= ratio[1:] * rho[:-2]
        rows = np.diff(cells, axis=0)[inside - 1]
        size = inside.size
        matrix = np.empty((size + 1, size + 1))
        matrix[:size, :size] = rows[:, inside]
        matrix[:size, size] = np.diff(by_offset)[inside - 1]
        matrix[size, :size] = weight[inside]
        matrix[size, size] = 0.0
        right = np.append(-residual[inside], 0.5 * math.pi - weight @ p)
        # Nodes that left the film have pressure 0 from here on.
        scale = np.max(np.abs(matrix), axis=1)
        try:
            change = np.linalg.solve(matrix / scale[:, None], right / scale)
        except np.linalg.LinAlgError as error:
            raise ArithmeticError("Newton's matrix is singular") from error
        largest = np.max(np.abs(change[:-1]))
        damping = min(1.0, 0.3 * max(p.max(), 0.1) / largest)
        p[inside] += damping * change[:-1]
        p[~fluid] = 0.0
        offset += damping * change[-1]
        clipped = p < 0.0
        p[clipped] = 0.0
        if damping == 1.0 and largest < 1e-9 * p.max() and not clipped[inside].any():
            break
    else:
        raise ArithmeticError(f"no convergence at M = {load}, L = {material}")

    gap, middle, mobility, by_pressure, flow, couette, rho, rho_slope = evaluate(p, offset)
    last = int(np.flatnonzero(p > 0.0)[-1])
    length_scale = math.sqrt(8.0 * load / math.pi)  # b/R (2U)^(−¼)
    film = float((couette - flow)[last - 1]) * 4.0 * load / math.pi
    rolling = -(length_scale * load / math.pi) * float(weight @ (p * x))
    shear = (length_scale * load / math.pi) * 0.5 * float(np.sum(middle * np.diff(p)))
    cells = slice(0, last + 1)
    inverse = float(np.sum(step[cells] / middle[cells])) * length_scale / (4.0 * load / math.pi)
    return LineContact(x, p, gap, film, rolling, shear, inverse)


def climb(load: float, materials: list[float], nodes: int = 500, **rheology) -> list[LineContact]:
    """Contacts at one load M and rising lubricant parameters L, each started from the one before.

    Where Newton's method fails, the step in L is halved. `rheology` holds functions of L that give `log_viscosity` and
    `density`.

    Raises
    ------
    ArithmeticError
        If a step below 0.02 in L does not help.
    """

    def options(material: float) -> dict:
        return {name: law(material) for name, law in rheology.items()}

    solution = solve_line(load, 0.0, nodes)
    reached, step = 0.0, 1.0
    solutions = []
    for target in materials:
        while reached < target:
            aim = min(target, reached + step)
            try:
                solution = solve_line(load, aim, nodes, start=solution, **options(aim))
            except ArithmeticError:
                step *= 0.5
                if step < 0.02:
                    raise
            else:
                reached, step = aim, min(2.0, 1.5 * step)
        solutions.append(solution)
    return solutions


def inlet_share(solution: LineContact, load: float) -> float:
    """N_F of the inlet, ½ ∫ (h − h*) dp up to X = −0.9 in Moes' groups."""
    scale = 0.5 * math.sqrt(8.0 * load / math.pi) * load / math.pi
    middle = 0.5 * (solution.gap[1:] + solution.gap[:-1])
    position = 0.5 * (solution.position[1:] + solution.position[:-1])
    work = (middle - solution.film * math.pi / (4.0 * load)) * np.diff(solution.pressure)
    return scale * float(work[position < -0.9].sum())


def roelands(load: float, alpha: float, exponent: float) -> Callable:
    """`log_viscosity` over L of Roelands' law with α [1/Pa] and Z at M = `load`."""

    def at(material: float):
        scale = material * math.sqrt(load / (2.0 * math.pi)) / alpha / 1.962e8
        factor = alpha * 1.962e8 / exponent
        return lambda p: (
            factor * ((1.0 + scale * p) ** exponent - 1.0),
            factor * exponent * scale * (1.0 + scale * p) ** (exponent - 1.0),
        )

    return at


def dowson_higginson(load: float, alpha: float) -> Callable:
    """`density` over L of Dowson and Higginson's law at M = `load`."""

    def at(material: float):
        scale = material * math.sqrt(load / (2.0 * math.pi)) / alpha
        return lambda p: (
            (5.9e8 + 1.34 * scale * p) / (5.9e8 + scale * p),
            0.34 * 5.9e8 * scale / (5.9e8 + scale * p) ** 2,
        )

    return at


def main() -> None:
    """Errors of the laws over the loads of a raceway contact of the base bearing, and over a grid of M and L."""
    from macroslip import Bearing, Lubricant
    from macroslip.contact.interface import interfaces
    from macroslip.contact.rolling import line_rolling

    contact = interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))[0]
    oil, speed = contact.lubricant, 0.396
    doubled = 2.0 * oil.viscosity * speed / (contact.modulus * contact.rolling_radius)
    material = oil.pressure_viscosity * contact.modulus * doubled**0.25
    exponent = oil.pressure_viscosity * 1.962e8 / (math.log(oil.viscosity) + 9.67)
    print(
        f"middle slice of the inner raceway contact, L = {material:.2f}; N_F of solutions, and laws over them"
    )
    print(
        "    Q [N]       M   Barus  inlet  Roelands, compressible | whole-film  inlet/inlet  inlet/whole"
    )
    for force in (30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5):
        line = 0.75 * force ** (2.0 / 3.0) / contact.hertz.semi_axis_across
        load = line / (contact.modulus * contact.rolling_radius) / math.sqrt(doubled)
        solution = climb(load, [material], 600)[0]
        laws = {
            "log_viscosity": roelands(load, oil.pressure_viscosity, exponent),
            "density": dowson_higginson(load, oil.pressure_viscosity),
        }
        real = climb(load, [material], 600, **laws)[0]
        inlet = inlet_share(solution, load) if load > 1.0 else math.nan
        whole, published = (line_rolling(law, load, material) for law in ("whole-film", "inlet"))
        print(
            f"{force:9.0f} {load:7.3f} {solution.rolling:7.4f} {inlet:6.3f} {real.rolling:10.4f} "
            f"{whole / solution.rolling:20.3f} {published / inlet:12.3f} {published / solution.rolling:12.3f}",
            flush=True,
        )
    print(
        "whole-film over solutions with Barus' law; rows M, columns L = 0, 1, 2, 4, 7, 10, 13.4, 18"
    )
    materials = [1.0, 2.0, 4.0, 7.0, 10.0, 13.4, 18.0]
    for load in (0.1, 0.3, 0.6, 1.5, 3.0, 6.0, 11.0, 20.0, 32.0, 60.0):
        solutions = [solve_line(load, 0.0, 500), *climb(load, materials, 500)]
        ratios = [
            line_rolling("whole-film", load, max(material, 1e-12)) / solution.rolling
            for material, solution in zip([0.0, *materials], solutions, strict=True)
        ]
        print(f"{load:5.1f}", " ".join(f"{ratio:6.3f}" for ratio in ratios), flush=True)


if __name__ == "__main__":
    main()
