"""Workers of a Dask cluster: one that is started here, on the loopback interface, or one that runs elsewhere.

A bounded number of tasks is in flight, whatever the size of the study, so that the scheduler and this process need
bounded memory. Where cases are short and workers many, several runs are sent together.
"""

from __future__ import annotations

import asyncio
import atexit
import contextlib
import importlib.util
import logging
import math
import os
import signal
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

from macroslip.errors import InputError, MacroslipError
from macroslip.machine import process_environment, usable_processors
from macroslip.study.outcome import Outcome
from macroslip.study.work import work_several
from macroslip.study.workers import Done

#: The only interface on which a cluster listens that is started here.
LOOPBACK = "127.0.0.1"
#: Tasks in flight for each thread of a worker: one under way, one waiting.
_AHEAD = 2
#: Tasks a second given to one scheduler and one client; they can do some five times as many.
_TASKS_PER_SECOND = 100.0
#: Longest time of runs that are sent together [s].
_LONGEST_BUNDLE = 20.0
#: Longest time until a scheduler responds [s].
_ANSWER = 20.0
_GONE = "the scheduler is gone. Nothing that was reported done is lost; go on with --resume."
#: Time between looks at who has joined [s].
_LOOK = 1.0


def check_installed() -> None:
    """Raise the error that names the packages which a cluster needs and how to install them."""
    missing = [name for name in ("distributed", "cryptography") if importlib.util.find_spec(name) is None]
    if missing:
        remedy = "pip install 'macroslip[cluster]', or leave out --workers and --scheduler."
        raise MacroslipError(f"workers need {' and '.join(missing)}, not installed here: {remedy}")


@contextmanager
def cluster(workers: int | None, scheduler: str | None, note: Callable[[str], None]) -> Iterator[Dask]:
    """Dask workers for the length of the block.

    Parameters
    ----------
    workers : int, optional
        Start so many worker processes of one thread each here. Scheduler and workers listen on the loopback interface
        only, and talk to each other by TLS with a certificate made for this run, so that nobody else on the machine
        can hand them work.
    scheduler : str, optional
        Address of a scheduler that runs, such as `tcp://10.0.0.1:8786`.
    note : callable
        Called with a line for the user.
    """
    import dask
    from distributed import Client

    # The study itself reports what is important in Dask's own messages.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    # Profiles of workers are for a dashboard only, and there is none.
    with dask.config.set({"distributed.worker.profile.enabled": False}):
        if scheduler is None:
            with (
                _safe_environment(),
                _started_here(workers) as local,
                # Not Dask's default: that is the user's own, and whatever they compute meanwhile would come here.
                Client(local, set_as_default=False) as client,
            ):
                client.register_plugin(_ignore_interrupts())
                try:
                    yield Dask(client, note)
                except KeyboardInterrupt:
                    _kill(local)
                    raise
            return
        try:
            client = Client(scheduler, timeout=_ANSWER, set_as_default=False)
        except OSError:  # since the check above
            raise MacroslipError(_GONE) from None
        with client:
            yield Dask(client, note)


@contextmanager
def _safe_environment() -> Iterator[None]:
    """Workers have the environment of this process, also those that Dask starts anew: none looks in the current folder."""
    safe = process_environment()
    before = {name: os.environ.get(name) for name in safe}
    os.environ.update(safe)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def _started_here(workers: int | None) -> Any:
    """A cluster of processes of this machine."""
    from distributed import LocalCluster
    from distributed.deploy.spec import close_clusters

    try:
        return LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            host=LOOPBACK,
            dashboard_address=f"{LOOPBACK}:0",
            worker_dashboard_address=f"{LOOPBACK}:0",
            security=True,
            silence_logs=logging.CRITICAL,
        )
    except KeyboardInterrupt:
        # When the process ends, Dask would fail over workers that have not started yet; they end with it anyway.
        atexit.unregister(close_clusters)
        raise


def _kill(local: Any) -> None:
    """End workers at once: on a request to end they would finish the roller under way first."""
    for nanny in local.workers.values():
        nanny.auto_restart = False
        if nanny.pid is not None:
            with contextlib.suppress(ProcessLookupError):
                os.kill(nanny.pid, getattr(signal, "SIGKILL", signal.SIGTERM))


def look_for(scheduler: str) -> None:
    """Check that a scheduler responds, before there is a client: one that cannot connect cannot be closed either.

    Raises
    ------
    InputError
        If there is none at the address.
    """
    from distributed.comm import connect
    from distributed.security import Security

    async def knock() -> None:
        async with asyncio.timeout(_ANSWER):
            comm = await connect(scheduler, timeout=_ANSWER, **Security().get_connection_args("client"))
            await comm.close()

    # In a thread of its own: in a notebook this one has a running loop already.
    with ThreadPoolExecutor(1) as thread:
        try:
            thread.submit(asyncio.run, knock()).result()
        except (OSError, ValueError, TypeError) as error:  # the last without what TLS needs
            raise InputError(
                f"no scheduler answers at '{scheduler}' ({str(error) or f'nothing is heard for {_ANSWER:g} s'})",
                remedy="Start one with `dask scheduler`, and look at its address.",
            ) from None


def _ignore_interrupts() -> Any:
    """Have workers leave Ctrl-C, which the terminal sends to all processes, to the one that started them."""
    from distributed import WorkerPlugin

    class IgnoreInterrupts(WorkerPlugin):
        def setup(self, worker: Any) -> None:
            signal.signal(signal.SIGINT, signal.SIG_IGN)

    return IgnoreInterrupts()


def threads_of_worker(workers: int | None) -> int:
    """Threads over rollers in each worker: the processors shared between workers started here, one elsewhere."""
    return 1 if workers is None else max(1, usable_processors() // workers)


class Dask:
    """The workers of a cluster, as many as there are at any moment.

    Parameters
    ----------
    client : distributed.Client
    note : callable
        Called with a line for the user.
    """

    def __init__(self, client: Any, note: Callable[[str], None]):
        from distributed import as_completed

        self._client, self._note = client, note
        self._done = as_completed(with_results=True, raise_errors=False, loop=client.loop)
        self._flying: dict[str, tuple[Any, list[dict[str, Any]]]] = {}
        self._looked, self._threads = -math.inf, 0
        self._workers: set[str] = set()
        self._seconds: float | None = None
        if not self._look():
            note("no worker has joined yet; waiting for one")

    def free_places(self) -> int:
        """Fills a window of two tasks for each thread of all workers that are there."""
        tasks = max(_AHEAD * self._look(), 2) - len(self._flying)
        return max(tasks, 0) * self._bundle()

    def submit(self, tasks: list[dict[str, Any]]) -> None:
        """Send tasks, several together where they are short."""
        size = self._bundle()
        for start in range(0, len(tasks), size):
            self._send(tasks[start : start + size])

    def wait(self) -> list[Done]:
        """Wait for something to be done.

        Raises
        ------
        MacroslipError
            If the scheduler is gone.
        """
        done: list[Done] = []
        while self._flying and not done:
            for future, result in self._done.next_batch():
                _, tasks = self._flying.pop(future.key)
                if future.status == "finished":
                    self._learn(result)
                    done += zip(tasks, result, strict=False)  # shorter only where the study has to stop
                else:
                    done += self._lost(future, result, tasks)
        return done

    def _send(self, tasks: list[dict[str, Any]]) -> None:
        # Not pure: Dask must not take two runs for one.
        future = self._client.submit(work_several, tasks, pure=False)
        self._flying[future.key] = future, tasks
        self._done.add(future)

    def _lost(self, future: Any, result: Any, tasks: list[dict[str, Any]]) -> list[Done]:
        """Handle tasks that gave no result."""
        from distributed import KilledWorker

        error = result[1] if isinstance(result, tuple) else result
        if future.status != "error":
            raise MacroslipError(_GONE)
        if not isinstance(error, KilledWorker):
            raise MacroslipError(
                f"a worker cannot work: {type(error).__name__}: {error}. Is macroslip installed there?"
            )
        if len(tasks) > 1:  # one of them is the cause
            for task in tasks:
                self._send([task])
            return []
        reason = "the workers that began with it died, one after the other; is their memory too small?"
        (task,) = tasks
        return [(task, {"run": task["run"], "outcome": Outcome.FAILED, "reason": reason})]

    def _look(self) -> int:
        """Number of threads of all workers, looked up from time to time; notes the workers that have joined and left."""
        if time.monotonic() - self._looked > _LOOK:
            threads = self._client.nthreads()
            present = set(threads)
            if self._looked > -math.inf:
                for address in sorted(present - self._workers):
                    self._note(f"worker {address} has joined")
                for address in sorted(self._workers - present):
                    self._note(f"worker {address} is gone; others take over what it had")
            self._workers, self._threads, self._looked = present, sum(threads.values()), time.monotonic()
        return self._threads

    def _learn(self, results: list[dict[str, Any]]) -> None:
        """Follow the time a run takes."""
        for result in results:
            values = result.get("values")
            if values:
                seconds = values["simulate_seconds"] + values["other_seconds"]
                self._seconds = seconds if self._seconds is None else 0.9 * self._seconds + 0.1 * seconds

    def _bundle(self) -> int:
        """How many runs to send together, so that the scheduler keeps up."""
        if not self._seconds:
            return 1
        wanted = math.ceil(self._threads / (_TASKS_PER_SECOND * self._seconds))
        return max(1, min(wanted, int(_LONGEST_BUNDLE / self._seconds)))
