"""The Euclidean norm of forces and unknowns."""

from math import sqrt

import numpy as np

from integration.arrays import Floats


def norm(vector: Floats) -> float:
    """Return the norm of a vector (n,), without the threads that BLAS starts for long ones."""
    return sqrt(float(np.einsum("i,i->", vector, vector)))
