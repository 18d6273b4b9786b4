"""The bar in Python: it counts what `simulate` reports, and leaves nothing behind."""

import io
import sys
import time

from macroslip import BearingLoads, Case, Laws, progress_bar, simulate
from macroslip.storage.waiting import COMPILING, tell


class Terminal(io.StringIO):
    """A terminal to write to."""

    def isatty(self):
        return True


def test_the_bar_counts_the_rollers(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    case = Case(
        loads=BearingLoads.constant([0.0, -300e3, 0.0], 0.0, 1.0), laws=Laws.paper(), rollers=[0, 5]
    )
    with progress_bar() as progress:
        seen = []
        result = simulate(
            case, progress=lambda done, total: (seen.append((done, total)), progress(done, total))
        )
    # Twice a second, and whenever rollers are done.
    assert (result.status == 0).all() and seen == sorted(seen) and seen[-1] == (4, 4)
    assert {total for _, total in seen} == {4}
    assert "rollers" in screen.getvalue() and "4/4" in screen.getvalue()


def test_compiling_has_a_bar_of_its_own_until_rollers_are_done(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    with progress_bar() as progress:
        tell(COMPILING, 3, 150)
        time.sleep(0.15)
        assert "compiling, which happens once" in screen.getvalue()
        assert "3/150" in screen.getvalue()
        progress(1, 2)
        screen.truncate(0)
        time.sleep(0.15)
    assert "1/2" in screen.getvalue() and "compiling" not in screen.getvalue()
