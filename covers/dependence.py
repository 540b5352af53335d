"""How many functions of an approximation depend on the others.

Weights with linear precision about their nodes, ``sum w_i x_i = x``, give for every polynomial
field ``B`` of degree p, with ``B_p . x = 0`` for its top-degree part,

    sum_i w_i(x) B(x) . (x_i - x) = 0,

which are p (p + 2) dependent functions of each displacement component on each connected piece of
material. On triangles there are no others (for p = 1 they are the motions of the mesh as a truss);
regular rectangles have more.
"""

from collections.abc import Sequence

import numpy as np

from covers.base import Cover
from covers.cut_cells import CutCells
from covers.local_functions import LocalFunctions
from integration.arrays import Ints


def dependent_functions(
    cover: Cover, cut: CutCells, functions: Sequence[LocalFunctions], which: Ints
) -> int:
    """Return the number of dependent functions known in closed form.

    Covers of lower degree among those of a body hold the field: its lowest degree counts.
    """
    if cover.precision < 1:
        return 0
    degree = np.array([item.degree for item in functions])[which]
    lowest = np.full(cut.n_bodies, degree.max(initial=0))
    np.minimum.at(lowest, cut.cover_body, degree)
    return int((2 * lowest * (lowest + 2)).sum())
