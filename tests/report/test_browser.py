"""The page in a real browser, from the file alone and without a network."""

import json
import math
import re

import numpy as np
import pytest
from markupsafe import Markup

from macroslip.bearing import Bearing
from macroslip.report.page import Opening, Section, Table, environment, render, words
from macroslip.report.results_page import results_page
from macroslip.report.style import picture
from macroslip.result.orbit import scene

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def file(result, hostile, tmp_path_factory):
    """A page whose title, names, texts of the input and citations would all do harm if they were not escaped."""
    given = json.loads(result.attrs["input"])
    given["lubricant"]["title"] = given["bearing"]["name"] = given["loads"]["source"] = hostile
    given["bearing"]["hardness"]["note"] = hostile
    attributes = {
        "title": hostile,
        "source": hostile,
        "citations": hostile,
        "film_range_notes": hostile,
    }
    dangerous = result.assign_attrs(attributes, input=json.dumps(given))
    path = tmp_path_factory.mktemp("page") / "report.html"
    path.write_text(results_page({hostile: dangerous}, title=hostile), encoding="utf-8")
    return path


@pytest.fixture
def opened(browser, file):
    """Open the page offline at a width [px]; gives it with everything it asked for and complained of."""
    contexts = []

    def at(width=1280, anchor="#bearing", **options):
        context = browser.new_context(
            viewport={"width": width, "height": 900}, offline=True, **options
        )
        contexts.append(context)
        page = context.new_page()
        page.requests, page.complaints = [], []
        context.on("request", lambda request: page.requests.append(request.url))
        page.on("console", lambda message: page.complaints.append(message.text))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.goto(file.as_uri() + anchor)
        return page

    yield at
    for context in contexts:
        context.close()


def roller(page, row, number):
    return page.locator(f'circle[data-row="{row}"][data-roller="{number}"]')


def centre(circle):
    box = circle.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def places(page):
    return page.eval_on_selector_all(
        "circle.roller", "all => all.map(one => one.getAttribute('transform'))"
    )


@pytest.mark.parametrize("width", [1280, 390])
def test_it_opens_without_network_errors_or_sideways_scrolling(
    opened, file, width, record_property
):
    page = opened(width)
    ready = page.evaluate("document.documentElement.dataset.ready")
    record_property("ready_ms", ready)
    print(f"interactive {ready} ms after the start of the page, {width} px wide")
    assert page.complaints == []
    assert [url for url in page.requests if not url.startswith("data:")] == [file.as_uri()]
    if width == 390:
        page.get_by_text("Contents").click()
    page.get_by_role("button", name="Open all").click()
    wide = page.evaluate(
        "[document.documentElement.scrollWidth, document.documentElement.clientWidth]"
    )
    assert wide[0] <= wide[1] <= width
    broken = page.eval_on_selector_all("img", "all => all.filter(one => !one.naturalWidth).length")
    assert broken == 0 < page.locator("img").count()
    sizes = page.eval_on_selector_all(
        "p, td, li", "all => all.map(one => parseFloat(getComputedStyle(one).fontSize))"
    )
    assert min(sizes) >= 12


def test_text_of_the_input_is_text_and_nothing_else(opened, hostile):
    page = opened()
    assert page.evaluate("window.broken") is None
    assert page.locator("h1").inner_text() == hostile
    assert page.title() == hostile
    assert page.locator("script").count() == 2, "the page's own, and its data"
    # Even a script that came into the page would not run: only the page's own has the right hash.
    page.evaluate("""() => {
        const added = document.createElement("script");
        added.textContent = "window.broken = 3";
        document.body.append(added);
    }""")
    assert page.evaluate("window.broken") is None
    assert any("Content Security Policy" in text for text in page.complaints)


def test_nothing_can_be_fetched(opened):
    page = opened()
    outcome = page.evaluate("fetch('https://example.org/').then(() => 'fetched', () => 'refused')")
    assert outcome == "refused"
    assert not any("example.org" in url for url in page.requests)


def test_the_slider_moves_the_rollers_to_their_places(opened, result):
    page = opened()
    slider, before = page.locator("input[type=range]"), places(page)
    slider.focus()
    page.keyboard.press("Home")
    for _ in range(7):
        page.keyboard.press("ArrowRight")
    assert slider.input_value() == "7"
    moved = places(page)
    assert all(old != other for old, other in zip(before, moved, strict=True))
    part = scene(result)
    assert page.locator("output").inner_text() == f"{float(part.time[7]):.2f} s"
    radius = 1e3 * Bearing.read("skf-240-600-bc").pitch_radius
    # The order of the circles is that of rows and rollers; the view is downwind: the left is 90 degrees on.
    angles = np.radians((part.angle + part.travelled[7]).values.ravel())
    for text, angle in zip(moved, angles, strict=True):
        x, y = map(float, re.findall(r"[-\d.]+", text))
        assert (x, y) == pytest.approx(
            (-radius * math.sin(angle), radius * math.cos(angle)), abs=0.02
        )


def test_play_and_pause(opened):
    page = opened()
    clock, play = page.locator("output"), page.get_by_role("button", name="Play")
    start = clock.inner_text()
    play.click()
    page.wait_for_function(
        "start => document.querySelector('output').textContent !== start", arg=start
    )
    page.get_by_role("button", name="Pause").click()
    stopped = clock.inner_text()
    page.wait_for_timeout(150)
    assert clock.inner_text() == stopped
    page.locator("input[type=range]").press("End")
    play.click()
    page.wait_for_function(
        "stop => document.querySelector('output').textContent !== stop", arg=clock.inner_text()
    )


def test_hovering_shows_values_with_units(opened, result):
    page = opened()
    circle = roller(page, "downwind", 7)
    circle.scroll_into_view_if_needed()
    # In steps, as a hand does: a busy browser may lose the very first move after loading.
    page.mouse.move(*centre(circle), steps=4)
    tip = page.locator(".tip")
    assert tip.is_visible()
    words = tip.inner_text()
    assert words.startswith("downwind roller 7, ")
    now = int(page.locator("input[type=range]").input_value())
    load = float(scene(result).roller_load.sel(row="downwind", roller=7)[now]) / 1e3
    assert float(re.search(r"load ([\d.]+) kN", words).group(1)) == pytest.approx(
        load, rel=5e-3, abs=2e-3
    )
    assert re.search(r"slip (below )?−?[\d.e-]+ mm/s", words)
    assert re.search(r"frictional power (below )?[\d.e-]+ W", words)
    page.mouse.move(5, 5)
    assert tip.is_hidden()


def test_a_chosen_roller_has_its_traces_and_a_trace_moves_time(opened, result):
    page = opened()
    circle = roller(page, "upwind", 14)
    circle.scroll_into_view_if_needed()
    before = page.locator(".trace").first.get_attribute("d")
    page.mouse.click(*centre(circle))
    assert "chosen" in circle.get_attribute("class")
    assert page.locator(".readout").inner_text().startswith("upwind roller 14, ")
    assert page.locator(".trace").first.get_attribute("d") != before
    title = page.locator(".chart h4").nth(1).inner_text()
    largest = float(result.roller_load.sel(row="upwind", roller=14).max()) / 1e3
    assert float(re.search(r"to ([\d.]+) kN", title).group(1)) == pytest.approx(
        largest, rel=5e-3, abs=1e-2
    )
    chart = page.locator(".chart svg").first
    chart.scroll_into_view_if_needed()
    box = chart.bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + 20)
    half = (scene(result).sizes["time"] - 1) / 2
    assert abs(int(page.locator("input[type=range]").input_value()) - half) <= 1
    assert float(page.locator(".cursor").first.get_attribute("x1")) == pytest.approx(500, abs=3)
    assert re.search(
        r"^upwind roller 14 at [\d.]+ s\s+slip .* mm/s$", page.locator(".tip").inner_text()
    )


def test_colour_follows_the_choice(opened):
    page = opened()
    colours = "all => all.map(one => one.getAttribute('fill'))"
    drawn_fills = []
    for choice in ("Slip", "Load", "Frictional power"):
        page.get_by_label("Rollers coloured by").select_option(label=choice)
        fills = page.eval_on_selector_all("circle.roller", colours)
        assert all(re.fullmatch(r"rgb\(\d+,\d+,\d+\)", fill) for fill in fills)
        drawn_fills.append(tuple(fills))
    assert len(set(drawn_fills)) == 3


def test_everything_can_be_done_from_the_keyboard(opened):
    page = opened()
    ring = page.locator(".rings svg").first
    ring.focus()
    page.keyboard.press("ArrowRight")
    assert page.locator(".readout").inner_text().startswith("downwind roller 7,")
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("ArrowLeft")
    assert page.locator(".readout").inner_text().startswith("downwind roller 21,")
    page.keyboard.press("Space")
    assert page.locator(".view button").inner_text() == "Pause"
    page.keyboard.press("Space")
    assert page.locator(".view button").inner_text() == "Play"
    named = page.eval_on_selector_all(
        ".view button, .view select, .view input, .view svg",
        "all => all.every(one => one.textContent || one.labels?.length || one.getAttribute('aria-label'))",
    )
    assert named


def test_a_finger_on_a_telephone_chooses_a_roller(opened):
    page = opened(390, has_touch=True, is_mobile=True)
    circle = roller(page, "upwind", 21)
    circle.scroll_into_view_if_needed()
    page.touchscreen.tap(*centre(circle))
    assert page.locator(".readout").inner_text().startswith("upwind roller 21,")
    assert page.locator(".view button").bounding_box()["height"] >= 44


def test_print_has_everything_but_the_controls(opened):
    page = opened(anchor="")
    assert page.locator(".rings").is_hidden()
    page.emulate_media(media="print")
    for name in (".controls", "nav", ".time"):
        assert page.locator(name).is_hidden()
    assert page.locator("h1").is_visible()
    # Also where no script opened what is folded.
    assert page.locator("details.fold[open]").count() == 0
    assert page.locator(".rings").is_visible() and page.locator(".verbatim").is_visible()
    page.emulate_media(media="screen")
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert page.locator("details.fold:not([open])").count() == 0
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert page.locator("details.fold[open]").count() == 0


@pytest.mark.parametrize(("width", "height"), [(1280, 900), (390, 844)])
def test_the_answer_and_a_picture_that_can_be_read_are_on_the_first_screen(opened, width, height):
    page = opened(width, anchor="")
    sentences, pictures = page.locator("#answer p"), page.locator("#answer img")
    assert sentences.count() == 2 and pictures.count() == 4
    for number in range(2):
        box = sentences.nth(number).bounding_box()
        assert box["y"] + box["height"] <= height
    first = pictures.first.bounding_box()
    assert first["y"] + first["height"] <= height
    # Their letters are drawn for 403 pixels.
    assert all(pictures.nth(number).bounding_box()["width"] >= 340 for number in range(4))


def test_contents_lead_to_folded_sections(opened):
    # Without the smooth way there, which takes its time.
    page = opened(anchor="", reduced_motion="reduce")
    assert page.locator("details.fold[open]").count() == 0
    page.get_by_role("link", name="Films").click()
    assert page.locator("details.fold[open]").count() == 1
    films = page.locator("#films")
    assert films.locator("img").first.is_visible() and 0 <= films.bounding_box()["y"] < 200
    assert page.locator("nav a[aria-current]").inner_text() == "Films"
    # They stay in sight beside a wide page.
    assert page.locator("nav").bounding_box()["y"] >= 0
    page.get_by_role("button", name="Fold all").click()
    assert page.locator("details.fold[open]").count() == 0
    # The same link once more: its section is opened again.
    page.get_by_role("link", name="Films").click()
    assert films.locator("img").first.is_visible()


def test_contents_are_folded_above_a_narrow_page(opened):
    page = opened(390, anchor="")
    link = page.get_by_role("link", name="Films")
    assert link.is_hidden()
    page.get_by_text("Contents").click()
    link.click()
    assert link.is_hidden() and page.locator("#films img").first.is_visible()


def test_a_link_from_outside_opens_its_section(opened):
    page = opened(anchor="#provenance")
    assert page.locator("#provenance .verbatim").is_visible()
    assert page.locator("details.fold[open]").count() == 1


def test_text_that_is_searched_for_opens_its_section(opened):
    """A text fragment is found as the search in a page finds text."""
    page = opened(anchor="#:~:text=engineering%20estimate")
    page.wait_for_function("document.querySelectorAll('details.fold[open]').length > 0")
    assert page.locator("#provenance > details").get_attribute("open") is not None


def test_a_keyboard_opens_a_section(opened):
    page = opened(anchor="")
    page.locator("#films summary").focus()
    page.keyboard.press("Enter")
    assert page.locator("#films img").first.is_visible()


@pytest.mark.parametrize("width", [1280, 390])
def test_no_part_makes_the_page_scroll_sideways(browser, tmp_path, width):
    drawn = [
        picture(lambda axes: axes.plot([0.0, 1.0]), "a line", width=size) for size in (4.2, 9.0)
    ]
    long, parts = "word " * 40 + "a" * 80, words("parts.html")
    call = (
        "{% from 'parts.html' import pictures %}{% call pictures(shown) %}{{ long }}{% endcall %}"
    )
    body = Markup(environment().from_string(call).render(shown=drawn, long=long))
    body += parts.verbatim(f"@misc{{a, note = {{{long}}}}}", long)
    body += parts.table(Table(tuple("abcdefgh"), (("a long cell of text",) * 8,), long))
    path = tmp_path / "page.html"
    opening = Opening(Markup("<p>{}</p>").format(long) * 5, (drawn[0],) * 4)
    path.write_text(
        render("Title", long, opening, (Section("one", long, body, long, long),)), encoding="utf-8"
    )
    context = browser.new_context(viewport={"width": width, "height": 900}, offline=True)
    try:
        page = context.new_page()
        page.goto(path.as_uri() + "#one")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
    finally:
        context.close()
