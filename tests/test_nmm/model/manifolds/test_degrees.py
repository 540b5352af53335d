"""Degrees that vary by region, from a formulation's text."""

from pathlib import Path

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.errors import field_errors
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.constraints.imposition import Method
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.geometry.tessellation.cover_types import highest_degree
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene import parse_scene
from nmm.stepping.drive.linear_statics import equilibrium, hold
from nmm.stepping.run import run
from nmm.testing.scenes import pulled_bar
from nmm.verification import text

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
COVER = '[cover]\ntype = "triangles"\nsize = 0.12\ndegree = {}\nangle = 0.3\nshift = [0.2, 0.4]\n'
NEAR = "[[cover.regions]]\ndegree = {}\npoint = [0, 0]\nradius = {}\n"
# A pole outside the corner (0, 0): the field is steep there and flat elsewhere.
POLE = -0.15 - 0.15j


def model_of(text: str, blocks: Polygons | None = None) -> Model:
    region = Polygons.from_vertices([SQUARE]) if blocks is None else blocks
    return solid(region, parse_formulation(text).cover, [Elastic(1.0, 0.3)], "stress")


def field(p: Floats) -> Floats:
    """(Re f, -Im f) of f = 1 / (z - pole)^2: no divergence and no rotation, so no body force."""
    f = 1 / (p[:, 0] + 1j * p[:, 1] - POLE) ** 2
    return np.stack([f.real, -f.imag], axis=1)


def strain(p: Floats) -> Floats:
    slope = -2 / (p[:, 0] + 1j * p[:, 1] - POLE) ** 3
    return np.stack([slope.real, -slope.real, -2 * slope.imag], axis=1)


def error(text: str) -> tuple[float, int]:
    """Relative error in energy and number of unknowns."""
    cover, model = parse_formulation(text).cover, model_of(text)
    place = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 12)
    method = Method("nitsche", cover.size, highest_degree(cover))
    found = equilibrium(model, [hold(model, place, method, field)])
    assert found.residual < 1e-10
    errors = field_errors(model, found.state.deformation, field, strain, 12)
    return errors.energy, model.manifold.n_unknowns


def test_a_higher_degree_where_the_field_is_steep_saves_most_of_the_unknowns() -> None:
    linear, few = error(COVER.format(1))
    local, some = error(COVER.format(1) + NEAR.format(2, 0.45))
    quadratic, many = error(COVER.format(2))
    # Measured 10.7 % with 732 unknowns, 2.37 % with 870, 2.35 % with 1464.
    assert local < 0.25 * linear
    assert local < 1.02 * quadratic
    assert some - few < 0.2 * (many - few)


def test_the_last_region_that_holds_a_cover_counts() -> None:
    text = COVER.format(0) + NEAR.format(3, 0.6) + NEAR.format(1, 0.3)
    manifold = model_of(text).manifold
    sizes = np.diff(manifold.cover_offset)
    assert sorted(np.unique(sizes).tolist()) == [2, 6, 20]
    plain = model_of(COVER.format(0) + NEAR.format(1, 0.3)).manifold
    assert (sizes == 6).sum() == (np.diff(plain.cover_offset) == 6).sum()


def test_a_polygon_and_a_block_choose_their_covers() -> None:
    half = "[[cover.regions]]\ndegree = 2\npolygon = [[0.5, 0], [1, 0], [1, 1], [0.5, 1]]\n"
    manifold = model_of(COVER.format(0) + half).manifold
    sizes, counts = np.unique(np.diff(manifold.cover_offset), return_counts=True)
    assert sizes.tolist() == [2, 12]
    # Half of the square, but for the column of covers that the line runs through.
    assert counts[1] == pytest.approx(manifold.n_covers / 2, rel=0.15)
    two = Polygons.from_vertices([SQUARE, SQUARE + np.array([1.5, 0.0])])
    block = '[[cover.regions]]\ndegree = 1\nblock = "#1"\n'
    right = model_of(COVER.format(0) + block, two).manifold
    linear = np.diff(right.cover_offset) == 6
    np.testing.assert_array_equal(linear, right.cover_body == 1)


SCENE = pulled_bar([text.material("m", 1.0, 0.3, None)], [("b", "m")])


def test_a_scene_runs_with_the_regions_of_its_formulation() -> None:
    scene = parse_scene(SCENE, "scene")
    corners = "".join(
        f"[[cover.regions]]\ndegree = 2\npoint = [0, {y}]\nradius = 0.3\n" for y in (0, 1)
    )
    ends = []
    for given in (COVER.format(1), COVER.format(1) + corners, COVER.format(2)):
        found = run(scene, parse_formulation(given))
        assert found.summary.status == "converged", found.summary.sentence
        ends.append(found.history["monitor:end:ux"][-1])
    # Two corners are all that a bar held at its end has: measured 0.983864, 0.984078, 0.984078.
    assert abs(ends[1] - ends[2]) < 0.02 * abs(ends[0] - ends[2])


TWO = pulled_bar(
    [text.material("stiff", 1.0, 0.45, None), text.material("m", 1.0, 0.3, None)],
    [("a", "stiff"), ("b", "m")],
    text.interface("any", 0.0, more={"cohesion": 1e9, "tensile_strength": 1e9, "bonded": True}),
    plane="strain",
    stress=0.3,
)


def test_a_higher_degree_may_stand_where_no_material_needs_pressures() -> None:
    """Pressures of the nearly incompressible block have fewer functions than the other block."""
    regions = '[[cover.regions]]\ndegree = 2\nblock = "b"\n[supports]\nmethod = "nitsche"\n'
    found = run(parse_scene(TWO, "scene"), parse_formulation(COVER.format(1) + regions))
    assert found.summary.status == "converged", found.summary.sentence
    # Equilibrium, to the rounding of a small system.
    assert found.history["reaction:left:x"][-1] == pytest.approx(-0.3, rel=1e-9)


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ("degree = 2", "expected one of polygon, block, point"),
        ('degree = 2\nblock = "b"\npoint = [0, 0]\nradius = 1', "expected one of polygon"),
        ("degree = 2\npoint = [0, 0]", "expected a point with a radius"),
        ('degree = 2\nblock = "b"\nradius = 1', "expected a point with a radius"),
        ("degree = 4\npoint = [0, 0]\nradius = 1", "expected a degree, 0 to 3"),
        ("point = [0, 0]\nradius = 1", "degree"),
        ("degree = 2\npoint = [0, 0]\nradius = 0", "> 0"),
        ("degree = 2\npolygon = [[0, 0], [1, 0]]", "three corners"),
        ("degree = 2\ncorner = [0, 0]", "unknown key"),
    ],
)
def test_a_bad_region_is_named_with_its_line(region: str, message: str) -> None:
    with pytest.raises(FormulationError, match=message) as caught:
        parse_formulation(COVER.format(1) + "[[cover.regions]]\n" + region, "f.toml")
    assert "f.toml:" in str(caught.value)
    assert "cover.regions" in str(caught.value)


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ("point = [3, 0]\nradius = 0.5", "no cover in it"),
        ('block = "c"', "no block of that name"),
        ("polygon = [[0, 0], [1, 1], [1, 0], [0, 1]]", "Self-intersection"),
        ("polygon = [[0, 0], [1, 1], [2, 2]]", "Self-intersection"),
    ],
)
def test_a_region_that_fits_no_cover_is_refused(region: str, message: str) -> None:
    text = COVER.format(1) + "[[cover.regions]]\ndegree = 2\n" + region
    with pytest.raises(FormulationError, match=message):
        model_of(text)


def test_blocks_have_no_regions() -> None:
    text = '[cover]\ntype = "block"\n' + NEAR.format(2, 0.5)
    with pytest.raises(FormulationError, match="expected a mesh of polynomials"):
        model_of(text)


def test_the_formulations_of_the_manual_are_read() -> None:
    page = (Path(__file__).parents[4] / "docs" / "covers.md").read_text()
    parts = [part.split("```")[0] for part in page.split("```toml\n")[1:]]
    assert len(parts) == 4
    regions, volumes, tips, mass = (parse_formulation(part) for part in parts)
    assert [item.degree for item in regions.cover.regions or ()] == [2, 0]
    assert volumes.cover.volumetric == "projected"
    assert tips.cover.enrichment is not None
    assert mass.integrator.mass == "lumped"
