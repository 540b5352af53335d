"""Cutting: areas, counts by hand in every degenerate position, boundaries, several regions."""

import numpy as np
import pytest
import shapely
from skfem import MeshTri

from covers.cutting.cut import cut
from covers.mathematical.bspline import BSplines
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

# Three by three square cells of edge 1; nodes at the integers, 16 stars.
CELLS = Quads.regular([[0, 0], [3, 3]], 1.0)
BLOCK = shapely.box(0, 0, 3, 3)


def regions(*shapes):
    return Polygons.from_shapely(list(shapes))


def covers_of(result, node):
    """Number of physical covers of the patch of a node."""
    patch = np.flatnonzero((CELLS.patch_centre == node).all(axis=1))
    return int((result.cover_patch == patch[0]).sum())


def square_crack(x, y, half):
    return shapely.get_coordinates(shapely.box(x - half, y - half, x + half, y + half))


def assert_sound(result, wanted_area):
    """Areas are conserved, rings simple, and the boundary closes around every body."""
    assert abs(result.elements.areas.sum() - wanted_area) <= 1e-12 * wanted_area
    assert shapely.is_valid(result.elements.to_shapely()).all()
    edges = result.boundary
    assert (np.sort(edges.next) == np.arange(len(edges))).all()
    assert (edges.previous[edges.next] == np.arange(len(edges))).all()
    assert (edges.end == edges.start[edges.next]).all()
    assert (edges.body == edges.body[edges.next]).all()
    doubled = edges.start[:, 0] * edges.end[:, 1] - edges.start[:, 1] * edges.end[:, 0]
    around = np.bincount(edges.body, doubled / 2, minlength=result.n_bodies)
    inside = np.bincount(result.element_body, result.elements.areas, minlength=result.n_bodies)
    np.testing.assert_allclose(around, inside, atol=1e-12 * wanted_area)
    paired = np.flatnonzero(edges.opposite >= 0)
    assert (edges.opposite[edges.opposite[paired]] == paired).all()
    assert (edges.start[paired] == edges.end[edges.opposite[paired]]).all()


def test_an_uncut_block_on_its_own_mesh_keeps_cells_nodes_and_no_more():
    result = cut(CELLS, regions(BLOCK))
    assert_sound(result, 9.0)
    assert result.element_whole.all()
    assert (result.covers == result.cover_patch[result.covers]).all()
    assert (result.cover_patch == np.arange(16)).all()
    assert (result.covers == CELLS.cell_patches[result.element_cell]).all()
    assert len(result.boundary) == 12


def test_whole_cells_keep_the_bits_and_the_order_of_their_corners():
    cover = Triangles.regular([[0, 0], [1, 1]], 0.07, angle=0.4, shift=(0.3, 0.1))
    result = cut(cover, regions(shapely.Point(0.5, 0.5).buffer(0.4)), [[[0.3, 0.3], [0.6, 0.55]]])
    whole = np.flatnonzero(result.element_whole)
    corners = cover.vertices[cover.cell_vertices[result.element_cell[whole]]].reshape(-1, 2)
    assert len(whole) > 100
    assert (result.elements.take(whole).points == corners).all()


@pytest.mark.parametrize(
    ("cracks", "covers", "bodies", "tips"),
    [
        # through the cells between two rows of nodes: the stars of both rows are crossed
        pytest.param([[[0, 1.5], [3, 1.5]]], 16 + 8, 2, 0, id="through cells"),
        pytest.param([[[-1, 1.5], [4, 1.5]]], 16 + 8, 2, 0, id="from outside to outside"),
        # along the edges of a row: only the stars of nodes on the crack are crossed
        pytest.param([[[0, 1], [3, 1]]], 16 + 4, 2, 0, id="along edges"),
        pytest.param([[[0, 1], [1, 1], [1, 3]]], 16 + 4, 2, 0, id="along edges and a corner"),
        # diagonal: 4 nodes on it, and both neighbours of each of its 3 cells
        pytest.param([[[0, 0], [3, 3]]], 16 + 4 + 6, 2, 0, id="through nodes"),
        pytest.param([[[1, 1], [2, 1]]], 16, 1, 2, id="one inner edge"),
        pytest.param([[[0, 1], [1, 1]]], 16 + 1, 1, 1, id="one edge from the rim"),
        pytest.param([[[1, 1], [2, 1], [3, 1]]], 16 + 2, 1, 1, id="edges with the tip on a node"),
        # node (0, 0) and its two neighbours are split, the star about the tip is not
        pytest.param([[[0, 0], [1, 1]]], 16 + 3, 1, 1, id="tip on a node"),
        # the crack splits cell 0 and stops on its edge: only stars that end there are split
        pytest.param([[[0, 0.5], [1, 0.5]]], 16 + 2, 1, 1, id="tip on an edge"),
        pytest.param([[[0, 0.5], [0.5, 0.5]]], 16, 1, 1, id="tip in the first cell"),
        # cells 0 and 1 are split to x = 1.5: nodes (0, 0), (0, 1) lose their halves
        pytest.param([[[0, 0.5], [1.5, 0.5]]], 16 + 2, 1, 1, id="tip in the second cell"),
        pytest.param([[[0, 0.5], [2.5, 0.5]]], 16 + 4, 1, 1, id="tip in the third cell"),
        pytest.param([[[1.3, 1.5], [1.7, 1.5]]], 16, 1, 2, id="slit inside a cell"),
        pytest.param([square_crack(1.5, 1.5, 0.2)], 16 + 4, 2, 0, id="closed crack in a cell"),
        pytest.param(
            [square_crack(1.5, 1.5, 0.3), square_crack(1.5, 1.5, 0.1)], 16 + 8, 3, 0, id="rings"
        ),
        pytest.param(
            [square_crack(1.2, 1.5, 0.1), square_crack(1.7, 1.4, 0.1)], 16 + 8, 3, 0, id="islands"
        ),
        pytest.param([[[1, 1.5], [1.3, 1.3], [1.3, 1.7], [1, 1.5]]], 20, 2, 0, id="loop on edge"),
        pytest.param([[[1, 1], [1.3, 1.2], [1.2, 1.3], [1, 1]]], 20, 2, 0, id="loop on a node"),
        pytest.param(
            [[[1, 1.5], [1.3, 1.5]], square_crack(1.5, 1.5, 0.2)], 20, 2, 1, id="loop on a stem"
        ),
        # two lines crossing in the middle node's neighbourhood: four quarters of 4 nodes each,
        # nodes within the crossed cells: (1,1),(2,1),(1,2),(2,2) carry four parts
        pytest.param([[[0, 1.5], [3, 1.5]], [[1.5, 0], [1.5, 3]]], 36, 4, 0, id="crossing in cell"),
        # crossing in a node along edges: 3 nodes on each arm row/column gain 1, the crossing 3
        pytest.param([[[0, 1], [3, 1]], [[1, 0], [1, 3]]], 16 + 6 + 3, 4, 0, id="crossing in node"),
        pytest.param(
            [[[0, 1], [1, 1]], [[1, 1], [3, 1]], [[1, 1], [1, 3]]],
            16 + 3 + 2 + 2,
            3,
            0,
            id="T node",
        ),
        pytest.param(
            [[[0, 1], [3, 1]], [[1.5, 1], [1.5, 3]]], 16 + 4 + 2 * 3, 3, 0, id="T on edge"
        ),
        pytest.param(
            [[[0.2, 0.2], [0.8, 0.8]], [[0.2, 0.8], [0.8, 0.2]]], 16, 1, 4, id="X in cell"
        ),
        pytest.param(
            [[[1.2, 1.5], [1.4, 1.5]], [[1.6, 1.5], [1.8, 1.5]]], 16, 1, 4, id="slits in line"
        ),
        pytest.param(
            [[[1.3, 1.5], [1.7, 1.5], [1.7, 1.7], [1.5, 1.7], [1.5, 1.45]]], 20, 2, 2, id="hook"
        ),
        pytest.param([[[0, 1.5], [3, 1.5]], [[3, 1.5], [0, 1.5]]], 24, 2, 0, id="twice"),
        pytest.param([[[0, 3], [3, 3]]], 16, 1, 0, id="along the rim"),
        pytest.param([[[5, 5], [7, 6]]], 16, 1, 0, id="outside"),
    ],
)
def test_physical_covers_are_those_counted_by_hand(cracks, covers, bodies, tips):
    result = cut(CELLS, regions(BLOCK), cracks)
    assert_sound(result, 9.0)
    assert (result.n_covers, result.n_bodies, len(result.tips)) == (covers, bodies, tips)


@pytest.mark.parametrize("away", [0.0, 1e-16, 1e-14, 1e-12, 1e-10, 3e-9, -1e-14, -1e-11])
@pytest.mark.parametrize(
    ("crack", "of_node", "covers"),
    [
        pytest.param([[0, 1], [3, 1]], 2, 20, id="along edges"),
        pytest.param([[0, 0], [3, 3]], 2, 26, id="diagonal"),
        # slope 1/2 through (1, 1): six cells are cut, nodes counted below it and above it
        pytest.param([[-1, 0], [5, 3]], 2, None, id="slanted"),
        pytest.param([[1, 1], [3, 1]], 1, 18, id="tip"),
    ],
)
def test_a_crack_near_a_node_passes_through_it(away, crack, of_node, covers):
    exact = cut(CELLS, regions(BLOCK), [crack])
    moved = cut(CELLS, regions(BLOCK), [np.array(crack) + away * np.array([0.6, 0.8])])
    assert_sound(moved, 9.0)
    assert covers_of(moved, (1, 1)) == of_node
    assert moved.n_covers == exact.n_covers
    assert covers is None or moved.n_covers == covers


def test_three_arms_that_meet_in_a_node_make_three_covers_of_its_star():
    arms = [[[1, 1], [0, 0.4]], [[1, 1], [3, 0.3]], [[1, 1], [1.2, 3]]]
    result = cut(CELLS, regions(BLOCK), arms)
    assert_sound(result, 9.0)
    assert covers_of(result, (1, 1)) == 3
    assert result.n_bodies == 3
    two = cut(CELLS, regions(BLOCK), arms[:2])
    assert covers_of(two, (1, 1)) == 2


def test_cracks_that_end_within_rounding_of_one_another_meet():
    angle = np.deg2rad(33)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    block = shapely.Polygon((np.array([[0, 0], [3, 0], [3, 3], [0, 3]]) - 1.5) @ turn.T + 1.5)
    cracks = [
        (np.array(c) - 1.5) @ turn.T + 1.5 for c in ([[0, 1.1], [3, 1.3]], [[1.3, 3], [1.2, 1.18]])
    ]
    result = cut(Triangles.regular([[-1, -1], [4, 4]], 0.4), regions(block), cracks)
    assert_sound(result, 9.0)
    assert result.n_bodies == 3
    assert len(result.tips) == 0


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-9, 1e-12])
def test_slivers_survive_and_areas_are_kept(depth):
    """A boundary at a depth beyond a line of nodes; the last depth is 70 steps of resolution."""
    strip = cut(CELLS, regions(shapely.box(0, 0, 3, 1 + depth)))
    assert strip.elements.areas.sum() == pytest.approx(3 * (1 + depth), rel=1e-14)
    sliver = strip.elements.areas < 0.5
    assert sliver.sum() == 3
    np.testing.assert_allclose(strip.elements.areas[sliver], depth, rtol=1e-15 / depth + 1e-12)
    assert strip.n_covers == 12


@pytest.mark.parametrize("leg", [1e-2, 1e-4, 1e-6])
def test_corner_slivers_of_area_fraction_1e_12_survive(leg):
    block = shapely.Polygon([[0, 0], [1 + leg, 0], [1 + leg, 1], [1, 1 + leg], [0, 1 + leg]])
    result = cut(CELLS, regions(block))
    assert result.elements.areas.sum() == pytest.approx(block.area, rel=1e-14)
    corner = result.elements.areas[np.flatnonzero(result.element_cell == 4)]
    np.testing.assert_allclose(corner, [leg**2 / 2], rtol=1e-9)
    assert (result.slivers, result.sliver_area) == (0, 0.0)


def test_pieces_below_the_smallest_area_are_left_out_and_reported():
    block = shapely.Polygon([[0, 0], [1 + 1e-9, 0], [1 + 1e-9, 1], [1, 1 + 1e-9], [0, 1 + 1e-9]])
    result = cut(CELLS, regions(block))
    assert result.slivers == 1  # the corner of area fraction 5e-19
    assert result.sliver_area == pytest.approx(5e-19, rel=1e-3)
    assert abs(result.elements.areas.sum() - block.area) < 1e-15


def test_a_tip_keeps_its_exact_place_and_both_faces_of_the_slit_are_boundary():
    tip = np.array([1.61803398875, 1.41421356237])
    result = cut(CELLS, regions(BLOCK), [[[0, 1.3], tip]])
    assert (result.tips.point == tip).all()
    assert (result.tips.crack == 0).all()
    ahead = tip - [0, 1.3]
    np.testing.assert_allclose(result.tips.direction[0], ahead / np.hypot(*ahead), atol=1e-12)
    assert result.element_cell[result.tips.element[0]] == 4
    edges = result.boundary
    faces = np.flatnonzero(edges.crack == 0)
    length = np.hypot(*(edges.end - edges.start)[faces].T)
    assert length.sum() == pytest.approx(2 * np.hypot(*ahead), rel=1e-14)
    assert (edges.opposite[faces] >= 0).all()
    # The halves of the tip's cell are one approximation, the chain turns about the tip.
    halves = np.flatnonzero(result.element_cell == 4)
    assert (result.covers[halves] == result.covers[halves[0]]).all()
    arriving = faces[(edges.end[faces] == tip).all(axis=1)]
    assert (edges.next[arriving] == edges.opposite[arriving]).all()


def test_a_hole_inside_a_cell_divides_it_into_simple_rings_with_equal_covers():
    block = BLOCK.difference(shapely.Point(1.5, 1.5).buffer(0.3))
    result = cut(CELLS, regions(block))
    assert_sound(result, block.area)
    assert result.n_covers == 16
    ring = result.covers[result.element_cell == 4]
    assert len(ring) == 2
    assert (ring == ring[0]).all()


def test_a_hole_about_a_node_leaves_its_star_in_one_part_and_one_that_cuts_it_in_two():
    ring = BLOCK.difference(shapely.Point(1, 1).buffer(0.4))
    assert covers_of(cut(CELLS, regions(ring)), (1, 1)) == 1
    slot = BLOCK.difference(shapely.box(-1, 0.9, 2.5, 1.1))
    result = cut(CELLS, regions(slot))
    assert_sound(result, slot.area)
    assert covers_of(result, (1, 1)) == 2
    assert result.n_bodies == 1


def test_a_block_smaller_than_a_cell_has_one_element_and_the_covers_of_that_cell():
    block = shapely.Polygon([[1.2, 1.1], [1.8, 1.3], [1.4, 1.9]])
    result = cut(CELLS, regions(block))
    assert (len(result.elements), result.n_covers, result.n_bodies) == (1, 4, 1)
    assert (result.cover_patch == np.sort(CELLS.cell_patches[4])).all()


def test_touching_regions_are_bodies_of_their_own_and_glued_ones_share_covers():
    shapes = [shapely.box(0, 0, 1.5, 3), shapely.box(1.5, 0, 3, 3)]
    apart = cut(CELLS, regions(*shapes))
    assert_sound(apart, 9.0)
    assert (apart.n_bodies, apart.n_covers) == (2, 12 + 12)
    assert (apart.element_body == apart.element_region).all()
    interface = apart.boundary.opposite >= 0
    assert interface.sum() == 6  # three cells on either side
    assert (apart.boundary.crack < 0).all()

    glued = cut(CELLS, regions(*shapes), glue=[7, 7])
    assert_sound(glued, 9.0)
    assert (glued.n_bodies, glued.n_covers) == (1, 16)
    assert len(glued.boundary) == 14
    assert (np.unique(glued.element_region) == [0, 1]).all()

    half = cut(CELLS, regions(*shapes), [[[1.5, 0], [1.5, 1.5]]], glue=[7, 7])
    # Cracked through cell 1 to the middle of cell 4: nodes (1, 0) and (2, 0) are parted.
    assert (half.n_bodies, half.n_covers, len(half.tips)) == (1, 18, 1)


def test_regions_that_share_a_corner_with_a_long_edge_meet_without_gap_or_overlap():
    """A T of block boundaries turned by 0.3: the corner lies on the long edge up to rounding."""
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    rings = [
        [[0, 0], [3, 0], [3, 1.1], [0, 1.1]],
        [[0, 1.1], [1.7, 1.1], [1.7, 3], [0, 3]],
        [[1.7, 1.1], [3, 1.1], [3, 3], [1.7, 3]],
    ]
    polygons = Polygons.from_vertices([np.array(ring) @ turn.T for ring in rings])
    cover = Triangles.regular([[-1, 0], [3, 4]], 0.37)
    apart = cut(cover, polygons)
    assert_sound(apart, 9.0)
    assert apart.n_bodies == 3
    length = np.hypot(*(apart.boundary.end - apart.boundary.start).T)
    shared = length[apart.boundary.opposite >= 0].sum()
    assert shared == pytest.approx(2 * (3 + 1.9), rel=1e-12)
    assert cut(cover, polygons, glue=[0, 0, 0]).n_bodies == 1


def test_regions_that_touch_up_to_rounding_do_not_count_as_overlapping():
    """GEOS gives the whole first polygon as the intersection of the two but for a grid."""
    rings = [
        [[0.6909469195456848, 0.4338043068500317], [0.932820625140881, 6.796473625767257e-17],
         [1, -4.631026479705913e-17], [0.9999999999999999, 1], [0.5159956156621635, 1]],
        [[0.3752565305114259, 0.9999999999999999], [-9.185984640721849e-17, 1],
         [7.215333888029294e-17, 3.4816391118732005e-17],
         [0.8249900251925482, -2.846475654610694e-17],
         [0.932820625140881, 5.3619835644014803e-17]],
    ]  # fmt: skip
    result = cut(Triangles.regular([[0, 0], [1, 1]], 0.3, angle=1), Polygons.from_vertices(rings))
    edges = result.boundary
    shared = np.hypot(*(edges.end - edges.start)[edges.opposite >= 0].T).sum()
    along = np.hypot(0.932820625140881 - 0.6909469195456848, 0.4338043068500317)
    assert shared == pytest.approx(2 * along, rel=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_clusters_of_vertices_of_the_size_of_rounding_do_not_turn_a_region_inside_out(seed):
    random = np.random.default_rng(seed)
    cover = Triangles.regular([[-0.2, -0.2], [1.2, 1.2]], 0.3, angle=0.5)
    away = 10.0 ** random.uniform(-16, -13)
    corners = np.array([[0, 0.1], [0.5, 0], [1, 0.3], [0.6, 0.5], [0.9, 1], [0.2, 0.8]])
    near = cover.vertices[
        [np.argmin(np.hypot(*(cover.vertices - corner).T)) for corner in corners[::2]]
    ]
    corners[::2] = near
    ring = np.repeat(corners, 3, axis=0) + random.uniform(-away, away, (18, 2))
    block = Polygons.from_vertices([ring])
    result = cut(cover, block)
    assert result.elements.areas.sum() == pytest.approx(block.areas[0], rel=1e-12)
    assert result.n_bodies == 1


@pytest.mark.parametrize("beyond", [1e-15, 1e-13, 3e-12, 1e-10])
def test_a_block_that_stands_out_of_the_mesh_by_rounding_ends_at_the_mesh(beyond):
    result = cut(CELLS, regions(shapely.box(0, -beyond, 3, 3 + beyond)))
    assert_sound(result, 9.0)
    assert (len(result.elements), len(result.boundary), result.n_covers) == (9, 12, 16)


def test_overlapping_regions_are_cut_apart_from_one_another():
    shapes = [shapely.box(0, 0, 2, 2), shapely.box(1.5, 1.5, 3, 3), shapely.box(0.5, 0.5, 1, 1)]
    result = cut(CELLS, regions(*shapes))
    area = np.bincount(result.element_region, result.elements.areas)
    np.testing.assert_allclose(area, [4, 2.25, 0.25], rtol=1e-14)
    assert result.n_bodies == 3
    assert (result.boundary.opposite < 0).all()
    with pytest.raises(ValueError, match="glued and overlapping"):
        cut(CELLS, regions(*shapes), glue=[0, 0, 1])


def test_regions_that_touch_in_a_point_do_not_hang_together():
    shapes = [shapely.box(0, 0, 1, 1), shapely.box(1, 1, 3, 3)]
    result = cut(CELLS, regions(*shapes), glue=[0, 0])
    assert result.n_bodies == 2
    assert covers_of(result, (1, 1)) == 2


def test_a_joint_splits_splines_over_their_whole_width():
    cover = BSplines.regular([[0, 0], [6, 2]], 1.0, degree=2)
    result = cut(cover, regions(shapely.box(0, 0, 6, 2)), [[[3.5, -1], [3.5, 3]]])
    # 8 x 4 splines; the columns that reach over x = 3.5 in their inside are the 3 of cell 3.
    assert result.n_covers == 8 * 4 + 3 * 4
    along = cut(cover, regions(shapely.box(0, 0, 6, 2)), [[[3, -1], [3, 3]]])
    assert along.n_covers == 8 * 4 + 2 * 4  # on a knot line: the 2 columns across it


@pytest.mark.parametrize(("scale", "shift"), [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e6), (1e3, 1e5)])
def test_counts_do_not_depend_on_size_and_place(scale, shift):
    cracks = [[[0, 1], [1, 1]], [[1, 1], [3, 1]], [[1, 1], [1.5, 3]], [[2, 0], [2.5, 0.5]]]
    moved = Quads.regular(np.array([[0, 0], [3, 3]]) * scale + shift, scale)
    block = shapely.transform(BLOCK, lambda x: x * scale + shift)
    result = cut(moved, regions(block), [np.array(c) * scale + shift for c in cracks])
    plain = cut(CELLS, regions(BLOCK), cracks)
    assert (result.covers == plain.covers).all()
    assert (result.element_body == plain.element_body).all()
    # At a distance of 1e6 coordinates are known to 1e-10.
    tolerance = 1e-9 if shift else 1e-12
    np.testing.assert_allclose(
        result.elements.areas, plain.elements.areas * scale**2, rtol=tolerance, atol=0
    )


def test_the_mesh_of_the_block_itself_and_any_other_give_the_same_bodies_and_areas():
    square = MeshTri().refined(4)
    cracks = [[[0.2, 0.2], [0.7, 0.6]], [[0, 0.8], [1, 0.9]]]
    for cover in (Triangles.from_mesh(square), Triangles.regular([[0, 0], [1, 1]], 0.1, angle=1)):
        result = cut(cover, regions(shapely.box(0, 0, 1, 1)), cracks)
        assert_sound(result, 1.0)
        assert (result.n_bodies, len(result.tips)) == (2, 2)


def test_the_same_input_gives_the_same_bytes():
    block = shapely.Point(0.5, 0.5).buffer(0.45)
    cover = Triangles.regular([[0, 0], [1, 1]], 0.05, angle=0.3)
    first, second = (cut(cover, regions(block), [[[0, 0.4], [0.7, 0.6]]]) for _ in range(2))
    assert first.covers.tobytes() == second.covers.tobytes()
    assert first.elements.points.tobytes() == second.elements.points.tobytes()


@pytest.mark.parametrize(
    ("shapes", "cracks", "message"),
    [
        ([shapely.Polygon([[0, 0], [2, 2], [2, 0], [0, 3]])], [], "region 0: Self-intersection"),
        ([BLOCK, shapely.Polygon([[0, 0], [1, 0], [2, 0]])], [], "region 1: area 0"),
        (
            [shapely.Polygon([[0, 0], [1, 1], [0, 2], [2, 2], [1, 1], [2, 0]])],
            [],
            "region 0: Ring Self-intersection",
        ),
        ([shapely.box(2, 2, 4, 4)], [], "region 0: cells cover an area of 1 of 4"),
        ([shapely.box(12, 12, 14, 14)], [], "no cell near the regions"),
        ([BLOCK], [[[1, 1], [1, 1]]], "crack 0: 1 distinct points"),
        ([BLOCK], [[[1, 1], [2, 2]], [[1, np.nan], [1, 2]]], "crack 1"),
    ],
)
def test_wrong_input_is_named(shapes, cracks, message):
    with pytest.raises(ValueError, match=message):
        cut(CELLS, regions(*shapes), cracks)


def test_regions_that_are_missing_or_glued_by_too_few_numbers_are_named():
    with pytest.raises(ValueError, match="regions: none"):
        cut(CELLS, Polygons.from_vertices([]))
    with pytest.raises(ValueError, match="one number for each region"):
        cut(CELLS, regions(BLOCK), glue=[0, 1])


def test_cells_that_cannot_be_told_from_rounding_are_refused():
    far = 1e9
    cover = Quads.regular([[far, far], [far + 1e-3, far + 1e-3]], 1e-4)
    with pytest.raises(ValueError, match="move the model towards the origin"):
        cut(cover, regions(shapely.box(far, far, far + 1e-3, far + 1e-3)))
