"""Studies of the reproduction run like any other: they resume, and what fails is a result or an error."""

import pytest

from macroslip import InputError, Laws, MacroslipError
from macroslip.reproduction.model_run import DETAILED_CASE, MODELS
from macroslip.reproduction.paper_study import paper_study
from macroslip.reproduction.studies import base_case, computed, reproduction_study

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("model", MODELS)
@pytest.mark.parametrize("stage", ["study", "detail", "sensitivity"])
def test_every_study_has_the_laws_of_its_model(stage, model):
    assert base_case(reproduction_study(f"{stage}_{model}")).laws == MODELS[model]


def test_the_sample_is_of_the_physical_model_and_shorter_loads():
    study = reproduction_study("uncertainty_physical")
    case = base_case(study)
    assert (case.laws, float(case.loads.time[-1]), case.roller_numbers) == (Laws.physical(), 100.0, (0,))
    assert len(study) == 2 * 129


def test_the_detailed_case_is_one_of_the_study():
    (load,) = reproduction_study("detail_paper").loads.loads
    assert load.name == DETAILED_CASE
    assert load.name in [one.name for one in reproduction_study("study_paper").loads.loads]


def test_a_second_run_computes_nothing(small, tmp_path):
    made = small("study_paper", bundled=["14A", "14B"], rollers=[0], window={"end": "20 s"})
    calls = []
    assert computed(made, tmp_path / "out", progress=lambda *call: calls.append(call))
    assert calls == [(1, 2), (2, 2)]
    assert not computed(made, tmp_path / "out")


def test_what_fails_is_an_error_unless_it_may(small, tmp_path):
    made = small("sensitivity_paper", rollers=[0], window={"end": "16 s"})
    with pytest.raises(MacroslipError, match="1 cases of 'Sensitivity of case 14B' failed, case 14B first: .*ellipse"):
        computed(made, tmp_path / "out")
    assert not computed(made, tmp_path / "out", may_fail=True), "the others were computed before"


def test_a_window_without_an_orbit_is_refused(small, tmp_path):
    computed(
        small("study_paper", bundled=["14B"], rollers=[0], window={"start": "1 s", "end": "2 s"}), tmp_path / "out"
    )
    with pytest.raises(InputError, match="no complete orbit"):
        paper_study(tmp_path / "out")
