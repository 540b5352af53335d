"""Which elements hold the material at a point: one of each body, and of each face of a crack."""

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints

APART = 1e-6
"""Share of the largest shape function by which those of two faces differ at least."""


def sides_at(manifold: Manifold, elements: Ints, point: Floats) -> Ints:
    """Return those of ``elements`` (k,) that touch a ``point`` (2,), one for each displacement.

    Displacements are continuous in a body but across its cracks, and in none from body to body.
    """
    m = len(elements)
    rows = manifold.rows(elements, np.tile(point, (m, 1)))
    unknown, column = np.unique(rows.unknowns, return_inverse=True)
    values = np.zeros((m, 2, len(unknown)))
    each, column = np.arange(m)[:, None], column.reshape(rows.unknowns.shape)
    for component in range(2):
        np.add.at(values[:, component], (each, column), rows.values[:, component])
    off = np.abs(values[:, None] - values).max(axis=(2, 3), initial=0.0)
    alike = off <= APART * np.abs(values).max(initial=0.0)
    return np.asarray(elements[alike.argmax(axis=1) == np.arange(m)])
