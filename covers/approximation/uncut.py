"""The trivial cut: every element is a cell with a patch, a cover and a body of its own."""

import numpy as np

from covers.approximation.manifold import Manifold
from covers.cutting.connectivity import Joins
from covers.cutting.cut_boundary import CrackTips, CutBoundary
from covers.cutting.cut_cells import CutCells


def uncut(manifold: Manifold) -> CutCells:
    """Return the elements of a manifold as an uncut cover."""
    elements, regions, edges = manifold.elements, manifold.element_region, manifold.boundary
    number = np.arange(len(elements), dtype=np.int64)
    none = np.full(len(edges), -1, dtype=np.int64)
    nowhere, no_number = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    return CutCells(
        elements=elements,
        element_cell=number,
        element_region=regions,
        element_body=number,
        element_whole=np.ones(len(elements), dtype=bool),
        cell_width=np.sqrt(elements.areas),
        covers=number[:, None],
        cover_patch=number,
        cover_region=regions,
        cover_body=number,
        boundary=CutBoundary(
            *(edges.start, edges.end, edges.element, edges.body, edges.next, edges.previous),
            crack=none,
            opposite=none,
        ),
        tips=CrackTips(nowhere, nowhere, no_number, no_number),
        joins=Joins(no_number, no_number, nowhere, nowhere),
        step=0.0,
        crack_tolerance=0.0,
        slivers=0,
        sliver_area=0.0,
    )
