"""The joint sets of a scene applied to its blocks."""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby

import numpy as np
import shapely

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.geometry.blocks import Regions
from nmm.geometry.tessellation.cutting import cut
from nmm.geometry.tessellation.faces import owners
from nmm.geometry.tessellation.joint_sets import JointSetGeometry
from nmm.geometry.tessellation.seeds import seed_of
from nmm.scene.model import Scene


def jointed(scene: Scene, whole: Regions) -> Regions:
    """Blocks cut by the scene's joint sets; the pieces take the place of their block.

    Neighbouring sets that cut the same block cut together, so that a joint of one may end on a
    joint of another.
    """
    for target, group in groupby(enumerate(scene.joint_sets), key=lambda entry: entry[1].block):
        whole = _cut(scene, whole, target, [index for index, _ in group])
    if not len(whole.cracks):
        return whole
    home = owners(shapely.points(whole.cracks.mean(axis=1)), whole.polygons.to_shapely())
    return replace(whole, cracks=whole.cracks[home >= 0], crack_region=home[home >= 0])


def _cut(scene: Scene, whole: Regions, target: str, sets: list[int]) -> Regions:
    chosen = whole.select(target)
    polygons = whole.polygons.take(chosen)
    joints = np.concatenate([_segments(scene, index, polygons.points) for index in sets])
    pieces = cut(polygons, joints)
    rest = np.setdiff1d(np.arange(len(whole)), chosen)
    origin = np.concatenate([rest, chosen[pieces.region]])
    order = np.argsort(origin, kind="stable")
    origin = origin[order]
    number = np.arange(len(origin)) - np.searchsorted(origin, origin)
    is_piece = np.isin(origin, chosen)
    return Regions(
        Polygons.concatenate([whole.polygons.take(rest), pieces.polygons]).take(order),
        whole.material[origin],
        tuple(
            f"{whole.name[o]}.{k}" if piece else whole.name[o]
            for o, k, piece in zip(origin, number, is_piece, strict=True)
        ),
        whole.source[origin],
        np.concatenate([whole.cracks, pieces.cracks]),
    )


def _segments(scene: Scene, index: int, points: Floats) -> Floats:
    item = scene.joint_sets[index]
    joints = JointSetGeometry(
        dip=item.dip,
        spacing=item.spacing,
        dip_scatter=item.dip_scatter,
        spacing_scatter=item.spacing_scatter,
        persistence=item.persistence,
        trace=item.trace,
        trace_scatter=item.trace_scatter,
        origin=item.origin,
        seed=seed_of(item, scene, index),
    )
    place = scene.source.place("joint_sets", index)
    return joints.segments(points.min(axis=0), points.max(axis=0), place)
