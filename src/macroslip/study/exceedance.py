"""Exceedance curves: orbits over energy and power, cycles over the range of the load."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr

from macroslip.constants import YEAR
from macroslip.errors import InputError
from macroslip.study.aggregation import Aggregation
from macroslip.study.over_temperature import MIXED
from macroslip.study.weights import Binning, weighted
from macroslip.variables import ALWAYS, Variable, VariableTable, described

#: Thresholds, 40 a decade: an energy [J] or power [W] is known to 6 %.
THRESHOLDS = np.logspace(-9.0, 9.0, 721)


_CELLS = ("group", "bin")
_CURVE = ("group", "row", "threshold")
#: All variables of `exceedance`.
EXCEEDANCE = VariableTable(
    "Exceedance per orbit, `macroslip.study.exceedance.exceedance`",
    (
        Variable("energy_orbits", _CURVE, "1/year", ALWAYS, "orbits whose energy exceeds it"),
        Variable("power_orbits", _CURVE, "1/year", ALWAYS, "orbits whose peak power exceeds it"),
        Variable("orbits", ("group", "row"), "1/year", ALWAYS, "orbits of a roller"),
        Variable("runs", _CELLS, "1", ALWAYS, "runs that were counted"),
        Variable("left_out", _CELLS, "1", ALWAYS, "runs without a result, or without an orbit"),
    ),
)
#: All variables of `load_spectrum`.
LOAD_SPECTRUM = VariableTable(
    "Load cycles in the lifetime, `macroslip.study.exceedance.load_spectrum`",
    (
        Variable(
            "cycles",
            ("group", "component", "load_range"),
            "1",
            ALWAYS,
            "cycles of the bearing's load in the lifetime",
        ),
    ),
)


def exceedance(study: xr.Dataset, aggregation: Aggregation) -> xr.Dataset:
    """Orbits a year in which one roller exceeds an energy, and a peak power.

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
    orbits exceed, and those that none does, are left out but for the nearest.
    """
    if MIXED in study.attrs:
        raise InputError(
            "the weights combine several oil temperatures, and single orbits are not interpolated between them",
            where="weights",
            remedy="Look at the runs of one temperature, under weights without scada and "
            "temperature.",
        )
    missing = [name for name in ("orbit_energy", "peak_power") if name not in study]
    if missing:
        fault = f"the results hold no {' and no '.join(missing)}"
        remedy = "Add them to keep in the study file, and go on with --resume."
        raise InputError(fault, allowed="a study with results that keep them", remedy=remedy)
    bins = aggregation.bins(study)
    counted = _counted(study, bins)
    weight = bins.probabilities(aggregation.weights)
    with np.errstate(invalid="ignore", divide="ignore"):
        rates = []
        for above in counted.above:
            per_second = above / counted.seconds[..., None]
            rates.append(YEAR * weighted(per_second, weight))
        orbits_per_second = counted.orbits / counted.seconds
        all_orbits = YEAR * weighted(orbits_per_second, weight)
        # Thresholds that some orbits exceed and some do not, and one more at either end.
        most = all_orbits[..., None] * (1.0 - 1e-12)
        some = []
        for rate in rates:
            is_between = (rate > 0.0) & (rate < most)
            some.append(is_between.any(axis=(0, 1)))
    kept = _span(some[0] | some[1])
    energy_orbits, power_orbits = [rate[..., kept] for rate in rates]
    about_thresholds = described("J or W", "energy [J] or power [W]")
    values = {
        "energy_orbits": energy_orbits,
        "power_orbits": power_orbits,
        "orbits": all_orbits,
        "runs": counted.used,
        "left_out": counted.left_out,
    }
    return xr.Dataset(
        EXCEEDANCE.put(values),
        bins.coordinates(study)
        | {"row": study.row, "threshold": ("threshold", THRESHOLDS[kept], about_thresholds)},
        {"title": f"Exceedance per orbit: {study.attrs.get('title', '')}"},
    )


class _Counted(NamedTuple):
    """Orbits by group and bin."""

    above: np.ndarray  #: Orbits above each threshold, (energy or power, group, bin, row, threshold)
    orbits: np.ndarray  #: All orbits, (group, bin, row)
    seconds: np.ndarray  #: Time that they took [s], (group, bin, row)
    used: np.ndarray  #: Runs that were counted, (group, bin)
    left_out: np.ndarray  #: Runs without a result, or without an orbit, (group, bin)


def _counted(study: xr.Dataset, bins: Binning) -> _Counted:
    """Count the orbits of each run by the energy or power that they exceed."""
    cells = (len(bins.groups), bins.centres.size)
    rows = study.sizes["row"]
    counted = _Counted(
        above=np.zeros((2, *cells, rows, THRESHOLDS.size)),
        orbits=np.zeros((*cells, rows)),
        seconds=np.zeros((*cells, rows)),
        used=np.zeros(cells),
        left_out=np.zeros(cells),
    )
    for case in range(study.sizes["case"]):
        group = bins.group[case]
        number = bins.bin[case]
        cell = (group, number)
        is_event = bool(bins.events[number])
        is_known = np.isfinite(study.energy_mean.values[case]).all()
        if is_known and (is_event or study.orbits.values[case] > 0):
            counted.used[cell] += 1
            run = study.isel(case=case)
            _count_run(counted, cell, run, is_event)
        else:
            counted.left_out[cell] += 1
    return counted


def _count_run(counted: _Counted, cell: tuple[int, int], run: xr.Dataset, is_event: bool) -> None:
    """Add the orbits of one run, and the time that they took."""
    dims = ("row", "roller", "orbit")
    energies = run.orbit_energy.sum("interface", skipna=False)
    energy = energies.transpose(*dims).values
    powers = run.peak_power.max("interface", skipna=False)
    power = powers.transpose(*dims).values
    length = (run.orbit_end - run.orbit_start).values
    for row, present in enumerate(np.isfinite(energy)):
        number = present.sum()
        cell_of_row = (*cell, row)
        for above, values in zip(counted.above, (energy, power), strict=True):
            ordered = np.sort(values[row][present])
            not_above = np.searchsorted(ordered, THRESHOLDS, side="right")
            above[cell_of_row] += number - not_above
        counted.orbits[cell_of_row] += number
        if is_event:
            # It has all of its record for the orbits that it completes, which may be none.
            most_orbits = max(present.any(axis=-1).sum(), 1)
            seconds = float(run.window_length) * most_orbits
        else:
            lengths = np.broadcast_to(length, present.shape)
            seconds = lengths[present].sum()
        counted.seconds[cell_of_row] += seconds


def load_spectrum(study: xr.Dataset, aggregation: Aggregation) -> xr.Dataset:
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
    years = aggregation.years
    bins = aggregation.bins(study)
    lengths = study.loads_length.values
    rates = []
    for case, length in enumerate(lengths):
        cycles_of_run = study.load_cycles.isel(case=case).values
        rates.append(cycles_of_run / length)
    mean_rates, _, _ = bins.means(rates)
    probabilities = bins.probabilities(aggregation.weights)
    cycles = years * YEAR * weighted(mean_rates, probabilities)
    is_counted = np.nan_to_num(cycles).any(axis=(0, 1))
    kept = _span(is_counted)
    return xr.Dataset(
        LOAD_SPECTRUM.put({"cycles": cycles[..., kept]}),
        bins.coordinates(study, bins=False)
        | {"component": study.component, "load_range": study.load_range[kept]},
        {"title": f"Load cycles: {study.attrs.get('title', '')}", "years": years},
    )


def _span(some: np.ndarray) -> slice:
    indices = np.flatnonzero(some).tolist()
    if not indices:
        return slice(0, 1)
    first = max(indices[0] - 1, 0)
    end = indices[-1] + 2
    return slice(first, end)
