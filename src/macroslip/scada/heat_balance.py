"""Least squares for the heat balance of a bearing over windows of two hours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from macroslip.arrays import BoolArray, FloatArray
from macroslip.constants import HOUR
from macroslip.scada.heat_models import HeatModel
from macroslip.scada.windows import Windows

#: Conductance of each temperature of the air.
AIR: Mapping[str, str] = {
    "nacelle_temperature": "to_nacelle",
    "ambient_temperature": "to_ambient",
}
#: Constants of a fit with unit and meaning.
PARAMETERS: Mapping[str, tuple[str, str]] = {
    "drift": ("K/h", "q0: heat that does not go with the model"),
    "capacity": ("J/K", "C: heat capacity of what warms with the bearing"),
    "seal_torque": ("N m", "M_s: constant torque of seals, or of what the model lacks"),
    "heat_at_rated": ("K/h", "heat at rated speed over the heat capacity"),
    "to_nacelle": ("1/h", "k_n: conductance to the nacelle over the heat capacity"),
    "to_ambient": ("1/h", "k_o: conductance to the air outside over the heat capacity"),
}
#: Length of the blocks of the bootstrap [days], their number of samples, and its seed.
BLOCK_DAYS = 3
SAMPLES = 400
SEED = 1


@dataclass(frozen=True, eq=False)
class Balance:
    """Temperatures of the windows of a record, which every model of the heat is fitted to."""

    windows: Windows
    start: pd.DatetimeIndex  #: Time of the first row of each window
    rate: FloatArray  #: dT/dt of each window [K/h]
    #: Mean excess over a temperature of the air [K], by the name of its conductance
    excess: Mapping[str, FloatArray]

    @classmethod
    def of(cls, record: pd.DataFrame, windows: Windows) -> Balance:
        """Of a record with `bearing_temperature` and temperatures of the air [K]."""
        bearing = record["bearing_temperature"].to_numpy(float)
        excess = {}
        for air, constant in AIR.items():
            if air in record and bool(record[air].notna().any()):
                over_air = bearing - record[air].to_numpy(float)
                excess[constant] = windows.mean(over_air)
        start = pd.DatetimeIndex(record.index[windows.first])
        return cls(windows, start, windows.rate(bearing), excess)

    @property
    def blocks(self) -> NDArray[np.int64]:
        """Number of the block of three days in which each window begins."""
        nanoseconds = self.start.as_unit("ns").asi8
        days = nanoseconds // (86_400_000_000_000 * BLOCK_DAYS)
        return days - days.min()


@dataclass(frozen=True, eq=False)
class HeatFit:
    """Constants of a model of the heat, with the windows of the whole record."""

    model: HeatModel
    values: Mapping[str, float]  #: Constants by the names of `PARAMETERS`
    errors: Mapping[str, float]  #: Standard errors by the bootstrap of blocks
    residual: float  #: Root mean square of the residuals of the reference [K/h]
    heat: FloatArray  #: q0 and the heat of the model in each window [K/h]
    left: FloatArray  #: dT/dt and what went to the air in each window [K/h]

    @property
    def residuals(self) -> FloatArray:
        """Measured less fitted dT/dt of each window [K/h]."""
        return self.left - self.heat


def fit_heat(balance: Balance, model: HeatModel, reference: BoolArray) -> HeatFit:
    """Fit the heat balance of a bearing by least squares over its windows.

        dT/dt = q0 + 3600 [P(T) + M_s n]/C − Σ k (T − T_air)    [K/h, W, J/K]

    is linear in q0, 1/C, M_s/C and the conductances over C. A model without a heat in W has a heat
    at rated speed in place of the first two sources. Errors are half of what the middle 68 % of 400
    samples of blocks of three days span.

    Parameters
    ----------
    balance : Balance
        Of n windows.
    model : HeatModel
    reference : ndarray of bool, shape (n,)
        Windows of the reference, which the constants are fitted to.

    Returns
    -------
    HeatFit
        Heat and residuals of all windows.
    """
    names, columns = _columns(balance, model)
    # Columns of one size: sums of squares of watts and kelvins differ by ten powers of ten.
    in_reference = columns[:, reference]
    mean_square = np.mean(in_reference**2, axis=1)
    scale = np.maximum(np.sqrt(mean_square), 1e-300)
    design = (columns / scale[:, None]).T
    target = balance.rate
    design_of_reference = design[reference]
    target_of_reference = target[reference]
    solved, *_ = np.linalg.lstsq(design_of_reference, target_of_reference, rcond=None)
    blocks = balance.blocks[reference]
    samples = _bootstrap(design_of_reference, target_of_reference, blocks)
    values = _constants(names, solved / scale)
    spread = _constants(names, samples / scale)
    errors = {name: _half_width(spread[name]) for name in values}
    fitted = design * solved
    sources = 1 + len(model.sources)
    heat = fitted[:, :sources].sum(axis=1)
    losses = fitted[:, sources:].sum(axis=1)
    left = target - losses
    missed = (left - heat)[reference]
    return HeatFit(
        model=model,
        values={name: float(value) for name, value in values.items()},
        errors=errors,
        residual=float(np.sqrt(np.mean(missed**2))),
        heat=heat,
        left=left,
    )


def _columns(balance: Balance, model: HeatModel) -> tuple[Sequence[str], FloatArray]:
    """Names of the constants, and what each is multiplied with, over (constant, window)."""
    sources = [balance.windows.mean(values) for values in model.sources.values()]
    excess = [-values for values in balance.excess.values()]
    names = ["drift", *model.sources, *balance.excess]
    constant = np.ones(len(balance.windows))
    return names, np.stack([constant, *sources, *excess])


def _constants(names: Sequence[str], solved: FloatArray) -> dict[str, FloatArray]:
    """Constants of the fit, from solutions over (..., constant)."""
    by_name = np.moveaxis(solved, -1, 0)
    values = dict(zip(names, by_name, strict=True))
    if "capacity" in values:
        per_heat = values["capacity"]
        with np.errstate(divide="ignore", invalid="ignore"):
            values["capacity"] = HOUR / per_heat
            if "seal_torque" in values:
                values["seal_torque"] = values["seal_torque"] / per_heat
    return values


def _bootstrap(design: FloatArray, target: FloatArray, blocks: NDArray[np.int64]) -> FloatArray:
    """Solutions of the normal equations of drawn blocks, over (sample, constant)."""
    _, block = np.unique(blocks, return_inverse=True)
    number = int(block.max()) + 1
    constants = design.shape[1]
    squares = np.zeros((number, constants, constants))
    products = np.zeros((number, constants))
    outer_products = design[:, :, None] * design[:, None, :]
    np.add.at(squares, block, outer_products)
    np.add.at(products, block, design * target[:, None])
    random = np.random.default_rng(SEED)
    drawn = random.integers(0, number, (SAMPLES, number))
    counts_of_samples = [np.bincount(row, minlength=number) for row in drawn]
    counts = np.stack(counts_of_samples).astype(float)
    left = np.einsum("sb,bij->sij", counts, squares)
    right = counts @ products
    solutions = []
    for matrix, vector in zip(left, right, strict=True):
        # By least squares, since two constants may be the same in a sample.
        solution, *_ = np.linalg.lstsq(matrix, vector, rcond=None)
        solutions.append(solution)
    return np.stack(solutions)


def _half_width(values: FloatArray) -> float:
    """Half of what the middle 68 % span: the standard deviation of normal numbers."""
    low, high = np.nanpercentile(values, [16.0, 84.0])
    return float(0.5 * (high - low))
