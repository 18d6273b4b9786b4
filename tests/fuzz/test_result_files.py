"""Result files with random damage and other contents, given to `macroslip report` and to the library's reader."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from macroslip import BearingLoads, Case, Laws, Traces, open_result, simulate
from macroslip.result.stored import to_netcdf
from tests.fuzz.oracle import app_of, ends_well, examples

_NUMBERS = [np.nan, np.inf, -np.inf, -1.0, 0.0, 1e308, -1e308, 5e-324, 127.0]
_TEXTS = [
    "",
    "x" * 100_000,
    "{",
    "[1]",
    "null",
    "a\nb",
    "<script>",
    -1,
    float("nan"),
    np.array([1.0, 2.0]),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("results")


@pytest.fixture(scope="module")
def result():
    loads = BearingLoads.constant([0.0, -300e3, 80e3], 2.1, 14.0)
    return simulate(Case(loads=loads, laws=Laws.paper(), rollers=[0, 7], traces=Traces(step=0.1)))


@pytest.fixture(scope="module")
def content(result):
    return to_netcdf(result)


def _read(folder, content):
    (folder / "mine.nc").write_bytes(content)
    return ends_well(folder, folder / "mine.nc", folder / "mine.nc", app=app_of(open_result))


def test_undamaged_is_accepted(folder, content, result):
    assert _read(folder, content) == ""
    xr.testing.assert_identical(open_result(folder / "mine.nc"), result)


@pytest.mark.slow
@examples(12)
@given(data=st.data())
def test_cut(folder, content, data):
    """The other half of a file that was not copied to its end is missed, and said to be."""
    assert "cannot be read" in _read(folder, content[: data.draw(st.integers(1, len(content) - 1))])


@pytest.fixture(scope="module")
def places(content, result):
    """Where in the file the numbers of some variables lie."""
    names = ("energy", "orbit_energy", "spin", "slip", "roller_load", "power", "film_thickness")
    values = {name: result[name].values.tobytes() for name in names}
    assert all(content.count(packed) == 1 for packed in values.values())
    return [
        range(content.index(packed), content.index(packed) + len(packed))
        for packed in values.values()
    ]


@pytest.mark.slow
@examples(10)
@given(data=st.data())
def test_a_flipped_bit_in_a_number_is_no_other_number(folder, content, places, data):
    position = data.draw(st.sampled_from(data.draw(st.sampled_from(places))))
    flipped = bytes([content[position] ^ (1 << data.draw(st.integers(0, 7)))])
    assert "cannot be read" in _read(folder, content[:position] + flipped + content[position + 1 :])


def _odd_values(draw, dataset, name):
    variable = dataset[name]
    if variable.dtype.kind not in "fiu":
        return dataset
    values = variable.values.astype(float)
    value = draw(st.sampled_from(_NUMBERS))
    if draw(st.booleans()) or not values.size:
        values[...] = value
    else:
        values.flat[draw(st.integers(0, values.size - 1))] = value
    return dataset.assign({name: (variable.dims, values, variable.attrs)})


def _attribute(draw, dataset, name):
    key = draw(st.sampled_from(sorted(dataset.attrs)))
    value = draw(st.sampled_from([None, *_TEXTS]))
    changed = dataset.copy()
    changed.attrs = {name: text for name, text in dataset.attrs.items() if name != key} | (
        {} if value is None else {key: value}
    )
    return changed


def _labels(draw, dataset, name):
    dim = draw(st.sampled_from(sorted(dataset.sizes)))
    return dataset.assign_coords({dim: [f"{number} & co" for number in range(dataset.sizes[dim])]})


def _part(draw, dataset, name):
    dim = draw(st.sampled_from(sorted(dataset.sizes)))
    return dataset.isel({dim: slice(0, draw(st.integers(0, 1)))})


def _twice(draw, dataset, name):
    dim = draw(st.sampled_from(sorted(dataset.sizes)))
    return dataset.isel({dim: np.repeat(np.arange(dataset.sizes[dim]), 2)})


def _turned(draw, dataset, name):
    return dataset.assign({name: dataset[name].transpose(*dataset[name].dims[::-1])})


def _as_text(draw, dataset, name):
    variable = dataset[name]
    return dataset.assign({name: (variable.dims, variable.values.astype(str), variable.attrs)})


def _bare(draw, dataset, name):
    variable = dataset[name]
    return dataset.assign({name: (variable.dims, variable.values)})


def _left_out(draw, dataset, name):
    return dataset.drop_vars(name)


def _renamed(draw, dataset, name):
    return dataset if "other" in dataset.variables else dataset.rename({name: "other"})


_CHANGES = (
    _odd_values, _odd_values, _attribute, _labels, _part, _twice, _turned, _as_text, _bare, _left_out, _left_out, _renamed,
)  # fmt: skip


def _changed(data, result):
    """A result with one to three changes that a program or a person might make to a file."""
    dataset = result.copy(deep=True)
    for _ in range(data.draw(st.integers(1, 3))):
        change = data.draw(st.sampled_from(_CHANGES))
        dataset = change(data.draw, dataset, data.draw(st.sampled_from(sorted(dataset.variables))))
    return dataset


@pytest.mark.deep
@examples(15)
@given(data=st.data())
def test_changed(folder, result, data):
    _read(folder, to_netcdf(_changed(data, result)))


@pytest.mark.deep
@examples(2)
@given(data=st.data())
def test_report_of_a_changed_result(folder, result, data):
    file, page = folder / "mine.nc", folder / "page.html"
    file.write_bytes(to_netcdf(_changed(data, result)))
    page.touch()
    ends_well(folder, file, "report", file, "-o", page, "--force", "--quiet")


@pytest.mark.deep
@pytest.mark.parametrize("value", [np.nan, 0.0, -1.0])
def test_page_of_any_variable_without_meaning(folder, result, value):
    file, page = folder / "mine.nc", folder / "page.html"
    for name in result.variables:
        if result[name].dtype.kind in "fiu":
            values = np.full_like(result[name].values, value, dtype=float)
            file.write_bytes(
                to_netcdf(result.assign({name: (result[name].dims, values, result[name].attrs)}))
            )
            page.touch()
            ends_well(folder, file, "report", file, "-o", page, "--force", "--quiet")


@pytest.mark.parametrize("name", ["energy", "status", "slip", "roller_load", "start_angle"])
def test_what_is_missing_is_named(folder, result, name):
    assert f"the dataset has no {name}" in _read(folder, to_netcdf(result.drop_vars(name)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda dataset: dataset.assign(energy=-dataset.energy), "energy is negative"),
        (
            lambda dataset: dataset.assign(energy=dataset.energy * np.nan),
            "energy is negative or not finite",
        ),
        (
            lambda dataset: dataset.assign_coords(start_angle=-1e300 + dataset.start_angle),
            "start_angle holds no angles",
        ),
        (
            lambda dataset: dataset.assign_coords(start_angle=np.nan * dataset.start_angle),
            "start_angle holds no angles",
        ),
        (
            lambda dataset: dataset.assign(roller_load=dataset.roller_load + np.inf),
            "roller_load holds numbers beyond 1e+30",
        ),
        (
            lambda dataset: dataset.assign(power=dataset.power + 1e308),
            "power holds numbers beyond 1e+30",
        ),
        (
            lambda dataset: dataset.assign_coords(time=dataset.time * np.inf),
            "the coordinate time does not rise",
        ),
        (
            lambda dataset: dataset.assign(status=dataset.status + 99),
            "status holds numbers without a meaning",
        ),
        (
            lambda dataset: dataset.assign(slip=dataset.slip.transpose("time", "roller", "row")),
            "slip is over",
        ),
        (lambda dataset: dataset.assign(power=dataset.power.astype(str)), "power holds no numbers"),
        (lambda dataset: dataset.assign_attrs(input="{"), "the attribute input holds no case"),
        (
            lambda dataset: dataset.assign_attrs(window_end="late"),
            "the attribute window_end is no time",
        ),
        (
            lambda dataset: dataset.assign_coords(time=dataset.time[::-1].values),
            "the coordinate time does not rise",
        ),
        (lambda dataset: dataset.assign_coords(row=["front", "rear"]), "row is front, rear"),
    ],
)
def test_what_no_result_holds_is_refused(folder, result, change, words):
    assert words in _read(folder, to_netcdf(change(result)))


@pytest.mark.slow
@pytest.mark.parametrize(
    "part",
    [{"row": ["downwind"]}, {"roller": [0]}, {"interface": ["cage"]}, {"time": slice(3.0, 9.0)}],
)
def test_a_selection_is_a_result(folder, result, part):
    assert _read(folder, to_netcdf(result.sel(part))) == ""
