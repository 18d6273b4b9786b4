"""Stages of both models side by side: their times, their order, and what ends them."""

import threading
from dataclasses import replace
from types import SimpleNamespace

import pytest

from paper import reproduce
from paper.reproduce import Lane, Stages, computed
from paper.studies import MODELS, PAPER


@pytest.fixture
def lane(tmp_path):
    """A lane whose models and experiments are to be replaced."""
    calls = []
    return Lane(tmp_path, 1, Stages(lambda *call: calls.append(call)), [], sampled=False), calls


@pytest.fixture
def drawn(monkeypatch):
    """Names of what is drawn, in its order, without drawing."""
    names = []

    def draw_all(jobs, folder, report):
        names.extend(jobs)
        report("figures", len(jobs), len(jobs))

    monkeypatch.setattr(reproduce, "draw_all", draw_all)
    monkeypatch.setattr(reproduce, "model_figures", lambda name, run: {f"of {name}": None})
    monkeypatch.setattr(reproduce, "experiment_figures", lambda made: {"of experiments": None})
    return names


def test_figures_of_the_paper_and_experiments_do_not_wait_for_the_other_model(
    lane, drawn, monkeypatch, tmp_path
):
    """The other model ends when they are there; one after the other it would wait for ever."""
    made = threading.Event()

    def model(self, name):
        self.stages.begin()
        if name != PAPER:
            assert made.wait(60.0)
        self.stages.report(f"study ({name})", 1, 1)
        return SimpleNamespace(name=name)

    def experiments(self):
        self.stages.begin()
        self.stages.report("experiments", 1, 1)
        made.set()
        return {"A1": 1}

    monkeypatch.setattr(Lane, "model", model)
    monkeypatch.setattr(Lane, "experiments", experiments)
    given, calls = lane
    runs, counts = computed(given, tmp_path)
    assert [runs[name].name for name in MODELS] == list(MODELS) == list(runs)
    assert counts == {"A1": 1} and drawn == [f"of {PAPER}", "of experiments"]
    stages = list(dict.fromkeys(stage for stage, _, _ in calls))
    assert stages == list(given.stages.seconds)
    assert min(given.stages.seconds.values()) >= 0.0


def test_a_fault_in_one_model_ends_the_other_at_its_next_report(lane, drawn, monkeypatch, tmp_path):
    ended = []

    def model(self, name):
        self.stages.begin()
        if name == PAPER:
            raise RuntimeError("out of paper")
        try:
            while True:
                self.stages.report("study", 0, 2)
        except BaseException as error:
            ended.append(type(error))
            raise

    monkeypatch.setattr(Lane, "model", model)
    given, _ = lane
    with pytest.raises(RuntimeError, match="out of paper"):
        computed(replace(given), tmp_path)
    assert ended == [reproduce._StoppedError] and drawn == []
