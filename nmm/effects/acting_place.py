"""Material points at which a table of the scene acts: at its point, segment or block."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.places import Place, at_point, on_block, on_segment
from nmm.effects.base import Setup
from nmm.errors import Fault, GeometryError

if TYPE_CHECKING:
    from nmm.scene.actions import PlacedTable
    from nmm.scene.tables.shaking.boundaries import FreeFieldTable, ViscousBoundaryTable

    OnEdges = PlacedTable | FreeFieldTable | ViscousBoundaryTable


SINGULAR_ORDER = 24
"""Degree of quadrature of roots of the distance from an end of a part: to 2e-5 of the largest."""


def traction_order(setup: Setup, order: int) -> int:
    """Return the degree of quadrature of tractions along edges, at least ``order``.

    Functions of crack tips and corners are no polynomials along edges that lead to them.
    """
    return max(order, SINGULAR_ORDER) if len(setup.model.manifold.singular) else order


def acting_place(setup: Setup, key: str, table: "PlacedTable", order: int) -> Place:
    """Return the material point of a table ``[[key]]``; else what `edge_place` returns.

    Raises
    ------
    GeometryError
        There is no material; with the line of the table.
    """
    if table.point is None:
        return edge_place(setup, key, table, order)
    point = np.array(table.point)
    place = at_point(setup.model.manifold, point, setup.regions(table.block))
    if not len(place):
        there = str((point + setup.origin).tolist())
        raise GeometryError(_nowhere(setup, key, table, there))
    return place


def edge_place(setup: Setup, key: str, table: "OnEdges", order: int) -> Place:
    """Return Gauss points on edges along the segment of a table ``[[key]]``, or of its block.

    They are exact for polynomials of degree ``order``.

    Raises
    ------
    GeometryError
        There is no edge; with the line of the table.
    """
    manifold, regions = setup.model.manifold, setup.regions(table.block)
    if table.segment is None:
        everything = np.ones(len(setup.region_name), dtype=bool)
        place, there = on_block(manifold, everything if regions is None else regions, order), None
    else:
        segment = np.array(table.segment)
        place = on_segment(manifold, segment, regions, order)
        there = str((segment + setup.origin).tolist())
    if not len(place):
        raise GeometryError(_nowhere(setup, key, table, there or str(table.block)))
    return place


def _nowhere(setup: Setup, key: str, table: "OnEdges", there: str) -> Fault:
    where = setup.scene.source.of_name(key, table.name)
    expected, remedy = "a place on the material", "move it onto a block or onto the edge of one"
    if setup.acting is not None and key in ("supports", "loads"):
        remedy += f", or list the {key} of the stage without it"
    return Fault(where, f'"{table.name}": {there}', expected, remedy)
