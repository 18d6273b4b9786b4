"""Sobol' indices from a sample: a sparse polynomial, fitted to it with a measured error, replaces the model."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

#: Parts into which the sample is divided to measure the error of the fit.
_PARTS = 10
#: Most terms of a fit, as a part of the number of samples.
_MOST_TERMS = 0.25
#: Samples of the polynomial from which SciPy takes the indices; a power of 2.
_SOBOL_SAMPLES = 4096


@dataclass(frozen=True, slots=True, eq=False)
class Polynomial:
    """A sum of products of Legendre polynomials of places from 0 to 1.

    Parameters
    ----------
    degrees : ndarray of int, shape (terms, values)
        Degree in every value; the first term is the constant.
    coefficients : ndarray, shape (terms,)
        Each term has the variance 1 over evenly likely places, the constant none.
    """

    degrees: NDArray[np.int64]
    coefficients: NDArray[np.float64]

    def __call__(self, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Value at each of n places, shape (n, values)."""
        return _columns(places, self.degrees) @ self.coefficients


def _columns(places: NDArray[np.float64], degrees: NDArray[np.int64]) -> NDArray[np.float64]:
    """Every term at every place, shape (places, terms)."""
    x = 2.0 * places - 1.0
    legendre = np.stack([np.ones_like(x), math.sqrt(3.0) * x, math.sqrt(5.0) * (1.5 * x * x - 0.5)])
    found = np.ones((len(places), len(degrees)))
    for k in range(degrees.shape[1]):
        found *= legendre[degrees[:, k], :, k].T
    return found


def _candidates(count: int) -> NDArray[np.int64]:
    """Degrees of all terms up to the second degree: one value's, and products of two."""
    unit = np.eye(count, dtype=int)
    pairs = [unit[i] + unit[k] for i, k in combinations(range(count), 2)]
    return np.concatenate(
        [np.zeros((1, count), dtype=int), unit, 2 * unit, np.array(pairs, dtype=int).reshape(-1, count)]
    )


def fit(places: NDArray[np.float64], values: NDArray[np.float64]) -> Polynomial:
    """The sparse polynomial of second degree that predicts the values of a sample best.

    Terms are taken up one by one, each the one that most lowers what is left; the number of terms is that at which leaving
    one sample out is predicted best.

    Parameters
    ----------
    places : ndarray, shape (samples, values)
        From 0 to 1.
    values : ndarray, shape (samples,)

    References
    ----------
    G. Blatman, B. Sudret, "Adaptive sparse polynomial chaos expansion based on least angle regression", J. Comput. Phys.
    230 (2011) 2345, doi:10.1016/j.jcp.2010.12.021; here by forward selection.
    """
    degrees = _candidates(places.shape[1])
    columns = _columns(places, degrees)
    chosen, best, least = [0], [0], math.inf
    basis = columns[:, :1] / np.linalg.norm(columns[:, 0])
    rest, spans = columns - basis @ (basis.T @ columns), np.linalg.norm(columns, axis=0)
    for _ in range(max(1, int(_MOST_TERMS * len(values)))):
        left = values - basis @ (basis.T @ values)
        leverage = (basis**2).sum(axis=1)
        # Beyond the error of leaving one out: the more terms have been tried, the more one of them fits by chance.
        error = float(np.mean((left / (1.0 - leverage)) ** 2)) / max(1e-9, 1.0 - basis.shape[1] / len(values))
        if error < least:
            best, least = chosen.copy(), error
        norms = np.linalg.norm(rest, axis=0)
        gain = np.where(norms > 1e-6 * spans, np.abs(left @ rest) / np.maximum(norms, 1e-300), 0.0)
        gain[chosen] = 0.0
        k = int(np.argmax(gain))
        if gain[k] <= 1e-12 * np.linalg.norm(values):
            break
        chosen.append(k)
        new = rest[:, k] / norms[k]
        basis = np.column_stack([basis, new])
        rest = rest - np.outer(new, new @ rest)
    coefficients, *_ = np.linalg.lstsq(columns[:, best], values, rcond=None)
    return Polynomial(degrees[best], coefficients)


def explained_variance(places: NDArray[np.float64], values: NDArray[np.float64]) -> float:
    """Part of the variance that the fit predicts for samples it was not fitted to [1], below 1; 0 and less: nothing.

    The sample is divided into ten parts; each is predicted by a fit to the other nine.
    """
    order = np.random.default_rng(0).permutation(len(values))
    error = 0.0
    for part in np.array_split(order, _PARTS):
        others = np.setdiff1d(order, part)
        error += float(((fit(places[others], values[others])(places[part]) - values[part]) ** 2).sum())
    return 1.0 - error / float(((values - values.mean()) ** 2).sum())


def sobol_indices(places: NDArray[np.float64], values: NDArray[np.float64]) -> tuple[NDArray, NDArray, float]:
    """Sobol' indices of a quantity over the values of a sample.

    Parameters
    ----------
    places : ndarray, shape (samples, values)
        Evenly likely, from 0 to 1.
    values : ndarray, shape (samples,)

    Returns
    -------
    first : ndarray, shape (values,)
        Part of the variance that each value makes by itself [1].
    total : ndarray, shape (values,)
        The same with all in which it takes part [1].
    float
        Part of the variance that the fit predicts, from `explained_variance`: indices are those of the fit; the rest of
        the variance is unexplained.

    References
    ----------
    I. M. Sobol', "Sensitivity estimates for nonlinear mathematical models", Math. Modelling Comput. Exp. 1 (1993) 407;
    `scipy.stats.sobol_indices`.
    """
    from scipy import stats

    polynomial = fit(places, values)
    if len(polynomial.coefficients) == 1:
        nothing = np.zeros(places.shape[1])
        return nothing, nothing.copy(), explained_variance(places, values)
    found = stats.sobol_indices(
        func=lambda x: polynomial(x.T)[None],
        n=_SOBOL_SAMPLES,
        dists=[stats.uniform()] * places.shape[1],
        rng=np.random.default_rng(1),
    )
    return found.first_order.ravel(), found.total_order.ravel(), explained_variance(places, values)
