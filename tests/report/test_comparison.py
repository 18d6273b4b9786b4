"""Results and designs side by side: differences, ranges and rankings against numbers by hand."""

import json

import numpy as np
import pytest
import xarray as xr

from macroslip import InputError, compare
from macroslip.constants import YEAR
from macroslip.report import bearing_figures
from macroslip.report.comparison import ENERGY, compare_results
from macroslip.report.comparison_page import comparison_page
from macroslip.study.summary import CASE_VARIABLES, ROW_VARIABLES

SECONDS = 360.0


def result(power=1.0, noise=0.0, *, osculation=0.97, sha="x", model="paper", seed=1):
    """A result of one hour's tenth: 20 orbits of 18 s, `power` [W] a roller and row, with noise from orbit to orbit."""
    edges = np.linspace(0.0, SECONDS, 21)
    wind = 0.3 * np.sin(np.arange(20.0))  # in common to all results
    orbits = 18.0 * (power * (1.0 + wind) + noise * np.random.default_rng(seed).standard_normal(20))
    orbits += 18.0 * power - orbits.mean()
    shape = np.broadcast_to(orbits[None, None, :, None] / 3.0, (2, 2, 20, 3)).copy()
    given = {
        "loads": {"sha256": sha},
        "laws": {"model": model},
        "bearing": {
            "osculation": {"value": osculation, "unit": "1", "tag": "E"},
            "diametral_clearance": {"value": 10.0 * osculation, "unit": "mm", "tag": "E"},
        },
    }
    return xr.Dataset(
        {
            "energy": (("row", "roller", "interface"), shape.sum(axis=2)),
            "orbit_energy": (("row", "roller", "orbit", "interface"), shape),
            "peak_power": (("row", "roller", "orbit", "interface"), shape),
            "window_peak_power": (("row", "roller", "interface"), shape.max(axis=2)),
            "min_spin_ratio": (("row", "roller"), np.full((2, 2), 0.9)),
            "status": (("row", "roller"), np.zeros((2, 2), dtype=np.int8)),
        },
        {
            "row": ["downwind", "upwind"], "roller": [0, 14], "interface": ["inner", "outer", "cage"],
            "orbit_start": ("orbit", edges[:-1]), "orbit_end": ("orbit", edges[1:]),
        },
        {"window_start": 0.0, "window_end": SECONDS, "input": json.dumps(given)},
    )  # fmt: skip


def energies(comparison):
    return comparison[comparison.quantity == ENERGY].reset_index(drop=True)


def test_values_and_differences_are_those_by_hand():
    energy = energies(compare(result(1.0), result(1.1, osculation=0.98)))
    # Two rows of 1 W each, by the hour.
    np.testing.assert_allclose(energy.value, [7200.0, 7920.0], rtol=1e-12)
    np.testing.assert_allclose(energy["difference [%]"], [np.nan, 10.0], rtol=1e-9)


def test_the_wind_in_common_does_not_widen_the_range():
    """The wind changes power by 20 % from orbit to orbit; the difference of 10 % scales with it and is surer."""
    energy = energies(compare(result(1.0), result(1.1, osculation=0.98)))
    half = energy["high [%]"][1] - energy["difference [%]"][1]
    assert 0.0 < half < 2.5
    assert (
        "From result 1 to result 2 the energy changes by +10 %"
        in compare(result(1.0), result(1.1, osculation=0.98)).attrs["ranking"]
    )


def test_the_range_holds_the_true_difference_in_95_of_100_cases():
    held = 0
    for seed in range(100):
        rng = np.random.default_rng(seed)
        base, other = result(1.0), result(1.0, osculation=0.98)
        true = 0.02
        orbits = (
            other.orbit_energy * (1.0 + true)
            + 18.0 / 3.0 * 0.2 * rng.standard_normal(20)[None, None, :, None]
        )
        other = other.assign(
            orbit_energy=orbits, energy=orbits.sum("orbit").transpose("row", "roller", "interface")
        )
        energy = energies(compare(base, other))
        held += energy["low [%]"][1] <= 100.0 * true <= energy["high [%]"][1]
    assert 88 <= held <= 100


def test_a_difference_within_its_scatter_is_not_told_apart():
    comparison = compare(result(1.0), result(1.001, noise=0.5, osculation=0.98))
    assert (
        "is smaller than its scatter of" in comparison.attrs["ranking"]
        and "cannot be distinguished" in comparison.attrs["ranking"]
    )


def test_inputs_that_differ_and_what_restricts_the_comparison():
    comparison = compare(result(), result(1.1, osculation=0.98, model="physical"))
    assert comparison.attrs["inputs"]["bearing.osculation"] == {"result 1": 0.97, "result 2": 0.98}
    assert comparison.attrs["inputs"]["bearing.diametral_clearance"]["result 1"] == "9.7 mm"
    notes = " ".join(comparison.attrs["notes"])
    assert (
        "different models of the contacts" in notes
        and "2 of 2 values" in notes
        and "different loads" not in notes
    )
    other = compare(result(), result(1.1, sha="y"))
    assert "different loads" in other.attrs["notes"][0] and np.isnan(energies(other)["low [%]"][1])
    same = compare(result(), result())
    assert same.attrs["notes"] == [
        "The results differ in nothing: they were computed from the same input."
    ]
    assert same.attrs["ranking"] == "All dissipate the same energy."


def test_where_the_best_by_energy_is_not_the_best_is_said():
    less = result(1.0, osculation=0.98)
    less["window_peak_power"] = 2.0 * less.window_peak_power
    less["min_spin_ratio"] = less.min_spin_ratio.where(less.row != "upwind", 0.5)
    ranking = compare(result(1.1), less).attrs["ranking"]
    assert ranking.endswith(
        "Others are more than 5 % better than result 2 in: largest power, downwind (result 1); "
        "largest power, upwind (result 1); lowest spin over pure rolling, upwind (result 1)."
    )
    assert "Others" not in compare(result(1.1), result(1.0, osculation=0.98)).attrs["ranking"]


def test_three_results_are_ranked():
    ranking = compare(
        result(2.0), result(1.0, osculation=0.98), result(3.0, osculation=0.99)
    ).attrs["ranking"]
    assert ranking.startswith("result 2 dissipates least, 7200 J/h")
    assert ranking.index("result 1 100 % more") < ranking.index("result 3 200 % more")


def test_a_bearing_at_standstill_is_compared_without_a_difference_in_per_cent():
    still = result(0.0)
    for pair in ((still, result(osculation=0.98)), (result(osculation=0.98), still)):
        comparison = compare(*pair)
        least = 1 + (pair[1] is still)
        assert comparison.attrs["ranking"].startswith(
            f"result {least} dissipates least, 0 J/h ({ENERGY}); result {3 - least} 7200 J/h."
        )
    # From nothing to something there is no per cent, from something to nothing it is all of it.
    assert np.isnan(energies(compare(still, result()))["difference [%]"][1])
    assert energies(compare(result(), still))["difference [%]"][1] == -100.0


def test_a_failed_roller_leaves_its_result_out_of_the_ranking():
    failed = result(1.1, osculation=0.98)
    failed["energy"][0, 0] = np.nan
    failed["status"][0, 0] = 1
    comparison = compare(result(), failed)
    assert "cannot be ranked" in comparison.attrs[
        "ranking"
    ] and "Rollers failed in result 2" in " ".join(comparison.attrs["notes"])


def study(better=0.8):
    """Two bearings under the same three winds; the second dissipates `better` times as much."""
    power = np.array([1.0, 1.4, 2.0])
    both = 600.0 * np.concatenate([power, better * power])
    labels = {name: ("case", ["x"] * 6) for name in ("lubricant", "model")}
    labels |= {"bearing": ("case", ["A"] * 3 + ["B"] * 3), "loads": ("case", ["a", "b", "c"] * 2)}
    labels["wind_speed"] = ("case", [12.0, 12.0, 14.0] * 2, {"units": "m/s"})
    data = {name: (("case", "row"), np.stack([both, both], axis=1)) for name in ROW_VARIABLES}
    data |= {name: ("case", np.full(6, 600.0)) for name in CASE_VARIABLES}
    return xr.Dataset(data, labels | {"row": ["downwind", "upwind"]})


def test_designs_of_a_study_are_compared_over_a_year():
    comparison = compare(study(), by="bearing")
    rows = energies(comparison)
    assert rows.design.tolist() == ["A", "B"] and rows["difference [%]"][1] == pytest.approx(
        -20.0, rel=1e-9
    )
    # All designs saw the same winds: of their scatter only that of the difference is left, a fifth of it.
    assert rows["high [%]"][1] - rows["low [%]"][1] > 0.0
    assert comparison.attrs["ranking"].startswith("B dissipates least")
    assert comparison.attrs["notes"][0].startswith(
        "The study has no weights: all its cases count alike"
    )
    # Without weights a year is the mean of the cases: 4.4/3 W of either row.
    assert rows.value[0] == pytest.approx(2.0 * 4.4 / 3.0 * YEAR, rel=1e-12)


def test_a_key_of_a_case_without_a_dot_distinguishes_designs():
    labels = {"oil_supply": ("case", np.repeat(np.array(["0.5", "flooded"], dtype=object), 3))}
    labelled = study().assign_coords(labels).assign_coords(bearing=("case", ["A"] * 6))
    labelled.attrs["study"] = json.dumps(
        {"variations": {"list": [{"oil_supply": 0.5}, {"oil_supply": "flooded"}]}}
    )
    assert energies(compare(labelled)).design.tolist() == ["oil supply 0.5", "oil supply flooded"]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: compare(result()), "one result only"),
        (lambda: compare(result(), study()), "a study is compared with something else"),
        (lambda: compare(result(), result(), by="bearing"), "results that are no study"),
        (lambda: compare(study(), by="mount"), "no label 'mount'.*bearing"),
        (lambda: compare(study(), by="lubricant"), "one lubricant only.*bearing"),
        (lambda: compare(study().isel(case=slice(3))), "differ in nothing"),
    ],
)
def test_what_cannot_be_compared(call, message):
    with pytest.raises(InputError, match=message):
        call()


def with_maps(dataset, places):
    """The result with maps of 1 J a cell of 1 mm² but for the first; 2 rollers leave it in 360 s, so 5 J/mm² an hour each."""
    energy = np.ones((2, 2, 4, 3, 1, 1))
    energy[0, 0, 0, 0] = places
    over = ("row", "raceway", "angle", "station", "slip_sign", "film_regime")
    area = (("row", "raceway", "station"), np.full((2, 2, 3), 1e-6))
    around = {
        "angle": [0.5, 2.0, 3.5, 5.0],
        "station": [-0.01, 0.0, 0.01],
        "raceway": ["inner", "outer"],
        "cell_area": area,
    }
    return dataset.assign(surface_energy=(over, energy)).assign_coords(around)


def test_maps_have_one_scale_and_their_difference_another(monkeypatch):
    drawn, draw = [], bearing_figures.plot_map
    monkeypatch.setattr(
        bearing_figures, "plot_map", lambda axes, *_, **more: drawn.append(draw(axes, *_, **more))
    )
    results = {"a": with_maps(result(), 2.0), "b": with_maps(result(1.1, osculation=0.98), 8.0)}
    page = comparison_page(compare_results(results), results)
    images = {axes.get_title(loc="left"): axes.images[0] for axes in drawn}
    assert len(images) == 12 and page.count("<img") == 14
    assert {image.get_clim() for name, image in images.items() if "−" not in name} == {(0.0, 40.0)}
    less = {name: image for name, image in images.items() if name.endswith("\nb − a")}
    assert {image.get_clim() for image in less.values()} == {(-30.0, 30.0)}
    whole = {name: np.abs(image.get_array()).sum() for name, image in less.items()}
    assert whole.pop("downwind row, inner raceway\nb − a") == pytest.approx(30.0) and not any(
        whole.values()
    )


def test_pages():
    results = {"a <b>": result(), "c": result(1.1, osculation=0.98)}
    page = comparison_page(compare_results(results), results)
    assert "a &lt;b&gt;" in page and "a <b>" not in page and page.count("<img") == 2
    assert "+10" in page and "bearing.osculation" in page
    assert "B dissipates least" in comparison_page(compare(study(), by="bearing"))
