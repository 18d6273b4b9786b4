"""Pages on results: what stands in them, what is refused, and that they are one self-contained file."""

import base64
import json
import re

import numpy as np
import pytest
import xarray as xr
from markupsafe import Markup, escape

from macroslip import BearingLoads, Case, HubLoads, InputError, Laws, Traces, simulate
from macroslip.bearing import Bearing
from macroslip.report.answer import answer
from macroslip.report.bearing_view import LEAST_POWER, MISSING, quantise, scene_data
from macroslip.report.page import Opening, Section, Table, render, words
from macroslip.report.provenance import bibtex
from macroslip.report.results_page import results_page
from macroslip.report.style import compared
from macroslip.result.damage import lines
from macroslip.result.orbit import in_window, scene, still
from macroslip.result.rating import with_rating

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def bare():
    """A result without traces and without a complete orbit."""
    return simulate(
        Case(
            loads=BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 0.5),
            laws=Laws.paper(),
            rollers=[0, 14],
        )
    )


@pytest.fixture(scope="module")
def page(result):
    return results_page({"fourteen": result}, title="Four rollers")


def opening(page):
    (text,) = re.findall(r'<section id="answer">.*?</section>', page, re.DOTALL)
    return text


def sentences(page):
    """The paragraphs of the opening, their white space as a browser shows it."""
    return [
        " ".join(paragraph.split())
        for paragraph in re.findall(r"<p[^>]*>(.*?)</p>", opening(page), re.DOTALL)
    ]


def numbers_section(page):
    (text,) = re.findall(r'<section id="numbers">.*?</section>', page, re.DOTALL)
    return " ".join(text.split())


def test_the_opening_is_the_answer_in_sentences_with_four_figures(page, result):
    # Without details of contacts there is nothing to say of films and criteria.
    assert sentences(page) == answer(result) and len(sentences(page)) == 2
    assert opening(page).count("<img") == 4
    assert " J " not in " ".join(sentences(page))


def test_energies_and_powers_stand_further_down(page, result):
    told = numbers_section(page)
    energy = result.energy.sum("interface").mean("roller")
    seconds = result.attrs["window_end"] - result.attrs["window_start"]
    for row in ("downwind", "upwind"):
        of_row = float(energy.sel(row=row))
        assert f"{of_row:.3g} J {row} ({of_row / seconds:.3g} W in the mean, " in told
    highest = result.peak_power.where(result.peak_power == result.peak_power.max(), drop=True)
    where = "cage" if (interface := highest.interface.item()) == "cage" else f"{interface} raceway"
    assert (
        f"{float(highest.max()):.3g} W, at the {where} of a roller of the {highest.row.item()} row"
        in told
    )
    given = json.loads(result.attrs["input"])
    tags = [
        value["tag"]
        for part in ("bearing", "lubricant")
        for value in given[part].values()
        if isinstance(value, dict)
    ]
    assert (
        f"{tags.count('E')} of {len(tags)} values of bearing and lubricant are engineering estimates"
        in told
    )
    assert "All 8 rollers completed." in told


def test_several_results_are_compared_in_the_opening(result):
    less = result.copy(deep=True)
    less["energy"] = 0.5 * less.energy
    page = results_page({"whole": result, "half": less})
    assert "the " not in sentences(page)[0] and "2 results are compared" in sentences(page)[0]
    energy = result.energy.sum("interface").mean("roller")
    most = str(energy.row[int(np.argmax(energy.values))].item())
    assert (
        f"The {most} row of whole dissipates most, {float(energy.max()):.3g} J a roller."
        in sentences(page)
    )
    assert opening(page).count("<img") == 4
    # Their sections are distinguished, in the contents too.
    assert page.count('<span class="group">whole</span>') > 3 and 'id="energy-1"' in page


def test_an_opening_is_kept_short():
    with pytest.raises(ValueError, match="five sentences and four pictures"):
        Opening(Markup("<p>one</p>") * 6, ())


def test_every_section_is_in_the_contents_and_can_be_folded(page):
    names = re.findall(r'<section id="([^"]+)"', page)
    assert re.findall(r'<li><a href="#([^"]+)"', page) == names
    assert page.count('<details class="fold">') == len(names) - 1
    assert {
        "answer",
        "numbers",
        "bearing",
        "energy",
        "power",
        "load-zone",
        "films",
        "provenance",
    } <= set(names)


def test_a_page_refers_to_nothing_outside_itself(page):
    assert re.findall(r"""(?:src|href)=["'](?!data:|#)""", page) == []
    assert re.findall(r"url\(|@import|<link(?![^>]*data:)", page) == []
    assert "script-src 'sha256-" in page and "default-src 'none'" in page
    assert len(page.encode()) < 8e6


def test_a_page_is_the_same_for_the_same_results(page, result):
    assert results_page({"fourteen": result}, title="Four rollers") == page


def test_every_picture_says_what_it_shows(page):
    pictures = re.findall(r"<img [^>]*>", page)
    assert len(pictures) > 8
    assert all(
        re.search(r'alt="[^"]{10,}"', picture) and re.search(r'width="\d+" height="\d+"', picture)
        for picture in pictures
    )


def test_typefaces_are_two_at_most(page):
    # One of the page, from the system; one of the figures, whose letters are drawn.
    assert len(re.findall(r"font(?:-family)?:[^;]*(?:sans-serif|serif|monospace)", page)) == 1


def test_the_overview_has_the_numbers(page, result):
    energy = result.energy.sum("interface").sel(row="upwind")
    for value in (
        energy.mean(),
        energy.min(),
        energy.max(),
        result.peak_power.sel(row="upwind").max(),
    ):
        assert f'class="number">{float(value):.4g}</td>' in page
    assert "All 8 rollers completed." in page


def test_provenance_is_complete(page):
    for text in (
        "macroslip 0",
        "masjedi-khonsari",
        "tolerance 0.0002",
        "engineering estimate",
        "bundled case 14B",
        "@misc{hart_slip",
        "doi = {10.1115/1.4005514}",
        "hardness group 0.03033",
        ">completed<",
    ):
        assert text in page


def test_without_traces_the_page_says_what_would_give_more(bare):
    page = results_page({"bare": bare})
    assert "Give the case traces" in opening(page) and "over the mean of the row" not in opening(
        page
    )
    assert "data-view" not in page.split("<main>")[1].split("<script>")[0]


def test_failed_rollers_are_reported_first(result):
    failed = result.copy(deep=True)
    failed.status.loc[{"row": "upwind", "roller": 7}] = 3
    for name in ("energy", "orbit_energy", "peak_power"):
        failed[name].loc[{"row": "upwind", "roller": 7}] = np.nan
    page = results_page({"one": failed})
    assert "1 of 8 rollers FAILED" in sentences(page)[0]
    assert (
        "roller 7 of the upwind row ended at t = " in page and "the step limit was reached" in page
    )


@pytest.mark.parametrize(
    ("results", "message"),
    [
        ({}, "no result"),
        ({"a": xr.Dataset({"x": 1})}, "^a: the dataset has no energy, no status, no row"),
    ],
)
def test_what_is_no_result_is_refused(results, message):
    with pytest.raises(InputError, match=message):
        results_page(results)


def test_names_are_escaped_wherever_they_stand(hostile):
    parts, table = words("parts.html"), Table((hostile,), ((hostile,),), hostile)
    body = parts.table(table) + parts.verbatim(hostile, hostile) + parts.view({hostile: {}})
    page = render(
        hostile,
        hostile,
        Opening(Markup("<p></p>"), ()),
        (Section("a", hostile, body, hostile, hostile),),
    )
    assert "<img" not in page and "7*7" in page
    assert page.count("<script") == page.count("</script>") == 2
    assert "</script><" not in page.split('class="scenes">')[1].split("</script>")[0]


def test_scene_survives_the_way_to_the_page(result):
    part = scene(result)
    data = scene_data(part, Bearing.read("skf-240-600-bc"))
    assert data["count"] == part.sizes["time"] and data["radii"]["pitch"] == pytest.approx(372.7)
    for name, quantity, factor in zip(
        ("slip", "roller_load", "power"), data["quantities"], (1e3, 1e-3, 1.0), strict=True
    ):
        codes = np.frombuffer(base64.b64decode(quantity["codes"]), "<u2").reshape(part[name].shape)
        decoded = quantity["low"] + (quantity["high"] - quantity["low"]) * codes / 65534.0
        expected = factor * part[name].values.astype(float)
        if quantity["logarithmic"]:
            decoded, expected = 10.0**decoded, np.maximum(expected, LEAST_POWER)
            np.testing.assert_allclose(decoded, expected, rtol=2e-4)
        else:
            np.testing.assert_allclose(
                decoded, expected, atol=1.01 * (quantity["high"] - quantity["low"]) / 65534.0
            )
            if name == "roller_load":
                np.testing.assert_array_equal(codes == 0, expected == 0.0)
    assert np.frombuffer(quantise(np.array([np.nan]), 0.0, 1.0), "<u2").tolist() == [MISSING]


def test_the_scale_of_colours_is_one_of_lightness(result):
    colours = np.array(scene_data(scene(result), Bearing.read("skf-240-600-bc"))["colours"])
    lightness = colours @ np.array([0.299, 0.587, 0.114])
    assert (np.diff(lightness) > 4.0).all()


def test_works_that_are_not_known_by_name_are_cited_all_the_same():
    text = bibtex(
        [
            "Hart et al., Dynamic modelling of slip in a wind turbine spherical roller main bearing",
            "Some One, A law {of mine, doi:10.1000/xyz123.",
            "Some One, A law too",
            "",
        ]
    )
    assert text.count("\n\n") == 3 and "doi = {10.1000/xyz123}" in text
    assert text.count("{") == text.count("}")
    keys = re.findall(r"@\w+\{([^,]+),", text)
    assert len(set(keys)) == 4


def test_doubts_stand_on_the_first_screen():
    """A film beyond its formula's range, with loads that are far too small for the bearing."""
    case = Case(
        loads=BearingLoads.constant([0.0, -300.0, 60.0], 2.1, 0.5), laws=Laws.paper(), rollers=[0]
    )
    page = results_page({"one": with_rating(simulate(case), case)})
    assert page.count("<b>Doubtful</b>") >= 2 and "static safety is" in page
    upwards = HubLoads.constant((160e3, 0.0, 260e3), (0.0, 0.0, 0.0), 2.0, 0.5)
    page = results_page({"one": simulate(Case(loads=upwards, laws=Laws.paper(), rollers=[0]))})
    assert "the rotor&#39;s weight acts upwards" in opening(page)


def test_the_first_screen_has_slip_before_a_line_for_every_criterion():
    case = Case(
        loads=HubLoads.bundled("14B").window(0.0, 12.0), rollers=[0, 14], traces=Traces(step=0.05)
    )
    result = simulate(case)
    whole = results_page({"one": result})
    assert (
        "energy by mechanism and row" in whole
        and "Energy per area along the rollers of the downwind row" in whole
    )
    page, (criteria, _) = opening(whole), lines(result)
    assert sentences(whole) == [escape(sentence) for sentence in answer(result, criteria)]
    first = page.index("All rows of rollers, coloured by slip")
    assert (
        page.index("<p>")
        < first
        < page.index("roller load of the")
        < page.index("Slip of the rollers of all rows")
        < page.index("Criteria of damage over")
        < page.index("<table")
    )
    table = page[page.index("<table") : page.index("</table>")]
    assert table.count("<tr>") == 1 + len(criteria)
    # Also where it is read as a card: every cell knows its heading.
    assert table.count('data-heading="known to a factor of"') == len(criteria)
    # What makes several criteria unsure is said once.
    assert all(page.count(str(escape(line["how sure"]))) == 1 for line in criteria)
    with_bearing = still(result)
    power = in_window(result).power.sum("interface").max(("row", "roller"))
    assert float(with_bearing.time) == float(power.time[int(power.argmax("time"))])
    roller = result.sel(time=with_bearing.time, row="downwind", roller=14)
    assert float(with_bearing.slip.sel(row="downwind", roller=14)) == float(
        1.0 - roller.spin / roller.spin_pure
    )


def test_panels_that_are_compared_share_their_scales():
    drawn = []
    compared(
        lambda axes, most: drawn.append(axes.plot([0.0, most])[0].axes), {"a": (1.0,), "b": (5.0,)}
    )
    assert drawn[0].get_ylim() == drawn[1].get_ylim() and drawn[0].get_ylim()[1] >= 5.0
    compared(
        lambda axes, most: drawn.append(axes.imshow([[0.0, most]]).axes), {"a": (1.0,), "b": (5.0,)}
    )
    assert [axes.images[0].get_clim() for axes in drawn[2:]] == [(0.0, 5.0)] * 2
