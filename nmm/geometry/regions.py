"""All blocks of a scene: given by corners, tessellated, cut by joint sets; checked."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError
from nmm.geometry.blocks import Regions, joined
from nmm.geometry.checks import overlap_faults, ring_faults
from nmm.geometry.jointing import jointed
from nmm.geometry.place_checks import place_faults
from nmm.geometry.places import edge_distances, tolerance
from nmm.geometry.seeds import seed_of
from nmm.geometry.voronoi import tessellate
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
    _refuse(_outline_faults(scene))
    parts = [_block(scene, index) for index in range(len(scene.blocks))]
    parts += [_tessellated(scene, index) for index in range(len(scene.tessellations))]
    whole = jointed(scene, joined(parts))
    places = [scene.source.place(*_path(scene, int(index))) for index in whole.source]
    faults = overlap_faults(whole.polygons, whole.source, whole.name, places)
    _refuse([*faults, *place_faults(scene, whole)])
    return whole


def _refuse(faults: list[Fault]) -> None:
    if faults:
        raise GeometryError(*faults)


def _path(scene: Scene, index: int) -> tuple[str, int]:
    count = len(scene.blocks)
    return ("blocks", index) if index < count else ("tessellations", index - count)


def _outline_faults(scene: Scene) -> list[Fault]:
    found: list[Fault] = []
    solids = [*((b.vertices, b.holes) for b in scene.blocks)]
    solids += [(t.region, t.holes) for t in scene.tessellations]
    for index, (outline, holes) in enumerate(solids):
        path = _path(scene, index)
        key = "vertices" if path[0] == "blocks" else "region"
        place = [scene.source.place(*path, key)]
        place += [scene.source.place(*path, "holes", k) for k in range(len(holes))]
        found += ring_faults([outline, *holes], place)
    return found


def _block(scene: Scene, index: int) -> Regions:
    block = scene.blocks[index]
    polygons = Polygons.from_rings([[block.vertices, *block.holes]]).oriented()
    return _part(scene, polygons, block.material, [block.name or f"#{index}"], index)


def _tessellated(scene: Scene, index: int) -> Regions:
    item = scene.tessellations[index]
    path = ("tessellations", index)
    outline = Polygons.from_rings([[item.region, *item.holes]]).oriented()
    cells = tessellate(
        outline,
        item.blocks,
        seed=seed_of(item, scene, index),
        smoothing=item.smoothing,
        shortest_edge=item.shortest_edge,
        keep=np.concatenate([np.reshape(item.keep, (-1, 2)), _acting_points(scene, outline)]),
        place=scene.source.place(*path),
    )
    names = [f"{item.name}.{k}" for k in range(len(cells))]
    return _part(scene, cells, item.material, names, len(scene.blocks) + index)


def _part(
    scene: Scene, polygons: Polygons, material: str, names: list[str], source: int
) -> Regions:
    count = len(polygons)
    number = list(scene.materials).index(material)
    return Regions(polygons, np.full(count, number), tuple(names), np.full(count, source))


def _acting_points(scene: Scene, outline: Polygons) -> Floats:
    points = np.reshape(np.array(list(_points(scene)), dtype=float), (-1, 2))
    return points[edge_distances(outline, points) <= tolerance(outline.points)]


def _points(scene: Scene) -> Iterator[tuple[float, float]]:
    for item in (*scene.supports, *scene.loads):
        if item.point is not None:
            yield item.point
        yield from item.segment or ()
