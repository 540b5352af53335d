"""The scalar product of two vectors, in as many partial sums as the processor adds at once."""

from integration.arrays import Floats
from nmm.compiled import compiled_sums


@compiled_sums
def dot(one: Floats, other: Floats) -> float:
    """``one @ other``."""
    total = 0.0
    for i in range(len(one)):
        total += one[i] * other[i]
    return total
