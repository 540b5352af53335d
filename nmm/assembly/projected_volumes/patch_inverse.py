"""Inverses of the small measures of patches, as square roots."""

import numpy as np

from integration.arrays import Floats, Ints

# Combinations of functions whose measure is below this share of the largest have no value of
# their own; one below minus this share comes from weights that are negative somewhere.
POSITIVE = 1e-10


def inverse_roots(mass: Floats, size: Ints) -> Floats | None:
    """Return ``R`` (P, q, q) with ``R^T R`` the inverse of each matrix (P, q, q).

    Only the first ``size`` (P,) rows and columns of each count; None when one is not positive.
    """
    used = np.arange(mass.shape[1]) < size[:, None]
    diagonal = np.einsum("pii->pi", mass)
    if (diagonal[used] <= 0).any():
        return None
    scale = np.where(used, 1 / np.sqrt(np.where(used, diagonal, 1.0)), 0.0)
    both = scale[:, :, None] * scale[:, None, :]
    value, vector = np.linalg.eigh(mass * both)
    if (value < -POSITIVE).any():
        return None
    sure = value > POSITIVE
    root = np.where(sure, 1 / np.sqrt(np.where(sure, value, 1.0)), 0.0)
    found = root[:, :, None] * np.swapaxes(vector, 1, 2) * scale[:, None, :]
    # Largest values first, so that rows of matrices that are smaller than the others are the first.
    return np.asarray(found[:, ::-1])
