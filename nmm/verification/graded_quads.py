"""Rectangles between the lines of graded triangles: a net for benchmarks on quads."""

from typing import Any, Self, cast

import numpy as np
import numpy.typing as npt

from covers.mathematical.graded import Graded
from covers.mathematical.quads import Quads


class GradedQuads(Quads):
    """`covers.mathematical.graded.Graded` without the diagonals of its rectangles."""

    @classmethod
    def foreseen(cls, bounds: npt.ArrayLike, size: float, **options: Any) -> float:
        """See `covers.mathematical.base.Cover.foreseen`: one for two triangles."""
        return Graded.foreseen(bounds, size, **options) / 2

    @classmethod
    def regular(cls, bounds: npt.ArrayLike, size: Any, **options: Any) -> Self:
        """Return a net over a box; parameters as of `covers.mathematical.graded.Graded.regular`."""
        from skfem import MeshQuad

        net = Graded.regular(bounds, size, **options)
        # The triangles [a, b, c] of all rectangles come first, then [a, c, d].
        lower, upper = np.split(net.cell_vertices, 2)
        cells = np.column_stack([lower, upper[:, 2]])
        return cast(Self, Quads.from_mesh(MeshQuad(net.vertices.T.copy(), cells.T.copy())))
