"""Matrices that are full among some unknowns: what water links by one pressure field.

Such a matrix is refused where memory cannot hold it (`refuse_full`).
"""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats, Ints
from nmm import capacity
from nmm.effects.base import Setup

# Bytes of a run for each entry of the matrix, with its sums, factors and patterns of contact:
# measured, 115 without contact and 290 with it.
ENTRY, BESIDE_CONTACT = 115, 290


def full_matrix(block: Floats, used: Ints, n: int) -> csc_array:
    """Return the matrix (n, n) of ``block`` (k, k) at the unknowns ``used`` (k,), which ascend.

    Columns are laid out at once: triplets would take four times as much.
    """
    length = np.zeros(n + 1, dtype=np.int64)
    length[used + 1] = len(used)
    rows = np.tile(used, len(used))
    return csc_array((block.T.ravel(), rows, np.cumsum(length)), shape=(n, n))


def refuse_full(setup: Setup, place: str, remedy: str) -> None:
    """Refuse a full matrix over all unknowns of a model that memory cannot hold.

    Raises
    ------
    NmmError
        There is less memory.
    """
    count = setup.model.manifold.n_unknowns
    entry = ENTRY if setup.scene.contact is None else BESIDE_CONTACT
    capacity.refuse(place, f"{count} unknowns", entry * count**2, remedy)
