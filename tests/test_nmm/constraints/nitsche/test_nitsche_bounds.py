"""How large Nitsche's penalty is: bounds of elements in closed form, and of an edge."""

import numpy as np
import pytest
import skfem
from scipy.sparse import csc_array

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.places import on_edges
from nmm.assembly.tractions.donors import traction_rows
from nmm.assembly.tractions.element_bounds import element_bounds
from nmm.constraints.imposition import Method
from nmm.constraints.nitsche import nitsche_terms
from nmm.constraints.nitsche.nitsche_bounds import edge_bound
from nmm.materials.elastic import Elastic

SQUARE = Polygons.from_vertices([np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])])
D = Elastic(1.0, 0.3).stiffness("stress")


def fitted(size=0.25):
    """Right triangles that fit the square."""
    line = np.linspace(0, 1, round(1 / size) + 1)
    return Triangles.from_mesh(skfem.MeshTri.init_tensor(line, line))


def turned(size=0.25):
    """A net that the sides of the square cut."""
    return Triangles.regular([[0.0, 0.0], [1.0, 1.0]], size, angle=0.3, shift=(0.07, 0.07))


def square(degree, cover):
    pieces = cut(cover, SQUARE)
    made = mesh_manifold(cover, pieces, Monomials(degree))
    count = len(made.elements)
    elasticity = np.broadcast_to(D, (count, 3, 3))
    return Model(made, elasticity, np.zeros(count), np.ones(count), 1.0, pieces)


def sides(model, degree):
    return on_edges(
        model.manifold, np.ones(len(model.manifold.boundary), dtype=bool), 2 * degree + 2
    )


def both_bounds(model, degree):
    """The largest ratio of the edge, and those of its elements."""
    place = sides(model, degree)
    unknowns, values = traction_rows(model, place.elements, place.position, place.normal)
    none = csc_array((model.manifold.n_unknowns,) * 2)
    each = element_bounds(model, [place.elements], [values], place.weight)[0]
    return edge_bound(model, place, (unknowns, values), none), each


def test_an_element_of_constant_strain_has_the_ratio_of_length_and_area():
    # t = sigma n along one side of length l, energy A eps D eps: over strains that is the largest
    # eigenvalue of (N D) with N = n's rows, l/A times; here n = (0, -1) and D of plane stress.
    model = square(0, fitted(1.0))
    place = sides(model, 0)
    bottom = np.abs(place.position[:, 1]) < 1e-12
    _, values = traction_rows(model, place.elements, place.position, place.normal)
    each = element_bounds(model, [place.elements[bottom]], [values[bottom]], place.weight[bottom])[
        0
    ]
    areas = model.manifold.elements.areas[place.elements[bottom]]
    lengths = np.bincount(place.elements[bottom], place.weight[bottom])[place.elements[bottom]]
    rows = np.array([[0.0, 0.0, -1.0], [0.0, -1.0, 0.0]])  # of sigma n, from (xx, yy, xy)
    largest = np.linalg.eigvalsh(rows @ D @ rows.T).max()
    assert np.allclose(each, largest * lengths / areas, rtol=1e-9)


@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("net", [fitted, turned])
def test_an_edge_asks_for_no_more_than_the_element_that_asks_most(degree, net):
    whole, each = both_bounds(square(degree, net()), degree)
    assert whole <= each.max() * (1 + 1e-6)  # the estimate's own tolerance


def penalty(model, degree):
    method = Method("nitsche", 0.25, degree)
    return method.hold(model, sides(model, degree), lambda end: np.zeros(2)).penalty


@pytest.mark.parametrize("degree", [0, 1, 2])
def test_where_no_element_is_cut_no_eigenvalue_of_the_edge_is_sought(degree, monkeypatch):
    model = square(degree, fitted())
    monkeypatch.setattr(nitsche_terms, "edge_bound", None)
    gamma = nitsche_terms.GAMMA[degree] * D[0, 0] / 0.25
    assert np.allclose(penalty(model, degree), gamma, rtol=1e-12)


@pytest.mark.parametrize("degree", [0, 1])
def test_small_cuts_are_held_by_twice_what_the_edge_asks_for(degree, monkeypatch):
    asked = []
    found = nitsche_terms.edge_bound
    monkeypatch.setattr(
        nitsche_terms, "edge_bound", lambda *given: asked.append(found(*given)) or asked[-1]
    )
    held = penalty(square(degree, turned()), degree)
    assert len(asked) == 1
    assert held.min() >= 2 * asked[0]
