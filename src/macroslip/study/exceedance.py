"""How often an orbit of a roller exceeds an energy or a power, and how often the bearing's load a range."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import xarray as xr

from macroslip.errors import InputError
from macroslip.result.variables import described
from macroslip.study.weights import YEAR, Weights, binned, weighted

#: Thresholds, 40 a decade: an energy [J] or power [W] is known to 6 %.
THRESHOLDS = np.logspace(-9.0, 9.0, 721)


def exceedance(
    study: xr.Dataset,
    weights: Weights,
    *,
    field: str = "wind_speed",
    width: float = 2.0,
    by: Sequence[str] = (),
) -> xr.Dataset:
    """How many orbits a year of one roller exceed an energy, and a peak power.

        n(x) = 1 year · Σ_b p_b N_b(> x) / t_b

    with the probability p_b of bin b, the number N_b(> x) of its orbits above x, over all runs,
    rollers of the row and complete orbits, and the time t_b that these took, over the same; of an
    event, the whole of its window.

    Results are read one after the other and counted by classes, so that memory does not grow with
    the study. Raises InputError if a label or a probability is wrong, or a stored result is
    damaged.

    Over (group, row, threshold) there are `energy_orbits` and `power_orbits` [1/year], orbits a
    year of one roller whose energy (all interfaces) or peak power (largest at any interface)
    exceeds the threshold [J or W]; over (group, row) `orbits` [1/year], all of them, NaN where a
    bin of some weight has no result; `runs` and `left_out` over (group, bin). Thresholds that all
    orbits exceed, and those that none does, are left out but for the nearest. Arguments are those
    of `macroslip.study.lifetime.lifetime_energy`.
    """
    missing = [name for name in ("orbit_energy", "peak_power") if name not in study]
    if missing:
        what = f"the results hold no {' and no '.join(missing)}"
        remedy = "Add them to keep in the study file, and go on with --resume."
        raise InputError(what, allowed="a study with results that keep them", remedy=remedy)
    bins = binned(study, field, width, by)
    shape = (len(bins.groups), bins.centres.size, study.sizes["row"])
    counts = np.zeros((2, *shape, THRESHOLDS.size))
    orbits, seconds = np.zeros(shape), np.zeros(shape)
    used, left_out = np.zeros(shape[:2]), np.zeros(shape[:2])
    for case in range(study.sizes["case"]):
        cell = bins.group[case], bins.bin[case]
        event = bool(bins.events[bins.bin[case]])
        complete = event or study.orbits.values[case] > 0
        if not np.isfinite(study.energy_mean.values[case]).all() or not complete:
            left_out[cell] += 1
            continue
        used[cell] += 1
        one = study.isel(case=case)
        dims = ("row", "roller", "orbit")
        energy = one.orbit_energy.sum("interface", skipna=False).transpose(*dims).values
        power = one.peak_power.max("interface", skipna=False).transpose(*dims).values
        length = (one.orbit_end - one.orbit_start).values
        for row in range(shape[2]):
            present = np.isfinite(energy[row])
            for kind, values in enumerate((energy, power)):
                above = np.sort(values[row][present])
                counts[kind][*cell, row] += present.sum() - np.searchsorted(
                    above, THRESHOLDS, side="right"
                )
            orbits[*cell, row] += present.sum()
            # An event has all of its record for the orbits that it completes, which may be none.
            alone = float(one.window_length) * max(present.any(axis=-1).sum(), 1)
            seconds[*cell, row] += (
                alone if event else np.broadcast_to(length, present.shape)[present].sum()
            )
    weight = bins.probabilities(weights)
    with np.errstate(invalid="ignore", divide="ignore"):
        found = np.stack(
            [YEAR * weighted(values / seconds[..., None], weight) for values in counts]
        )
        every = YEAR * weighted(orbits / seconds, weight)
        # Thresholds that some orbits exceed and some do not, and one more at either end.
        some = (found > 0.0) & (found < every[None, ..., None] * (1.0 - 1e-12))
    kept = _span(some.any(axis=(0, 1, 2)))
    dims = ("group", "row", "threshold")
    return xr.Dataset(
        {
            "energy_orbits": (dims, found[0][..., kept], described("1/year", "orbits whose energy exceeds it")),
            "power_orbits": (dims, found[1][..., kept], described("1/year", "orbits whose peak power exceeds it")),
            "orbits": (dims[:2], every, described("1/year", "orbits of a roller")),
            "runs": (("group", "bin"), used, described("1", "runs that were counted")),
            "left_out": (("group", "bin"), left_out, described("1", "runs without a result, or without an orbit")),
        },
        bins.coordinates(study) | {
            "row": study.row,
            "threshold": ("threshold", THRESHOLDS[kept], described("J or W", "energy [J] or power [W]")),
        },
        {"title": f"Exceedance per orbit: {study.attrs.get('title', '')}"},
    )  # fmt: skip


def load_spectrum(
    study: xr.Dataset, weights: Weights, *, years: float = 20.0, field: str = "wind_speed", width: float = 2.0,
    by: Sequence[str] = (),
) -> xr.Dataset:  # fmt: skip
    """Cycles of the bearing's load in a lifetime by their range, of a study that counts cycles.

        n = T Σ_b p_b (1/N_b) Σ_{c in b} n_c / t_c

    as in `macroslip.study.lifetime.lifetime_energy`, with the cycles n_c and the length t_c of each
    load history. Raises InputError if a label or a probability is wrong, or the study has not
    counted cycles. `cycles` [1] are over (group, component, load_range), NaN where a bin of some
    weight has no result. Ranges below the smallest and above the largest that occur are left out.
    """
    if "load_cycles" not in study:
        remedy = "Set `cycles: true` in the study file and run it again."
        raise InputError("the study has not counted cycles", remedy=remedy)
    bins = binned(study, field, width, by)
    lengths = study.loads_length.values
    rates = (
        study.load_cycles.isel(case=case).values / lengths[case]
        for case in range(study.sizes["case"])
    )
    cycles = years * YEAR * weighted(bins.means(rates)[0], bins.probabilities(weights))
    kept = _span(np.nan_to_num(cycles).any(axis=(0, 1)))
    about = described("1", f"cycles of the bearing's load in {years:g} years")
    return xr.Dataset(
        {"cycles": (("group", "component", "load_range"), cycles[..., kept], about)},
        bins.coordinates(study, bins=False)
        | {"component": study.component, "load_range": study.load_range[kept]},
        {"title": f"Load cycles: {study.attrs.get('title', '')}", "years": years},
    )


def _span(some: np.ndarray) -> slice:
    places = np.flatnonzero(some)
    return slice(max(int(places[0]) - 1, 0), int(places[-1]) + 2) if places.size else slice(0, 1)
