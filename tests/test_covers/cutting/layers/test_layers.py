"""The lines of a layer on meshes whose cells can be counted, and the elements between them."""

import numpy as np
import pytest
import shapely

from covers.cutting.cracks import crack_segments
from covers.cutting.domain import domain_of
from covers.cutting.layers.arranged import arranged
from covers.cutting.layers.lines import lines_of, mesh_segments, within
from covers.cutting.resolution import resolution_of
from covers.mathematical.quads import Quads
from integration.polygons import Polygons

COVER = Quads.regular([[-1, -1], [6, 6]], 1.0)
RESOLUTION = resolution_of(COVER.vertices)
# Between the lines of the mesh: its boundary touches the outer ring of its 4 by 4 cells.
BLOCK = shapely.box(0.5, 0.5, 3.5, 3.5)


def layer(cracks=()):
    domain = domain_of(Polygons.from_shapely([BLOCK]), None, 8 * RESOLUTION.step)
    lines = lines_of(COVER, domain, 0, crack_segments(cracks), RESOLUTION, 1e-8)
    given = lines.cells, lines.boundary, lines.cracks, 2 * lines.margin, RESOLUTION
    return lines, arranged(COVER, *given, 1e-15, domain.group)


def corners(chosen):
    """Lower left corners of cells, sorted."""
    return sorted(map(tuple, COVER.vertices[COVER.cell_vertices[chosen]].min(axis=1).tolist()))


def test_cracks_are_clipped_to_the_material_and_a_margin():
    crack = crack_segments([[[-9.0, 2.0], [9.0, 2.0]], [[-9.0, 7.0], [9.0, 7.0]]])
    domain = domain_of(Polygons.from_shapely([BLOCK]), None, 1e-12)
    found = within(crack, domain.boundary(0), 1.0)
    assert len(found) == 1
    np.testing.assert_allclose([found.start[0], found.end[0]], [[-0.5, 2.0], [4.5, 2.0]])


def test_cells_that_the_boundary_runs_through_and_those_inside_are_told_apart():
    lines, _ = layer()
    inside = [(x, y) for x in (1.0, 2.0) for y in (1.0, 2.0)]
    ring = [(x, y) for x in range(4) for y in range(4) if (x, y) not in inside]
    assert corners(lines.cells.whole) == inside
    assert set(ring) <= set(corners(lines.rim))
    assert not lines.near.any()


def test_cells_that_a_crack_touches_are_near_it_and_no_longer_whole():
    lines, _ = layer([[[1.2, 1.5], [1.8, 1.5]]])
    assert corners(lines.near) == [(1.0, 1.0)]
    assert corners(lines.cells.whole) == [(1.0, 2.0), (2.0, 1.0), (2.0, 2.0)]


def test_edges_of_the_mesh_keep_their_numbers_as_segments():
    edges = np.array([5, 2])
    found = mesh_segments(COVER, edges)
    assert found.owner.tolist() == [5, 2]
    np.testing.assert_array_equal(found.start, COVER.vertices[COVER.edges.start[edges]])
    np.testing.assert_allclose(np.hypot(*(found.end - found.start).T), 1.0)


@pytest.mark.parametrize(
    ("cracks", "elements", "joins", "tips"),
    [
        ([], 16, 24, 0),
        # Through: four elements more, of which three pairs of neighbours are joined.
        ([[[0.0, 1.25], [4.0, 1.25]]], 20, 27, 0),
        # Through one cell, from edge to edge: each neighbour is joined to both parts.
        ([[[1.0, 1.5], [2.0, 1.5]]], 17, 26, 2),
        # Along two edges of the mesh, across which nothing is joined.
        ([[[1.0, 1.0], [3.0, 1.0]]], 16, 22, 2),
    ],
)
def test_elements_fill_the_region_and_are_joined_where_no_crack_is(cracks, elements, joins, tips):
    _, found = layer(cracks)
    assert (len(found.pieces.cell), len(found.joins.first)) == (elements, joins)
    assert len(found.tips) == tips
    # Coordinates are whole halves and quarters: areas are exact to rounding.
    np.testing.assert_allclose(found.pieces.elements.areas.sum(), BLOCK.area, rtol=1e-14)
