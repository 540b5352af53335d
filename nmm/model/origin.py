"""Scenes far from the origin: solved about a local origin, written in their own coordinates.

A coordinate of 1e6 m is rounded to 1e-10 m. Springs of 1e13 N/m read that as a thousand newtons, so
blocks, supports and loads are shifted once at the door, by a sum that rounds nothing, and what is
written is shifted back.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any, TypeVar, get_args

import numpy as np

from integration.arrays import Floats
from nmm.geometry.blocks import Regions
from nmm.geometry.tessellation.cover_types import COVER_TYPES
from nmm.results.frame import Frame, Topology
from nmm.results.sink import Sink
from nmm.results.tee import Tee
from nmm.scene.fields import Coordinates
from nmm.scene.methods.cover_tables import CoverTable

if TYPE_CHECKING:
    from pydantic import BaseModel

    ModelT = TypeVar("ModelT", bound=BaseModel)

# A scene keeps its axes as long as its middle is not further from their origin than this, in sizes
# of the scene: coordinates then lose at most four binary digits.
FAR = 10.0


def own_origin(points: Floats) -> Floats:
    """Return where to work on points (P, 2): zero, or near their middle when they lie far away.

    It is a multiple of a power of two near the size of the scene, so that every difference to a
    coordinate is a number without rounding.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    middle, size = (low + high) / 2, float((high - low).max())
    if size <= 0 or np.abs(middle).max() <= FAR * size:
        return np.zeros(2)
    grain = 2.0 ** np.floor(np.log2(size))
    return np.asarray(np.round(middle / grain) * grain)


def shifted_regions(regions: Regions, by: Floats) -> Regions:
    """Return blocks and cracks moved by ``by`` (2,), which know how they were rounded there."""
    polygons = regions.polygons
    return replace(
        regions,
        polygons=polygons.with_points(polygons.points + by),
        cracks=regions.cracks + by,
        rounding=float(np.spacing(np.abs(polygons.points).max())),
    )


def shifted(part: "ModelT", by: Floats) -> "ModelT":
    """Return a scene or formulation with all its coordinates moved by ``by`` (2,).

    Fields are coordinates by their type, options of a cover by what its class says of them.
    """
    changes: dict[str, Any] = {}
    places = coordinate_fields(type(part))
    for name in type(part).model_fields:
        value = getattr(part, name)
        changed = _moved(value, by) if name in places else _shifted_within(value, by)
        if changed is not value:
            changes[name] = changed
    if isinstance(part, CoverTable) and part.options:
        changes["options"] = _moved_options(part, by)
    return part.model_copy(update=changes) if changes else part


@cache
def coordinate_fields(model: "type[BaseModel]") -> frozenset[str]:
    """Return the fields of a model that hold coordinates."""
    return frozenset(
        name
        for name, item in model.model_fields.items()
        if any(isinstance(mark, Coordinates) for mark in item.metadata) or _marked(item.annotation)
    )


def _marked(hint: Any) -> bool:
    """Whether a type, or one that it is made of, is marked as coordinates."""
    if any(isinstance(mark, Coordinates) for mark in getattr(hint, "__metadata__", ())):
        return True
    return any(map(_marked, get_args(hint)))


def _moved_options(cover: CoverTable, by: Floats) -> dict[str, Any]:
    moved = dict(cover.options)
    for name in COVER_TYPES.load(cover.type).coordinates:
        try:
            points = np.asarray(moved.get(name, ()), dtype=float).reshape(-1, 2)
        except (TypeError, ValueError):  # no points: the cover says so when it is laid
            continue
        if len(points):
            moved[name] = (points + by).tolist()
    return moved


def _shifted_within(value: Any, by: Floats) -> Any:
    if isinstance(value, Mapping):
        return {key: _shifted_within(item, by) for key, item in value.items()}
    if isinstance(value, tuple):
        return tuple(_shifted_within(item, by) for item in value)
    return shifted(value, by) if hasattr(type(value), "model_fields") else value


def _moved(value: Any, by: Floats) -> Any:
    """Move a point, or points in tuples of any depth."""
    if not isinstance(value, tuple) or not value:
        return value
    if isinstance(value[0], tuple):
        return tuple(_moved(item, by) for item in value)
    return tuple(float(number + shift) for number, shift in zip(value, by, strict=True))


class MovedBack(Tee):
    """Sink that hands on what it gets with all places moved by ``by`` (2,)."""

    def __init__(self, sink: Sink, by: Floats) -> None:
        super().__init__([sink])
        self._by = by

    def begin(self, topology: Topology) -> None:
        """See `Sink.begin`."""
        elements = topology.elements
        moved = elements.with_points(elements.points + self._by)
        super().begin(replace(topology, elements=moved))

    def frame(self, frame: Frame) -> None:
        """See `Sink.frame`."""
        fields = {name: one.moved(self._by) for name, one in frame.fields.items()}
        moved = replace(
            frame,
            points=frame.points + self._by,
            contact_position=frame.contact_position + self._by,
            fields=fields,
        )
        super().frame(moved)
