"""The unknowns of rigid motions and of the uniform stretch of each body."""

import numpy as np
from scipy.sparse import csc_array

from covers.approximation.groups.physical_covers import PhysicalCovers
from covers.local_functions.polynomials import Kinds
from integration.arrays import Floats
from integration.plane_vectors import QUARTER_TURN

STILL = np.zeros((2, 2))


def rigid_modes(
    kinds: Kinds,
    covers: PhysicalCovers,
    n_unknowns: int,
    body_centroid: Floats,
    nodes: Floats | None = None,
) -> csc_array:
    """Return the unknowns (n_unknowns, 3 B) of translations and linearised rotation of each body.

    The rotation is about the centroid. It is exact if all local functions contain linear fields, or
    if the weights reproduce linear fields from values at nodes.

    Parameters
    ----------
    kinds
        Local functions of each cover.
    nodes
        (C, 2) nodes of weights of linear precision, at which covers of any degree take the values
        of the field; None to represent the field in every cover.
    """
    fields = [
        (np.array([1.0, 0.0]), STILL),
        (np.array([0.0, 1.0]), STILL),
        (np.zeros(2), QUARTER_TURN),
    ]
    return _modes(fields, kinds, covers, n_unknowns, body_centroid, nodes)


def stretch_modes(
    kinds: Kinds,
    covers: PhysicalCovers,
    n_unknowns: int,
    body_centroid: Floats,
    nodes: Floats | None = None,
) -> csc_array:
    """Return the unknowns (n_unknowns, B) of the field ``X - Xc`` of each body."""
    fields = [(np.zeros(2), np.eye(2))]
    return _modes(fields, kinds, covers, n_unknowns, body_centroid, nodes)


def _modes(
    fields: list[tuple[Floats, Floats]],
    kinds: Kinds,
    covers: PhysicalCovers,
    n_unknowns: int,
    body_centroid: Floats,
    nodes: Floats | None = None,
) -> csc_array:
    """Unknowns of linear fields ``value + gradient (X - Xc)`` of each body, a column each."""
    each = len(fields)
    total = csc_array((n_unknowns, each * len(body_centroid)))
    for number, item in enumerate(kinds.functions):  # a handful of kinds of covers
        index = np.flatnonzero(kinds.which == number)
        arm = (covers.centre if nodes is None else nodes)[index]
        arm = arm - body_centroid[covers.body[index]]
        constant = 1.0 if nodes is None else 0.0
        still = (len(index), 2, 2)
        unknowns = [
            item.linear_field(
                value + arm @ gradient.T,
                np.broadcast_to(constant * gradient, still),
                covers.matrix[index],
            )
            for value, gradient in fields
        ]
        values = np.stack(unknowns, axis=2)
        rows = (covers.first_unknown[index, None] + np.arange(item.n_unknowns))[:, :, None]
        columns = each * covers.body[index, None, None] + np.arange(each)
        rows, columns = np.broadcast_arrays(rows, columns)
        part = (values.ravel(), (rows.ravel(), columns.ravel()))
        total = total + csc_array(part, shape=total.shape)
    return total
