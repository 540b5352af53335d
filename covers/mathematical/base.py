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

# Largest number of cells along a side that is counted exactly.
MOST_ALONG = 1e6


class CoverType:
    """A type of cover: patches over all of the material, or one cover for each block.

    Attributes
    ----------
    coordinates
        options that are points in the axes of the scene.
    """

    coordinates: ClassVar[tuple[str, ...]] = ()


@dataclass(frozen=True, eq=False)
class Cover(CoverType, ABC):
    """Patches over a mesh of convex cells; each cell has the numbers of the patches active in it.

    The mesh does not follow the material: the cut determines what is covered.

    Attributes
    ----------
    vertices : (V, 2)
        corners of the cells, m.
    cell_vertices : (C, v)
        corners of each cell, counter-clockwise.
    cell_patches : (C, k)
        patches active in each cell, padded with -1 where their number varies.
    patch_centre : (N, 2)
        centre of each patch, m. With ``precision >= 1``, ``sum w_i(x) centre_i = x``.
    patch_size : (N,)
        length that scales coordinates about the centre to about one in the patch, m.
    cell_shape : (C,)
        cells of the same number are translates of each other; -1 where this is unknown.
    overlap
        Ratio of the number of entries of its matrix rows to those of a mesh of finite elements.
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
        """Return the approximate number of cells that ``regular`` makes over a box.

        By default one for each square of ``size``; override it for other cells. Beyond a million
        cells along a side the number is not exact.

        Raises
        ------
        ValueError, TypeError
            As ``regular`` raises them.
        """
        low, high = np.array(bounds, dtype=float).reshape(2, 2)
        return float(np.prod(np.minimum(high - low, MOST_ALONG * size) / size + 1))

    @property
    @abstractmethod
    def precision(self) -> int:
        """Highest degree ``s`` of the polynomials that the weights reproduce exactly."""

    @property
    def weight_degree(self) -> int | None:
        """Total degree of the weights as polynomials on a cell; None for others."""
        return None

    @property
    def disc_radius(self) -> Floats | None:
        """Radii (N,) of patches that are discs (m); None if patches are unions of cells."""
        return None

    @abstractmethod
    def evaluate(self, cells: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Weights (m, k) and gradients (m, k, 2) of the patches of ``cells`` (m,) at points."""

    def settled(self, cut: CutCells, again: Recut) -> tuple[Cover, CutCells]:
        """Return the cover and cut on which functions are defined, without unusable patches.

        Parameters
        ----------
        cut
            The cut of the cover by the material.
        again
            Cuts another cover by the same material.
        """
        return self, cut

    @property
    def settles(self) -> bool:
        """Whether its patches depend on the cut, so that each cut begins with a cover laid anew."""
        return type(self).settled is not Cover.settled

    @property
    def mended(self) -> dict[str, int]:
        """Changes by `settled`, in words, with the number of patches."""
        return {}

    def weights(self, cells: Ints, points: Floats) -> Floats:
        """Weights (m, k) at ``points`` (m, 2) in ``cells`` (m,)."""
        return self.evaluate(cells, points)[0]

    def weight_tables(self, cells: Ints, origin: Floats, scale: Floats) -> tuple[Floats, int]:
        """Coefficients (m, k, K) of the weights over monomials of (x - origin) / scale, and degree.

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
    def cell_width(self) -> Floats:
        """Second longest side (C,) of each cell, m: in a uniform net the size it was laid with."""
        corners = self.vertices[self.cell_vertices]
        sides = np.hypot(*(np.roll(corners, -1, axis=1) - corners).transpose(2, 0, 1))
        return np.asarray(np.sort(sides, axis=1)[:, -2])

    @cached_property
    def cell_boxes(self) -> tuple[Floats, Floats]:
        """Lowest and highest coordinates (C, 2) of the cells, m."""
        corners = self.vertices[self.cell_vertices]
        return corners.min(axis=1), corners.max(axis=1)

    @cached_property
    def edges(self) -> MeshEdges:
        """Edges of the mesh of cells with the cells on either side."""
        return mesh_edges(self.cell_vertices)
