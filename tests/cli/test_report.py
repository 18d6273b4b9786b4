"""`macroslip report`: from what `macroslip run` wrote to one page."""

import pytest

pytestmark = pytest.mark.slow


@pytest.fixture
def ran(quick, folder, macroslip):
    """Two results of `macroslip run`, one with traces."""
    (folder / "out").mkdir()
    for name, further in (("plain", ""), ("traced", "traces: {step: 0.05 s}\n")):
        case = quick(further)
        assert macroslip("run", case, "-o", f"out/{name}.nc", "--quiet").code == 0
    return folder


def test_a_folder_becomes_one_page_beside_its_results(ran, macroslip):
    done = macroslip("report", "out", "--title", "Mine <b>")
    assert (done.code, done.out, done.err) == (0, "written: out/report.html\n", "")
    page = (ran / "out" / "report.html").read_text(encoding="utf-8")
    assert "<h1>Mine &lt;b&gt;</h1>" in page
    assert ">plain<" in page and ">traced<" in page and "data-view" in page
    assert "paper states" not in page
    again = macroslip("report", "out")
    assert again.code == 2 and "the file exists" in again.err
    assert macroslip("report", "out", "--force", "--quiet").out == ""


def test_one_file_and_a_page_of_ones_own_choice(ran, macroslip):
    done = macroslip("report", "out/plain.nc", "-o", "page.html")
    assert (done.code, done.out) == (0, "written: page.html\n")
    assert (
        "data-view"
        not in (ran / "page.html")
        .read_text(encoding="utf-8")
        .split("</header>")[1]
        .split("<script>")[0]
    )


def test_the_folder_of_a_study(folder, macroslip):
    text = "case: {laws: {model: paper}, rollers: [0], loads: {end: 16 s}}\nloads: {bundled: [12A, 18B]}\n"
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    assert macroslip("study", "study.yaml", "-o", "out", "--quiet").code == 0
    done = macroslip("report", "out", "--title", "Mine", "--weibull", 9, 2)
    assert (done.code, done.out, done.err) == (0, "written: out/report.html\n", "")
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    for words in ("Lifetime energy", "Exceedance", "Worst cases", "No run failed", "scale 9 m/s"):
        assert words in page
    assert macroslip("study", "study.yaml", "-o", "out", "--resume", "--quiet").code == 0, (
        "the page is in no way"
    )


def test_no_file_of_a_study_becomes_its_page(folder, macroslip):
    text = (
        "case: {laws: {model: paper}, rollers: [0], loads: {end: 16 s}}\nloads: {bundled: [12A]}\n"
    )
    (folder / "study.yaml").write_text(text, encoding="utf-8")
    assert macroslip("study", "study.yaml", "-o", "out", "--quiet").code == 0
    before = {path: path.read_bytes() for path in (folder / "out").rglob("*") if path.is_file()}
    for path in before:
        done = macroslip("report", "out", "-o", path, "--force")
        assert done.code == 2 and "a file that the output is made from" in done.err
    assert {
        path: path.read_bytes() for path in (folder / "out").rglob("*") if path.is_file()
    } == before


def test_weights_belong_to_studies(ran, macroslip):
    done = macroslip("report", "out", "--weibull", 9, 2)
    assert done.code == 2 and "--weibull is given for results that are no study" in done.err


@pytest.mark.parametrize(
    ("path", "message"),
    [
        ("nothing", "nothing: there is no such file or folder"),
        ("empty", "empty: the folder holds no netCDF file"),
        ("broken.nc", "broken.nc: the file cannot be read as netCDF"),
        ("other.nc", "other.nc: the dataset has no energy"),
    ],
)
def test_what_is_no_result_gives_one_paragraph(folder, macroslip, path, message):
    import xarray as xr

    (folder / "empty").mkdir()
    (folder / "broken.nc").write_text("no netCDF")
    xr.Dataset({"x": 1.0}).to_netcdf(folder / "other.nc", engine="h5netcdf")
    done = macroslip("report", path)
    assert done.code == 2 and message in done.err
    assert not list(folder.rglob("*.html"))


def test_failed_rollers_give_exit_code_3(quick, folder, macroslip):
    case = quick("integrator: {method: radau, max_steps: 5}\n")
    assert macroslip("run", case, "-o", "case.nc", "--quiet").code == 3
    done = macroslip("report", "case.nc")
    assert done.code == 3 and "failed: 4 of 4 rollers" in done.err
    assert "4 of 4 rollers FAILED" in (folder / "report.html").read_text(encoding="utf-8")
