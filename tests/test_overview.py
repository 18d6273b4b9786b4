"""What objects show of themselves in a notebook: short, and harmless whatever names they hold."""

import pytest

from macroslip import Bearing, BearingLoads, Case, HubLoads, Laws, Lubricant

LOADS = BearingLoads.constant([0.0, -300e3, 0.0], 2.0, 1.0)
OBJECTS = {
    "hub loads": HubLoads.constant([1e5, 0, -2e5], [1e5, 0, 0], 2.0, 1.0),
    "bearing loads": LOADS,
    "bearing": Bearing.read("skf-240-600-bc"),
    "lubricant": Lubricant.read("vg460-pao"),
    "case": Case(loads=LOADS, laws=Laws.paper()),
}


@pytest.mark.parametrize("name", OBJECTS)
def test_one_line_and_one_table(name):
    subject = OBJECTS[name]
    assert (
        repr(subject).startswith(f"<{type(subject).__name__}")
        and "\n" not in repr(subject)
        and len(repr(subject)) < 300
    )
    html = subject._repr_html_()
    assert html.count("<table>") == html.count("</table>") == 1 and len(html) < 8000


def test_a_case_names_what_it_is_made_of():
    case = Case(loads=LOADS, laws=Laws.paper(), rollers=[0, 3])
    for word in (
        "constant load",
        "skf-240-600-bc",
        "vg460-pao",
        "model paper",
        "Radau",
        "2 rollers of each row",
    ):
        assert word in repr(case) and word in case._repr_html_()


def test_every_value_of_a_record_is_in_its_table():
    bearing = OBJECTS["bearing"]
    html = bearing._repr_html_()
    for key, origin in bearing.provenance.items():
        assert f"<td>{key}</td><td>{origin.value}" in html


def test_text_is_escaped():
    evil = Bearing.read("skf-240-600-bc").replace(name="<script>alert(1)</script>")
    assert "<script>" not in evil._repr_html_() and "&lt;script&gt;" in evil._repr_html_()
    assert "<script>" not in Case(loads=LOADS, laws=Laws.paper(), bearing=evil)._repr_html_()
