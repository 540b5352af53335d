"""Whether what acts on a random scene has a place on some of its blocks."""

from typing import Any

import shapely

from nmm.verification.hard.cases.base import Document

LEAST = 1e-6
"""Share of an edge that is a part of it."""


def has_place(table: dict[str, Any], scene: Document, there: tuple[str, ...]) -> bool:
    """Whether the blocks that a table names, its points and a part of its edge are there."""
    named = {table["block"]} if "block" in table else set(table.get("blocks", []))
    if not named <= {*there, "all", "ground"}:
        return False
    shapes = [one["vertices"] for one in scene["blocks"] if one["name"] in there]
    solid = shapely.unary_union([shapely.Polygon(one) for one in shapes])
    if "segment" in table:
        edge = shapely.LineString(table["segment"])
        return bool(solid.boundary.intersection(edge).length > LEAST * edge.length)
    points = [table["point"]] if "point" in table else table.get("points", [])
    on_ground = "ground" in table.get("blocks", [])
    return all(solid.covers(shapely.Point(one)) for one in (points[:1] if on_ground else points))
