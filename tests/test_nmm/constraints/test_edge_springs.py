"""How stiff the springs are that hold an edge where the formulation gives no stiffness."""

import numpy as np
import pytest

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.assembly.state import initial_state
from nmm.constraints.imposition import Method
from nmm.materials.elastic import Elastic
from nmm.stepping.drive.linear_statics import hold

SQUARE = Polygons.from_vertices([[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]])
YOUNG = 2e9


@pytest.mark.parametrize(
    ("size", "degree", "factor"),
    # Of an edge of one cell, and the most that many cells are given (docs/supports_and_interfaces).
    [(1.0, 1, 100.0), (1.0, 2, 100.0), (1e-3, 1, 1e6)],
)
def test_springs_of_an_edge_are_a_hundred_moduli_over_a_cell_and_a_million_at_most(
    size, degree, factor
):
    cover = Triangles.regular([[0.0, 0.0], [1.0, 1.0]], 1.0)
    pieces = cut(cover, SQUARE)
    made = mesh_manifold(cover, pieces, Monomials(degree))
    count = len(made.elements)
    elasticity = np.broadcast_to(Elastic(YOUNG, 0.0).stiffness("stress"), (count, 3, 3))
    modulus = np.full(count, YOUNG)
    model = Model(made, elasticity, np.zeros(count), modulus, 1.0, pieces)
    base = made.boundary.start[:, 1] + made.boundary.end[:, 1] == 0
    supports = hold(model, on_edges(made, base, 2), Method("spring", size, degree))
    # A motion of one in x, which constant functions of all covers make: twice its energy is the
    # stiffness of all springs together, along an edge of one.
    motion = made.rigid_modes[:, [0]].toarray()[:, 0]
    held = motion @ (supports.matrix(initial_state(made)) @ motion)
    assert held == pytest.approx(factor * YOUNG / size, rel=1e-12)
