"""Formulations side by side at common points."""

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from integration.polygons import Polygons
from nmm.cli.app import app
from nmm.study.cases.variants import StudyCase
from nmm.study.comparison.drawing import curve_columns, heading
from nmm.study.comparison.page import comparison_page, write_comparison
from nmm.study.comparison.runs import compare_cases, exit_code
from nmm.study.samples import elements_at, fields, raster
from nmm.verification import text

# With it a bar held along its end in x is under uniform tension, which every formulation holds
# exactly: sxx = 1e-3.
CORNER = """
[[supports]]
name = "corner"
point = [0, 0]
fix = ["y"]
"""
KINDS = {
    "DDA": nmm.Formulation(),
    "NMM": nmm.Formulation.model_validate({"cover": {"type": "triangles", "size": 0.7}}),
}


@pytest.fixture(scope="module")
def pulled(bar_text):
    return bar_text(fix='["x"]', more=CORNER)


@pytest.fixture(scope="module")
def bar(pulled):
    return nmm.scene.parse_scene(pulled)


def test_the_raster_keeps_what_lies_in_material():
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    hole = 0.5 + (square - 0.5)[::-1] / 2
    grid = raster(Polygons.from_rings([[square, hole]]), 400)
    assert len(grid.points) == pytest.approx(300, abs=25)  # area 3/4, the cells on the hole's edge
    image = grid.image(np.ones(len(grid.points)))
    assert np.nansum(image) == len(grid.points)
    assert np.isnan(image[10, 10])


def test_points_outside_are_in_no_element():
    squares = Polygons.from_vertices([np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])] * 2)
    assert elements_at(squares, np.array([[0.5, 0.5], [2, 2]])).tolist() == [0, -1]


@pytest.mark.parametrize("name", KINDS)
def test_fields_of_uniform_tension_are_exact(bar, name):
    points = np.array([[0.3, 0.2], [3.1, 0.9], [9, 9]])
    found = fields(nmm.run(bar, KINDS[name]), points)
    # The springs of the supports give way by 1e-3 of the stretch at most.
    assert found.stress[:2] == pytest.approx(np.array([[1e-3, 0, 0]] * 2), abs=2e-6)
    assert found.displacement[1, 0] == pytest.approx(3.1e-3, rel=1e-2)
    assert found.mises[:2] == pytest.approx(1e-3, rel=2e-3)
    assert np.isnan(found.stress[2]).all()


def test_fields_of_a_bar_far_from_the_origin_are_those_beside_it(bar, pulled):
    # Runs count from an origin of their own there.
    far = pulled.replace("[0, 0]", "[50, 0]").replace("[0, 1]", "[50, 1]")
    far = nmm.scene.parse_scene(far.replace("[4, ", "[54, "))
    points = np.array([[0.3, 0.2], [3.1, 0.9], [9, 9]])
    here, there = fields(nmm.run(bar), points), fields(nmm.run(far), points + np.array([50, 0]))
    np.testing.assert_allclose(there.displacement, here.displacement, rtol=1e-9, atol=1e-15)
    np.testing.assert_allclose(there.stress, here.stress, rtol=1e-9, atol=1e-15)


def test_the_page_holds_table_differences_and_faults(bar, tmp_path):
    broken = nmm.Formulation.model_validate({"cover": {"functions": "none_such"}})
    cases = [StudyCase(name, bar, kind) for name, kind in {**KINDS, "broken": broken}.items()]
    study = compare_cases(cases, memory=False)
    files = write_comparison(study, tmp_path)
    assert [path.name for path in files] == ["compare.md", "compare.png"]
    page = comparison_page(study, "compare.png")
    assert "| family | DDA | manifold | DDA |" in page
    assert "NMM differs from DDA by" in page
    assert 'cover.functions: local functions: "none_such": expected one of' in page
    assert heading(study).splitlines()[-1] == "broken: not run"
    assert exit_code(study) == 1
    # energy of uniform tension, sigma^2 / (2 E) times the area
    energy = next(line for line in page.splitlines() if line.startswith("| elastic energy"))
    assert [float(cell) for cell in energy.split("|")[2:4]] == pytest.approx([2e-6] * 2, rel=1e-2)
    # All of the load in one increment.
    assert "| largest load factor | 1 | 1 | - |" in page


def test_the_verb_writes_the_page(tmp_path, pulled):
    scene, kind = tmp_path / "bar.toml", tmp_path / "b.toml"
    scene.write_text(pulled)
    kind.write_text('title = "quadratic"\n[cover]\nfunctions = "monomials"\ndegree = 2\n')
    (tmp_path / "a.toml").write_text("")
    words = ["compare", scene, tmp_path / "a.toml", kind, "--no-memory", "--out", tmp_path]
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    assert "| family | DDA | DDA |" in result.stdout
    assert (tmp_path / "compare.png").exists()


def test_points_where_one_scene_has_no_block_count_in_no_difference(tmp_path, bar_text):
    """A second bar, pulled three times as much, is no part of what half of the load differs by."""
    second = text.box("second", (0, 9), (4, 1), "m") + text.fixed_edge("foot", [(0, 9), (0, 10)])
    pull = (
        '[[loads]]\nname = "up"\nkind = "edge"\nsegment = [[4, 9], [4, 10]]\ntraction = [3e-3, 0]'
    )
    found = [(1e-3, CORNER + second + pull), (5e-4, CORNER)]
    scenes = [bar_text(fix='["x"]', traction=f"[{load}, 0]", more=more) for load, more in found]
    cases = [StudyCase(str(i), nmm.parse_scene(one), KINDS["DDA"]) for i, one in enumerate(scenes)]
    page = comparison_page(compare_cases(cases, memory=False), "compare.png")
    assert "1 differs from 0 by 50 % in displacement and 50 % in stress" in page


def test_scenes_of_one_case_are_columns_beside_each_other(tmp_path, bar_text):
    """Half of the load beside all of it: displacements differ by half, energies by a quarter."""
    whole, half = tmp_path / "whole.toml", tmp_path / "half.toml"
    for path, pull in ((whole, 1e-3), (half, 5e-4)):
        written = bar_text(fix='["x"]', traction=f"[{pull}, 0]", more=CORNER)
        path.write_text(f'{written}\n[formulation]\ntitle = "{path.stem}"\n')
    words = ["compare", whole, "--beside", half, "--no-memory", "--out", tmp_path]
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    assert "half differs from whole by 50 % in displacement and 50 % in stress" in result.stdout
    energy = next(x for x in result.stdout.splitlines() if x.startswith("| elastic energy"))
    one, other = (float(cell) for cell in energy.split("|")[2:4])
    assert other == pytest.approx(one / 4, rel=1e-3)


def test_scenes_without_a_monitor_in_common_are_compared_by_their_energy(tmp_path, bar_text):
    one, other = tmp_path / "one.toml", tmp_path / "other.toml"
    one.write_text(bar_text(more='[[monitors]]\nname = "end"\npoint = [1, 0.5]\n'))
    other.write_text(bar_text() + '[formulation]\ntitle = "other"\n')
    runs = [nmm.run(nmm.read_scene(place)) for place in (one, other)]
    assert curve_columns(runs)[1] == "strain_energy"
    assert curve_columns(runs[:1])[1].startswith("monitor:end:")


def test_a_scene_that_lies_elsewhere_is_a_fault_of_the_page(bar):
    held = [text.box("far", (50, 0), (1, 1)), text.fixed_edge("left", ((50, 0), (50, 1)))]
    far = nmm.scene.parse_scene(text.scene('plane = "stress"', [text.material("rock"), *held]))
    cases = [StudyCase(name, one, KINDS["DDA"]) for name, one in (("here", bar), ("far", far))]
    page = comparison_page(compare_cases(cases, memory=False), "compare.png")
    assert "- far: no block lies at the points that are compared: expected a scene of" in page


@pytest.mark.parametrize("turned", [False, True])
def test_a_run_that_ends_before_its_first_step_is_a_column_beside_the_others(bar, turned, tmp_path):
    spent = nmm.Formulation.model_validate({"loading": {"budget": 1e-9}})
    cases = [StudyCase("none", bar, spent), StudyCase("DDA", bar, KINDS["DDA"])]
    study = compare_cases(cases[::-1] if turned else cases, memory=False)
    write_comparison(study, tmp_path)
    ends = ("converged", "budget_spent") if turned else ("budget_spent", "converged")
    assert heading(study).splitlines()[-1] == "none: budget_spent"
    assert exit_code(study) == 3  # that of `nmm run`
    assert f"| verdict | {' | '.join(ends)} |" in (tmp_path / "compare.md").read_text()
