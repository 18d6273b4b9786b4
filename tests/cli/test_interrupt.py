"""An interrupt that arrives where Python can raise nothing is raised a moment later."""

import signal
import subprocess
import sys
import time

import pytest

from macroslip.cli.failure import interrupts_kept


class Interrupted:
    """Its finalizer gets a Ctrl-C."""

    def __del__(self):
        signal.raise_signal(signal.SIGINT)


class Faulty:
    """Its finalizer has another fault."""

    def __del__(self):
        raise ValueError("in a finalizer")


@pytest.fixture
def interruptible():
    """Workers of the tests may ignore Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def lose_one(seconds=5.0):
    """An interrupt in a finalizer, and then work."""
    Interrupted()
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        time.sleep(0.01)


def test_an_interrupt_in_a_finalizer_is_not_lost(interruptible):
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt), interrupts_kept():
        lose_one()
    assert time.monotonic() - start < 2.0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_without_it_python_goes_on(interruptible):
    """The fault that is mended: were it gone from Python, this would not be needed."""
    lose_one(seconds=1.0)


def test_other_faults_of_finalizers_are_reported_as_before(monkeypatch):
    seen = []
    monkeypatch.setattr("sys.unraisablehook", seen.append)
    with interrupts_kept():
        Faulty()
    assert [warning.exc_type for warning in seen] == [ValueError]


def test_an_interrupt_while_the_arguments_are_read_is_told():
    code = (
        "import typer.core; from macroslip.cli import main\n"
        "def interrupted(*_, **__): raise KeyboardInterrupt\n"
        "typer.core.TyperGroup.make_context = interrupted; main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


def test_an_interrupt_after_the_last_word_does_not_change_the_exit_code():
    """A user who presses again while the process ends would see a death by a signal."""
    code = (
        "import atexit, signal, time; from macroslip.cli import main\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import macroslip.cli.commands as commands\n"
        "from macroslip.cli.failure import command\n"
        "def interrupted(): raise KeyboardInterrupt\n"
        "atexit.register(signal.raise_signal, signal.SIGINT)\n"
        "import sys, typer; sys.argv = ['macroslip', 'wait']\n"
        "command(commands.app, interrupted, 'wait'); main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")


def test_an_interrupt_while_an_interrupt_is_told_is_ignored():
    code = (
        "import signal; from macroslip.cli import main\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import macroslip.cli.commands as commands, macroslip.cli.failure as failure\n"
        "def interrupted(): raise KeyboardInterrupt\n"
        "tell = failure.to_stderr\n"
        "def press_and_tell(text): signal.raise_signal(signal.SIGINT); tell(text)\n"
        "failure.to_stderr = press_and_tell\n"
        "import sys; sys.argv = ['macroslip', 'wait']\n"
        "failure.command(commands.app, interrupted, 'wait'); main()"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "interrupted\n")
