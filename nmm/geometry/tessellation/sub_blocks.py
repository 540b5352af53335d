"""Blocks divided by a mesh into sub-blocks (Ke 1996), each a block of its own to the covers."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.errors import FormulationError
from nmm.registry import check_values

if TYPE_CHECKING:
    from covers.mathematical.base import Cover as Net
    from nmm.formulation import CoverTable

MESHES = ("triangles", "quads", "voronoi")
BONDS = ("elastic", "interface")
GLUES = ("springs", "nitsche")


@dataclass(frozen=True)
class SubBlocks:
    """How blocks are divided: the options of ``[cover] type = "sub_blocks"``.

    Attributes
    ----------
    mesh
        "triangles" (squares halved), "quads" (squares) or "voronoi". The squares start at the lower
        left corner of all blocks, so that rectangles of whole multiples of the size are not cut.
    bond
        "elastic": sub-blocks never part. "interface": they are joints of the scene's interface
        between the block's material and itself, and break as that says.
    glue
        What elastic bonds are: "springs", or "nitsche" for Nitsche's terms, which give by nothing.
    stiffness
        Springs in Young's moduli over the distance of the sub-blocks' middles.
    seed
        Of the Voronoi points.
    """

    mesh: str = "triangles"
    bond: str = "elastic"
    glue: str = "springs"
    stiffness: float = 100.0
    seed: int = 1

    @classmethod
    def of(cls, cover: CoverTable) -> Self:
        """Read the options of a formulation's cover.

        Raises
        ------
        FormulationError
            An unknown option or value, or no size.
        """
        check_values(
            "[cover.options]", {item.name: item.type for item in fields(cls)}, cover.options
        )
        found = cls(**cover.options)
        for name, values in (("mesh", MESHES), ("bond", BONDS), ("glue", GLUES)):
            if getattr(found, name) not in values:
                raise FormulationError(
                    f"[cover.options] {name}: {getattr(found, name)!r}: expected one of "
                    f"{', '.join(values)}: correct the name"
                )
        if not found.stiffness > 0:
            raise FormulationError(
                f"[cover.options] stiffness: {found.stiffness}: expected a number > 0"
            )
        if cover.size is None:
            raise FormulationError(
                "[cover] size: not given: expected the size of a sub-block in m with type = "
                '"sub_blocks"'
            )
        return found


def divided(blocks: Polygons, cover: CoverTable) -> tuple[Polygons, Ints]:
    """Return the sub-blocks of all blocks and the block (n,) that each comes from."""
    options = SubBlocks.of(cover)
    assert cover.size is not None
    if options.mesh == "voronoi":
        return _voronoi(blocks, cover.size, options.seed)
    from covers.cutting.cut import cut

    points = blocks.points
    bounds = np.stack([points.min(axis=0), points.max(axis=0)])
    try:
        pieces = cut(_net(bounds, cover, options.mesh == "triangles"), blocks)
    except ValueError as fault:
        raise FormulationError(f"[cover] {fault}") from fault
    return pieces.elements, pieces.element_region


def _net(bounds: Floats, cover: CoverTable, halved: bool) -> Net:
    from covers.mathematical.quads import Quads

    assert cover.size is not None
    squares = Quads.regular(bounds, cover.size, angle=cover.angle, shift=cover.shift)
    if not halved:
        return squares
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
