"""Progress: what it says of rate and time left, by a clock of our own."""

import pytest

from macroslip.study import progress as module
from macroslip.study.progress import Progress


@pytest.fixture
def clock(monkeypatch):
    """A clock that goes on where it is shown to."""

    class Clock:
        now = 1000.0

        def __call__(self):
            return self.now

    clock = Clock()
    monkeypatch.setattr(module.time, "monotonic", clock)
    return clock


def run(progress, clock, seconds, rate, step=0.5):
    """Let runs be done at a rate for some seconds."""
    before, start = progress.computed, clock.now
    while clock.now < start + seconds:
        clock.now += step
        progress.computed = before + round(rate * (clock.now - start))
        progress.mark()


def test_before_the_first_run_nothing_is_foreseen(clock):
    progress = Progress(10, started=clock.now)
    clock.now += 5.0
    assert (progress.rate, progress.time_left) == (0.0, None)
    assert progress.short == "0 of 10, 0 failed, 0 a second, - left"


def test_at_a_steady_rate_the_time_left_is_what_it_takes(clock):
    progress = Progress(1000, started=clock.now)
    run(progress, clock, 100.0, 4.0)
    assert progress.rate == pytest.approx(4.0, rel=1e-3) and progress.time_left == pytest.approx(150.0, rel=1e-3)
    assert "2 min 30 s left" in progress.line and "400 computed" in progress.line
    run(progress, clock, 150.0, 4.0)
    assert progress.time_left == 0.0 and progress.line.endswith("4 a second, nothing left")


def test_workers_that_come_are_seen_within_ten_minutes(clock):
    progress = Progress(10**6, started=clock.now)
    run(progress, clock, 3600.0, 1.0)
    run(progress, clock, 300.0, 9.0)
    assert progress.rate == pytest.approx(5.0, rel=0.01)  # half of the ten minutes
    run(progress, clock, 300.0, 9.0)
    assert progress.rate == pytest.approx(9.0, rel=0.01)
    assert len(progress._marks) <= 602  # one a second, of the last ten minutes


def test_runs_that_are_there_already_tell_nothing_of_the_rest(clock):
    progress = Progress(3000, started=clock.now)
    progress.unchanged = 1500
    clock.now += 4.0
    progress.mark()
    assert (progress.done, progress.time_left) == (1500, None)
    run(progress, clock, 60.0, 1.0)
    assert progress.time_left == pytest.approx(1440.0, rel=0.1)


def test_failures_count_as_work(clock):
    progress = Progress(40, started=clock.now)
    progress.unchanged, progress.failed = 20, 4
    clock.now += 8.0
    progress.mark()
    assert (progress.done, progress.rate, progress.time_left) == (24, 0.5, 32.0)
    assert progress.short == "24 of 40, 4 failed, 0.5 a second, 32 s left"
