"""The number of linearly dependent functions of an approximation.

Hats on triangles, ``sum w_i x_i = x``, give for every polynomial field ``B`` of degree p, with
``B_p . x = 0`` for its top-degree part,

    sum_i w_i(x) B(x) . (x_i - x) = 0,

which are p (p + 2) dependent functions of each displacement component on each connected body, and
there are no others (for p = 1 they are the motions of the mesh as a truss). With covers of lower
degree only those fields ``B`` remain whose terms these covers contain.

Bilinear hats on a grid give more. Along every line of nodes, with ``r`` of degree p - 1,

    w_j(y) sum_i w_i(x) (x_i - x) r(x, y) = 0,

and the same across: p (p + 1) / 2 for each connected line of covers. The p (p - 1) / 2 fields
``(x_i - x) (y_j - y) r(x, y)`` of a connected body are in both families.

For all other weights the dimension of the null space is the number of eigenvalues of the Gram
matrix, scaled to unit diagonal, below `ZERO`. By Sylvester's law of inertia it is the number of
negative pivots of the matrix minus `ZERO` times the identity.
"""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.sparse import coo_array, csc_array, diags_array, eye_array

from covers.approximation.groups.element_group import ElementGroup
from covers.cutting.components import components
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import LocalFunctions
from covers.mathematical.base import Cover
from covers.mathematical.polynomial_cover import PolynomialCover
from covers.mathematical.quads import BILINEAR
from covers.mathematical.triangles import HATS
from integration.arrays import Floats, Ints
from integration.monomials import count, exponents, multiply

# Eigenvalues of a Gram matrix of unit diagonal below this count as zero. They are squares of
# singular values, of which those of cubic covers on triangles reach down to 1e-4 of the largest.
ZERO = 1e-12
# Singular values below this share of the largest count as zero in the matrices of the closed form.
RANK = 1e-10


def dependent_functions(
    cover: Cover,
    cut: CutCells,
    functions: Sequence[LocalFunctions],
    which: Ints,
    groups: Callable[[], tuple[Sequence[ElementGroup], int]],
) -> int:
    """Return the number of vector functions of an approximation that depend on the others.

    Parameters
    ----------
    cover, cut
        The mathematical cover, and the cut of it.
    functions, which
        Local functions, and the number of those of each physical cover (C,).
    groups
        Returns the element groups and the number of unknowns, called only if they are needed.
    """
    degree = np.array([item.degree for item in functions])[which]
    if not degree.any():
        return 0
    whole = all(item.n_unknowns == 2 * item.n_functions for item in functions)
    if whole and _has(cover, HATS):
        return 2 * _of_triangles(cover, cut, degree)
    if whole and _has(cover, BILINEAR) and (cover.cell_shape == 0).all() and not np.ptp(degree):
        return 2 * _of_grids(cut, int(degree[0]))
    return _counted(*groups())


def _has(cover: Cover, table: Floats) -> bool:
    return isinstance(cover, PolynomialCover) and np.array_equal(cover.table, table)


def _of_triangles(cover: Cover, cut: CutCells, degree: Ints) -> int:
    highest = np.zeros(cut.n_bodies, dtype=np.int64)
    np.maximum.at(highest, cut.cover_body, degree)
    total = int((highest * (highest + 2)).sum())
    lower = degree < highest[cut.cover_body]
    for body in np.unique(cut.cover_body[lower]):  # bodies of covers of several degrees
        mine = lower & (cut.cover_body == body)
        nodes = cover.patch_centre[cut.cover_patch]
        inside = nodes[cut.cover_body == body]
        away = (nodes[mine] - inside.mean(axis=0)) / max(
            float(np.ptp(inside, axis=0).max()), 1e-300
        )
        total -= _terms_not_held(away, degree[mine], int(highest[body]))
    return total


def _terms_not_held(nodes: Floats, degree: Ints, highest: int) -> int:
    """Number of conditions on ``B`` by covers of lower ``degree`` (m,) at ``nodes`` (m, 2)."""
    fields = _null_fields(highest)
    size = count(highest + 1)
    order = exponents(highest + 1).sum(axis=1)
    lines = np.zeros((len(nodes), 2, 3))
    lines[:, :, 0] = nodes
    lines[:, 0, 1] = lines[:, 1, 2] = -1.0
    rows = np.zeros((len(nodes), size, len(fields)))
    for number, field in enumerate(fields):  # at most 15
        product = multiply(lines, 1, field[None], highest).sum(axis=1)
        rows[:, :, number] = np.where(order > degree[:, None], product, 0.0)
    values = np.linalg.svd(rows.reshape(-1, len(fields)), compute_uv=False)
    return int((values > RANK * values[0]).sum())


def _null_fields(degree: int) -> Floats:
    """The p (p + 2) fields ``B`` (n, 2, K): all of degree p - 1, and (y, -x) times degree p - 1."""
    size, lower = count(degree), count(degree - 1)
    plain = np.zeros((2, lower, 2, size))
    for axis in (0, 1):
        plain[axis, :, axis, :lower] = np.eye(lower)
    top = exponents(degree - 1).sum(axis=1) == degree - 1
    times = np.eye(lower)[top]
    x, y = np.eye(3)[1:2], np.eye(3)[2:]
    turned = np.stack([multiply(y, 1, times, degree - 1), -multiply(x, 1, times, degree - 1)], 1)
    return np.concatenate([plain.reshape(-1, 2, size), turned])


def _of_grids(cut: CutCells, degree: int) -> int:
    lines = 0
    for first, second in (((0, 3), (1, 2)), ((0, 1), (3, 2))):  # neighbours along x and along y
        pairs = cut.covers[:, first].ravel(), cut.covers[:, second].ravel()
        lines += int(components(cut.n_covers, *pairs).max()) + 1
    return degree * (degree + 1) // 2 * lines - degree * (degree - 1) // 2 * cut.n_bodies


def _counted(groups: Sequence[ElementGroup], n: int) -> int:
    """Number of eigenvalues of the scaled Gram matrix of all unknowns below `ZERO`."""
    scalar = all(group.combination is None for group in groups)
    gram = _gram([_products(group, scalar) for group in groups], n // 2 if scalar else n)
    scale = 1 / np.sqrt(np.maximum(gram.diagonal(), 1e-300))
    scaled = diags_array(scale) @ gram @ diags_array(scale)
    return (2 if scalar else 1) * _below(csc_array(scaled), ZERO)


def _below(matrix: csc_array, bound: float) -> int:
    from scipy.sparse.linalg import splu

    shifted = csc_array(matrix - bound * eye_array(matrix.shape[0]))
    options = {"SymmetricMode": True}
    factor = splu(shifted, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    return int((factor.U.diagonal() < 0).sum())


def _products(group: ElementGroup, scalar: bool) -> tuple[Ints, Floats]:
    """Unknowns (n, L) and integrals (n, L, L) of their products; of one component if scalar."""
    products = group.products()
    if scalar:  # both components have the same functions, one after the other
        return group.unknowns[:, ::2] // 2, products[group.shape]
    m, size, _ = products.shape
    both = np.zeros((m, size, 2, size, 2))
    both[:, :, 0, :, 0] = both[:, :, 1, :, 1] = products
    full = both.reshape(m, 2 * size, 2 * size)
    if group.combination is not None:
        full = np.swapaxes(group.combination, 0, 1) @ full @ group.combination
    return group.unknowns, full[group.shape]


def _gram(parts: Sequence[tuple[Ints, Floats]], n: int) -> csc_array:
    rows, columns = [], []
    for unknowns, _ in parts:  # a handful of groups
        rows.append(np.repeat(unknowns, unknowns.shape[1], axis=1).ravel())
        columns.append(np.tile(unknowns, unknowns.shape[1]).ravel())
    values = np.concatenate([products.ravel() for _, products in parts])
    entries = values, (np.concatenate(rows), np.concatenate(columns))
    return csc_array(coo_array(entries, shape=(n, n)))
