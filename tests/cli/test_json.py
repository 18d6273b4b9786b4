"""Every command that prints a table prints it as JSON too: the same values, in full."""

import json

import pytest
import xarray as xr

from macroslip import Bearing, Lubricant
from macroslip.bearing.kinds import bearing_catalogue, read_bearing

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("noun", "catalogue", "read"),
    [
        ("bearing", bearing_catalogue, read_bearing),
        ("lubricant", Lubricant.catalogue, Lubricant.read),
    ],
)
def test_catalogue(macroslip, noun, catalogue, read):
    listed = [record["name"] for record in json.loads(macroslip(noun, "list", "--json").out)]
    assert listed == catalogue()
    for name in listed:
        shown = json.loads(macroslip(noun, "show", name, "--json").out)
        assert shown["name"] == name
        for key, origin in read(name).provenance.items():
            assert (
                shown["values"][key]["value"] == origin.value
                and shown["values"][key]["tag"] == origin.tag
            )


def test_bearing_estimate(macroslip, folder):
    page = (
        "--bore",
        "630 mm",
        "--outside",
        "920 mm",
        "--width",
        "290 mm",
        "--c0",
        "17600 kN",
        "--e",
        0.3,
        "--c",
        "9307 kN",
    )
    done = macroslip("bearing", "estimate", *page, "-o", "mine.yaml", "--json")
    assert (done.code, done.err) == (0, "")
    printed = json.loads(done.out)
    written = Bearing.read(folder / "mine.yaml")
    for key, estimate in printed["values"].items():
        low, high = estimate["10 to 90 %"]
        assert low <= estimate["median"] <= high
        assert (
            written.provenance[key].value == estimate["median"]
            and written.provenance[key].unit == estimate["unit"]
        )
    assert {"roller_diameter", "contact_angle"} <= set(printed["values"])
    shown = macroslip("bearing", "estimate", *page, "-o", "mine.yaml", "--force").out
    assert f"is {printed['C by ISO 281 / published [1]']:.3f} of the published one" in shown
    assert (printed["name"], printed["written"]) == ("mine", "mine.yaml")


def test_run(quick, macroslip, folder):
    done = macroslip("run", quick(), "-o", "case.nc", "--json")
    assert done.code == 0 and done.err.startswith(
        "doubtful: the film's formula is outside its range"
    )
    printed = json.loads(done.out)
    result = xr.load_dataset(folder / "case.nc", engine="h5netcdf")
    energy = result.energy.sum("interface").mean("roller")
    for row in ("downwind", "upwind"):
        assert printed["rows"][row]["mean energy per roller [J]"] == pytest.approx(
            float(energy.sel(row=row)), rel=1e-12
        )
        # Two seconds hold no complete orbit; the peak is that of the window.
        peak = float(result.window_peak_power.sel(row=row).max())
        assert printed["rows"][row]["highest peak power [W]"] == pytest.approx(peak, rel=1e-12)
    assert (
        all(printed[name] == result.attrs[name] for name in ("model", "oil"))
        and printed["oil"] in printed["title"]
    )
    assert printed["written"] == "case.nc" and printed["window"]["complete orbits"] == 0


def test_study(folder, macroslip):
    (folder / "study.yaml").write_text(
        "case: {rollers: [0], loads: {end: 2 s}}\nloads: {bundled: [14B]}\n", encoding="utf-8"
    )
    printed = json.loads(macroslip("study", "study.yaml", "--dry-run", "--json").out)
    assert printed["runs"] == 1 and printed["load histories"] == 1 and printed["bytes"] > 0
    done = macroslip("study", "study.yaml", "-o", "out", "--json", "--quiet")
    printed = json.loads(done.out)
    assert (
        printed["runs"],
        printed["computed"],
        printed["failed"],
        printed["left"],
        printed["failures"],
    ) == (1, 1, 0, 0, [])


def test_an_error_is_one_line_with_quiet(folder, macroslip):
    (folder / "case.yaml").write_text("bearing: [1\nloads: 3\nrollers: some\n")
    several = macroslip("run", "case.yaml", "-o", "case.nc")
    single = macroslip("run", "case.yaml", "-o", "case.nc", "--quiet")
    assert several.code == single.code == 2
    assert single.err.count("\n") == 1 and single.err.split() == several.err.split()
