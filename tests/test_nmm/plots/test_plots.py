"""Pictures: what they hold, by the artists drawn and the numbers behind them."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
import shapely
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import nmm
from integration.polygons import Polygons
from nmm import parse_scene, plots
from nmm.contact.problem.contact_state import ContactState
from nmm.errors import NmmError
from nmm.plots.edges import cracks, opened_on_several, outlines, segments
from nmm.plots.results.broken import broken_parts, edge_parts
from nmm.plots.results.compared import DrawnRun
from nmm.plots.results.comparison import comparison
from nmm.plots.results.deformed import BROKEN, visible
from nmm.plots.results.stress import measure, scale_end
from nmm.plots.shapes import fill
from nmm.plots.time_shares import by_phase
from nmm.plots.units import prefixed, words_of
from nmm.results import MemorySink, Topology
from nmm.verification import text

SCENE = """
title = "beam"
plane = "stress"
[materials.concrete]
law = "elastic"
young_modulus = 27.5e9
poisson_ratio = 0.2
[[blocks]]
material = "concrete"
vertices = [[0, 0], [0.4, 0], [0.4, 0.1], [0, 0.1]]
[[supports]]
name = "left"
point = [0.05, 0]
fix = ["x", "y"]
[[supports]]
name = "right"
point = [0.35, 0]
fix = ["y"]
[[loads]]
name = "jack"
kind = "point"
point = [0.2, 0.1]
force = [0, -1000]
"""


def is_png(path):
    return path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


def rgb(colour):
    from matplotlib.colors import to_rgb

    return to_rgb(colour)


def lines_of_colour(axes, colour):
    from matplotlib.collections import LineCollection

    found = [c for c in axes.collections if isinstance(c, LineCollection)]
    return [
        s for c in found if tuple(c.get_color()[0][:3]) == rgb(colour) for s in c.get_segments()
    ]


@pytest.mark.parametrize(
    "draw",
    [
        plots.blocks,
        plots.deformed,
        plots.failure_mode,
        plots.stress,
        plots.contact_forces,
        plots.overview,
        lambda run, path: plots.curve(run, "monitor:middle:uy", path=path),
        lambda run, path: plots.history(run, ["bonded", "broken"], path=path),
    ],
)
def test_each_picture_is_written_as_png(draw, memory_run, tmp_path):
    draw(memory_run, path=tmp_path / "new/picture.png")
    assert is_png(tmp_path / "new/picture.png")


def test_pictures_of_the_plane_have_equal_axes_units_and_a_title(memory_run):
    for axes in (
        plots.blocks(memory_run),
        plots.deformed(memory_run),
        plots.stress(memory_run),
        plots.contact_forces(memory_run),
    ):
        assert axes.get_aspect() == 1.0
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("x  (m)", "y  (m)")
        assert axes.get_title(loc="left")


def test_a_given_axes_is_drawn_into(memory_run):
    from matplotlib.figure import Figure

    axes = Figure().subplots()
    assert plots.stress(memory_run, ax=axes) is axes


def test_blocks_have_the_colours_of_their_materials(memory_run):
    axes = plots.blocks(memory_run)
    faces = axes.collections[0].get_facecolor()
    material = memory_run.topologies[0].element_material
    assert len(np.unique(faces, axis=0)) == 2
    assert len(np.unique(faces[material == 1], axis=0)) == 1
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["concrete", "mortar"]


def test_supports_and_loads_are_drawn_inside_the_limits(memory_run):
    axes = plots.blocks(memory_run, scene=parse_scene(SCENE))
    assert [line.get_marker() for line in axes.lines] == ["^", "o"]
    tip, tail = axes.texts[0].xy, axes.texts[0].xyann
    assert tip == pytest.approx((0.2, 0.1))
    assert tail[1] > 0.1  # pushes from above
    assert axes.get_ylim()[1] > tail[1]
    assert axes.get_ylim()[0] < axes.lines[0].get_ydata()[0] < 0


def test_the_crack_is_marked_on_both_its_faces(memory_run):
    axes = plots.deformed(memory_run, magnification=1.0)
    marks = lines_of_colour(axes, BROKEN[1])
    length = shapely.union_all(shapely.linestrings(np.round(marks, 12))).length
    frame = memory_run.frames[-1]
    crack = frame.contact_length[frame.contact_state == ContactState.BROKEN].sum()
    # two faces; the faces differ from the joints by the rotation of 6e-4 only
    assert length == pytest.approx(2 * crack, rel=1e-3)


def test_nothing_is_marked_before_failure(memory_run):
    axes = plots.deformed(memory_run, frame=0)
    assert not lines_of_colour(axes, BROKEN[1])


def two_squares(state, position, length):
    """Two unit squares side by side and one contact between them."""
    elements = Polygons.from_vertices(
        [[[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 0], [2, 0], [2, 1], [1, 1]]]
    )
    from nmm.results import Frame

    zero = np.zeros_like(elements.points)
    frame = Frame(
        index=0,
        time=0.0,
        load_factor=1.0,
        stage="load",
        points=elements.points,
        displacement=zero,
        velocity=zero,
        stress=np.zeros((2, 3)),
        contact_position=np.array([position]),
        contact_normal=np.array([[1.0, 0.0]]),
        contact_length=np.array([length]),
        contact_force=np.zeros((1, 2)),
        contact_gap=np.zeros(1),
        contact_state=np.array([state]),
    )
    return elements, frame


@pytest.mark.parametrize(
    ("y", "expected"),
    [
        (0.0, (0.0, 0.5)),  # a corner speaks for its half of the joint
        (1.0, (0.5, 1.0)),
        (0.2113248654, (0.0, 0.4613248654)),  # a Gauss point for half its length to both sides
    ],
)
def test_a_contact_point_marks_its_part_of_the_joint(y, expected):
    elements, frame = two_squares(ContactState.SLIDE, [1.0, y], 0.5)
    parts = edge_parts(frame, elements, ContactState.SLIDE).on(elements)
    assert len(parts) == 2
    for part in parts:
        assert part[:, 0] == pytest.approx([1.0, 1.0])
        assert sorted(part[:, 1]) == pytest.approx(expected)


@pytest.mark.parametrize("state", [ContactState.OPEN, ContactState.STICK, ContactState.BONDED])
def test_contacts_that_never_held_are_not_broken(state):
    elements, frame = two_squares(state, [1.0, 0.0], 0.5)
    topology = Topology(elements, np.arange(2), np.zeros(2, dtype=np.int64), ("rock",))
    assert len(broken_parts([frame], topology, frame).point) == 0


def test_a_bond_that_is_no_longer_among_the_contacts_is_broken():
    elements, bonded = two_squares(ContactState.BONDED, [1.0, 0.0], 0.5)
    topology = Topology(elements, np.arange(2), np.zeros(2, dtype=np.int64), ("rock",))
    gone = {name: value[:0] for name, value in vars(bonded).items() if name.startswith("contact_")}
    later = replace(bonded, index=1, **gone)
    parts = broken_parts([later, bonded, later], topology, later).on(elements)
    assert len(parts) == 2
    for part in parts:
        assert sorted(part[:, 1]) == pytest.approx([0.0, 0.5])


def test_a_contact_without_a_length_is_marked_by_a_dot():
    elements, frame = two_squares(ContactState.SLIDE, [1.0, 0.25], 0.0)
    run = MemorySink()
    run.topologies = [Topology(elements, np.arange(2), np.zeros(2, dtype=np.int64), ("rock",))]
    run.frames = [frame]
    axes = plots.deformed(run, magnification=1.0)
    assert {tuple(point) for point in axes.lines[0].get_xydata()} == {(1.0, 0.25)}


def test_the_magnification_makes_small_displacements_visible(memory_run):
    topology = memory_run.topologies[0]
    frame = memory_run.frames[1]
    largest = np.hypot(*frame.displacement.T).max()
    factor = visible(frame, topology)
    assert 0.02 < factor * largest / np.hypot(0.4, 0.1) <= 0.05
    assert visible(replace(frame, displacement=1e4 * frame.displacement), topology) == 1.0
    assert visible(replace(frame, displacement=0 * frame.displacement), topology) == 1.0


def test_a_hole_stays_open():
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    outer, hole = [[0, 0], [3, 0], [3, 3], [0, 3]], [[1, 1], [2, 1], [2, 2], [1, 2]]
    canvas = FigureCanvasAgg(Figure(figsize=(1, 1), dpi=30))
    axes = canvas.figure.add_axes((0, 0, 1, 1), xlim=(0, 3), ylim=(0, 3))
    axes.set_axis_off()
    fill(axes, Polygons.from_rings([[outer, hole]]), facecolors="black")
    canvas.draw()
    red = np.asarray(canvas.buffer_rgba())[:, :, 0]
    assert red[15, 5] == 0
    assert red[15, 15] == 255


def test_outlines_leave_out_the_edges_inside_a_region():
    elements = Polygons.from_vertices(
        [[[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 0], [2, 0], [2, 1], [1, 1]]]
    )
    material = np.zeros(2, dtype=np.int64)
    one = Topology(elements, np.array([0, 0]), material[:1], ("rock",))
    two = Topology(elements, np.array([0, 1]), material, ("rock",))
    assert (len(outlines(one)), len(outlines(two))) == (6, 8)


# Two squares side by side, and a triangle above both, whose lower edge their common corner divides:
# where the squares come apart, that corner is the tip of a crack.
TIP = Polygons.from_vertices(
    [[[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 0], [2, 0], [2, 1], [1, 1]], [[0, 1], [2, 1], [1, 2]]]
)


def at_a_tip(memory_run, jump):
    """Topology of one region, and a frame in which the two lower elements are apart by a jump."""
    topology = Topology(TIP, np.zeros(3, int), np.zeros(1, int), ("rock",))
    move = np.zeros_like(TIP.points)
    move[:, 1] = 0.3 * TIP.points[:, 0]
    move[4:8, 0] += jump * (1 - TIP.points[4:8, 1])  # nothing at the upper end, the tip
    return topology, replace(memory_run.frames[0], points=TIP.points + move, displacement=move)


def test_an_edge_that_the_tip_of_a_crack_divides_is_no_outline(memory_run):
    topology, _ = at_a_tip(memory_run, 0.1)
    drawn = {tuple(TIP.points[n]) for n in outlines(topology)}
    # Five outer edges and the two slopes above remain; the line y = 1 and the crack are inside.
    assert len(outlines(topology)) == 6 + 2 - 2
    assert drawn == {(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (1, 2)}


@pytest.mark.parametrize(("jump", "faces"), [(0.1, 2), (1e-4, 2), (0.0, 0)])
def test_a_crack_is_told_by_the_jump_across_its_faces(memory_run, jump, faces):
    topology, frame = at_a_tip(memory_run, jump)
    found = cracks(topology, frame)
    assert len(found) == faces
    assert all(TIP.points[n][0] == 1 for n in found)


@pytest.mark.parametrize(("jump", "faces"), [(0.1, 3), (0.0, 0)])
def test_faces_that_lay_on_several_are_told_once_they_part(memory_run, jump, faces):
    topology, frame = at_a_tip(memory_run, 0.0)
    move = frame.displacement.copy()
    move[8:, 1] += jump  # the triangle goes up, from two squares
    found = opened_on_several(topology, replace(frame, displacement=move))
    assert len(found) == faces
    ends = segments(TIP, found)
    assert (ends[..., 1] == 1).all()


def test_the_initial_picture_shows_cracks_of_runs_in_which_they_grow(memory_run):
    topology, frame = at_a_tip(memory_run, 0.1)
    sink = MemorySink()
    sink.topologies = [topology, topology]
    sink.frames = [frame, replace(frame, topology=1)]
    axes = plots.blocks(sink)
    drawn = [
        tuple(np.sort(one[:, 1]))
        for c in axes.collections[1:]
        for one in c.get_segments()
        if (one[:, 0] == 1).all()
    ]
    assert (0.0, 1.0) in drawn


def test_one_sliver_does_not_set_the_colours():
    areas = np.array([1.0] * 100 + [1e-6])
    even = np.linspace(1, 2, 101)
    assert scale_end(even, areas) == (2.0, 0.0)
    peaked = np.append(even[:100], 500.0)
    end, beyond = scale_end(peaked, areas)
    assert 1.9 < end < 2  # what the hundred cells need
    assert beyond == pytest.approx(1e-8, rel=0.01)
    assert scale_end(np.append(even[:99], [500.0, 1.0]), areas)[0] == 500  # 1 % of the area counts
    assert scale_end(np.zeros(101), areas) == (1.0, 0.0)


def test_a_scale_that_is_cut_says_so_and_how_much(memory_run):
    cells = Polygons.from_vertices([[[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 0], [1.002, 0], [1, 1]]])
    still = np.zeros_like(cells.points)
    sink = MemorySink()
    sink.topologies = [Topology(cells, np.zeros(2, int), np.zeros(1, int), ("rock",))]
    stress = np.array([[1.0, 0, 0], [-50.0, 0, 0]])
    frame = replace(memory_run.frames[1], points=cells.points, displacement=still, stress=stress)
    sink.frames = [frame]
    axes = plots.stress(sink, "xx")
    (bar,) = [one for one in axes.figure.axes if one is not axes]
    assert bar.get_ylabel().endswith("\n0.1 % of the area beyond, up to 50")
    assert axes.collections[0].get_clim() == (-1.0, 1.0)


def test_stress_measures_of_known_states():
    pure_shear, tension = np.array([[0.0, 0.0, 1.0]]), np.array([[2.0, 0.0, 0.0]])
    assert measure(pure_shear, "mises") == pytest.approx(np.sqrt(3))
    assert measure(pure_shear, "major") == pytest.approx(1)
    assert measure(pure_shear, "minor") == pytest.approx(-1)
    assert measure(tension, "mises") == pytest.approx(2)
    with pytest.raises(NmmError, match="component 'zz': expected one of mises"):
        measure(tension, "zz")


def test_the_colour_bar_has_a_unit(memory_run):
    axes = plots.stress(memory_run, "xx")
    assert axes.figure.axes[1].get_ylabel() == "stress xx  (MPa)"


@pytest.mark.parametrize(
    ("values", "unit", "expected"),
    [([2e-5], "m", "µm"), ([0.3], "m", "mm"), ([5.0], "m", "m"), ([3e6], "Pa", "MPa")],
)
def test_prefixes_bring_numbers_between_one_and_a_thousand(values, unit, expected):
    factor, found = prefixed(np.array(values), unit)
    assert found == expected
    assert 1 <= factor * values[0] < 1000


def test_seconds_are_not_gathered_to_kiloseconds():
    assert prefixed(np.array([5000.0]), "s") == (1.0, "s")


def test_a_monitor_is_named_in_words():
    assert words_of("monitor:tip:ux") == "ux of tip"


def test_a_quantity_that_is_drawn_in_place_of_stress_has_one_picture_of_its_name(tmp_path):
    tables = [
        text.material("rock", density=None) + "conductivity = 2.0\nthermal_expansion = 1e-5\n",
        text.box("block", (0, 0), (2, 1)),
        text.fixed_edge("left", [(0, 0), (0, 1)]),
        '[heat]\n[[temperatures]]\nname = "warm"\nblock = "block"\ntemperature = 10.0\n',
    ]
    run = nmm.run(nmm.parse_scene(text.scene('plane = "stress"\n', tables)))
    drawn = plots.draw_all(run, tmp_path, component="heat:temperature")
    assert [path.name for path in drawn if "temperature" in path.name] == ["heat_temperature.png"]
    assert not [path for path in drawn if path.name.startswith("stress")]


def test_a_block_that_is_held_as_a_whole_is_hatched(memory_run):
    held = '[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1]]\n'
    support = '[[supports]]\nname = "s"\nblock = "b"\nfix = ["x", "y"]\n'
    matter = "[materials.m]\nyoung_modulus = 1.0\npoisson_ratio = 0.0\n"
    scene = parse_scene('plane = "strain"\n' + matter + held + support)
    hatched = [one for one in plots.blocks(memory_run, scene=scene).patches if one.get_hatch()]
    assert [one.get_xy()[:3].tolist() for one in hatched] == [[[0, 0], [1, 0], [1, 1]]]


def test_bars_of_phases_hold_all_of_the_time():
    """Audits, a third of a small run, were left out of its bar; so were phases without a colour."""
    axes = Figure().subplots()
    by_phase(axes, {"run": {"covers": 1.0, "audits": 2.0, "bound": 3.0, "rest": 4.0}})
    widths = [bar.get_width() for bar in axes.patches]
    assert sum(widths) == pytest.approx(100.0)
    assert max(widths) == pytest.approx(70.0)  # the rest, with what is seldom


def test_numbers_beside_a_flat_picture_do_not_cover_each_other():
    rng = np.random.default_rng(0)
    none = np.zeros((0, 2))
    runs = [
        DrawnRun(name, "DDA", "block", *rng.random((2, 20, 200)), none, none, [], none, none)
        for name in ("one", "other")
    ]
    panels = comparison(runs, [], np.array([[0.0, 0.0], [2.0, 0.2]]))
    FigureCanvasAgg(panels[0].figure.figure).draw()
    boxes = [tick.label1.get_window_extent() for tick in panels[0].yaxis.get_major_ticks()]
    seen = sorted((box.y0, box.y1) for box in boxes)
    assert all(low[1] < high[0] for low, high in pairwise(seen))


def test_differences_that_are_rounding_have_no_picture():
    """A ramp to 1 m beside the same but for 1e-16 of it: noise would fill its picture."""
    ramp, none = np.linspace(0.0, 1.0, 100).reshape(10, 10), np.zeros((0, 2))
    run = DrawnRun("one", "DDA", "block", ramp, ramp, none, none, [], none, none)
    noise = 1e-16 * np.random.default_rng(0).choice([-1.0, 1.0], (10, 10))
    panels = comparison([run, run], [(noise, noise)], np.array([[0.0, 0.0], [1.0, 1.0]]))
    images = [one.images[0] for one in panels if one.images]
    shade = [np.abs(image.norm(image.get_array()) - 0.5).max() for image in images]
    # Displacement twice, its difference, stress twice, its difference: noise is white.
    assert len(shade) == 6
    assert max(shade[2], shade[5]) < 1e-6


@pytest.mark.parametrize("draw", [plots.deformed, plots.stress, plots.contact_forces])
def test_a_frame_that_is_not_there_is_refused_and_so_is_what_is_no_run(draw, memory_run):
    with pytest.raises(NmmError, match=r"frame 77: expected one of the 4 frames .* from 0 to 3"):
        draw(memory_run, frame=77)
    with pytest.raises(TypeError, match=r"'runs/a': expected a run: read a folder by nmm\.read"):
        draw("runs/a")
