"""Full numerical solution of an isothermal, incompressible, smooth line contact: Reynolds and elastic half-spaces.

In Moes' variables two numbers are left, M and L. With x = R ε^½ X, h = R ε H, p = E' ε^½ P and ε = (2U)^½:

    (H³ e^(−L P) P')' = 6 H',   H = H0 + X²/2 − (4/π) ∫ P ln|X − X'| dX',   ∫ P dX = M,   P ≥ 0,

with Reynolds' boundary condition at the outlet, which the inequality brings about. Newton's method on pressures and H0
with the Fischer-Burmeister function for the inequality; finite volumes with central fluxes on a graded grid.
"""

from __future__ import annotations

import numpy as np
import pytest

from macroslip import Bearing, Lubricant
from macroslip.roller.model import interfaces


def _log_kernel(x, edges):
    """Integrals of ln|x_i − s| over the cells."""

    def primitive(distance):
        size = np.abs(distance)
        return distance * (np.log(np.where(size > 0.0, size, 1.0)) - 1.0)

    return primitive(x[:, None] - edges[None, :-1]) - primitive(x[:, None] - edges[None, 1:])


def _grid(inlet, outlet, finest, growth):
    """Cell edges that are `finest` apart about the middle and grow outwards."""

    def side(reach, core):
        steps = [finest] * int(np.ceil(core / finest))
        while sum(steps) < reach:
            steps.append(steps[-1] * growth)
        return np.cumsum(steps)

    core_in, core_out = inlet[1], outlet[1]
    left, right = side(inlet[0], core_in), side(outlet[0], core_out)
    return np.concatenate([-left[::-1], [0.0], right])


def solve(load, material, rigid=False, cells=240):
    """Smallest film thickness H, and the one that the volume flow fills, for M = `load` and L = `material`.

    Parameters
    ----------
    load, material : float
        M > 0 and L ≥ 0.
    rigid : bool
        Leave elastic deformation out.
    cells : int
        About how many cells cover the loaded part.

    Returns
    -------
    (float, float)
        Smallest H; H where P is highest, which is the volume flow over the entrainment speed.

    Raises
    ------
    RuntimeError
        If Newton's method stops: at high loads and high L together the pressures are too steep for this grid.
    """
    half_width = np.sqrt(8.0 * load / np.pi) if not rigid else 0.0  # Hertz: b = R ε^½ √(8 M/π)
    film = max(2.449 / load, 1.3 * material ** (2.0 / 3.0) if rigid else 0.0)
    reach = np.sqrt(2.0 * film) if rigid else np.sqrt(2.0 * min(film, 2.6 * load**-0.2 + 1.3 * material**0.7))
    core = 1.2 * half_width + 1.0 * reach
    finest = 2.0 * core / cells
    edges = _grid((half_width + 60.0 * reach, core), (half_width + 6.0 * reach, core), finest, 1.06)
    x = 0.5 * (edges[1:] + edges[:-1])
    width = np.diff(edges)
    gap = np.diff(x)
    deform = np.zeros((x.size, x.size)) if rigid else -4.0 / np.pi * _log_kernel(x, edges)
    n = x.size

    def residual(unknown, viscosity_exponent, target, scale=None):
        pressure, offset = unknown[:-1], unknown[-1]
        height = offset + 0.5 * x**2 + deform @ pressure
        d_height = np.hstack([deform, np.ones((n, 1))])
        # Fluxes through inner edges: −H³ e^(−LP) P' + 6 H, from the mean values of both sides.
        mean_h = 0.5 * (height[1:] + height[:-1])
        mean_p = 0.5 * (pressure[1:] + pressure[:-1])
        conductance = mean_h**3 * np.exp(-viscosity_exponent * mean_p) / gap
        drop = np.diff(pressure)
        flux = -conductance * drop + 6.0 * mean_h
        d_mean_h = 0.5 * (d_height[1:] + d_height[:-1])
        d_flux = (6.0 - 3.0 * conductance * drop / mean_h)[:, None] * d_mean_h
        rows = np.arange(n - 1)
        half = 0.5 * viscosity_exponent * conductance * drop
        d_flux[rows, rows] += conductance + half
        d_flux[rows, rows + 1] += -conductance + half
        # Ambient pressure at both ends.
        net = np.zeros(n)
        d_net = np.zeros((n, n + 1))
        net[1:-1] = np.diff(flux)
        d_net[1:-1] = np.diff(d_flux, axis=0)
        # 0 ≤ P ⊥ net outflow ≥ 0; scaled so that neither dominates, and alike for all trials of one iteration.
        if scale is None:
            scale = np.ones(n)
            scale[1:-1] = conductance[1:] + conductance[:-1]
        a, b = pressure, net / scale
        root = np.hypot(a, b) + 1e-300
        value = root - a - b
        by_a, by_b = a / root - 1.0, b / root - 1.0
        jacobian = by_b[:, None] * d_net / scale[:, None]
        jacobian[np.arange(n), np.arange(n)] += by_a
        value[[0, -1]] = pressure[[0, -1]]
        jacobian[[0, -1]] = 0.0
        jacobian[0, 0] = jacobian[-1, n - 1] = 1.0
        balance = (width @ pressure - target) / target
        jacobian = np.vstack([jacobian, np.append(width, 0.0)[None, :] / target])
        return np.append(value, balance), jacobian, height, scale, flux

    # A light contact first, which is nearly rigid; then more load, then more viscosity.
    light = min(load, 0.5)
    stages = [(m, 0.0) for m in np.geomspace(light, load, 1 + int(np.ceil(4.0 * np.log(load / light))))]
    stages += [(load, e) for e in np.linspace(0.0, material, 1 + int(np.ceil(material * max(1.0, load**0.5))))[1:]]
    start = np.maximum(1.0 - x**2 * light / 4.9, 0.0)
    start *= light / (width @ start)
    unknown = np.append(start, 2.449 / light)
    for target, exponent in stages:
        for _ in range(100):
            value, jacobian, height, scale, _ = residual(unknown, exponent, target)
            change = np.linalg.solve(jacobian, -value)
            norm, damping = np.linalg.norm(value), 1.0
            while damping > 1e-4:
                trial = unknown + damping * change
                new, _, height, _, flux = residual(trial, exponent, target, scale)
                if (
                    np.all(np.isfinite(new))
                    and np.linalg.norm(new) < (1.0 - 1e-4 * damping) * norm
                    and height.min() > 0
                ):
                    break
                damping *= 0.5
            unknown = trial
            if np.linalg.norm(new) < 1e-9:
                break
        else:
            raise RuntimeError(f"no convergence at M = {target}, L = {exponent}")
    return float(height.min()), float(flux[np.argmax(unknown[:-1])] / 6.0)


@pytest.fixture(scope="session")
def numerical_film():
    """`solve`, the full numerical solution."""
    return solve


@pytest.fixture(scope="session")
def base():
    """Interfaces of the base bearing: inner, outer, cage."""
    return interfaces(Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao"))
