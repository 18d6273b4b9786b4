"""Results of a traction law for a whole contact over which slip varies."""

from __future__ import annotations

from typing import NamedTuple


class Patch(NamedTuple):
    """Forces and moments of a film on a roller over a whole contact; every integral is over the patch.

    Attributes
    ----------
    force : float
        F = ∫τ dA [N], positive where it drives the spin up.
    lag : float
        ∫τ h/r dA [N]: by so much the moment about the roller's axis, over r, falls short of the force.
    skew : float
        ∫τ ζ dA [N m].
    force_slope, lag_slope : float
        Derivatives of force and lag by Δu, along the change of state the slip field names [N s/m].
    force_by_film, lag_by_film : float
        Derivatives by film thickness [N/m].
    """

    force: float
    lag: float
    skew: float
    force_slope: float
    lag_slope: float
    force_by_film: float
    lag_by_film: float
