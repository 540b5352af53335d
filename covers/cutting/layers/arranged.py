"""The elements of a layer: an arrangement of all lines, then topology."""

from __future__ import annotations

import numpy as np

from covers.cutting.cut_boundary import boundary_of
from covers.cutting.cut_cells import Layer
from covers.cutting.domain import Segments
from covers.cutting.layers.lines import mesh_segments
from covers.cutting.pieces import joins_of, pieces_of
from covers.cutting.plane_graph.closures import closed_faces
from covers.cutting.plane_graph.faces import BOUNDARY, CRACK, MESH, Cells, Sources
from covers.cutting.plane_graph.snap_rounding import lines_between, node
from covers.cutting.resolution import Resolution
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Ints


def arranged(
    cover: PatchMesh,
    cells: Cells,
    boundary: Segments,
    cracks: Segments,
    reach: float,
    resolution: Resolution,
    smallest: float,
    group: Ints,
    part: bool = False,
) -> Layer:
    """Return the elements of ``cells``: faces between lines in touched cells, and whole cells.

    Parameters
    ----------
    reach : float
        largest length of a closure, m.
    smallest : float
        see `covers.cutting.cut.cut`.
    group : (R,)
        regions of the same number share physical covers.
    part : bool
        whether other cells have material, too.
    """
    mesh = np.unique(cover.edges.of_cell[cells.touched])
    parts = [mesh_segments(cover, mesh), boundary, cracks]
    sources = Sources(
        np.repeat([MESH, BOUNDARY, CRACK], [len(part) for part in parts]),
        np.concatenate([part.owner for part in parts]),
    )
    start = np.concatenate([part.start for part in parts])
    end = np.concatenate([part.end for part in parts])
    count = np.arange(len(start))
    graph = lines_between(np.concatenate([start, end]), resolution, count, count + len(start))
    graph = node(graph, count >= len(mesh), resolution)
    faces = closed_faces(graph, sources, cells, resolution, reach)

    pieces = pieces_of(cover, cells, faces, smallest, resolution.step)
    joins = joins_of(cover, cells, faces, pieces, group)
    edges, tips = boundary_of(faces, pieces, group, part)
    return Layer(pieces, joins, edges, tips, cells.touched)
