"""Reynolds' equation over the gap of a rigid, isoviscous contact of finite length: load, rolling and sliding together.

In X = x/√(2 R_x h0), Z = 2z/l, H = h/h0 and P = p h0²/(12 η0 u √(2 R_x h0)) the gap h = h0 + x²/(2R_x) + z²/(2R_y) obeys

    ∂/∂X (H³ ∂P/∂X) + λ² ∂/∂Z (H³ ∂P/∂Z) = 2X where P > 0,   P ≥ 0,   H = 1 + X² + κ Z²,   P = 0 at Z = ±1,

with κ = l²/(8 R_y h0) and λ = 2 √(2 R_x h0)/l; u is the mean of the surface speeds. Where the pressure ends, the film
ruptures (Swift and Stieber). The inlet is full of oil to infinity.

Finite volumes on a graded grid; the complementarity problem is solved by the set of nodes with pressure, each time with
a sparse factorisation. The matrix is an M-matrix, so that the sets converge in finitely many steps.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, diags
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]


class GapSolution(NamedTuple):
    """Integrals over the film, Z from −1 to 1.

    Attributes
    ----------
    load : float
        ∫∫ P dX dZ, with Q = 12 η0 u R_x l/h0 of it.
    rolling : float
        ∫∫ H ∂P/∂X dX dZ = −∫∫ 2 P X dX dZ, with F_R = 3 η0 u l √(2 R_x/h0) of it.
    shear : float
        ∫∫ dX dZ/H over the inlet and the film with pressure, with ∫∫ dx dz/h = (l/2) √(2 R_x/h0) of it.
    dissipation : float
        ∫∫ H³ (P_X² + λ² P_Z²) dX dZ, which is `rolling` where energy balances.
    """

    load: float
    rolling: float
    shear: float
    dissipation: float


def places(wide: float, far: float, cells: int) -> Array:
    """Faces of the cells over X: even in asinh X, five times finer about the pressure than in the long inlet."""
    fine = np.linspace(-math.asinh(far * wide), math.asinh(1.2 * wide), 20001)
    density = 1.0 + 2.0 * (1.0 + np.tanh((fine + math.asinh(4.0 * wide)) / 0.5))
    share = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    return np.sinh(np.interp(np.linspace(0.0, share[-1], cells + 1), share, fine))


def stations(kappa: float, reach: float, cells: int) -> Array:
    """Faces of the cells over Z from 0 to 1, finer in the middle where κ is large and towards the roller's end."""
    fine = np.linspace(0.0, 1.0, 20001) ** 2
    fine = np.unique(np.concatenate([fine, 1.0 - fine]))
    density = (
        1.0
        + 1.0 / np.sqrt(fine**2 + 1.0 / (1.0 + kappa))
        + 0.5 / (1.0 - fine + 0.02 * min(1.0, reach) + 1e-4)
    )
    share = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(fine))])
    return np.interp(np.linspace(0.0, share[-1], cells + 1), share, fine)


def solve_gap(
    kappa: float, aspect: float, cells: tuple[int, int] = (160, 40), far: float = 1e4
) -> GapSolution:
    """The film at κ ≥ 0 and λ = `aspect` > 0.

    Parameters
    ----------
    kappa, aspect : float
        κ and λ.
    cells : tuple of int
        Cells along X and over half the length.
    far : float
        How far upstream the inlet is full, in √(2 R_x h0) (1 + κ)^½.

    Raises
    ------
    ArithmeticError
        If the set of nodes with pressure does not settle.
    """
    wide = math.sqrt(1.0 + kappa)
    faces = places(wide, far, cells[0])
    x = 0.5 * (faces[1:] + faces[:-1])
    width = np.diff(faces)
    edges = stations(kappa, aspect * wide, cells[1])
    z = 0.5 * (edges[1:] + edges[:-1])
    depth = np.diff(edges)
    gap_x = (1.0 + faces[:, None] ** 2 + kappa * z[None, :] ** 2) ** 3  # at faces across X
    gap_z = (1.0 + x[:, None] ** 2 + kappa * edges[None, :] ** 2) ** 3
    spacing_x = np.concatenate([[x[0] - faces[0]], np.diff(x), [faces[-1] - x[-1]]])
    spacing_z = np.concatenate([[math.inf], np.diff(z), [edges[-1] - z[-1]]])
    along = gap_x / spacing_x[:, None] * depth[None, :]
    across = aspect**2 * gap_z / spacing_z[None, :] * width[:, None]
    centre = (along[1:] + along[:-1] + across[:, 1:] + across[:, :-1]).ravel()
    n = z.size
    beside = across[:, 1:].copy()
    beside[:, -1] = 0.0
    ahead = along[1:-1].ravel()
    matrix = diags(
        [centre, -beside.ravel()[:-1], -beside.ravel()[:-1], -ahead, -ahead],
        [0, 1, -1, n, -n],
        format="csr",
    )
    # ∫ H_X over a cell is exact between its faces.
    source = ((faces[1:] ** 2 - faces[:-1] ** 2)[:, None] * depth[None, :]).ravel()
    pressure = np.zeros(centre.size)
    fluid = np.repeat(x < 0.6 * wide, n)
    for _ in range(100):
        inside = np.flatnonzero(fluid)
        part = csc_matrix(matrix[inside][:, inside])
        pressure[:] = 0.0
        pressure[inside] = splu(part).solve(-source[inside])
        residual = matrix @ pressure + source
        changed = np.where(fluid, pressure > 0.0, residual < 0.0)
        if np.array_equal(changed, fluid):
            break
        fluid = changed
    else:
        raise ArithmeticError(f"the film's end does not settle at κ = {kappa}, λ = {aspect}")
    field = pressure.reshape(x.size, n)
    load = 2.0 * float(width @ field @ depth)
    rolling = -float(np.sum(field * (faces[1:] ** 2 - faces[:-1] ** 2)[:, None] * depth[None, :]))
    rolling *= 2.0
    dissipation = 2.0 * float(pressure @ (matrix @ pressure))
    shear = 2.0 * float(np.sum(exit_shear(x, faces, width, field, 1.0 + kappa * z * z) * depth))
    return GapSolution(load, rolling, shear, dissipation)


def exit_shear(x: Array, faces: Array, width: Array, field: Array, lowest: Array) -> Array:
    """∫ dX/H of every station, from far upstream to the film's end.

    The pressure meets zero as (X_e − X)²: its square root over the last two cells gives X_e to second order.
    """
    last = field.shape[0] - 1 - np.argmax(field[::-1] > 0.0, axis=0)
    station = np.arange(field.shape[1])
    end, before = np.sqrt(field[last - 1, station]), np.sqrt(field[last - 2, station])
    boundary = x[last - 1] + end * (x[last - 1] - x[last - 2]) / (before - end)
    root = np.sqrt(lowest)
    return (np.arctan(boundary / root) + 0.5 * math.pi) / root
