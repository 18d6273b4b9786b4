"""Laws of one's own by name in a case file: `macroslip run --laws`, with the files of the examples."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import xarray as xr

from macroslip import Bearing, Lubricant
from macroslip.contact.interface import interfaces

pytestmark = pytest.mark.slow

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def run(folder):
    """Run the command in a process of its own: laws stay registered for as long as a process lives."""

    def run(*arguments):
        command = [
            sys.executable,
            "-W",
            "error",
            "-c",
            "from macroslip.cli import main; main()",
            "run",
            *map(str, arguments),
        ]
        environment = os.environ | {"PYTHONIOENCODING": "utf-8", "COLUMNS": "200"}
        return subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=600, check=False
        )

    return run


LAWS = ["--laws", EXAMPLES / "own_film.py", "--laws", EXAMPLES / "own_law.py"]


def test_film_and_traction_laws_of_ones_own(run, folder):
    case = (EXAMPLES / "own_laws.yaml").read_text(encoding="utf-8") + "traces: {step: 10 ms}\n"
    (folder / "case.yaml").write_text(
        case.replace("inlet_heating: true", "inlet_heating: false"), encoding="utf-8"
    )
    done = run("case.yaml", *LAWS, "-o", "own.nc")
    # The film of its own is used beyond its range, and told so.
    assert done.returncode == 0
    assert "doubtful: the film's formula is outside its range" in done.stderr
    with xr.open_dataset("own.nc", engine="h5netcdf") as written:
        result = written.sel(row="downwind").isel(roller=0).load()
    assert (result.status == 0).all()
    assert result.attrs["model"] == "paper, but film dowson-higginson, traction isothermal-barus"
    assert (
        "Dowson, Proc. Inst." in result.attrs["citations"]
        and "Crook" not in result.attrs["citations"]
    )
    # The film in the result is the formula's, written here once more, where only the rings load the roller.
    bearing, oil = Bearing.read("skf-240-600-bc"), Lubricant.read("vg460-pao")
    inner = interfaces(bearing, oil)[0]
    heaviest = result.isel(time=int(result.roller_load.argmax("time")))
    load, speed = (
        float(heaviest.roller_load),
        -float(heaviest.spin_pure) * bearing.roller_diameter / 2,
    )
    w = 0.75 * load ** (2 / 3) / inner.hertz.semi_axis_across
    size = inner.modulus * inner.rolling_radius
    thickness = (
        2.65
        * (oil.viscosity * speed / size) ** 0.7
        * (oil.pressure_viscosity * inner.modulus) ** 0.54
    )
    thickness *= (w / size) ** -0.13 * inner.rolling_radius
    assert float(heaviest.film_thickness.sel(interface="inner")) == pytest.approx(
        thickness, rel=1e-4
    )


@pytest.mark.deep  # each compiles the whole integrator once more; tests/result/test_own_laws.py has those of the examples
@pytest.mark.parametrize(
    ("laws", "is_outside"),
    [
        ("{model: physical, film: dowson-higginson}", True),
        (
            "{model: paper, film: masjedi-khonsari-moes, starvation: true, inlet_heating: true, "
            "asperities: film-ratio, traction: isothermal-barus}",
            False,
        ),
    ],
    ids=["film", "traction"],
)
def test_own_laws_beside_the_mechanisms_of_the_package(run, folder, laws, is_outside):
    loads = "{main_bearing: {force: [0 N, -100 kN, 0 N], shaft_speed: 20 rpm, duration: 8 s}}"
    (folder / "case.yaml").write_text(
        f"loads: {loads}\nrollers: [0]\nlaws: {laws}\n", encoding="utf-8"
    )
    done = run("case.yaml", *LAWS, "-o", "own.nc")
    assert done.returncode == 0, done.stderr
    # The film of one's own is used beyond its range, and told so.
    told = "doubtful: the film's formula is outside its range" in done.stderr
    assert told == is_outside, done.stderr
    with xr.open_dataset("own.nc", engine="h5netcdf") as result:
        assert (result.status == 0).all() and float(result.asperity_energy.min()) >= 0.0
        parts, total = result.mechanism_energy.sum("mechanism"), result.energy
        assert float(abs(parts - total).max()) < 1e-3 * float(total.max())


def test_without_its_file_a_law_is_told_with_how_to_name_it(run, folder):
    done = run(EXAMPLES / "own_laws.yaml", "-o", "own.nc")
    assert done.returncode == 2 and not Path("own.nc").exists()
    assert "laws.traction: 'isothermal-barus' does not exist. Allowed: mechanisms, kellstroem. Choose one of these. A law of your own " \
           "needs its file: macroslip run CASE --laws FILE." in done.stderr  # fmt: skip


def test_a_file_that_is_wrong_ends_the_run(run, folder):
    (folder / "my_laws.py").write_text("import nothing_of_this_name\n", encoding="utf-8")
    done = run(EXAMPLES / "own_laws.yaml", "--laws", "my_laws.py", "-o", "own.nc")
    assert (done.returncode, done.stdout) == (2, "") and not Path("own.nc").exists()
    assert done.stderr == (
        "error: my_laws.py, line 1: ModuleNotFoundError while its laws were read (No module named 'nothing_of_this_name'). "
        "Mend it; python my_laws.py shows where the error comes from.\n"
    )


def test_a_case_file_names_no_program(run, folder):
    # A case file is data: nothing in it makes anything run.
    (folder / "my_laws.py").write_text("raise RuntimeError('I ran')\n", encoding="utf-8")
    text = (
        (EXAMPLES / "own_laws.yaml")
        .read_text(encoding="utf-8")
        .replace("film: dowson-higginson", "film: my_laws.py")
    )
    (folder / "case.yaml").write_text(text, encoding="utf-8")
    done = run("case.yaml", "-o", "own.nc")
    assert done.returncode == 2 and "I ran" not in done.stderr
