"""Mathematical covers: overlapping patches with weights that sum to one (Shi 1991)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from covers.concatenate import numbers
from covers.mathematical.mesh_edges import MeshEdges, mesh_edges
from integration.arrays import Floats, Ints
from integration.polygons import Polygons

if TYPE_CHECKING:
    from collections.abc import Callable

    from covers.cutting.cut_cells import CutCells

    Recut = Callable[["Cover"], CutCells]

# Cells along a side that are told apart when they are counted.
MOST_ALONG = 1e6


class CoverType:
    """A way of covering material: by patches over all of it, or by its pieces, one cover each.

    Attributes
    ----------
    coordinates
        options that are points, in the axes of the material.
    """

    coordinates: ClassVar[tuple[str, ...]] = ()


@dataclass(frozen=True, eq=False)
class Cover(CoverType, ABC):
    """Patches over a mesh of convex cells; each cell knows the patches that are active in it.

    A cover is laid without regard to the material: the cut decides what is covered.

    Attributes
    ----------
    vertices : (V, 2)
        corners of the cells, m.
    cell_vertices : (C, v)
        corners of each cell, counter-clockwise.
    cell_patches : (C, k)
        patches active in each cell; -1 fills the rows of covers whose number varies.
    patch_centre : (N, 2)
        centre of each patch, m. With ``precision >= 1``, ``sum w_i(x) centre_i = x``.
    patch_size : (N,)
        length that scales coordinates about the centre to at most about one in the patch, m.
    cell_shape : (C,)
        cells of one number are translations of one another; -1 where nothing is known.
    overlap
        How many times the entries of a mesh's rows those of the cover have.
    """

    overlap: ClassVar[float] = 1.0
    vertices: Floats
    cell_vertices: Ints = field(metadata=numbers("vertex"))
    cell_patches: Ints = field(metadata=numbers("patch"))
    patch_centre: Floats
    patch_size: Floats
    cell_shape: Ints = field(metadata=numbers("shape"))

    @classmethod
    def foreseen(cls, bounds: npt.ArrayLike, size: float, **options: Any) -> float:
        """Return about how many cells ``regular`` would lay over a box, before it lays any.

        Here one for each square of ``size``; a cover whose cells differ counts them. Of more than
        a million along a side the number is no longer exact.

        Raises
        ------
        ValueError, TypeError
            Where ``regular`` would raise it.
        """
        low, high = np.array(bounds, dtype=float).reshape(2, 2)
        return float(np.prod(np.minimum(high - low, MOST_ALONG * size) / size + 1))

    @property
    @abstractmethod
    def precision(self) -> int:
        """Highest degree ``s`` of the polynomials that the weights combine to exactly."""

    @property
    def weight_degree(self) -> int | None:
        """Total degree of the weights as polynomials on a cell, None when they are not."""
        return None

    @property
    def disc_radius(self) -> Floats | None:
        """Radii (N,) of patches that are discs, None when patches are unions of cells, m."""
        return None

    @abstractmethod
    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2) of the patches of ``cells`` (m,) at points."""

    def settled(self, cut: CutCells, again: Recut) -> tuple[Cover, CutCells]:
        """Return cover and cut as functions are made on them: without patches that carry none.

        Parameters
        ----------
        cut
            What the material has left of the cover.
        again
            Cuts another cover by the same material.
        """
        return self, cut

    @property
    def mended(self) -> dict[str, int]:
        """What `settled` has changed, in words with how many patches."""
        return {}

    def weights(self, cells: Ints, points: Floats) -> Floats:
        """Weights (m, k) at ``points`` (m, 2), each in the cell of the same row."""
        return self.evaluate(cells, points)[0]

    def weight_tables(self, cells: Ints, origin: Floats, scale: Floats) -> tuple[Floats, int]:
        """Coefficients (m, k, K) of the weights over monomials of (x - origin) / scale, degree.

        Raises
        ------
        ValueError
            The weights are not polynomials on a cell (`weight_degree` is None).
        """
        raise ValueError(
            f"{type(self).__name__}: weights that are no polynomials: polynomial weights expected: "
            "integrate with point rules and evaluate()"
        )

    @property
    def n_patches(self) -> int:
        """Number of patches."""
        return len(self.patch_centre)

    @cached_property
    def cells(self) -> Polygons:
        """The cells as polygons."""
        n, corners = self.cell_vertices.shape
        points = self.vertices[self.cell_vertices].reshape(-1, 2)
        return Polygons(points, np.arange(0, n * corners + 1, corners), np.arange(n + 1))

    @cached_property
    def cell_boxes(self) -> tuple[Floats, Floats]:
        """Lowest and highest coordinates (C, 2) of the cells, m."""
        corners = self.vertices[self.cell_vertices]
        return corners.min(axis=1), corners.max(axis=1)

    @cached_property
    def edges(self) -> MeshEdges:
        """Edges of the mesh of cells with the cells on either side."""
        return mesh_edges(self.cell_vertices)
