"""What every mathematical cover is held to."""

import numpy as np

from covers.mathematical.base import Cover
from integration.arrays import Floats, Ints
from integration.monomials import count, evaluate
from nmm.testing.claims import claim, close, finite

# m2 of rounding and truncation: the weights are of size one on cells of size one.
STEP = 1e-5
# Least squares lose three digits to the moment matrix, and gradients one more.
SUM, SLOPE_SUM, PLACE = 1e-12, 1e-10, 1e-12
# Second differences of weights are below 1e3 on cells of size one, third below 1e5: 1e-5 in all.
SLOPE = 2e-5


def check_cover(cover: Cover, points: int = 300, seed: int = 0) -> None:
    """Hold a mathematical cover to what every cover promises.

    Weights sum to one and their gradients to zero; gradients are the differences of the weights;
    weights combine to the polynomials of the claimed ``precision``, of which there is no higher;
    patch centres give the coordinates; weights are the same from both sides of an edge and lie
    within the size of their patch; coefficient tables are the weights in any coordinates.

    Parameters
    ----------
    cover
        Laid over any box, as by ``Cover.regular``.
    points
        At how many random points of its cells.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    name = type(cover).__name__
    cells, places = random_points(cover, points, seed)
    _is_laid(cover, name)
    _sums(cover, name, cells, places)
    _slopes(cover, name, cells, places)
    _precision(cover, name, seed)
    _centres(cover, name, cells, places)
    _tables(cover, name, cells, places)
    _edges(cover, name)
    _sizes(cover, name)


def random_points(cover: Cover, number: int, seed: int = 0) -> tuple[Ints, Floats]:
    """Return cells (m,) and points (m, 2) inside them."""
    random = np.random.default_rng(seed)
    cells = random.integers(0, len(cover.cell_vertices), number)
    corners = cover.vertices[cover.cell_vertices[cells]]
    share = random.dirichlet(np.ones(corners.shape[1]), number)
    return cells, np.einsum("mk,mki->mi", share, corners)


def spread(cover: Cover, cells: Ints, values: Floats) -> Floats:
    """Return values (m, k) of the active patches as (m, N) of all patches."""
    found = np.zeros((len(cells), cover.n_patches + 1))
    np.put_along_axis(found, cover.cell_patches[cells], values, axis=1)
    return found[:, :-1]


def cell_size(cover: Cover) -> float:
    """Return the root of the mean area of cells (m)."""
    return float(np.sqrt(np.mean(cover.cells.ring_areas)))


def _is_laid(cover: Cover, name: str) -> None:
    areas = cover.cells.ring_areas
    claim(len(areas) > 0, f"{name}: it has no cells")
    claim(areas.min() > 0, f"{name}: cell {int(np.argmin(areas))} is not counter-clockwise")
    claim(cover.patch_size.min() > 0, f"{name}: patch_size {cover.patch_size.min()} is not > 0")


def _sums(cover: Cover, name: str, cells: Ints, points: Floats) -> None:
    weights, gradients = cover.evaluate(cells, points)
    finite(f"{name}: weights", weights)
    finite(f"{name}: gradients", gradients)
    close(f"{name}: the sum of the weights, one", weights.sum(axis=1), 1.0, SUM)
    total = gradients.sum(axis=1) * cell_size(cover)
    close(f"{name}: the sum of the gradients times the size of a cell", total, 0.0, SLOPE_SUM)


def _slopes(cover: Cover, name: str, cells: Ints, points: Floats) -> None:
    """Gradients against central differences, in units of a cell."""
    _, gradients = cover.evaluate(cells, points)
    size = cell_size(cover)
    for axis in (0, 1):
        away = STEP * size * np.eye(2)[axis]
        change = cover.weights(cells, points + away) - cover.weights(cells, points - away)
        what = f"{name}: gradients along {'xy'[axis]} against differences of weights"
        close(what, size * gradients[..., axis], change / (2 * STEP), SLOPE)


def _precision(cover: Cover, name: str, seed: int) -> None:
    """Fit monomials of one degree more than claimed by the weights."""
    cells, points = random_points(cover, 3000, seed)
    values, degree = spread(cover, cells, cover.weights(cells, points)), cover.precision + 1
    middle, size = points.mean(axis=0), float(np.ptp(points, axis=0).max())
    wanted = evaluate((points - middle) / size, degree)
    fit = np.linalg.lstsq(values, wanted, rcond=1e-9)[0]
    miss = np.abs(values @ fit - wanted).max(axis=0)
    below = float(miss[: count(degree - 1)].max(initial=0.0))
    claim(below < 1e-9, f"{name}: polynomials of degree {degree - 1} are missed by {below:.3g}")
    beyond = float(miss[count(degree - 1) :].max())
    claim(beyond > 1e-7, f"{name}: precision {degree - 1} claimed, {degree} found")


def _centres(cover: Cover, name: str, cells: Ints, points: Floats) -> None:
    if cover.precision < 1:
        return
    centres = cover.patch_centre[cover.cell_patches[cells]]
    field = np.einsum("mk,mki->mi", cover.weights(cells, points), centres)
    size = float(np.abs(cover.vertices).max())
    close(f"{name}: weighted patch centres against coordinates", field, points, PLACE * size)


def _tables(cover: Cover, name: str, cells: Ints, points: Floats) -> None:
    if cover.weight_degree is None:
        return
    size = cell_size(cover)
    origin = points + size * np.array([0.2, -0.1])
    scale = size * np.linspace(0.2, 8.0, len(points))
    table, degree = cover.weight_tables(cells, origin, scale)
    claim(degree == cover.weight_degree, f"{name}: tables of degree {degree}, not weight_degree")
    values = evaluate((points - origin) / scale[:, None], degree)
    found = np.einsum("mK,mkK->mk", values, table)
    close(f"{name}: weights by tables", found, cover.weights(cells, points), SUM)


def _edges(cover: Cover, name: str) -> None:
    edges = cover.edges
    inner = np.flatnonzero((edges.left >= 0) & (edges.right >= 0))
    points = 0.7 * cover.vertices[edges.start[inner]] + 0.3 * cover.vertices[edges.end[inner]]
    left, right = (
        spread(cover, cells, cover.weights(cells, points))
        for cells in (edges.left[inner], edges.right[inner])
    )
    close(f"{name}: weights from both sides of an edge", left, right, SUM)


def _sizes(cover: Cover, name: str) -> None:
    """Patches are unions of cells within their size, or discs that reach into their cells."""
    corners = cover.vertices[cover.cell_vertices]
    active = cover.cell_patches >= 0
    away = corners[:, None] - cover.patch_centre[cover.cell_patches][:, :, None]
    reach = np.linalg.norm(away, axis=3)
    size = cover.patch_size[cover.cell_patches]
    if cover.disc_radius is None:
        far = float((reach.max(axis=2) / size)[active].max())
        claim(far <= 1 + 1e-9, f"{name}: a patch reaches {far:.3g} times its patch_size")
        return
    diameter = np.linalg.norm(corners[:, :, None] - corners[:, None], axis=3).max(axis=(1, 2))
    beyond = (reach.min(axis=2) - size - diameter[:, None])[active].max()
    claim(beyond < 0, f"{name}: a disc is active in a cell {beyond:.3g} m beyond its radius")
