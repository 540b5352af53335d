"""Physical covers against a slow oracle: unions of cells, cut by regions, less thin cracks."""

import numpy as np
import pytest
import shapely
from skfem import MeshTri

from covers.cutting.components import components
from covers.cutting.cut import cut
from covers.mathematical.bspline import BSplines
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons

BOUNDS = [[-0.3, -0.3], [1.3, 1.3]]
# Half width of the gap that stands for a crack, and the smallest part the oracle can see.
GAP, VISIBLE = 1e-6, 1e-8


def oracle(cover, shapes, cracks):
    """Areas of the connected parts of each patch in each region, sorted."""
    cells = cover.cells.to_shapely()
    gap = shapely.union_all([shapely.LineString(crack).buffer(GAP) for crack in cracks])
    parts = {}
    for region, shape in enumerate(shapes):
        for patch in range(cover.n_patches):
            star = shapely.union_all(cells[(cover.cell_patches == patch).any(axis=1)])
            areas = shapely.area(shapely.get_parts((star & shape) - gap))
            parts[patch, region] = sorted(areas[areas > VISIBLE].tolist())
    return {key: areas for key, areas in parts.items() if areas}


def found(result):
    """The same from the cut."""
    area = np.zeros(result.n_covers)
    for column in result.covers.T:
        np.add.at(area, column, result.elements.areas)
    parts = {}
    for patch, region, size in zip(result.cover_patch, result.cover_region, area, strict=True):
        if size > VISIBLE:
            parts.setdefault((int(patch), int(region)), []).append(float(size))
    return {key: sorted(areas) for key, areas in parts.items()}


def assert_equal_parts(result, wanted):
    counted = found(result)
    assert {key: len(areas) for key, areas in counted.items()} == {
        key: len(areas) for key, areas in wanted.items()
    }
    for key, areas in wanted.items():
        # The gap takes at most its width times a crack's length, below ten here.
        np.testing.assert_allclose(counted[key], areas, atol=20 * GAP)


def random_cover(random):
    options = {
        "angle": random.choice([0.0, random.uniform(0, 3)]),
        "shift": tuple(random.choice([[0, 0], random.uniform(0, 1, 2)])),
    }
    kind = random.integers(4)
    if kind == 3:
        mesh = MeshTri.init_tensor(np.linspace(-0.3, 1.3, 6), np.linspace(-0.3, 1.3, 6))
        inside = (np.abs(mesh.p - 0.5) < 0.79).all(axis=0)
        jitter = inside * random.uniform(-0.08, 0.08, mesh.p.shape)
        return Triangles.from_mesh(MeshTri(mesh.p + jitter, mesh.t))
    return (Triangles, Quads, BSplines)[kind].regular(BOUNDS, 0.4, **options)


def random_region(random):
    """A star-shaped polygon, often not convex, sometimes with a hole."""
    while True:
        angle = np.sort(random.uniform(0, 2 * np.pi, random.integers(3, 9)))
        radius = random.uniform(0.25, 0.7, len(angle))
        shape = shapely.Polygon(0.5 + (radius * [np.cos(angle), np.sin(angle)]).T)
        if random.random() < 0.4:
            shape -= shapely.Point(random.uniform(0.4, 0.6, 2)).buffer(0.08, quad_segs=2)
        if shape.is_valid and shape.geom_type == "Polygon" and shape.area > 0.1:
            return shape


def random_cracks(random, cover, shape):
    """Polylines between nodes, places on edges, corners, places on the rim and on one another."""
    edges, rim = cover.edges, shapely.get_coordinates(shape)
    cracks = []

    def between(line):
        i, share = random.integers(len(line) - 1), random.choice([0, 1, random.uniform()])
        return (1 - share) * line[i] + share * line[i + 1]

    def point():
        kind = random.integers(5)
        if kind == 0:
            edge = random.integers(len(edges.start))
            return between(cover.vertices[[edges.start[edge], edges.end[edge]]])
        if kind == 1:
            return between(rim)
        if kind == 2 and cracks:
            return between(cracks[random.integers(len(cracks))])
        return random.uniform(-0.2, 1.2, 2)

    while len(cracks) < random.integers(4):
        crack = np.array([point() for _ in range(random.integers(2, 4))])
        if np.hypot(*np.diff(crack, axis=0).T).min() > 0.05:
            cracks.append(crack)
    return cracks


@pytest.mark.parametrize("seed", range(60))
def test_random_cuts_have_the_parts_of_the_oracle_also_when_cracks_are_moved_by_rounding(seed):
    random = np.random.default_rng(seed)
    cover, shape = random_cover(random), random_region(random)
    cracks = random_cracks(random, cover, shape)
    wanted = oracle(cover, [shape], cracks)
    for away in (0.0, 10.0 ** random.uniform(-14, -9)):
        moved = [crack + random.uniform(-away, away, crack.shape) for crack in cracks]
        result = cut(cover, Polygons.from_shapely([shape]), moved)
        assert result.elements.areas.sum() == pytest.approx(shape.area, rel=1e-12)
        assert_equal_parts(result, wanted)


@pytest.mark.parametrize("seed", range(15))
def test_random_partitions_have_the_parts_of_each_region_and_glued_those_of_the_whole(seed):
    random = np.random.default_rng(seed)
    cover, square = random_cover(random), shapely.box(0, 0, 1, 1)
    nodes = cover.vertices[(np.abs(cover.vertices - 0.5) < 0.5).all(axis=1)]
    lines = []
    for _ in range(3):
        ends = [nodes[random.integers(len(nodes))], random.uniform(0.1, 0.9, 2)]
        lines.append(shapely.LineString(ends[0] + np.array([[-3], [3]]) * (ends[1] - ends[0])))
    drawn = shapely.union_all([square.boundary, *(square & line for line in lines)])
    shapes = list(shapely.polygonize(shapely.get_parts(drawn)).geoms)
    apart = cut(cover, Polygons.from_shapely(shapes))
    assert apart.n_bodies == len(shapes)
    assert_equal_parts(apart, oracle(cover, shapes, []))
    glued = cut(cover, Polygons.from_shapely(shapes), glue=np.zeros(len(shapes)))
    assert glued.n_bodies == 1
    assert glued.n_covers == cut(cover, Polygons.from_shapely([square])).n_covers


def test_covers_of_elements_follow_the_cells_patches_and_stay_in_one_body():
    random = np.random.default_rng(5)
    for cover in (random_cover(random), MovingLeastSquares.regular(BOUNDS, 0.3, degree=2)):
        shape = random_region(random)
        result = cut(cover, Polygons.from_shapely([shape]), [[[0, 0.4], [1, 0.6]]])
        active = result.covers >= 0
        patches = cover.cell_patches[result.element_cell]
        assert (result.cover_patch[result.covers][active] == patches[active]).all()
        bodies = np.broadcast_to(result.element_body[:, None], active.shape)
        assert (result.cover_body[result.covers][active] == bodies[active]).all()
        assert (np.diff(result.cover_patch) >= 0).all()
        assert (np.unique(result.covers[active]) == np.arange(result.n_covers)).all()


def test_a_crack_parts_the_discs_that_it_crosses_and_no_others():
    cover = MovingLeastSquares.regular([[0, 0], [1, 1]], 0.1, radius=2.0)
    block = Polygons.from_shapely([shapely.box(0, 0, 1, 1)])
    result = cut(cover, block, [[[0, 0.43], [0.62, 0.43]]])
    number = np.bincount(result.cover_patch, minlength=cover.n_patches)
    box = shapely.box(0, 0, 1, 1)
    for patch in range(cover.n_patches):
        disc = shapely.Point(cover.patch_centre[patch]).buffer(0.2 * (1 - 1e-9), quad_segs=64)
        crack = shapely.LineString([[-1, 0.43], [0.62, 0.43]]).buffer(1e-9)
        parts = shapely.area(shapely.get_parts((disc & box) - crack))
        # The polygon of the oracle leaves out a rim of 1e-4 of the disc's area.
        assert number[patch] == (parts > 1e-5).sum() or (np.abs(parts - 1e-5) < 2e-5).any()


def test_weights_left_out_of_cut_elements_vanish_there():
    cover = MovingLeastSquares.regular([[0, 0], [1, 1]], 0.13, angle=0.2)
    shape = shapely.Point(0.5, 0.5).buffer(0.42)
    result = cut(cover, Polygons.from_shapely([shape]), [[[0, 0.43], [0.62, 0.46]]])
    points = shapely.get_coordinates(shapely.point_on_surface(result.elements.to_shapely()))
    weights = cover.weights(result.element_cell, points)
    assert np.abs(weights[result.covers < 0]).max() < 1e-14
    assert ((result.covers < 0) & (cover.cell_patches[result.element_cell] >= 0)).any()


def test_components_are_numbered_in_the_order_of_their_first_members():
    label = components(6, np.array([4, 5]), np.array([1, 3]))
    assert label.tolist() == [0, 1, 2, 3, 1, 3]
