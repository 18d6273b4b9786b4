"""What leaving the details of contacts out changes: their variables, and nothing else."""

from dataclasses import replace

import pytest
import xarray as xr

from macroslip import BackwardEuler, Case, HubLoads, InputError, Laws, Traces, simulate
from macroslip.result import heat_balance
from macroslip.result.surface_maps import energy_density
from macroslip.result.variables import CONTACT_DETAILS
from macroslip.study.settings import template
from tests.quick import COARSE

LOADS = HubLoads.bundled("14B").window(30.0, 42.0)
CASE = Case(loads=LOADS, laws=Laws.physical(), rollers=[7], traces=Traces(step=0.5))


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"integrator": BackwardEuler(step=2e-3), "loads": LOADS.window(30.0, 31.0)},
        pytest.param(
            {"dynamics": "whole-bearing", "loads": LOADS.window(30.0, 31.0)}, marks=pytest.mark.slow
        ),
    ],
    ids=["radau", "backward-euler", "whole-bearing"],
)
def test_everything_else_is_the_same_to_the_last_bit(changes):
    case = replace(CASE, **changes)
    full, lean = simulate(case), simulate(replace(case, contact_details=False))
    assert set(full.data_vars) - set(lean.data_vars) == set(CONTACT_DETAILS)
    assert set(lean.data_vars) < set(full.data_vars)
    xr.testing.assert_equal(
        full.drop_vars([*CONTACT_DETAILS, *(set(full.coords) - set(lean.coords))]), lean
    )
    assert not {"station", "angle", "cell_area"} & {*lean.coords, *lean.dims}


def test_without_maps_the_message_names_the_key():
    with pytest.raises(InputError, match="contact_details: true"):
        energy_density(simulate(replace(CASE, contact_details=False)))


def test_simulations_that_look_for_a_temperature_leave_them_out(monkeypatch):
    seen = []

    def power(result):
        seen.append(set(result.data_vars))
        return 600.0

    monkeypatch.setattr(heat_balance, "bearing_friction_power", power)
    heat = {"temperature": "balance", "heat": {"conductance": "60 W/K", "ambient": "15 degC"}}
    coarse = {"integrator": {"tolerance": COARSE.tolerance}}
    case, _ = template({"laws": {"model": "physical"}, "rollers": [7], **coarse, **heat}, [], {})
    balanced = heat_balance.case_at_balance(replace(case, loads=LOADS.window(30.0, 31.0)), simulate)
    assert balanced.contact_details and seen
    assert all(names.isdisjoint(CONTACT_DETAILS) and "mechanism_energy" in names for names in seen)


@pytest.mark.parametrize(
    ("asked", "keep", "recorded"),
    [
        (True, None, True),
        (True, ["energy", "flash_temperature"], True),
        (True, ["energy"], False),
        (True, [], False),
        (False, None, False),
        (False, ["flash_temperature"], False),
    ],
)
def test_a_study_records_them_where_it_keeps_some(asked, keep, recorded):
    case, _ = template({"laws": {"model": "physical"}, "contact_details": asked}, [], {}, keep=keep)
    assert case.contact_details is recorded
