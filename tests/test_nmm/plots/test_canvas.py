import io

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from PIL import Image

from nmm.plots import canvas


@pytest.fixture
def panels():
    """Two panels with titles, a curve in each."""
    made = canvas.axes_grid(1, 2, 2.0)
    for axes in made:
        axes.plot([0.0, 1.0, 2.0], [0.0, 1e5, -3e5])
        canvas.frame(axes, "time  (s)", "force  (N)", "a title")
    return made


def test_a_figure_is_laid_out_once_and_drawn_once(panels, tmp_path, monkeypatch):
    calls = []
    drawn, laid = Figure.draw, ConstrainedLayoutEngine.execute
    monkeypatch.setattr(Figure, "draw", lambda *a: (calls.append("draw"), drawn(*a)))
    monkeypatch.setattr(
        ConstrainedLayoutEngine, "execute", lambda *a: (calls.append("layout"), laid(*a))
    )
    canvas.save(panels[0], tmp_path / "two.png")
    assert calls == ["layout", "draw"]


def test_a_picture_is_the_one_that_matplotlib_saves(panels, tmp_path):
    canvas.save(panels[0], tmp_path / "two.png")
    whole = io.BytesIO()
    panels[0].figure.savefig(whole, dpi=canvas.RESOLUTION, format="png")
    with Image.open(tmp_path / "two.png") as found, Image.open(whole) as expected:
        assert found.info["dpi"] == pytest.approx(expected.info["dpi"])
        assert np.array_equal(np.asarray(found), np.asarray(expected.convert("RGB")))


def test_other_kinds_of_files_are_left_to_matplotlib(panels, tmp_path):
    canvas.save(panels[0], tmp_path / "two.svg")
    assert (tmp_path / "two.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize(
    ("names", "rows"), [(["a"], 1), (["branch 1"] * 4, 1), (["branch"] * 9, 2)]
)
def test_a_legend_never_lies_on_the_axis_label(names, rows, tmp_path):
    from matplotlib.lines import Line2D

    (axes,) = canvas.axes_grid(1, 1, 3.0)
    canvas.frame_plane(axes, np.array([[0.0, 0.0], [2.0, 1.0]]), "a title")
    canvas.legend_below(axes, [Line2D([], [], label=name) for name in names])
    canvas.finished(axes, tmp_path / "one.png", fit=True)
    legend, label = axes.get_legend().get_window_extent(), axes.xaxis.label.get_window_extent()
    assert not legend.overlaps(label)
    assert axes.figure.bbox.containsx(legend.x0)
    assert axes.title.get_window_extent().y1 <= axes.figure.bbox.y1
    assert len({text.get_window_extent().y0 for text in axes.get_legend().get_texts()}) == rows
