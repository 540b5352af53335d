"""Blocks divided by a mesh into sub-blocks (Ke 1996), each a block of its own to the covers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from integration.arrays import Ints
from integration.polygons import Polygons
from nmm.errors import FormulationError
from nmm.geometry.tessellation.block_cover import BlockCover, PieceGlue
from nmm.registry import above_zero

if TYPE_CHECKING:
    from covers.mathematical.base import Cover as Net
    from covers.mathematical.quads import Quads

MESHES = ("triangles", "quads", "voronoi")
BONDS = ("elastic", "interface")
GLUES = ("springs", "nitsche")


@dataclass(frozen=True)
class SubBlocks(BlockCover):
    """Blocks divided by a mesh into sub-blocks that are glued, or may part (Ke 1996).

    Attributes
    ----------
    mesh
        "triangles" (squares halved), "quads" (squares) or "voronoi". The squares start at the lower
        left corner of all blocks, so that rectangles of whole multiples of the size are not cut.
    bond
        "elastic": sub-blocks never part. "interface": they are joints of the scene's interface
        between the block's material and itself, and break as that says.
    glue, stiffness
        What elastic bonds are; see `PieceGlue`.
    seed
        Of the Voronoi points.
    """

    divides: ClassVar[bool] = True
    mesh: str = "triangles"
    bond: str = "elastic"
    glue: str = "springs"
    stiffness: float = above_zero(100.0)
    seed: int = 1

    def __post_init__(self) -> None:
        for name, values in (("mesh", MESHES), ("bond", BONDS), ("glue", GLUES)):
            if getattr(self, name) not in values:
                raise FormulationError(
                    f"[cover.options] {name}: {getattr(self, name)!r}: expected one of "
                    f"{', '.join(values)}: correct the name"
                )

    @property
    def piece_glue(self) -> PieceGlue | None:
        method = None if self.glue == "springs" else self.glue
        return PieceGlue(method, self.stiffness) if self.bond == "elastic" else None

    def divided(
        self, blocks: Polygons, size: float | None, angle: float, shift: tuple[float, float]
    ) -> tuple[Polygons, Ints]:
        assert size is not None
        if self.mesh == "voronoi":
            return _voronoi(blocks, size, self.seed)
        from covers.cutting.cut import cut
        from covers.mathematical.quads import Quads

        points = blocks.points
        bounds = np.stack([points.min(axis=0), points.max(axis=0)])
        squares = Quads.regular(bounds, size, angle=angle, shift=shift)
        net = _halved(squares) if self.mesh == "triangles" else squares
        try:
            pieces = cut(net, blocks)
        except ValueError as fault:
            raise FormulationError(f"[cover] {fault}") from fault
        return pieces.elements, pieces.element_region


def _halved(squares: Quads) -> Net:
    from skfem import MeshTri

    from covers.mathematical.triangles import Triangles

    a, b, c, d = squares.cell_vertices.T
    corners: Any = np.concatenate([np.stack([a, b, c]), np.stack([a, c, d])], axis=1)
    return Triangles.from_mesh(MeshTri(squares.vertices.T.copy(), corners))


def _voronoi(blocks: Polygons, size: float, seed: int) -> tuple[Polygons, Ints]:
    from nmm.geometry.tessellation.voronoi import tessellate

    parts = []
    for number, area in enumerate(blocks.areas):  # each block has points of its own
        count = max(int(np.rint(area / size**2)), 1)
        parts.append(tessellate(blocks.take([number]), count, seed=(seed, number)))
    source = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    return Polygons.concatenate(parts), source
