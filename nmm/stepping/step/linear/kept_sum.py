"""A sum of matrices, made anew only when one of them or its factor is another."""

from scipy.sparse import csc_array

Parts = list[tuple[float, csc_array]]


class KeptSum:
    """The sum of factors times matrices (n, n): the same object as long as all of them stay."""

    def __init__(self) -> None:
        self._kept: tuple[Parts, csc_array] | None = None

    def of(self, parts: Parts) -> csc_array:
        """Return the sum of at least one part."""
        if self._kept is None or not _are(self._kept[0], parts):
            factor, matrix = parts[0]
            total = matrix if factor == 1 else csc_array(factor * matrix)
            for factor, matrix in parts[1:]:  # stiffness, mass, and a handful of dampers
                total = csc_array(total + factor * matrix)
            self._kept = parts, total
        return self._kept[1]


def _are(some: Parts, others: Parts) -> bool:
    """Whether factors and matrices are the same objects."""
    if len(some) != len(others):
        return False
    for (a, one), (b, other) in zip(some, others, strict=True):
        if a != b or one is not other:
            return False
    return True
