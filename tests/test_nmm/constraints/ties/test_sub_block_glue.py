"""What holds sub-blocks together: patch tests and rates of every degree."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import field_errors, stresses
from nmm.assembly.model import Model
from nmm.assembly.places import Place, on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.constraints.ties.artificial_joints import ArtificialJoints
from nmm.formulation import CoverTable
from nmm.geometry.tessellation.block_cover import PieceGlue
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import body_force, equilibrium, hold, traction

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
LAW = Elastic(1.0, 0.3)


def sub_blocks(mesh: str, degree: int, size: float, angle: float = 0.0) -> Model:
    cover = CoverTable(
        type="sub_blocks",
        functions="monomials",
        degree=degree,
        size=size,
        angle=angle,
        options={"mesh": mesh},
    )
    return solid(SQUARE, cover, [LAW], "strain")


def side(model: Model, axis: int, value: float, order: int = 8) -> Place:
    edges = model.manifold.boundary
    middle = (edges.start + edges.end)[:, axis] / 2
    return on_edges(model.manifold, np.abs(middle - value) < 1e-9, order)


def glue(model: Model, method: str | None, joint_rule: str = "corners") -> ArtificialJoints:
    start = initial_state(model.manifold)
    ties = ArtificialJoints.ties_of(model, PieceGlue(method, 100.0), joint_rule, start)
    return ArtificialJoints(ties, model.manifold.n_unknowns)


@pytest.mark.parametrize("joint_rule", ["corners", "gauss"])
@pytest.mark.parametrize("degree", [1, 2, 3])
def test_a_uniform_traction_stays_uniform_through_springs(degree: int, joint_rule: str) -> None:
    model = sub_blocks("quads", degree, 0.25)
    size = 0.25
    rollers = [
        hold(model, side(model, axis, 0.0), Method("penalty", size, degree), held=held)
        for axis, held in ((0, (True, False)), (1, (False, True)))
    ]
    pull = traction(model, side(model, 0, 1.0), lambda p, n: n)
    found = equilibrium(model, [*rollers, glue(model, None, joint_rule), pull])
    rule = polygon_rule(model.manifold.elements, 4)
    stress = stresses(model, found.state.deformation, rule)
    np.testing.assert_allclose(stress, np.tile([1.0, 0.0, 0.0], (len(stress), 1)), atol=1e-9)


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("mesh", ["triangles", "quads", "voronoi"])
def test_sub_blocks_glued_by_nitsche_pass_the_patch_test(mesh: str, degree: int) -> None:
    model = sub_blocks(mesh, degree, 0.25, 0.0 if mesh == "voronoi" else 0.3)
    strain = np.array([1e-3, -2e-4, 5e-4])
    tensor = np.array([[strain[0], strain[2] / 2], [strain[2] / 2, strain[1]]])
    stress = LAW.stiffness("strain") @ strain

    def pull(p: Floats, n: Floats) -> Floats:
        x, y = n.T
        return np.stack([stress[0] * x + stress[2] * y, stress[2] * x + stress[1] * y], axis=1)

    # What is held is loaded by its own stress besides, so that springs have nothing to carry.
    held = hold(model, side(model, 0, 0.0), Method("penalty", 0.25, degree), lambda p: p @ tensor)
    loads = [
        traction(model, side(model, *place), pull)
        for place in ((0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0))
    ]
    found = equilibrium(model, [held, glue(model, "nitsche"), *loads])
    rule = polygon_rule(model.manifold.elements, 4)
    miss = stresses(model, found.state.deformation, rule) - stress
    assert np.abs(miss).max() < 1e-12
    assert found.residual < 1e-10


def errors(mesh: str, degree: int, size: float, angle: float) -> tuple[float, float]:
    """Benchmark A8 on sub-blocks glued by Nitsche's terms: errors in energy and displacement."""
    model = sub_blocks(mesh, degree, size, angle)
    d, pi, order = LAW.stiffness("strain"), np.pi, 2 * degree + 4

    def u(p: Floats) -> Floats:
        x, y = pi * p.T
        return np.stack([np.sin(x) * np.cos(y), np.cos(x) * np.sin(y)], axis=1)

    def strain(p: Floats) -> Floats:
        x, y = pi * p.T
        normal = pi * np.cos(x) * np.cos(y)
        return np.stack([normal, normal, -2 * pi * np.sin(x) * np.sin(y)], axis=1)

    factor = (d[0, 1] + 2 * d[2, 2]) * 2 * pi**2
    edges = model.manifold.boundary
    middle = (edges.start + edges.end) / 2
    outer = np.abs(middle * (1 - middle)).min(axis=1) < 1e-9
    place = on_edges(model.manifold, outer, order)
    effects = [
        hold(model, place, Method("penalty", size, degree, stiffness=1e6), u),
        body_force(model, lambda p: factor * u(p), order),
        glue(model, "nitsche"),
    ]
    found = equilibrium(model, effects)
    error = field_errors(model, found.state.deformation, u, strain, order)
    return error.energy, error.displacement


@pytest.mark.parametrize(
    ("degree", "sizes"), [(1, (1 / 8, 1 / 16)), (2, (1 / 8, 1 / 16)), (3, (1 / 4, 1 / 8))]
)
@pytest.mark.parametrize("angle", [0.0, 0.3])
def test_sub_blocks_glued_by_nitsche_converge_by_their_degree(
    degree: int, sizes: tuple[float, float], angle: float
) -> None:
    coarse, fine = (errors("triangles", degree, size, angle) for size in sizes)
    energy, displacement = np.log2(np.array(coarse) / np.array(fine))
    # Measured 1.00 to 1.10, 2.00 to 2.09, 2.94 to 2.99 and 1.98 to 2.05, 3.00 to 3.33,
    # 4.03 to 4.06: blocks are cut at the rim, and their sizes do not halve everywhere.
    assert energy == pytest.approx(degree, abs=0.15)
    assert degree + 1 - 0.05 < displacement < degree + 1 + 0.4
