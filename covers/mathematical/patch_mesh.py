"""The mesh of a cover, and which patches are active in each of its cells: what a cut asks of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from covers.concatenate import numbers
from covers.mathematical.mesh_edges import MeshEdges, mesh_edges
from integration.arrays import Floats, Ints
from integration.polygons import Polygons


@dataclass(frozen=True, eq=False)
class PatchMesh:
    """Patches over a mesh of convex cells; each cell has the numbers of the patches active in it.

    Attributes
    ----------
    vertices : (V, 2)
        corners of the cells, m.
    cell_vertices : (C, v)
        corners of each cell, counter-clockwise.
    cell_patches : (C, k)
        patches active in each cell, padded with -1 where their number varies.
    patch_centre : (N, 2)
        centre of each patch, m.
    patch_size : (N,)
        length that scales coordinates about the centre to about one in the patch, m.
    cell_shape : (C,)
        cells of the same number are translates of each other; -1 where this is unknown.
    """

    vertices: Floats
    cell_vertices: Ints = field(metadata=numbers("vertex"))
    cell_patches: Ints = field(metadata=numbers("patch"))
    patch_centre: Floats
    patch_size: Floats
    cell_shape: Ints = field(metadata=numbers("shape"))

    @property
    def disc_radius(self) -> Floats | None:
        """Radii (N,) of patches that are discs (m); None if patches are unions of cells."""
        return None

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
