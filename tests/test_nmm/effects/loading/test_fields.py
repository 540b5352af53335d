"""Tractions, forces on volume and displacements given as fields: exact solutions from scenes."""

from collections import Counter

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of

PLATE = """
title = "plate"
plane = "stress"
[materials.steel]
young_modulus = 1000.0
poisson_ratio = {nu}
[[blocks]]
name = "plate"
material = "steel"
vertices = [[1, -1], [3, -1], [3, 1], [1, 1]]
[[monitors]]
name = "inside"
point = [2.3, 0.4]
[[monitors]]
name = "corner"
point = [3, 1]
{more}
[formulation.cover]
type = "{cover}"
size = 0.7
degree = {degree}
[formulation.supports]
method = "{method}"
"""
# sxx = 6 y: u = 6 x y / E, v = -3 (x^2 + nu y^2) / E.
BENDING = """
[[supports]]
name = "left"
segment = [[1, -1], [1, 1]]
fix = ["x", "y"]
field = ["6*x*y/1000", "-3*(x**2 + 0.3*y**2)/1000"]
[[loads]]
name = "right"
kind = "edge"
segment = [[3, -1], [3, 1]]
field = {field}
"""
# u = x^2 y / 1000, nu = 0: sxx = 2 x y, sxy = x^2 / 2; force on volume (-2 y, -x).
VOLUME = """
[[supports]]
name = "edges"
block = "plate"
fix = ["x", "y"]
field = ["x**2*y/1000", "0"]
[[loads]]
name = "inside"
kind = "body"
field = ["-2*y", "-x"]
"""


def plate(more, cover="quads", degree=1, method="nitsche", nu=0.3):
    return PLATE.format(more=more, cover=cover, degree=degree, method=method, nu=nu)


def ends(run, monitor):
    return np.array([run.history[f"monitor:{monitor}:u{axis}"][-1] for axis in "xy"])


def bent(x, y):
    return np.array([6 * x * y, -3 * (x**2 + 0.3 * y**2)]) / 1000


@pytest.mark.parametrize("method", ["nitsche", "lagrange"])
@pytest.mark.parametrize("cover", ["quads", "triangles"])
@pytest.mark.parametrize("table", [False, True], ids=["expressions", "table along the edge"])
def test_pure_bending_from_a_scene_alone_is_exact_in_covers_that_hold_it(cover, method, table):
    more = BENDING.format(field='"sides"' if table else '["6*y", "0"]')
    if table:
        more += "[fields.sides]\nrows = [[3, -1, -6, 0], [3, 0.3, 1.8, 0], [3, 1, 6, 0]]\n"
    run = nmm.run(nmm.parse_scene(plate(more, cover, 2 if cover == "triangles" else 1, method)))
    assert run.summary.status == "converged"
    # Quads of degree 1 hold complete quadratics; rounding of the penalty terms.
    assert ends(run, "inside") == pytest.approx(bent(2.3, 0.4), abs=1e-9)
    assert ends(run, "corner") == pytest.approx(bent(3, 1), abs=1e-9)
    assert abs(run.summary.energy_balance) < 1e-6


def test_a_manufactured_solution_from_a_scene_alone_is_exact():
    run = nmm.run(nmm.parse_scene(plate(VOLUME, "triangles", degree=2, nu=0.0)))
    assert ends(run, "inside") == pytest.approx([2.3**2 * 0.4 / 1000, 0], abs=1e-9)


def test_a_table_over_triangles_and_times_is_linear_between_them():
    from nmm.effects.loading.fields import ValueTable
    from nmm.scene.tables.loading.fields import FieldTable

    places = [(0, 0), (2, 0), (0, 2), (2, 2)]
    rows = [(t, x, y, t * (x + 2 * y), -t) for t in (0, 1, 3) for x, y in places]
    table = ValueTable.of(FieldTable(rows=rows, scale=10))
    points = np.array([[0.5, 0.25], [1.9, 1.0]])
    expected = 10 * 2 * np.stack([points @ [1, 2], [-1, -1]], axis=1)
    assert table.values(points, 2.0) == pytest.approx(expected)
    assert table.values(points, 9.0) == pytest.approx(1.5 * expected)
    assert np.isnan(table.values(np.array([[3.0, 0.0]]), 1.0)).all()


def test_a_field_of_constants_is_the_load_of_the_same_numbers():
    hold = BENDING.split("[[loads]]")[0].replace(
        '"6*x*y/1000", "-3*(x**2 + 0.3*y**2)/1000"', "0, 0"
    )
    load = '[[loads]]\nname = "right"\nkind = "edge"\nsegment = [[3, -1], [3, 1]]\n'
    runs = [
        nmm.run(nmm.parse_scene(plate(hold + load + key + " = [3.0, -1.0]\n")))
        for key in ("field", "traction")
    ]
    assert runs[0].displacement == pytest.approx(runs[1].displacement, abs=1e-12)


def test_a_file_of_columns_gives_the_field(tmp_path):
    (tmp_path / "sides.csv").write_text("x, y, tx, ty\n3, -1, -6, 0\n3, 1, 6, 0\n")
    more = BENDING.format(field='"sides"') + '[fields.sides]\nfile = "sides.csv"\n'
    (tmp_path / "s.toml").write_text(plate(more))
    run = nmm.run(nmm.read_scene(tmp_path / "s.toml"))
    assert ends(run, "corner") == pytest.approx(bent(3, 1), abs=1e-9)


def held(load, cover='type = "block"'):
    """Resultant of a load on a plate of 2 m that is held on its left, from its reactions."""
    hold = BENDING.split("[[loads]]")[0].replace(
        '"6*x*y/1000", "-3*(x**2 + 0.3*y**2)/1000"', "0, 0"
    )
    text = plate(hold + load).split("[formulation.cover]")[0] + f"[formulation.cover]\n{cover}\n"
    run = nmm.run(nmm.parse_scene(text))
    found = [-run.history[f"reaction:left:{axis}"][-1] for axis in "xy"]
    return found, run.summary.warnings


@pytest.mark.parametrize("cover", ['type = "block"', 'type = "triangles"\nsize = 0.7\ndegree = 2'])
@pytest.mark.parametrize(
    ("field", "expected"),
    [
        ('["where(y > 0.3, 2.0, 0)", "sin(9*y) + 1"]', (1.4, 2.0)),
        ('["exp(-200*(y - 0.2)**2)", "abs(y - 0.1)"]', (np.sqrt(np.pi / 200), 1.01)),
        ('"knots"', (0.35, -1.0)),
    ],
)
def test_a_traction_that_jumps_waves_or_bends_within_an_edge_has_its_integral(
    field, expected, cover
):
    # Triangles over 0.7 m, of height 1, between knots; 1e-8 leaves room for rounding of supports.
    load = '[[loads]]\nname = "right"\nkind = "edge"\nsegment = [[3, -1], [3, 1]]\n'
    table = "[fields.knots]\nrows = [[3, -1, 0, 0], [3, -0.8, 0, -2.5], [3, -0.2, 0, 0], "
    table += "[3, -0.1, 1, 0], [3, 0.5, 0, 0], [3, 1, 0, 0]]\n"
    found, told = held(f"{load}field = {field}\n" + (table if "knots" in field else ""), cover)
    assert found == pytest.approx(expected, abs=1e-7)
    assert not told


def test_a_force_on_volume_that_jumps_within_a_block_has_its_integral():
    # Above a slanting line 0.4 m over the middle of the plate lie 2 - 0.8 of its 4 m2.
    load = (
        '[[loads]]\nname = "part"\nkind = "body"\nfield = ["where(y > 0.3*x - 0.2, 1, 0)", "0"]\n'
    )
    found, told = held(load)
    assert found == pytest.approx((1.2, 0.0), abs=1e-4)
    assert not told


def test_a_jump_that_moves_with_the_load_factor_within_an_edge_is_told():
    load = '[[loads]]\nname = "front"\nkind = "edge"\nsegment = [[3, -1], [3, 1]]\n'
    _, told = held(load + 'field = ["where(y < 0.7*t, 1.0, 0)", "0"]\n')
    assert any("[[loads]] front may be off by" in one for one in told)


@pytest.mark.parametrize("cover", ["quads", "triangles"])
def test_field_loads_keep_what_every_effect_promises(cover):
    more = BENDING.format(field='["6*y", "0"]') + VOLUME.split("[[supports]]")[0]
    more += '[[loads]]\nname = "weight"\nkind = "body"\nfield = ["x*y", "-sin(x)"]\n'
    check_effect_of(nmm.parse_scene(plate(more, cover)), "field loads")
    check_effect_of(nmm.parse_scene(plate(more, cover)), "supports")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ('["6*y", "0"]', '["6*z", "0"]', 'the name "z": expected an expression of x, y, t'),
        ('["6*y", "0"]', '["6*y"]', "expected two expressions of x, y, t, or the name"),
        ('["6*y", "0"]', '"side"', '"side": expected the name of one of [fields.NAME]'),
        ('["6*y", "0"]', '["6*y", "0"]\ntraction = [1, 1]', "expected traction or field, as kind"),
        ('fix = ["x", "y"]\nfield', 'fix = ["x", "y"]\ndisplacement = [1, 0]\nfield', "one of the"),
    ],
)
def test_wrong_fields_are_told_by_line(old, new, said):
    text = plate(BENDING.format(field='["6*y", "0"]'))
    assert old in text
    with pytest.raises(SceneError) as caught:
        nmm.parse_scene(text.replace(old, new, 1), "s.toml")
    assert said in str(caught.value)
    assert str(caught.value).startswith("s.toml:")


def test_a_field_that_is_infinite_somewhere_is_refused_with_the_place():
    with pytest.raises(SceneError, match=r"\[\[loads\]\] right: field is \[inf, 0.0\] at \(3"):
        nmm.run(nmm.parse_scene(plate(BENDING.format(field='["1/(x - 3)", "0"]'))))


def test_a_field_of_driven_ground_is_evaluated_once_for_an_instant(monkeypatch):
    from nmm.effects.loading import fields

    hold = BENDING.split("[[loads]]")[0].replace(
        '"6*x*y/1000", "-3*(x**2 + 0.3*y**2)/1000"', '"y*sin(t)**2/100", "0"'
    )
    text = plate(hold).replace('"stress"', '"stress"\nduration = 0.1\n[inertia]')
    text = text.replace("= 0.3\n", "= 0.3\ndensity = 1.0\n", 1)
    text += '[formulation.integrator]\ntype = "newmark"\nstep = 0.017\n'
    evaluated, at = fields.evaluated, Counter()

    def counted(expression, points, time):
        at[expression.text, round(time, 9)] += 1
        return evaluated(expression, points, time)

    monkeypatch.setattr(fields, "evaluated", counted)
    run = nmm.run(nmm.parse_scene(text))
    times = [round(time, 9) for time in run.history["time"]]
    assert len(times) > 5
    # The first and the last instant are those of the check before a run too.
    assert {at["y*sin(t)**2/100", time] for time in times[1:-1]} == {1}


STRIP = """
title = "strip load on a half plane"
plane = "strain"
[materials.soil]
young_modulus = 1000.0
poisson_ratio = 0.3
[[blocks]]
name = "soil"
material = "soil"
vertices = [[-4, -4], [4, -4], [4, 0], [-4, 0]]
[[loads]]
name = "strip"
kind = "edge"
segment = [[1, 0], [-1, 0]]
traction = [0, -1]
{cuts}
[[supports]]
name = "pin"
point = [0, -4]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [-4, -4]
fix = ["y"]
[formulation.cover]
type = "{cover}"
size = 0.3
degree = {degree}
"""
CUT = """
[[loads]]
name = "{name}"
kind = "edge"
segment = {segment}
field = ["{x}", "{y}"]
"""
# Angles from the vertical to both ends of the strip |x| < 1 (Boussinesq 1885).
LEFT, RIGHT = "atan2(x + 1, -y)", "atan2(x - 1, -y)"
BOTH = f"(sin(2*{LEFT}) - sin(2*{RIGHT}))/2"
SXX = f"-({LEFT} - {RIGHT} - {BOTH})/pi"
SYY = f"-({LEFT} - {RIGHT} + {BOTH})/pi"
SXY = f"(cos(2*{RIGHT}) - cos(2*{LEFT}))/2/pi"


@pytest.mark.parametrize(("cover", "degree"), [("triangles", 1), ("bspline", 0)])
def test_a_piece_of_a_half_plane_under_a_strip_load_has_the_stress_of_boussinesq(cover, degree):
    cuts = [
        ("right", [[4, -4], [4, 0]], SXX, SXY),
        ("left", [[-4, 0], [-4, -4]], f"-({SXX})", f"-({SXY})"),
        ("below", [[-4, -4], [4, -4]], f"-({SXY})", f"-({SYY})"),
    ]
    edges = "".join(CUT.format(name=n, segment=s, x=x, y=y) for n, s, x, y in cuts)
    run = nmm.run(nmm.parse_scene(STRIP.format(cuts=edges, cover=cover, degree=degree)))
    # Tractions of the half plane hold the piece in balance: nothing is left to the supports.
    reactions = [h[-1] for name, h in run.history.items() if name.startswith("reaction:")]
    assert np.abs(reactions).max() < 1e-4
    x, y = run.manifold.elements.centroids.T
    left, right = np.arctan2(x + 1, -y), np.arctan2(x - 1, -y)
    mean, both = left - right, (np.sin(2 * left) - np.sin(2 * right)) / 2
    shear = (np.cos(2 * right) - np.cos(2 * left)) / 2
    exact = -np.stack([mean - both, mean + both, -shear], axis=1) / np.pi
    # Below 0.7 m cells of 0.3 m are a seventh of the distance from the ends of the strip and more,
    # and errors of order two.
    deep = y < -0.7
    assert np.abs(run.stress - exact)[deep].max() < 1e-2
    middle = np.argmin(np.hypot(x, y + 1))
    assert run.stress[middle, 1] == pytest.approx(exact[middle, 1], abs=3e-3)
