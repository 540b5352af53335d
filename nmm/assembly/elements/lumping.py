"""A lumped mass must not be negative in any cover."""

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import csc_array
from nmm.errors import FormulationError

# Least eigenvalue of the mass of a cover, of unit diagonal, that is zero but for rounding: that of
# functions that depend on one another in a sliver.
NO_MASS = 1e-12


def check_positive(mass: csc_array, offset: Ints) -> None:
    """Refuse a mass that is negative in some cover; it may be zero for some functions.

    Raises
    ------
    FormulationError
        Naming the cover.
    """
    sizes = np.diff(offset)
    for size in np.unique(sizes):  # a handful of sizes
        chosen = np.flatnonzero(sizes == size)
        least = np.linalg.eigvalsh(_blocks(mass, offset[chosen], int(size)))[:, 0]
        bad = np.flatnonzero(least < -NO_MASS)
        if len(bad):
            raise FormulationError(
                f'[integrator] mass: "lumped": cover {chosen[bad[0]]} has a mass of '
                f"{least[bad[0]]:.2g} of its diagonal: expected a positive one: weights that are "
                'negative somewhere need "consistent"'
            )


def _blocks(mass: csc_array, first: Ints, size: int) -> Floats:
    """Blocks (k, size, size) on the diagonal, scaled to a diagonal of ones."""
    columns = (first[:, None] + np.arange(size)).ravel()
    part = mass[:, columns].tocoo()
    row, column = part.coords
    owner, inside = np.divmod(column, size)
    found = np.zeros((len(first), size, size))
    found[owner, row - first[owner], inside] = part.data
    diagonal = np.einsum("kii->ki", found)
    empty = (diagonal == 0).all(axis=1)
    found[empty] = np.eye(size)
    scale = 1 / np.sqrt(np.abs(np.einsum("kii->ki", found)))
    return np.asarray(found * scale[:, :, None] * scale[:, None, :])
