"""Whole runs by tables: their forces against the laws themselves, what a result says of them, and states beyond them."""

from dataclasses import replace

import numpy as np
import pytest

from macroslip import (
    BearingLoads,
    Case,
    HubLoads,
    InputError,
    Laws,
    Radau,
    Traces,
    read_case,
    simulate,
)
from macroslip.contact.table import tractions
from macroslip.imposed.status import Status
from macroslip.result import prepared
from macroslip.result import simulate as runs
from macroslip.result.orbit import position
from macroslip.result.run_input import run_input
from tests.quick import COARSE

pytestmark = pytest.mark.slow

LAWS = {
    "physical": Laws.physical().but(rolling="none"),
    "limiting shear": Laws.physical().but(rolling="none", rheology="limiting-shear"),
    "without microslip": Laws.physical().but(rolling="none", microslip=False),
}


@pytest.fixture(scope="module", params=LAWS)
def traced(request):
    loads = HubLoads.bundled("14B").window(30.0, 45.0)
    return simulate(
        Case(loads=loads, laws=LAWS[request.param], rollers=[7], traces=Traces(step=0.01))
    )


def test_a_result_tells_the_errors_of_its_tables(traced):
    attributes = traced.attrs
    assert (
        attributes["contact_evaluation"] == "tables" and (traced.status == Status.COMPLETED).all()
    )
    # The largest is that of rollers under a few newtons whose slip exceeds the ring's speed.
    assert 0.0 < attributes["table_error_typical"] <= 1e-5 < attributes["table_error_worst"] < 1.0
    assert attributes["table_size"] > 1e5


def raceway_loads(model, row, angle):
    """Normal loads at inner and outer raceway with weight and centrifugal force."""
    orbital = row.spin_pure.values * model.radius / model.outer_radius
    height = -np.cos(np.radians(angle))  # sine of the position φ
    outward = (
        model.centrifugal * orbital**2 - model.weight_in_plane * height
    ) * model.cos_contact_angle
    outward = outward + model.weight_along_axis * model.sin_contact_angle
    load = row.roller_load.values
    return np.stack([load + np.maximum(-outward, 0.0), load + np.maximum(outward, 0.0)], axis=-1)


def test_traction_all_the_way_round_is_that_of_the_laws(traced):
    """At every sample of the traces, by the laws' values and the sum over the patch; without rolling resistance."""
    models, angle = run_input(traced).models, position(traced).values
    for r, row in enumerate(traced.row.values.tolist()):
        model, of_row = models[row], traced.isel(row=r)
        loads, slip = raceway_loads(model, of_row, angle[r])[0], of_row.slip.values[0]
        ring_speed = of_row.spin_pure.values[0] * model.radius
        for i, ring in enumerate(("inner", "outer")):
            traction, load = of_row.traction.sel(interface=ring).values[0], loads[..., i]
            pressed = load > 0.0
            pull, lag, _, _ = tractions(
                getattr(model.laws, ring), load[pressed], ring_speed[pressed], slip[pressed]
            )
            wanted = pull - lag
            off = np.abs(np.abs(traction[pressed]) - np.abs(wanted))
            assert (traction[~pressed] == 0.0).all()
            assert np.median(off / np.maximum(np.abs(wanted), 1e-3)) < 1e-4, (row, ring)
            assert (off <= 2e-3 * np.abs(wanted) + 1e-6 * load[pressed] + 1e-3).all(), (row, ring)


def test_finer_tables_change_nothing_that_is_promised(monkeypatch):
    """Energies to 2e-4, peaks to 2e-3 and spin to 2e-4 of pure rolling, against tables with half the distances."""
    case = Case(loads=HubLoads.bundled("14B").window(30.0, 60.0), laws=Laws.physical(), rollers=[7])
    result = simulate(case)
    table_box = prepared.table_box
    monkeypatch.setattr(
        prepared, "table_box", lambda *given: table_box(*given)._replace(fineness=0.5)
    )
    fine = simulate(case)
    assert fine.attrs["table_size"] > 3 * result.attrs["table_size"]
    assert (result.status == Status.COMPLETED).all() and (fine.status == Status.COMPLETED).all()
    for name, most in (("energy", 5e-5), ("orbit_energy", 2e-4), ("rolling_energy", 5e-5)):
        total = result[name].sum("interface") / fine[name].sum("interface") - 1.0
        assert float(abs(total).max()) < most, name
    peak = result.peak_power.max("interface") / fine.peak_power.max("interface") - 1.0
    assert float(abs(peak).max()) < 2e-3
    for name in ("mechanism_energy", "asperity_energy", "station_energy"):
        scale = float(fine[name].sel(row="downwind").max())
        assert float(abs(result[name] - fine[name]).sel(row="downwind").max()) < 2e-4 * scale, name
    # Spin is good to 1e-4 of pure rolling at the default tolerance in either run, whose steps are not the same.
    np.testing.assert_allclose(result.min_spin_ratio, fine.min_spin_ratio, rtol=0.0, atol=2e-4)


@pytest.mark.parametrize("model", [Laws.paper(), Laws.physical()], ids=["paper", "physical"])
def test_a_shaft_that_turns_round(model):
    """Through standstill and back: energies hold at a tighter tolerance, with finer tables.

    Inlets are flooded: `skf` has a gap of 0.3 mm here, which is as good as full, and takes tables of two gaps.
    """
    time = np.array([0.0, 6.0, 12.0])
    loads = BearingLoads(
        time, np.array([1.5, -1.5, -1.0]), np.tile([0.0, -2e5, 1e5], (3, 1)), "made"
    )
    case = Case(loads=loads, laws=model, rollers=[0], oil_supply="flooded")
    result, exact = simulate(case), simulate(replace(case, integrator=Radau(tolerance=1e-5)))
    assert (result.status == Status.COMPLETED).all() and (exact.status == Status.COMPLETED).all()
    total = result.energy.sum("interface") / exact.energy.sum("interface") - 1.0
    assert float(abs(total).max()) < 1e-3


@pytest.mark.parametrize("dynamics", ["imposed-orbit", "whole-bearing"])
def test_a_state_beyond_the_tables_makes_them_larger(monkeypatch, dynamics):
    case = Case(
        loads=BearingLoads.constant([0.0, -300e3, 50e3], 2.1, 1.0),
        laws=Laws.physical(),
        rollers=[0],
        integrator=COARSE,
    )
    case = replace(case, dynamics=dynamics)
    wanted = simulate(case)
    table_box = prepared.table_box
    monkeypatch.setattr(
        prepared, "table_box", lambda *given: table_box(*given)._replace(load=16384.0)
    )
    result = simulate(case)
    assert (wanted.status == Status.COMPLETED).all() and (result.status == Status.COMPLETED).all()
    total = result.energy.sum("interface") / wanted.energy.sum("interface") - 1.0
    assert float(abs(total).max()) < 1e-3
    monkeypatch.setattr(runs, "_ENLARGED", 0)
    failed = simulate(case).sel(row="downwind")
    assert (failed.status == Status.OUTSIDE_TABLES).all() and failed.energy.isnull().all()


def test_tables_are_no_choice_of_a_case(tmp_path):
    path = tmp_path / "case.yaml"
    path.write_text("loads: {bundled: 14B}\nintegrator: {tables: false}\n")
    with pytest.raises(
        InputError, match=r"line 2: the key .tables. inside integrator is unknown.*Remove it"
    ):
        read_case(path)
