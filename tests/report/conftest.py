"""A small result with traces, and a browser that may be asked for."""

import os
import shutil

import pytest

from macroslip import Case, HubLoads, Laws, Traces, simulate

#: Text that would run, load something or break the page if it were not escaped.
HOSTILE = "<script>window.broken=1</script><img src=x onerror=window.broken=2>\"'&{{7*7}}</script>"


@pytest.fixture(scope="session")
def hostile():
    return HOSTILE


@pytest.fixture(scope="session")
def result():
    loads = HubLoads.bundled("14B").window(0.0, 20.0)
    return simulate(
        Case(loads=loads, laws=Laws.paper(), rollers=[0, 7, 14, 21], traces=Traces(step=0.05))
    )


@pytest.fixture(scope="module")
def browser():
    """Debian's Chromium, driven over its own protocol."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="playwright is not installed: pip install '.[test]'"
    )
    path = next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
    )
    if path is None:
        pytest.skip("there is no browser: apt-get install chromium")
    options = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
    with playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(executable_path=path, args=options)
        yield chromium
        chromium.close()
