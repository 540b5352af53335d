"""Dependent functions leave the displacement field unique: on every cover, for every shift."""

import numpy as np
import pytest

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.places import on_edges
from nmm.constraints.imposition import Method
from nmm.formulation import CoverTable, Solver
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.stepping.drive.linear_statics import equilibrium, hold

REGION = Polygons.from_vertices(
    [np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.6], [0.0, 1.0]])]
)
COVERS = [
    CoverTable(type="triangles", size=0.4, degree=1, angle=0.4, shift=(0.2, 0.3)),
    CoverTable(type="triangles", size=0.5, degree=3, angle=0.4, shift=(0.2, 0.3)),
    CoverTable(type="quads", size=0.4, degree=1, angle=0.4, shift=(0.2, 0.3)),
    CoverTable(type="quads", size=0.4, degree=2),
    CoverTable(type="bspline", size=0.4, degree=1, angle=0.4),
    # Least squares with linear functions are too ill-conditioned for this (docs/limits.md).
    CoverTable(type="mls", size=0.4, degree=0, angle=0.4),
]


def bent(points: Floats) -> Floats:
    return np.stack([points[:, 1] ** 4, points[:, 0] ** 3], axis=1)


@pytest.mark.parametrize("cover", COVERS, ids=lambda c: f"{c.type}{c.degree}")
def test_the_field_is_the_same_whatever_the_shift(cover: CoverTable) -> None:
    model = solid(REGION, cover, [Elastic(1000.0, 0.3)], "stress")
    assert (model.manifold.dependent > 0) == (cover.degree != 0)
    assert cover.size is not None
    every = np.ones(len(model.manifold.boundary), dtype=bool)
    place = on_edges(model.manifold, every, 10)
    held = hold(model, place, Method("nitsche", cover.size, cover.degree or 0), bent)
    fields = []
    for shift in (1e-10, 1e-14, 1e-12, 1e-8):
        found = equilibrium(model, [held], Solver(options={"shift": shift, "refinements": 8}))
        # Benchmark D2.
        assert found.residual < 1e-10
        fields.append(model.manifold.vertex_rows.apply(found.state.deformation))
    size = np.abs(fields[0]).max()
    assert max(np.abs(field - fields[0]).max() for field in fields[1:]) < 1e-8 * size
