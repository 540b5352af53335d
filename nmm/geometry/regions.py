"""All blocks of a scene: given by corners, tessellated, cut by joint sets; checked."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
import shapely

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError, NmmError
from nmm.geometry.blocks import Regions, joined
from nmm.geometry.checks.amounts import refuse_many_blocks
from nmm.geometry.checks.places import place_faults
from nmm.geometry.checks.rings import outline_faults, overlap_faults
from nmm.geometry.checks.together import Together
from nmm.geometry.places import edge_distances, tolerance
from nmm.geometry.tessellation.jointing import jointed
from nmm.geometry.tessellation.seeds import seed_of
from nmm.geometry.tessellation.voronoi import tessellate
from nmm.scene.model import Scene


def regions(scene: Scene) -> Regions:
    """All blocks of a scene.

    Points of supports and loads, and ends of their segments, that lie on the boundary of a
    tessellated region become vertices of its blocks.

    Raises
    ------
    GeometryError
        Every fault found: outlines that touch or cross themselves, blocks without area, double
        vertices, blocks that overlap or lie inside others, supports, loads and monitors that
        touch nothing.
    """
    outlines = _outlines(scene)
    _refuse(outline_faults(outlines, partial(_ring_place, scene)))
    refuse_many_blocks(scene, outlines)
    parts = [_given(scene, outlines)]
    for index in range(len(scene.tessellations)):
        outline = outlines.take([len(scene.blocks) + index]).oriented()
        parts.append(_tessellated(scene, index, outline))
    try:
        whole = jointed(scene, joined(parts))
    except (ValueError, shapely.errors.GEOSException) as fault:
        if isinstance(fault, NmmError):
            raise
        place, value = scene.source.place("joint_sets"), " ".join(str(fault).split())
        remedy = "move or remove joints that almost coincide, or use another seed"
        raise GeometryError(Fault(place, value, "joints that cut blocks", remedy)) from fault
    at, meet = partial(_place, scene), Together.of(scene, whole).meet
    faults = overlap_faults(whole.polygons, whole.source, whole.name, at, meet)
    _refuse([*faults, *place_faults(scene, whole)])
    return whole


def _refuse(faults: list[Fault]) -> None:
    if faults:
        raise GeometryError(*faults)


def _path(scene: Scene, index: int) -> tuple[str, int]:
    count = len(scene.blocks)
    return ("blocks", index) if index < count else ("tessellations", index - count)


def _place(scene: Scene, index: int) -> str:
    return scene.source.place(*_path(scene, index))


def _outlines(scene: Scene) -> Polygons:
    """Outlines of all blocks and tessellated regions; a ring's repeated first vertex is dropped."""
    solids = [[block.vertices, *block.holes] for block in scene.blocks]
    solids += [[item.region, *item.holes] for item in scene.tessellations]
    return Polygons.from_rings(solids)


def _ring_place(scene: Scene, index: int, ring: int) -> str:
    path = _path(scene, int(index))
    if ring:
        return scene.source.place(*path, "holes", int(ring) - 1)
    return scene.source.place(*path, "vertices" if path[0] == "blocks" else "region")


def _given(scene: Scene, outlines: Polygons) -> Regions:
    names = list(scene.materials)
    count = len(scene.blocks)
    return Regions(
        outlines.take(np.arange(count)).oriented(),
        np.array([names.index(block.material) for block in scene.blocks], dtype=np.int64),
        tuple(block.name or f"#{index}" for index, block in enumerate(scene.blocks)),
        np.arange(count),
    )


def _tessellated(scene: Scene, index: int, outline: Polygons) -> Regions:
    item = scene.tessellations[index]
    cells = tessellate(
        outline,
        item.blocks,
        seed=seed_of(item, scene, index),
        smoothing=item.smoothing,
        shortest_edge=item.shortest_edge,
        keep=np.concatenate([np.reshape(item.keep, (-1, 2)), _acting_points(scene, outline)]),
        place=scene.source.place("tessellations", index),
    )
    count = len(cells)
    return Regions(
        cells,
        np.full(count, list(scene.materials).index(item.material)),
        tuple(f"{item.name}.{k}" for k in range(count)),
        np.full(count, len(scene.blocks) + index),
    )


def _acting_points(scene: Scene, outline: Polygons) -> Floats:
    points = np.reshape(np.array(list(_points(scene)), dtype=float), (-1, 2))
    return points[edge_distances(outline, points) <= tolerance(outline.points)]


def _points(scene: Scene) -> Iterator[tuple[float, float]]:
    for item in (*scene.supports, *scene.loads):
        if item.point is not None:
            yield item.point
        yield from item.segment or ()
