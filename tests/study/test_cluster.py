"""Workers: real schedulers and real worker processes on the loopback interface, killed and joining late."""

import asyncio
import os
import signal
import socket
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

pytest.importorskip("distributed")
psutil = pytest.importorskip("psutil")

from distributed import Client, default_client  # noqa: E402

from macroslip import InputError, MacroslipError, open_study, run_study  # noqa: E402
from macroslip.study import cluster as module  # noqa: E402
from macroslip.study.study_file import study_of  # noqa: E402

pytestmark = pytest.mark.slow


def listening(process):
    """Addresses and ports that a process and its children listen on."""
    family = [process, *process.children(recursive=True)]
    return {one.laddr for member in family for one in member.net_connections("inet") if one.status == "LISTEN"}


def default_clients():
    """What Dask would hand the work of this process to: the scheduler that is set, and the default client."""
    import dask

    try:
        return dask.config.get("scheduler", None), default_client()
    except ValueError:
        return dask.config.get("scheduler", None), None


@pytest.fixture
def slow_content(long_content):
    """Forty runs of some thirty milliseconds."""
    return long_content | {"case": {"rollers": [0, 7], "loads": {"end": "150 s"}}}


def test_workers_started_here_listen_on_the_loopback_only_and_find_what_one_process_finds(
    tmp_path, long_content, begin
):
    before = listening(psutil.Process())
    out, seen, workers = tmp_path / "out", set(), []

    def look(progress):
        me = psutil.Process()
        seen.update(listening(me))
        workers.append(len([child for child in me.children(recursive=True) if child.status() != "zombie"]))

    ended = run_study(study_of(long_content, tmp_path), out, workers=2, progress=look)
    assert (ended.progress.computed, ended.progress.failed) == (40, 0)
    assert {one.ip for one in seen - before} == {"127.0.0.1"} and max(workers) >= 2
    assert listening(psutil.Process()) == before
    run_study(study_of(long_content, tmp_path), tmp_path / "alone", threads=1)
    several, one = open_study(out), open_study(tmp_path / "alone")
    assert list(several.key.values) == list(one.key.values)
    for name in ("energy", "peak_power", "energy_mean", "end_slip"):
        np.testing.assert_array_equal(several[name].values, one[name].values)


def test_workers_end_with_the_study_that_started_them(tmp_path, begin, slow_content, wait_for, done, counted, resumed):
    out = tmp_path / "out"
    process = begin(slow_content, out, workers=2)
    reported = int(process.stdout.readline().split()[0])
    workers = psutil.Process(process.pid).children(recursive=True)
    assert len(workers) >= 2
    process.kill()
    process.wait()
    wait_for(lambda: not any(worker.is_running() and worker.status() != "zombie" for worker in workers))
    keys = done(out)
    assert reported <= len(keys) < 40
    ended, simulated = resumed(study_of(slow_content, tmp_path), out, counted)
    assert (simulated, ended.progress.unchanged) == (40 - len(keys), len(keys))


def test_a_stranger_cannot_hand_work_to_a_cluster_started_here(tmp_path, slow_content):
    """Without the certificate of the run nobody connects, at whatever port: one of them is the scheduler's."""
    before, attempts = listening(psutil.Process()), {}
    attempt = (
        "import os, sys\nfrom distributed import Client\n"
        "try:\n    Client(sys.argv[1], timeout=2).submit(print).result()\n"
        "except BaseException:\n    os._exit(1)\n"  # at once: its threads go on trying
        "os._exit(0)\n"
    )

    def stranger(progress):
        if not attempts:
            for place in listening(psutil.Process()) - before:
                command = [sys.executable, "-c", attempt, f"tcp://{place.ip}:{place.port}"]
                attempts[place] = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            end = time.monotonic() + 10.0
            for process in attempts.values():
                try:
                    process.wait(max(end - time.monotonic(), 0.0))
                except subprocess.TimeoutExpired:  # it waits for ever where a port answers nothing
                    process.kill()
                    process.wait()

    one = slow_content | {"variations": {"grid": {"drivetrain.tilt": {"values": [4, 5], "unit": "deg"}}}}
    ended = run_study(study_of(one, tmp_path), tmp_path / "out", workers=1, progress=stranger)
    assert ended.progress.computed == 2
    assert attempts and all(process.returncode != 0 for process in attempts.values())


@pytest.fixture
def dask(tmp_path):
    """Starts a scheduler, and workers by number, as a user does on the command line."""
    processes = []

    def start(*arguments):
        with (tmp_path / f"dask{len(processes)}.log").open("w") as log:
            command = [sys.executable, "-m", *arguments, "--host", "127.0.0.1", "--no-dashboard"]
            processes.append(subprocess.Popen(command, stdout=log, stderr=log, cwd=tmp_path))
        return processes[-1]

    class Cluster:
        """Address of the scheduler, and what starts a worker."""

        scheduler = start("distributed.cli.dask_scheduler", "--port", "0", "--scheduler-file", "scheduler.json")

        @property
        def address(self):
            import json

            path = tmp_path / "scheduler.json"
            end = time.monotonic() + 60
            while not path.exists() or not path.read_text().endswith("}"):
                assert time.monotonic() < end
                time.sleep(0.05)
            return json.loads(path.read_text())["address"]

        def worker(self):
            return start("distributed.cli.dask_worker", self.address, "--nthreads", "1", "--no-nanny")

    yield Cluster()
    for process in processes:
        process.kill()
        process.wait()


@pytest.fixture
def under_way(tmp_path, slow_content):
    """A study in a thread of this process, with what it reports."""

    class UnderWay:
        out, done, ended, error = tmp_path / "out", 0, None, None

        def start(self, address, **options):
            self.thread = threading.Thread(target=self._run, args=(address, options), daemon=True)
            self.thread.start()

        def _run(self, address, options):
            try:
                self.ended = run_study(
                    study_of(slow_content, tmp_path), self.out, scheduler=address, progress=self._take, **options
                )
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


def test_a_worker_joins_late_and_another_is_killed(dask, under_way, wait_for, done, journal):
    under_way.start(dask.address)
    wait_for(lambda: (under_way.out / "log.txt").exists() and "no worker has joined yet" in under_way.log)
    first = dask.worker()
    wait_for(lambda: under_way.done >= 3)
    first.send_signal(signal.SIGSTOP)  # with what it has under way
    second = dask.worker()
    with Client(dask.address, set_as_default=False) as client:
        client.wait_for_workers(2, timeout=120)
    before = done(under_way.out)
    assert 3 <= len(before) < 40
    first.kill()
    under_way.join()
    assert under_way.error is None and second.poll() is None
    assert (under_way.ended.progress.computed, under_way.ended.progress.failed) == (40, 0)
    assert before <= done(under_way.out)
    # Nothing that was reported done was computed again: the journal has one line a run.
    runs = [record["run"] for record in journal(under_way.out)]
    assert len(runs) == len(set(runs)) == 40
    assert "has joined" in under_way.log and "is gone; others take over" in under_way.log
    study = open_study(under_way.out)
    assert (study.outcome == "completed").all() and study.energy.notnull().all()


def test_a_scheduler_that_dies_loses_nothing(dask, under_way, wait_for, done, slow_content, tmp_path, counted, resumed):
    dask.worker()
    under_way.start(dask.address)
    wait_for(lambda: under_way.done >= 3)
    reported = under_way.done
    dask.scheduler.kill()
    under_way.join()
    assert isinstance(under_way.error, MacroslipError) and "--resume" in str(under_way.error)
    keys = done(under_way.out)
    assert reported <= len(keys) < 40
    ended, simulated = resumed(study_of(slow_content, tmp_path), under_way.out, counted)
    assert (simulated, ended.progress.unchanged) == (40 - len(keys), len(keys))


def test_a_case_that_kills_its_workers_is_recorded_and_the_others_computed(tmp_path, load_files, content, monkeypatch):
    """A worker that ends where it would store a certain result stands for one that the system ends for its memory."""
    run_study(study_of(content, load_files), tmp_path / "before")
    key = str(open_study(tmp_path / "before").key.values[2])
    site = tmp_path / "site"
    site.mkdir()
    (site / "sitecustomize.py").write_text(
        "import os, sys\n"
        "def hook(event, arguments):\n"
        f"    if event == 'open' and '.{key}.nc.' in str(arguments[0]): os._exit(1)\n"
        "if os.environ.get('MACROSLIP_TEST_PARENT') not in (None, str(os.getpid())): sys.addaudithook(hook)\n"
    )
    monkeypatch.setenv("PYTHONPATH", str(site))
    monkeypatch.setenv("MACROSLIP_TEST_PARENT", str(os.getpid()))
    ended = run_study(study_of(content, load_files), tmp_path / "out", workers=2)
    assert (ended.progress.computed, ended.progress.failed) == (3, 1)
    assert ended.failures[0][0]["loads"] == "runs/14mps_seed1.csv" and "died" in ended.failures[0][2]


def test_wrong_addresses_and_arguments(tmp_path, load_files, content):
    study = study_of(content, load_files)
    with pytest.raises(InputError, match="workers and scheduler are given together"):
        run_study(study, tmp_path / "out", workers=1, scheduler="tcp://127.0.0.1:1")
    for scheme, words in (("nonsense", "unknown address scheme"), ("tls", "TLS")):
        with pytest.raises(InputError, match=f"no scheduler answers at '{scheme}://127.0.0.1:1' .*{words}"):
            run_study(study, tmp_path / "out", scheduler=f"{scheme}://127.0.0.1:1")
    with pytest.raises(InputError, match="missing port number"):
        run_study(study, tmp_path / "out", scheduler="localhost")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("listens", [False, True])
def test_who_does_not_answer_is_no_scheduler(tmp_path, load_files, content, monkeypatch, listens):
    monkeypatch.setattr(module, "_ANSWER", 1.0)
    with socket.socket() as deaf:
        deaf.bind(("127.0.0.1", 0))
        if listens:
            deaf.listen()
        address = f"tcp://127.0.0.1:{deaf.getsockname()[1]}"
        with pytest.raises(InputError, match=f"no scheduler answers at '{address}' .*1 s"):
            run_study(study_of(content, load_files), tmp_path / "out", scheduler=address)
    assert not (tmp_path / "out").exists()


def test_a_scheduler_is_found_from_a_notebook(dask):
    """There the thread has a running loop already."""

    async def cell():
        module.look_for(dask.address)

    asyncio.run(cell())


def test_no_client_is_left_where_others_compute(tmp_path, load_files, content):
    """A default client that waits for its scheduler would make every later `compute` of the process wait."""
    assert default_clients() == (None, None)
    with pytest.raises(InputError, match="no scheduler answers"):
        run_study(study_of(content, load_files), tmp_path / "nowhere", scheduler="nonsense://127.0.0.1:1")
    assert default_clients() == (None, None)
    seen = []
    run_study(
        study_of(content, load_files), tmp_path / "out", workers=1, progress=lambda _: seen.append(default_clients())
    )
    assert set(seen) == {(None, None)} and default_clients() == (None, None)


def test_the_client_of_the_user_stays_theirs(dask, tmp_path, load_files, content):
    dask.worker()
    with Client(dask.address) as mine:
        seen = []
        run_study(
            study_of(content, load_files), tmp_path / "out", scheduler=dask.address,
            progress=lambda _: seen.append(default_clients()),
        )  # fmt: skip
        assert seen and all(client is mine for _, client in seen) and default_client() is mine
        assert mine.submit(sum, [1, 2]).result() == 3
    assert default_clients() == (None, None)


class Threads:
    """What `Dask` needs of a client: threads by worker."""

    loop = object()

    def __init__(self, threads):
        self._threads = threads

    def nthreads(self):
        return {f"worker{number}": 1 for number in range(self._threads)}


@pytest.mark.parametrize(
    ("threads", "seconds", "bundle"), [(2, 1.0, 1), (1000, 1.0, 10), (2, 1e-3, 20), (1000, 60.0, 1)]
)
def test_short_runs_travel_together_so_that_the_scheduler_keeps_up(threads, seconds, bundle):
    from macroslip.study.cluster import Dask

    pool = Dask(Threads(threads), lambda text: None)
    pool._learn([{"values": {"simulate_seconds": seconds, "other_seconds": 0.0}}])
    assert pool._bundle() == bundle
    # At most a hundred tasks a second, and a bounded number of runs in flight.
    assert threads / (seconds * bundle) <= 100.0 * 1.01 and pool.free_places() == 2 * threads * bundle
