"""Runs Python as a user does."""

import os
import subprocess
import sys

import pytest


@pytest.fixture(scope="session")
def python():
    """Run Python in a process of its own, with warnings as errors."""

    def run(*arguments, folder):
        environment = os.environ | {"MPLBACKEND": "agg", "PYTHONIOENCODING": "utf-8"}
        return subprocess.run(
            [sys.executable, "-W", "error", *arguments],
            cwd=folder,
            env=environment,
            text=True,
            encoding="utf-8",
            capture_output=True,
            timeout=850,
            check=False,
        )

    return run
