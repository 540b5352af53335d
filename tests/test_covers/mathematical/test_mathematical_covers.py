"""What every mathematical cover must do, and what its kind promises."""

from math import factorial

import numpy as np
import pytest
import shapely
from skfem import MeshQuad, MeshTri

from covers.mathematical.bspline import BSplines, cardinal_pieces
from covers.mathematical.graded import Graded
from covers.mathematical.mesh_edges import mesh_edges
from covers.mathematical.meshless.moving_least_squares import MovingLeastSquares
from covers.mathematical.quads import Quads
from covers.mathematical.registry import COVERS, cover_class
from covers.mathematical.triangles import Triangles
from integration.monomials import evaluate
from nmm.testing import check_cover
from nmm.testing.covers import random_points

BOUNDS = [[0.0, 0.0], [2.0, 1.0]]
TURNED = {"angle": 0.3, "shift": (0.2, 0.7)}


def jittered_triangles():
    mesh = MeshTri.init_tensor(np.linspace(0, 2, 9), np.linspace(0, 1, 5))
    return Triangles.from_mesh(MeshTri(_jitter(mesh.p), mesh.t))


def jittered_quads():
    mesh = MeshQuad.init_tensor(np.linspace(0, 2, 9), np.linspace(0, 1, 5))
    return Quads.from_mesh(MeshQuad(_jitter(mesh.p), mesh.t))


def sheared_quads():
    mesh = MeshQuad.init_tensor(np.linspace(0, 2, 9), np.linspace(0, 1, 5))
    return Quads.from_mesh(MeshQuad(np.array([[1, 0.4], [0.1, 1]]) @ mesh.p, mesh.t))


def scattered_discs():
    net = Quads.regular(BOUNDS, 0.25)
    random = np.random.default_rng(2)
    nodes = random.uniform([-0.6, -0.6], [2.6, 1.6], (260, 2))
    radius = random.uniform(0.45, 0.6, len(nodes))
    return MovingLeastSquares.on_cells(nodes, radius, net.vertices, net.cell_vertices)


def _jitter(points):
    inside = (points > 0).all(axis=0) & (points[0] < 2) & (points[1] < 1)
    return points + inside * np.random.default_rng(1).uniform(-0.06, 0.06, points.shape)


EXAMPLES = {
    "triangles": lambda: Triangles.regular(BOUNDS, 0.23, **TURNED),
    "triangles of a mesh": jittered_triangles,
    "graded triangles": lambda: Graded.regular(BOUNDS, 0.05, **TURNED, focus=[[0.7, 0.4]]),
    "quads": lambda: Quads.regular(BOUNDS, (0.2, 0.3), **TURNED),
    "parallelograms": sheared_quads,
    "distorted quads": jittered_quads,
    "splines of degree 1": lambda: BSplines.regular(BOUNDS, 0.21, degree=1, **TURNED),
    "splines of degree 2": lambda: BSplines.regular(BOUNDS, (0.2, 0.3), degree=2, **TURNED),
    "splines of degree 3": lambda: BSplines.regular(BOUNDS, 0.21, degree=3, **TURNED),
    "Shepard": lambda: MovingLeastSquares.regular(BOUNDS, 0.2, degree=0, **TURNED),
    "least squares": lambda: MovingLeastSquares.regular(BOUNDS, 0.2, degree=1, **TURNED),
    "quadratic least squares": lambda: MovingLeastSquares.regular(
        BOUNDS, 0.2, degree=2, kernel="wendland", **TURNED
    ),
    "quartic kernel": lambda: MovingLeastSquares.regular(
        BOUNDS, 0.2, kernel="quartic_spline", radius=2.4
    ),
    "scattered discs": scattered_discs,
}


@pytest.mark.parametrize("name", EXAMPLES)
def test_a_cover_keeps_what_every_cover_promises(name):
    check_cover(EXAMPLES[name]())


@pytest.mark.parametrize("name", EXAMPLES)
def test_weights_that_are_no_polynomials_have_no_tables(name):
    cover = EXAMPLES[name]()
    if cover.weight_degree is None:
        cells, points = random_points(cover, 5)
        with pytest.raises(ValueError, match="no polynomials"):
            cover.weight_tables(cells, points, np.ones(5))


def test_regular_covers_hold_the_box_and_their_cells_are_congruent():
    for name in COVERS:
        cover = cover_class(name).regular(BOUNDS, 0.17, **TURNED)
        assert (
            shapely.union_all(cover.cells.to_shapely())
            .buffer(1e-9)
            .contains(shapely.box(0, 0, 2, 1))
        )
        areas = cover.cells.ring_areas
        np.testing.assert_allclose(areas, areas[0], rtol=1e-12)
        for shape in np.unique(cover.cell_shape):
            corners = cover.vertices[cover.cell_vertices[cover.cell_shape == shape]]
            moved = corners - corners[:, :1]
            np.testing.assert_allclose(moved, np.broadcast_to(moved[0], moved.shape), atol=1e-14)


def test_a_net_of_divisors_fits_the_box_exactly():
    cover = Quads.regular([[0.1, 0.2], [0.8, 0.5]], 0.1)
    assert len(cover.cell_vertices) == 21
    assert cover.vertices.min(axis=0) == pytest.approx([0.1, 0.2], abs=0)
    assert cover.vertices.max(axis=0) == pytest.approx([0.8, 0.5], abs=1e-15)


def test_a_hexagon_of_six_triangles_is_the_patch_of_shis_net():
    cover = Triangles.regular([[0, 0], [10, 10]], 1.0)
    stars = np.bincount(cover.cell_vertices.ravel())
    assert np.bincount(stars)[6] > 60
    assert stars.max() == 6


def test_quadratic_pieces_are_those_of_the_handbook():
    # N(t) = (1 - t)^2 / 2, (1 + 2 t - 2 t^2) / 2, t^2 / 2 on one span (de Boor 1978).
    expected = np.array([[1, -2, 1], [1, 2, -2], [0, 0, 1]]) / 2
    np.testing.assert_allclose(cardinal_pieces(2), expected, atol=1e-15)


def test_spline_gradients_are_continuous_across_spans():
    cover = BSplines.regular(BOUNDS, 0.2, degree=2, **TURNED)
    edges = cover.edges
    inner = np.flatnonzero((edges.left >= 0) & (edges.right >= 0))
    points = 0.4 * cover.vertices[edges.start[inner]] + 0.6 * cover.vertices[edges.end[inner]]
    slopes = []
    for cells in (edges.left[inner], edges.right[inner]):
        spread = np.zeros((len(inner), cover.n_patches, 2))
        for axis in (0, 1):
            gradient = cover.evaluate(cells, points)[1][..., axis]
            np.put_along_axis(spread[..., axis], cover.cell_patches[cells], gradient, axis=1)
        slopes.append(spread)
    np.testing.assert_allclose(slopes[0], slopes[1], atol=1e-12)


def test_parallelograms_stay_polynomial_and_distorted_quads_do_not():
    assert sheared_quads().weight_degree == 2
    assert jittered_quads().weight_degree is None


def test_bilinear_weights_of_a_distorted_quad_are_those_of_its_reference_square():
    corners = np.array([[0.0, 0.0], [2.0, 0.3], [1.7, 1.9], [-0.4, 1.1]])
    cover = Quads.from_mesh(MeshQuad(corners.T, np.arange(4)[:, None]))
    x, y = 0.3, 0.8
    weights = np.array([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y])
    found = cover.weights(np.zeros(1, dtype=np.int64), (weights @ corners)[None])
    order = [int(np.flatnonzero((corners == v).all(axis=1))[0]) for v in cover.vertices]
    placed = np.zeros(4)
    placed[np.array(order)[cover.cell_vertices[0]]] = found[0]
    np.testing.assert_allclose(placed, weights, atol=1e-14)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Quads.regular([[0, 0], [0, 1]], 0.1), "lower and upper corner"),
        (lambda: Triangles.regular([[0, 0], [1, 1]], -0.1), "positive length"),
        (lambda: BSplines.regular([[0, 0], [1, 1]], 0.1, degree=0), "degree = 0"),
        (lambda: MovingLeastSquares.regular([[0, 0], [1, 1]], 0.1, kernel="hat"), "kernel: 'hat'"),
        (lambda: MovingLeastSquares.regular([[0, 0], [1, 1]], 0.1, radius=0.6), "enlarge the rad"),
        (lambda: cover_class("hexagons"), "expected one of triangles"),
        (
            lambda: cover_class("covers.mathematical.triangles:Triangles"),
            "expected one of triangles",
        ),
        (
            lambda: Quads.from_mesh(
                MeshQuad(np.array([[0, 1, 0.2, 0], [0, 0, 0.2, 1.0]]), np.arange(4)[:, None])
            ),
            "convex",
        ),
    ],
)
def test_wrong_input_is_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_a_point_far_from_its_cell_is_refused_by_distorted_quads():
    cover = jittered_quads()
    with pytest.raises(ValueError, match="no place in its cell"):
        cover.weights(np.zeros(1, dtype=np.int64), np.array([[50.0, 70.0]]))


def test_overlapping_cells_are_refused():
    with pytest.raises(ValueError, match="edge of another cell"):
        mesh_edges(np.array([[0, 1, 2], [0, 1, 3]]))


def test_a_graded_net_is_fine_at_its_foci_and_grows_no_faster_than_asked():
    focus = np.array([[0.5, 0.2], [1.7, 0.9]])
    net = Graded.regular(BOUNDS, 0.01, focus=focus, radius=0.05, growth=0.3, coarsest=0.15)
    assert net.vertices.min(axis=0) == pytest.approx([0, 0], abs=1e-15)
    assert (net.vertices.max(axis=0) >= [2, 1]).all()
    for axis in (0, 1):
        lines = np.unique(net.vertices[:, axis])
        steps = np.diff(lines)
        middle = (lines[1:] + lines[:-1]) / 2
        off = np.abs(middle[:, None] - focus[:, axis]).min(axis=1)
        # A whole number of lines makes all steps a little shorter; a step has two ends.
        allowed = np.minimum(0.01 + 0.3 * np.maximum(off + steps / 2 - 0.05, 0), 0.15)
        assert (steps <= allowed * (1 + 1e-6)).all()
        assert steps[off < 0.04] == pytest.approx(0.01, rel=0.05)
        if axis == 0:  # the box is wide enough for the coarsest cells along x alone
            assert steps.max() == pytest.approx(0.15, rel=0.2)


@pytest.mark.parametrize(
    "options", [{}, TURNED, {"focus": [[0.5, 0.2], [1.7, 0.9]], "growth": 0.3, "coarsest": 0.15}]
)
def test_the_cells_of_a_graded_net_are_foreseen(options):
    laid = Graded.regular(BOUNDS, 0.02, **options)
    assert Graded.foreseen(BOUNDS, 0.02, **options) == len(laid.cell_vertices)


@pytest.mark.parametrize("name", [name for name in COVERS if name != "graded"])
def test_the_cells_of_a_regular_net_are_foreseen_to_a_factor_of_three(name):
    laid = cover_class(name).regular(BOUNDS, 0.05)
    # Regular triangles are 2.3 to a square.
    assert 1 / 3 <= len(laid.cell_vertices) / cover_class(name).foreseen(BOUNDS, 0.05) <= 3


def test_a_graded_net_without_focus_is_even():
    lines = np.unique(Graded.regular(BOUNDS, 0.25).vertices[:, 0])
    assert lines == pytest.approx(np.linspace(0, 2, 9), abs=1e-12)


@pytest.mark.parametrize("options", [{"growth": -1}, {"coarsest": 0.01}, {"radius": -1}])
def test_a_graded_net_that_cannot_be_is_refused(options):
    with pytest.raises(ValueError, match="correct the options"):
        Graded.regular(BOUNDS, 0.1, focus=[[1, 1]], **options)


@pytest.mark.parametrize("degree", [1, 2, 3])
@pytest.mark.parametrize("away", [1e-3, 1e-9])
def test_a_spline_that_ends_at_a_line_is_right_to_rounding_beside_it(degree, away):
    cover = BSplines.regular(BOUNDS, 0.25, degree=degree)
    corner = cover.vertices[cover.cell_vertices[9, 2]]
    origin = corner - [away * 0.25, 0.125]
    table, total = cover.weight_tables(np.array([9]), origin[None], np.array([0.25]))
    value = (table[0] @ evaluate(np.zeros((1, 2)), total)[0]).reshape(degree + 1, degree + 1)
    # The one that ends at the right side is s^p / p! there; both factors add up across.
    along = value.sum(axis=0)
    # 0.25 away is rounded to 1e-16 of coordinates up to two.
    assert along[0] == pytest.approx(away**degree / factorial(degree), rel=2e-15 / away, abs=0)
