"""The Euclidean norm of forces and unknowns."""

from math import sqrt

from integration.arrays import Floats
from integration.contraction import contract


def norm(vector: Floats) -> float:
    """Return the norm of a vector (n,), without the threads that BLAS starts for long ones."""
    return sqrt(float(contract("i,i->", vector, vector)))
