"""Orders on sides and interfaces that a turned mesh cuts: supports and glue of every method."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.errors import field_errors
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.constraints.imposition import Method
from nmm.formulation import CoverTable
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import Equilibrium, body_force, equilibrium, glued, hold

LAW = Elastic(1.0, 0.3)
SQUARE = [[[0, 0], [1, 0], [1, 1], [0, 1]]]
# The same square in two along a kinked line.
SPLIT = [
    [[0, 0], [0.53, 0], [0.61, 0.45], [0.47, 1], [0, 1]],
    [[0.53, 0], [1, 0], [1, 1], [0.47, 1], [0.61, 0.45]],
]
SIZES = {0: (1 / 32, 1 / 64), 1: (1 / 20, 1 / 40), 2: (1 / 16, 1 / 32)}


def wave(p: Floats) -> Floats:
    """Benchmark A8."""
    x, y = np.pi * p.T
    return np.stack([np.sin(x) * np.cos(y), np.cos(x) * np.sin(y)], axis=1)


def strain(p: Floats) -> Floats:
    x, y = np.pi * p.T
    normal = np.pi * np.cos(x) * np.cos(y)
    return np.stack([normal, normal, -2 * np.pi * np.sin(x) * np.sin(y)], axis=1)


def solve(
    rings: list[list[list[float]]], cover: CoverTable, supports: str, glue: str, turn: float
) -> Equilibrium:
    c, s = np.cos(turn), np.sin(turn)
    blocks = Polygons.from_vertices([np.array(ring, dtype=float) for ring in rings])
    model = solid(
        blocks.with_points(blocks.points @ np.array([[c, s], [-s, c]])), cover, [LAW], "strain"
    )
    degree, size = cover.degree or 0, cover.size or 0.0
    order = 2 * degree + 6
    d = LAW.stiffness("strain")
    factor = (d[0, 1] + 2 * d[2, 2]) * 2 * np.pi**2
    place = on_edges(model.manifold, outer(model, turn), order)
    effects = [
        hold(model, place, Method(supports, size, degree), wave),
        body_force(model, lambda p: factor * wave(p), order),
    ]
    if len(rings) > 1:
        effects.append(glued(model, glue, size))
    found = equilibrium(model, effects)
    assert found.residual < 1e-10
    return found


def outer(model: Model, turn: float) -> "np.ndarray[tuple[int], np.dtype[np.bool_]]":
    edges = model.manifold.boundary
    c, s = np.cos(turn), np.sin(turn)
    middle = (edges.start + edges.end) / 2 @ np.array([[c, -s], [s, c]])
    return np.asarray(np.abs(middle * (1 - middle)).min(axis=1) < 1e-9)


def rates(
    rings: list[list[list[float]]], kind: str, degree: int, supports: str, glue: str = "nitsche"
) -> Floats:
    """Rates in energy and displacement, the median over three places of the mesh."""
    found = []
    for number, shift in enumerate([(0.17, 0.29), (0.61, 0.83), (0.42, 0.05)]):
        errors = []
        for size in SIZES[degree]:
            cover = CoverTable(
                type=kind, size=size, degree=degree, angle=0.2 + 0.3 * number, shift=shift
            )
            one = solve(rings, cover, supports, glue, 0.35 * number)
            error = field_errors(one.model, one.state.deformation, wave, strain, 2 * degree + 6)
            errors.append([error.energy, error.displacement])
        found.append(np.log2(np.array(errors[0]) / np.array(errors[1])))
    return np.asarray(np.median(found, axis=0))


@pytest.mark.slow
@pytest.mark.parametrize("supports", ["penalty", "nitsche", "lagrange"])
@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("kind", ["triangles", "quads"])
def test_supports_on_cut_sides_keep_the_order(kind: str, degree: int, supports: str) -> None:
    energy, displacement = rates(SQUARE, kind, degree, supports)
    # Cut quads and multipliers still fall faster at these sizes: measured 1.00 to 1.02,
    # 2.00 to 2.27, 3.14 to 3.38 in energy; the displacements of springs as low as 1.76 and 3.59.
    assert energy > degree + 1 - 0.15
    assert displacement > degree + 2 - 0.45


@pytest.mark.slow
@pytest.mark.parametrize("glue", ["nitsche", "lagrange"])
@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("kind", ["triangles", "quads"])
def test_glue_along_a_kinked_line_keeps_the_order(kind: str, degree: int, glue: str) -> None:
    energy, displacement = rates(SPLIT, kind, degree, "nitsche", glue)
    assert energy > degree + 1 - 0.15
    assert displacement > degree + 2 - 0.15


@pytest.mark.parametrize("glue", ["nitsche", "lagrange"])
def test_a_glued_square_is_as_exact_as_a_whole_one(glue: str) -> None:
    cover = CoverTable(type="triangles", size=1 / 12, degree=1, angle=0.3, shift=(0.2, 0.3))
    error = []
    for rings in (SQUARE, SPLIT):
        one = solve(rings, cover, "lagrange", glue, 0.35)
        error.append(field_errors(one.model, one.state.deformation, wave, strain, 8).energy)
    # Measured 0.99 to 1.00: two parts have more freedom than one.
    assert error[1] < 1.1 * error[0]
