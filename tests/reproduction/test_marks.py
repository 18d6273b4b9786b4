"""Marks of the paper's statements on figures."""

from macroslip.report.style import new_figure
from macroslip.reproduction.marks import mark_level, mark_wind_speeds


def test_marks_of_the_paper_say_so_and_widen_the_axis():
    axes = new_figure(4.0, 3.0)[1][0]
    axes.plot([12.0, 24.0], [1.1, 1.2])
    axes.set_yscale("log")
    mark_level(axes, 5.0, 20.0, "paper: about 10")
    assert axes.get_ylim()[1] >= 20.0 and axes.get_ylim()[0] <= 1.1
    mark_wind_speeds(axes, (12.0, 14.0), "paper: highest")
    assert [text.get_text() for text in axes.texts] == ["paper: about 10", "paper: highest"]
