"""Elements whose covers have the same local functions, in the same order."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from covers.approximation.singular.carriers import Carriers
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import Kinds, LocalFunctions
from integration.arrays import Ints


@dataclass(frozen=True)
class Pattern:
    """Elements whose covers have the same local functions, in the same order.

    Attributes
    ----------
    elements
        (n,) numbers in the cut.
    slots
        (n, k) positions of their active covers among those of their cell.
    covers
        (n, k) the active physical covers.
    functions
        Local functions of the k covers.
    carried
        (k,) number of singular points whose functions each cover carries too.
    """

    elements: Ints
    slots: Ints
    covers: Ints
    functions: list[LocalFunctions]
    carried: Ints

    @property
    def degree(self) -> int:
        """Highest degree of the local functions."""
        return max(item.degree for item in self.functions)


def patterns(cut: CutCells, kinds: Kinds, carriers: Carriers) -> Iterator[Pattern]:
    """Yield the elements of each pattern of local functions among the covers of elements."""
    covers, most = cut.covers, carriers.points.shape[1] + 1
    none = most * len(kinds.functions)
    code = most * kinds.which + carriers.counts
    codes = np.where(covers >= 0, code[covers], none)
    # Enriched slots first, then by functions, inactive ones last, in a stable order.
    rank = np.where(codes == none, none, codes - none * (codes % most))
    slots = np.argsort(rank, axis=1, kind="stable")
    for elements, row in _equal_rows(np.take_along_axis(codes, slots, axis=1)):
        active = row[row < none]
        places = slots[elements, : len(active)]
        yield Pattern(
            elements,
            places,
            np.take_along_axis(covers[elements], places, axis=1),
            [kinds.functions[kind] for kind in active // most],
            active % most,
        )


def _equal_rows(codes: Ints) -> Iterator[tuple[Ints, Ints]]:
    """Yield the numbers of equal rows, and the row, for each distinct row."""
    if (codes == codes[0]).all():
        distinct, which = codes[:1], np.zeros(len(codes), dtype=np.int64)
    else:
        distinct, which = np.unique(codes, axis=0, return_inverse=True)
        which = which.ravel()
    for number, row in enumerate(distinct):  # a handful of patterns
        yield np.flatnonzero(which == number), row
