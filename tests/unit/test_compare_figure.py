"""The labels on the axes of a comparison can be read: none lies on another, whatever the numbers."""

from __future__ import annotations

import itertools
from pathlib import Path

import matplotlib as mpl
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from fairlead.analysis.cost.compare import Comparison, Row
from fairlead.report.compare_figure import figure_of
from fairlead.report.figures import STYLE

NUMBERS = ((4, 0.0), (4.0, None), (1.1e-11, 9.9e9), (9.9, 1.1))


@pytest.mark.parametrize(("first", "second"), NUMBERS)
def test_no_label_lies_on_another(first, second):
    rows = tuple(
        Row(label, "finished", "", error=one, creep=one, steps=one, switches=one, seconds=one)
        for label, one in (("hold", first), ("tanh", second))
    )
    with mpl.rc_context(STYLE):
        figure = figure_of(Comparison(rows, "hold at accuracy 1e-07", Path()))
        FigureCanvasAgg(figure).draw()
        texts = [label for ax in figure.axes for label in _shown(ax)]
        boxes = [text.get_window_extent() for text in texts]
    assert len(boxes) >= len(figure.axes)
    pairs = itertools.combinations(zip(texts, boxes, strict=True), 2)
    assert not [(a.get_text(), b.get_text()) for (a, one), (b, other) in pairs if one.overlaps(other)]


def _shown(ax):
    """The labels below an axis, of ticks within its limits."""
    low, high = sorted(ax.get_xlim())
    ticks = [*ax.xaxis.get_major_ticks(), *ax.xaxis.get_minor_ticks()]
    return [tick.label1 for tick in ticks if tick.label1.get_text() and low <= tick.get_loc() <= high]


def test_a_bar_has_its_number_and_a_dot_says_what_it_is():
    """Without them a dot at the left edge could be none, zero or rounding, and a bar is read off a logarithm."""
    rows = (Row("hold", "finished", "", error=2.5e-5, creep=3e-17, steps=932, switches=0, seconds=0.0063),)
    with mpl.rc_context(STYLE):
        figure = figure_of(Comparison(rows, "hold at accuracy 1e-07", Path()))
    told = [[text.get_text() for text in ax.texts] for ax in figure.axes]
    assert told == [["2.5e-05"], ["rounding"], ["932"], ["0"], ["0.0063"]]
