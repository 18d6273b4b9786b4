"""Workers for runs: threads, processes of this machine, or those of a Dask scheduler.

A bounded number of runs is under way, whatever the size of the study.
"""

from __future__ import annotations

import asyncio
import importlib.util
import logging
import math
import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker
from threading import Event, Lock, Thread
from typing import Any, Protocol

from macroslip.errors import InputError, MacroslipError
from macroslip.machine import process_environment
from macroslip.storage.waiting import listen, tell
from macroslip.study.database import Outcome
from macroslip.study.work import work_several

Task = dict[str, Any]
Done = list[tuple[Task, dict[str, Any]]]
#: Worker processes that may die of one run before it counts as failed; Dask has the same number.
_DEATHS = 4
#: Longest wait for the end of a process that has died [s].
_PATIENCE = 5.0
_NO_GUARD = (
    "the worker processes end as they start: each of them imports this script, so call "
    'run_study(..., workers=...) below the main guard, if __name__ == "__main__":'
)
#: Tasks in flight for each thread of a worker elsewhere: one under way, one waiting.
_AHEAD = 2
#: Tasks a second given to one scheduler and one client, which can do some five times as many;
#: longest time until a scheduler responds, and time between looks at who has joined [s].
_TASKS_PER_SECOND = 100.0
_ANSWER = 20.0
_LOOK = 1.0
_GONE = "the scheduler is gone. Nothing that was reported done is lost; go on with --resume."


class ThisProcess:
    """Several runs at once in threads of this process, or one by one in the waiting thread.

    All workers have `free_places`, how many more runs they take now; `submit`, to begin at most as
    many; and `wait`, until something is done: runs with their results, nothing when nothing is
    under way.
    """

    def __init__(self, count: int):
        self._count = count
        self._ended = Event()
        self._pool = ThreadPoolExecutor(count) if count > 1 else None
        self._under_way: dict[Future, Task] = {}

    def __enter__(self) -> ThisProcess:
        return self

    def __exit__(self, *error: object) -> None:
        """End: runs that have not begun never will, and those under way end within a second."""
        self._ended.set()
        if self._pool:
            self._pool.shutdown(cancel_futures=True)

    def free_places(self) -> int:
        """Number of tasks that can be submitted: as many as run at once."""
        return self._count - len(self._under_way)

    def submit(self, tasks: list[Task]) -> None:
        """Begin runs."""
        for task in tasks:
            future = (
                self._pool.submit(work_several, [task], self._go_on) if self._pool else Future()
            )
            self._under_way[future] = task

    def wait(self) -> Done:
        """Wait until something is done."""
        if not self._pool:
            for future, task in self._under_way.items():
                future.set_result(work_several([task]))
        done, _ = wait(self._under_way, return_when=FIRST_COMPLETED)
        finished = []
        for future in done:
            task = self._under_way.pop(future)
            (result,) = future.result()
            finished.append((task, result))
        return finished

    def _go_on(self, done: int, total: int) -> None:
        if self._ended.is_set():
            raise KeyboardInterrupt


def end_in_worker() -> None:
    """End silently in a worker that imports a script without main guard.

    The process that began the worker reports it.
    """
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        sys.exit(1)


class Processes:
    """Worker processes of this machine, each a pool of its own, so that one that dies loses one run.

    `note` writes to the log.
    """

    def __init__(self, count: int, note: Callable[[str], None]):
        self._note = note
        self._under_way: dict[Future, tuple[_Seat, Task]] = {}
        self._deaths: dict[str, int] = {}
        self._idle: list[_Seat] = []
        self._count = count

    def __enter__(self) -> Processes:
        # They wait for the same, so that one of them tells for all.
        self._idle = [_Seat(tells=number == 0) for number in range(self._count)]
        return self

    def __exit__(self, *error: object) -> None:
        """End every process at once, in the middle of its run if need be."""
        busy = [seat for seat, _ in self._under_way.values()]
        seats = [*self._idle, *busy]
        for seat in seats:
            seat.kill()
        for seat in seats:
            seat.pool.shutdown(cancel_futures=True)

    def free_places(self) -> int:
        """Number of tasks that can be submitted: one for each idle process."""
        return len(self._idle)

    def submit(self, tasks: list[Task]) -> None:
        """Begin runs."""
        for task in tasks:
            seat = self._idle.pop()
            try:
                future = seat.pool.submit(work_several, [task])
            except BrokenProcessPool as error:  # it has died while it was idle
                future = Future()
                future.set_exception(error)
            self._under_way[future] = seat, task

    def wait(self) -> Done:
        """Wait until something is done; a process that has died is replaced."""
        finished: Done = []
        while self._under_way and not finished:
            done, _ = wait(self._under_way, return_when=FIRST_COMPLETED)
            for future in done:
                seat, task = self._under_way.pop(future)
                try:
                    (result,) = future.result()
                    finished.append((task, result))
                    self._idle.append(seat)
                except BrokenProcessPool:
                    self._idle.append(self._another(seat))
                    name = task["run"]
                    self._deaths[name] = self._deaths.get(name, 0) + 1
                    if self._deaths[name] < _DEATHS:
                        self.submit([task])
                    else:
                        finished.append((task, _killed(task)))
        return finished

    def _another(self, seat: _Seat) -> _Seat:
        # Without a main guard a process ends by itself as it starts; whoever kills one leaves a
        # signal instead.
        started = (
            seat.ready.done() and not seat.ready.cancelled() and seat.ready.exception() is None
        )
        if not started and seat.has_ended_itself():
            raise MacroslipError(_NO_GUARD) from None
        self._note("a worker process has died; another takes over")
        seat.pool.shutdown(wait=False)
        return _Seat()


class _Seat:
    """A worker process; one that tells passes on how far it is with compiling and tables."""

    def __init__(self, *, tells: bool = False) -> None:
        before = set(multiprocessing.active_children())
        # A pipe of its own: a process that is killed while it writes blocks no other.
        heard, told = multiprocessing.Pipe(duplex=False) if tells else (None, None)
        with _safe_start():
            self.pool = ProcessPoolExecutor(
                1, multiprocessing.get_context("spawn"), _begin_worker, (told,)
            )
            self.ready = self.pool.submit(os.getpid)  # starts the process
        if heard is not None and told is not None:
            told.close()
            Thread(target=_pass_on, args=(heard,), daemon=True).start()
        started = set(multiprocessing.active_children()) - before
        self._process = next(iter(started), None)

    def has_ended_itself(self) -> bool:
        """True if the dead process is known to have ended by its own failure, not by a signal."""
        end = time.monotonic() + _PATIENCE
        # The pool's own thread waits for the process too; until it has noted the exit code, there
        # is none here.
        while (
            self._process is not None and self._process.exitcode is None and time.monotonic() < end
        ):
            time.sleep(0.01)
        return self._process is not None and (self._process.exitcode or 0) > 0

    def kill(self) -> None:
        if self._process is not None:
            with suppress(OSError, ValueError):
                self._process.kill()


@contextmanager
def _safe_start() -> Iterator[None]:
    """Let processes started in the block import nothing from this folder and ignore Ctrl-C.

    Ctrl-C is left to this process.
    """
    safe = process_environment()
    path = list(sys.path)
    before = {name: os.environ.get(name) for name in safe}
    os.environ.update(safe)
    sys.path[:] = [entry for entry in path if entry]
    try:
        with _without_interrupts():
            yield
    finally:
        sys.path[:] = path
        for name, value in before.items():
            if value is None:
                os.environ.pop(name)
            else:
                os.environ[name] = value


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Let processes started in the block have Ctrl-C blocked from their first instruction on.

    Windows has no such mask; there they ignore it as soon as they run.
    """
    if sys.platform == "win32":
        yield
        return
    # It would be started with the first process, and then let Ctrl-C through again.
    resource_tracker.ensure_running()
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)


class _Sends(Protocol):
    """End of a pipe that sends; its class differs between systems."""

    def send(self, value: Any, /) -> None:
        """Send an object."""


class _Receives(Protocol):
    """End of a pipe that receives."""

    def recv(self) -> Any:
        """Wait for an object."""


def _begin_worker(told: _Sends | None) -> None:
    """Prepare a worker process, which tells how far it is if there is a connection to do so."""
    _end_with_parent()
    if told is None:
        return
    guard = Lock()

    def pass_on(*stage: str | int) -> None:
        with guard, suppress(OSError):
            told.send(stage)

    listen(pass_on)


def _pass_on(heard: _Receives) -> None:
    """Tell the listeners of this process what a worker waits for, until the worker ends."""
    with suppress(EOFError, OSError):
        while True:
            tell(*heard.recv())


def _end_with_parent() -> None:
    """Have this worker end at once when the process that started it does, however that ends."""
    if sys.platform == "win32":  # elsewhere it was started with Ctrl-C blocked
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def watch() -> None:
        if parent is not None:
            parent.join()
            os._exit(1)

    Thread(target=watch, daemon=True).start()


def _killed(task: Task) -> dict[str, Any]:
    reason = "the workers that began with it died, one after the other; is their memory too small?"
    return {"run": task["run"], "outcome": Outcome.FAILED, "reason": reason}


def look_for(scheduler: str) -> None:
    """Check that a scheduler responds, before there is a client.

    A client that cannot connect cannot be closed either.

    Raises InputError if there is none at the address, and MacroslipError if Dask is not installed.
    """
    if importlib.util.find_spec("distributed") is None:
        remedy = "pip install 'macroslip[cluster]', or leave out the scheduler."
        raise MacroslipError(f"a scheduler needs distributed, not installed here: {remedy}")
    from distributed.comm import connect
    from distributed.security import Security

    async def knock() -> None:
        async with asyncio.timeout(_ANSWER):
            comm = await connect(
                scheduler, timeout=_ANSWER, **Security().get_connection_args("client")
            )
            await comm.close()

    # In a thread of its own: in a notebook this one has a running loop already.
    with ThreadPoolExecutor(1) as thread:
        try:
            thread.submit(asyncio.run, knock()).result()
        except (OSError, ValueError, TypeError) as error:  # the last without what TLS needs
            why = str(error) or f"nothing is heard for {_ANSWER:g} s"
            fault = f"no scheduler answers at '{scheduler}' ({why})"
            raise InputError(
                fault, remedy="Start one with `dask scheduler`, and look at its address."
            ) from None


@contextmanager
def dask_workers(scheduler: str, note: Callable[[str], None]) -> Iterator[Dask]:
    """The workers of a Dask scheduler at an address such as `tcp://10.0.0.1:8786`."""
    from distributed import Client

    # The study itself reports the important part of Dask's own messages.
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    try:
        # Not Dask's default: that is the user's own, and whatever they compute meanwhile would come
        # here.
        client = Client(scheduler, timeout=_ANSWER, set_as_default=False)
    except OSError:
        raise MacroslipError(_GONE) from None
    with client:
        yield Dask(client, note)


class Dask:
    """The workers of a Dask scheduler, as many as there are at any moment.

    `note` writes to the log.
    """

    def __init__(self, client: Any, note: Callable[[str], None]):
        self._client = client
        self._note = note
        self._pool = client.get_executor(
            pure=False
        )  # not pure: Dask must not take two runs for one
        self._under_way: dict[Future, list[Task]] = {}
        self._looked = -math.inf
        self._threads = 0
        self._names: set[str] = set()
        if not self._look():
            note("no worker has joined yet; waiting for one")

    def free_places(self) -> int:
        """Fills a window of two tasks for each thread of all workers that are there."""
        wanted = max(_AHEAD * self._look(), _AHEAD)
        missing = max(wanted - len(self._under_way), 0)
        return missing * self._bundle()

    def submit(self, tasks: list[Task]) -> None:
        """Send runs, several together where they are short."""
        size = self._bundle()
        for start in range(0, len(tasks), size):
            part = tasks[start : start + size]
            future = self._pool.submit(work_several, part)
            self._under_way[future] = part

    def wait(self) -> Done:
        """Wait until something is done.

        Raises MacroslipError if the scheduler is gone or a worker cannot work.
        """
        from distributed import KilledWorker

        finished: Done = []
        while self._under_way and not finished:
            done, _ = wait(self._under_way, return_when=FIRST_COMPLETED)
            for future in done:
                tasks = self._under_way.pop(future)
                try:
                    results = future.result()
                except CancelledError:
                    raise MacroslipError(_GONE) from None
                except KilledWorker:
                    if len(tasks) == 1:
                        (task,) = tasks
                        finished.append((task, _killed(task)))
                    else:  # one of them is the cause
                        self._under_way |= {
                            self._pool.submit(work_several, [task]): [task] for task in tasks
                        }
                except Exception as error:
                    fault = f"a worker cannot compute a run: {type(error).__name__}: {error}. "
                    fault += "Is macroslip installed there?"
                    raise MacroslipError(fault) from None
                else:
                    finished += zip(
                        tasks, results, strict=False
                    )  # fewer only where the study has to stop
        return finished

    def _look(self) -> int:
        """Number of threads of all workers, looked up from time to time.

        Notes the workers that have joined and left.
        """
        if time.monotonic() - self._looked > _LOOK:
            threads = self._client.nthreads()
            names = set(threads)
            if self._looked > -math.inf:
                for name in sorted(names - self._names):
                    self._note(f"worker {name} has joined")
                for name in sorted(self._names - names):
                    self._note(f"worker {name} is gone; others take over what it had")
            self._names = names
            self._threads = sum(threads.values())
            self._looked = time.monotonic()
        return self._threads

    def _bundle(self) -> int:
        """Number of runs sent together, so that the scheduler keeps up with runs over a second."""
        return max(1, round(self._threads / _TASKS_PER_SECOND))


Workers = ThisProcess | Processes | Dask
