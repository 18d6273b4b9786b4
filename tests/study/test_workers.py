"""Workers: real processes and real Dask schedulers, killed, joining late, and started from scripts as users write them."""

import asyncio
import contextlib
import json
import signal
import socket
import subprocess
import sys
import threading
import time

import numpy as np
import psutil
import pytest

from macroslip import InputError, MacroslipError, open_study, run_study
from macroslip.storage.waiting import TABLES, heard_by
from macroslip.study import workers as module
from macroslip.study.study_file import study_of

pytestmark = pytest.mark.slow


@pytest.fixture
def slow_content(long_content):
    """Twenty runs that take a tenth of a second each."""
    return few(long_content, 20) | {
        "case": {"laws": {"model": "paper"}, "rollers": [0, 7], "loads": {"end": "150 s"}}
    }


def few(content, count):
    """The first runs of a study over tilts."""
    tilt = content["variations"]["grid"]["drivetrain.tilt"]
    tilts = tilt | {"values": tilt["values"][:count]}
    return content | {"variations": {"grid": {"drivetrain.tilt": tilts}}}


def workers_of(process):
    """The worker processes of a study, those that started first in front."""
    workers = []
    for child in psutil.Process(process.pid).children(recursive=True):
        try:
            if "spawn_main" in " ".join(child.cmdline()) and child.status() != psutil.STATUS_ZOMBIE:
                workers.append(child)
        except psutil.NoSuchProcess:
            continue
    return sorted(workers, key=lambda child: child.create_time())


def kill_a_worker(process):
    """End the oldest worker, and say whether there was one: a pool that is just replaced has none."""
    for worker in workers_of(process):
        with contextlib.suppress(psutil.NoSuchProcess):
            worker.kill()
            return True
    return False


def report_of(process):
    """The number of results that a study says next it has."""
    line = process.stdout.readline()
    assert line, process.stderr.read()
    return int(line.split()[0])


def runs(process):
    with contextlib.suppress(psutil.NoSuchProcess):
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    return False


def test_processes_find_what_this_process_finds_and_listen_to_nobody(tmp_path, long_content):
    seen, count = set(), []

    def look(progress):
        family = [psutil.Process(), *psutil.Process().children(recursive=True)]
        seen.update(
            connection.laddr
            for member in family
            for connection in member.net_connections("inet")
            if connection.status == "LISTEN"
        )
        count.append(len(workers_of(psutil.Process())))

    study = study_of(few(long_content, 12), tmp_path)
    ended = run_study(study, tmp_path / "out", workers=2, progress=look)
    assert (ended.progress.computed, ended.progress.failed) == (12, 0)
    assert seen == set() and max(count) == 2 and workers_of(psutil.Process()) == []
    run_study(study, tmp_path / "alone", threads=1)
    several, alone = open_study(tmp_path / "out"), open_study(tmp_path / "alone")
    assert list(several.key.values) == list(alone.key.values)
    for name in ("energy", "peak_power", "energy_mean", "end_slip"):
        np.testing.assert_array_equal(several[name].values, alone[name].values)


@pytest.mark.parametrize(
    ("rounds", "kills", "runs_in_all"), [(1, 4, 36), (3, 4, 120)], ids=["five", "fifteen"]
)
def test_kills_lose_nothing(
    rounds, kills, runs_in_all, tmp_path, begin, slow_content, wait_for, done, rows, identities,
    counted, resumed,
):  # fmt: skip
    """In each round some worker processes and then the study itself; what was reported is there once, and stays as it was."""
    values = [round(2.0 + 0.05 * number, 2) for number in range(runs_in_all)]
    content = slow_content | {
        "variations": {"grid": {"drivetrain.tilt": {"values": values, "unit": "deg"}}}
    }
    out, before = tmp_path / "out", {}
    for _ in range(rounds):
        process = begin(content, out, resume=True, workers=2)
        for _ in range(kills):
            reported = report_of(process)
            wait_for(lambda process=process: kill_a_worker(process))
        reported = max(reported, report_of(process))
        left = workers_of(process)
        process.kill()
        process.wait()
        wait_for(lambda left=left: not any(map(runs, left)))
        keys = done(out)  # compares every checksum
        assert reported <= len(keys) < runs_in_all
        after = identities(out)
        assert all(after[name] == identity for name, identity in before.items())
        before = {f"{key}.nc": after[f"{key}.nc"] for key in keys}
    ended, simulated = resumed(study_of(content, tmp_path), out, counted)
    assert (simulated, ended.progress.unchanged) == (runs_in_all - len(keys), len(keys))
    assert (ended.progress.failed, rows(out, "SELECT count(*), count(DISTINCT key) FROM runs")) == (
        0,
        [(runs_in_all, runs_in_all)],
    )
    assert (out / "log.txt").read_text().count(
        "a worker process has died; another takes over"
    ) >= rounds * kills // 2
    assert all(identities(out)[name] == identity for name, identity in before.items())


def test_processes_killed_as_they_start_are_no_missing_main_guard():
    """Forty processes, each killed within milliseconds of its start, while the pool's own thread waits for them too."""
    notes, ended = [], threading.Event()

    def kill():
        while not ended.is_set():
            kill_a_worker(psutil.Process())

    killer = threading.Thread(target=kill, daemon=True)
    with module.Processes(1, notes.append) as pool:
        killer.start()
        try:
            for number in range(10):
                task = {"run": f"{number}"}
                pool.submit([task])
                assert [(run["run"], str(outcome["outcome"])) for run, outcome in pool.wait()] == [
                    (f"{number}", "failed")
                ]
        finally:
            ended.set()
            killer.join()
    assert len(notes) >= 40


def test_a_run_that_kills_its_workers_is_recorded_and_the_others_computed(
    tmp_path, load_files, content, monkeypatch
):
    """A worker that ends where it would store a certain result stands for one that the system ends for its memory."""
    run_study(study_of(content, load_files), tmp_path / "before")
    key = str(open_study(tmp_path / "before").key.values[2])
    site = tmp_path / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text(
        "import os, sys\n"
        "def hook(event, arguments):\n"
        # A file under way has the beginning of its name.
        f"    if event == 'open' and '.{f'{key}.nc'[:40]}.' in str(arguments[0]): os._exit(1)\n"
        "sys.addaudithook(hook)\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(site))
    monkeypatch.setattr(module, "_DEATHS", 2)
    ended = run_study(study_of(content, load_files), tmp_path / "out", workers=2)
    assert (ended.progress.computed, ended.progress.failed) == (3, 1)
    assert (
        ended.failures[0][0]["loads"] == "runs/14mps_seed1.csv" and "died" in ended.failures[0][2]
    )


@pytest.mark.parametrize("guard", [True, False])
def test_a_script_needs_the_main_guard_and_is_told_so(tmp_path, load_files, content, guard):
    call = f"print(run_study(study_of({content!r}), 'out', workers=1).progress.computed)\n"
    script = "from macroslip import run_study\nfrom macroslip.study.study_file import study_of\n"
    script += "if __name__ == '__main__':\n    " + call if guard else call
    (tmp_path / "script.py").write_text(script)
    done = subprocess.run(
        [sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True
    )
    if guard:
        assert (done.stdout, done.stderr) == ("4\n", "")
        return
    assert done.returncode == 1 and done.stderr.count("Traceback") == 1
    assert done.stderr.splitlines()[-1].endswith('below the main guard, if __name__ == "__main__":')
    assert "multiprocessing" not in done.stderr and len(done.stderr.splitlines()) < 25


def test_no_worker_takes_modules_of_the_current_folder(tmp_path, load_files, content, monkeypatch):
    here = tmp_path / "here"
    here.mkdir()
    for name in ("multiprocessing", "numba", "struct", "pandas"):
        (here / f"{name}.py").write_text("open('taken', 'w').close()\nraise SystemExit(3)\n")
    monkeypatch.chdir(here)
    monkeypatch.setattr(sys, "path", ["", *sys.path])
    assert (
        run_study(study_of(content, load_files), tmp_path / "out", workers=1).progress.computed == 4
    )
    assert not (here / "taken").exists()


def test_an_interrupt_ends_processes_at_once(tmp_path):
    slow = {
        "case": {
            "rollers": "all",
            "laws": {"model": "physical"},
            "integrator": {"tolerance": 1e-9, "max_steps": 10**9},
        },
        "loads": {"bundled": ["14B", "24A"]},
    }
    script = (
        "import signal\nfrom macroslip import run_study\nfrom macroslip.study.study_file import study_of\n"
        "if __name__ == '__main__':\n    signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        f"    run_study(study_of({slow!r}), 'out', workers=2)\n"
    )
    (tmp_path / "script.py").write_text(script)
    command = [sys.executable, "script.py"]
    with subprocess.Popen(
        command, cwd=tmp_path, stderr=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        try:
            end = time.monotonic() + 60.0
            while len(workers_of(process)) < 2 and time.monotonic() < end:
                time.sleep(0.05)
            time.sleep(2.0)
            workers = workers_of(process)
            spent = sum(psutil.Process(process.pid).cpu_times()[:2])
            process.send_signal(signal.SIGINT)
            started = time.monotonic()
            for worker in workers:
                worker.wait(timeout=10.0)
            error = process.communicate(timeout=10.0)[1]
            assert (
                time.monotonic() - started < 5.0 and spent < 60.0
            )  # the machine may be busy with other things
            assert (
                process.returncode != 0
                and error.count("Traceback") == 1
                and error.endswith("KeyboardInterrupt\n")
            )
        finally:
            process.kill()


@pytest.fixture
def dask(tmp_path):
    """Starts a scheduler, and workers by number, as a user does on the command line."""
    pytest.importorskip("distributed")
    processes = []

    def start(*arguments):
        with (tmp_path / f"dask{len(processes)}.log").open("w") as log:
            command = [sys.executable, "-m", *arguments, "--host", "127.0.0.1", "--no-dashboard"]
            processes.append(subprocess.Popen(command, stdout=log, stderr=log, cwd=tmp_path))
        return processes[-1]

    class Cluster:
        """Address of the scheduler, and what starts a worker."""

        scheduler = start(
            "distributed.cli.dask_scheduler", "--port", "0", "--scheduler-file", "scheduler.json"
        )

        @property
        def address(self):
            path, end = tmp_path / "scheduler.json", time.monotonic() + 60
            while not path.exists() or not path.read_text().endswith("}"):
                assert time.monotonic() < end
                time.sleep(0.05)
            return json.loads(path.read_text())["address"]

        def worker(self):
            return start(
                "distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny"
            )

    yield Cluster()
    for process in processes:
        process.kill()
        process.wait()


@pytest.fixture
def under_way(tmp_path, slow_content):
    """A study in a thread of this process, with what it reports."""

    class UnderWay:
        out, done, ended, error = tmp_path / "out", 0, None, None

        def start(self, address):
            self.thread = threading.Thread(target=self._run, args=(address,), daemon=True)
            self.thread.start()

        def _run(self, address):
            try:
                study = study_of(slow_content, tmp_path)
                self.ended = run_study(study, self.out, scheduler=address, progress=self._take)
            except BaseException as error:
                self.error = error

        def _take(self, progress):
            self.done = progress.done

        def join(self):
            self.thread.join(120)
            assert not self.thread.is_alive()

        @property
        def log(self):
            return (self.out / "log.txt").read_text()

    return UnderWay()


def test_a_worker_joins_late_and_another_is_killed(dask, under_way, wait_for, done, rows):
    under_way.start(dask.address)
    wait_for(
        lambda: (under_way.out / "log.txt").exists() and "no worker has joined yet" in under_way.log
    )
    first = dask.worker()
    wait_for(lambda: under_way.done >= 3)
    first.send_signal(signal.SIGSTOP)  # with what it has under way
    second = dask.worker()
    time.sleep(2.0)
    first.kill()
    wait_for(lambda: under_way.done >= 8 or under_way.error)
    under_way.join()
    assert under_way.error is None and (
        under_way.ended.progress.computed,
        under_way.ended.progress.failed,
    ) == (20, 0)
    assert second.poll() is None and len(done(under_way.out)) == 20
    assert "has joined" in under_way.log and "is gone; others take over" in under_way.log
    assert open_study(under_way.out).energy.notnull().all()


def test_a_scheduler_that_dies_loses_nothing(
    dask, under_way, wait_for, done, slow_content, tmp_path, counted, resumed
):
    dask.worker()
    under_way.start(dask.address)
    wait_for(lambda: under_way.done >= 3)
    reported = under_way.done
    dask.scheduler.kill()
    under_way.join()
    assert isinstance(under_way.error, MacroslipError) and "--resume" in str(under_way.error)
    keys = done(under_way.out)
    assert reported <= len(keys) < 20
    ended, simulated = resumed(study_of(slow_content, tmp_path), under_way.out, counted)
    assert (simulated, ended.progress.unchanged) == (20 - len(keys), len(keys))


def test_the_client_of_the_user_stays_theirs(dask, tmp_path, load_files, content):
    from distributed import Client, default_client

    dask.worker()
    with Client(dask.address) as mine:
        ended = run_study(study_of(content, load_files), tmp_path / "out", scheduler=dask.address)
        assert (
            ended.progress.computed == 4
            and default_client() is mine
            and mine.submit(sum, [1, 2]).result() == 3
        )
    with pytest.raises(ValueError, match="No client"):
        default_client()

    async def cell():  # a notebook has a running loop already
        module.look_for(dask.address)

    asyncio.run(cell())


def test_wrong_addresses_and_arguments(tmp_path, load_files, content, monkeypatch):
    pytest.importorskip("distributed")
    study = study_of(content, load_files)
    with pytest.raises(InputError, match="workers and scheduler are given together"):
        run_study(study, tmp_path / "out", workers=1, scheduler="tcp://127.0.0.1:1")
    with pytest.raises(
        InputError,
        match="no scheduler answers at 'nonsense://127.0.0.1:1' .*unknown address scheme",
    ):
        run_study(study, tmp_path / "out", scheduler="nonsense://127.0.0.1:1")
    with pytest.raises(InputError, match="missing port number"):
        run_study(study, tmp_path / "out", scheduler="localhost")
    monkeypatch.setattr(module, "_ANSWER", 1.0)
    with socket.socket() as deaf:
        deaf.bind(("127.0.0.1", 0))
        deaf.listen()
        address = f"tcp://127.0.0.1:{deaf.getsockname()[1]}"
        with pytest.raises(InputError, match=f"no scheduler answers at '{address}' .*1 s"):
            run_study(study, tmp_path / "out", scheduler=address)
    assert not (tmp_path / "out").exists()


def test_a_worker_tells_what_it_waits_for(tmp_path):
    case = {
        "laws": {"model": "physical"},
        "rollers": [0],
        "loads": {"end": "2 s"},
        "integrator": {"tolerance": 2e-3},
        # A temperature of which no table is kept.
        "temperature": f"{30.0 + time.time() % 10.0:.6f} degC",
    }
    heard = []
    with heard_by(lambda *told: heard.append(told)):
        run_study(study_of({"case": case, "loads": {"bundled": ["14B"]}}), tmp_path, workers=2)
    stages, done, total = zip(*heard, strict=True)
    assert TABLES in stages and all(0 < d <= t for d, t in zip(done, total, strict=True))
