"""Multipliers are of the degree of the stresses that a cover holds: quadratic patches."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from integration.rules import polygon_rule
from nmm.assembly.errors import stresses
from nmm.assembly.places import on_edges
from nmm.constraints.imposition import Method
from nmm.formulation import CoverTable
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import body_force, equilibrium, hold

LAW = Elastic(1000.0, 0.3)
REGIONS = {
    "square": [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
    "triangle": [[0.0, 0.0], [1.2, 0.1], [0.3, 1.0]],
    "notched": [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.55, 1.0], [0.5, 0.4], [0.45, 1.0], [0, 1.0]],
}


def displacement(p: Floats) -> Floats:
    """Field of benchmark A1b."""
    x, y = p.T
    return np.stack([x**2 + 2 * x * y - y**2, -(x**2) + x * y + 3 * y**2], axis=1)


def stress(p: Floats) -> Floats:
    x, y = p.T
    strain = np.stack([2 * x + 2 * y, x + 6 * y, 2 * x - 2 * y - 2 * x + y], axis=1)
    return np.asarray(strain @ LAW.stiffness("stress"))


def load(p: Floats) -> Floats:
    """``-div sigma`` of the linear stress, from its differences over one metre."""
    zero = stress(np.zeros((1, 2)))[0]
    along_x, along_y = (stress(np.eye(2)[axis : axis + 1])[0] - zero for axis in (0, 1))
    force = -np.array([along_x[0] + along_y[2], along_x[2] + along_y[1]])
    return np.tile(force, (len(p), 1))


@pytest.mark.parametrize("region", list(REGIONS))
@pytest.mark.parametrize("angle", [0.0, 0.4])
@pytest.mark.parametrize(
    ("kind", "degree", "options"),
    [
        ("bspline", 0, {}),
        ("bspline", 0, {"degree": 3}),
        ("bspline", 1, {}),
        ("triangles", 1, {}),
        ("quads", 1, {}),
    ],
)
def test_quadratic_fields_held_by_multipliers_are_exact(
    kind: str, degree: int, options: dict[str, int], angle: float, region: str
) -> None:
    size = 0.23
    cover = CoverTable(
        type=kind, size=size, degree=degree, angle=angle, shift=(0.2, 0.3), options=options
    )
    ring = Polygons.from_vertices([np.array(REGIONS[region])])
    model = solid(ring, cover, [LAW], "stress")
    method = Method("lagrange", size, degree)
    order = method.order(model)
    edges = on_edges(model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), order)
    found = equilibrium(
        model, [hold(model, edges, method, displacement), body_force(model, load, order)]
    )
    assert found.residual < 1e-10
    rule = polygon_rule(model.manifold.elements, 4)
    exact = stress(rule.points)
    miss = np.abs(stresses(model, found.state.deformation, rule) - exact).max()
    # Benchmark A1b asks for 1e-8 of the largest stress.
    assert miss < 1e-8 * np.abs(exact).max()
