"""How many blocks and cells a scene will have, estimated before any is made."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from covers.mathematical.base import Cover
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm import capacity
from nmm.errors import Fault, FormulationError
from nmm.geometry.tessellation.cover_types import COVER_TYPES, highest_degree

if TYPE_CHECKING:
    from nmm.formulation import CoverTable
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene

# Sizes of a net in sizes of the blocks: beyond it they vanish in the rounding of its cells.
COARSEST = 1e6


def refuse_many_blocks(scene: Scene, outlines: Polygons) -> None:
    """Refuse tessellations and joint sets whose blocks take more memory than there is.

    Raises
    ------
    NmmError
        Names the tessellation or joint set that has most of them.
    """
    for index, item in enumerate(scene.tessellations):
        place = scene.source.place("tessellations", index, "blocks")
        amount = item.blocks * capacity.BLOCK
        capacity.refuse(place, f"{item.blocks:,} blocks", amount, "take fewer blocks")
    total = len(scene.blocks) + sum(item.blocks for item in scene.tessellations)
    place = scene.source.place("tessellations")
    capacity.refuse(place, f"{total:,} blocks", total * capacity.BLOCK, "take fewer blocks")
    if scene.joint_sets:
        _refuse_dense_joints(scene, outlines.points)


def refuse_many_cells(regions: Regions, cover: CoverTable, place: str) -> None:
    """Refuse nets whose cells take more memory than there is, before one is laid.

    Raises
    ------
    NmmError
        Names the size.
    """
    if cover.finest is None:
        return
    points = regions.polygons.points
    nets = {net.block: net.size for net in cover.nets or () if net.size is not None}
    for block, size in nets.items():
        own = regions.polygons.take(regions.select(block))
        if len(own):
            _refuse_cells(own.points, own.areas, size, cover, place)
    if cover.size is not None:
        _refuse_cells(points, regions.polygons.areas, cover.size, cover, place)


def _refuse_cells(
    points: Floats,
    areas: Floats,
    size: float,
    cover: CoverTable,
    place: str,
) -> None:
    """A regular net is laid over the box of the material before it is cut by it."""
    kind, bounds = COVER_TYPES.load(cover.type), np.stack([points.min(axis=0), points.max(axis=0)])
    box = bounds[1] - bounds[0]
    if size > COARSEST * box.max():
        value = f"{size:g} m, for blocks of {box.max():g} m"
        expected = "a size nearer to that of the blocks"
        raise FormulationError(Fault(place, value, expected, "check its unit"))
    if issubclass(kind, Cover):
        try:
            cells = kind.foreseen(bounds, size, **cover.options)
        except (ValueError, TypeError):  # the net says what is wrong with its options when laid
            return
        amount = cells * capacity.CELL * kind.overlap * (1 + highest_degree(cover)) ** 2
    else:
        cells = float(areas.sum()) / size**2
        amount = cells * capacity.BLOCK
    what = f"size {size:g} m over {box[0]:g} m by {box[1]:g} m: {cells:,.0f} cells"
    capacity.refuse(place, what, amount, "take a larger size")


def _refuse_dense_joints(scene: Scene, points: Floats) -> None:
    """Lines of sets of different dip cross one another everywhere: their blocks multiply."""
    across = float(np.hypot(*np.ptp(points, axis=0)))
    lines = [across / item.spacing for item in scene.joint_sets]
    traces = [
        count * (across / item.trace if item.persistence < 1 and item.trace else 1.0)
        for count, item in zip(lines, scene.joint_sets, strict=True)
    ]
    worst = int(np.argmax(traces))
    most = sorted(traces)[-2:]
    # Two sets divide a region into the product of their lines, one into as many as it has.
    blocks = math.prod(count + 1 for count in most)
    place = scene.source.place("joint_sets", worst, "spacing")
    what = f"about {blocks:,.0f} blocks between joints"
    capacity.refuse(place, what, blocks * capacity.BLOCK, "increase spacing or trace")
