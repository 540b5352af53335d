"""Unknowns of the rigid motions of each body."""

import numpy as np
from scipy.sparse import csc_array

from covers.local_functions import LocalFunctions
from covers.polynomial_groups import PhysicalCovers
from integration.arrays import Floats, Ints


def rigid_modes(
    functions: LocalFunctions, covers: PhysicalCovers, offset: Ints, body_centroid: Floats
) -> csc_array:
    """Return the unknowns (n_unknowns, 3 B) of translation x, y and linear rotation of each body.

    The rotation is about the body's centroid. It is exact when the local functions hold the
    linear field, or when the weights reproduce linear fields from the values at the centres.
    """
    still, turn = np.zeros((2, 2)), np.array([[0.0, -1.0], [1.0, 0.0]])
    fields = [(np.array([1.0, 0.0]), still), (np.array([0.0, 1.0]), still), (np.zeros(2), turn)]
    return _modes(fields, functions, covers, offset, body_centroid)


def stretch_modes(
    functions: LocalFunctions, covers: PhysicalCovers, offset: Ints, body_centroid: Floats
) -> csc_array:
    """Return the unknowns (n_unknowns, B) of the field ``X - Xc`` of each body."""
    return _modes([(np.zeros(2), np.eye(2))], functions, covers, offset, body_centroid)


def _modes(
    fields: list[tuple[Floats, Floats]],
    functions: LocalFunctions,
    covers: PhysicalCovers,
    offset: Ints,
    body_centroid: Floats,
) -> csc_array:
    """Unknowns of linear fields ``value + gradient (X - Xc)`` of each body, a column each."""
    n, kinds = len(covers.body), len(fields)
    arm = covers.centre - body_centroid[covers.body]
    unknowns = [
        functions.linear_field(
            value + arm @ gradient.T, np.broadcast_to(gradient, (n, 2, 2)), covers.length
        )
        for value, gradient in fields
    ]
    values = np.stack(unknowns, axis=2)
    rows = (offset[:n, None] + np.arange(functions.n_unknowns))[:, :, None]
    columns = kinds * covers.body[:, None, None] + np.arange(kinds)
    rows, columns = np.broadcast_arrays(rows, columns)
    shape = (int(offset[-1]), kinds * len(body_centroid))
    return csc_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=shape)
