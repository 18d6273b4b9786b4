"""Importing the data rooms stays cheap."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    "package", ["macroslip.bearing", "macroslip.lubricant", "macroslip.bearing.geometry"]
)
def test_import_loads_no_heavy_package(package):
    code = f"import sys, {package}; print([m for m in ('numba', 'scipy', 'xarray', 'pandas') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout.strip(), done.stderr) == ("[]", "")
