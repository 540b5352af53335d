"""Points on the edges of bodies, followed with the material: the two sides of a contact.

A side is an edge and a parameter in [0, 1] on it; a vertex is its edge at 0. Between the ends the
surface is the chord, so a row at a parameter is the mean of the ends' rows and agrees with the
geometry that the search sees, whatever the degree of the approximation.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.rows import Rows
from integration.arrays import Floats, Ints
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.state import Frames
from nmm.contact.detection.surface import Surface
from nmm.contact.points.side_kernels import EdgeRows, places

_UPRIGHT = np.zeros(0)


@dataclass(frozen=True)
class Sides:
    """Both ends of all boundary edges as material points.

    ``together`` (n,) and ``weight`` (n, 2) are those of `Surface`.
    """

    manifold: Manifold
    start: MaterialPoints
    end: MaterialPoints
    together: Ints | None = None
    weight: Floats | None = None

    def surface(self, frames: Frames, deformation: Floats) -> Surface:
        """Return the edges where they are now."""
        return self._with_starts(self.start.place(frames, deformation))

    def moved(self, frames: Frames, deformation: Floats) -> Surface:
        """Return the same by compiled code, which is loaded where steps are taken."""
        return self._with_starts(self.places(frames, deformation))

    def places(self, frames: Frames, deformation: Floats) -> Floats:
        """Return where the starts of the edges are now (n, 2), by compiled code."""
        tilt = _UPRIGHT if frames.tilt is None else frames.tilt
        return places(*self._columns, frames.centre, frames.rotation, tilt, deformation)

    def _with_starts(self, start: Floats) -> Surface:
        edges = self.manifold.boundary
        return Surface(
            start=start,
            end=start[edges.next],
            body=edges.body,
            next=edges.next,
            previous=edges.previous,
            together=self.together,
            weight=self.weight,
        )

    @cached_property
    def table(self) -> EdgeRows:
        """Rows at the ends of all edges."""
        start, end = self.start.rows, self.end.rows
        return EdgeRows(start.unknowns, start.values, end.values, self.start.body)

    @cached_property
    def length(self) -> Floats:
        """(n,) lengths of the edges where bodies were laid (m)."""
        edges = self.manifold.boundary
        return np.asarray(np.hypot(*(edges.end - edges.start).T))

    @cached_property
    def _columns(self) -> tuple[Ints, Floats, Ints, Floats]:
        """The starts of the edges as compiled code takes them."""
        at = self.start
        values = np.ascontiguousarray(at.rows.values)
        return at.body, np.ascontiguousarray(at.arm), np.ascontiguousarray(at.rows.unknowns), values

    @cached_property
    def whole(self) -> bool:
        """Whether the starts of the edges are the vertices of all elements, in their order."""
        elements, edges = self.manifold.elements, self.manifold.boundary
        same = np.array_equal(elements.points, edges.start)
        return same and np.array_equal(elements.polygon_of_point, edges.element)

    @cached_property
    def repeats(self) -> bool:
        """Whether one row may name an unknown twice: padded rows, or both sides in one body."""
        return len(self.manifold.groups) > 1 or len(self.manifold.elements) > self.manifold.n_bodies

    def turns(self, edge: Ints) -> Floats:
        """Rows (m, 2, L) of the ends of edges less those of their starts, in the bodies' axes."""
        return np.asarray(self.end.rows.values[edge] - self.start.rows.values[edge])

    def at(self, edge: Ints, parameter: Floats) -> MaterialPoints:
        """Return the points (m,) at ``parameter`` on ``edge``."""
        start, end, s = self.start, self.end, parameter[:, None]
        if not parameter.any():
            return start.take(edge)
        values = start.rows.values[edge] + s[:, :, None] * (
            end.rows.values[edge] - start.rows.values[edge]
        )
        return MaterialPoints(
            body=start.body[edge],
            arm=start.arm[edge] + s * (end.arm[edge] - start.arm[edge]),
            rows=Rows(start.rows.unknowns[edge], values),
        )


def sides(manifold: Manifold, together: Ints | None = None, weight: Floats | None = None) -> Sides:
    """Return the sides of a manifold's boundary edges; ``together``, ``weight`` are of bodies."""
    edges = manifold.boundary
    return Sides(
        manifold,
        material_points(manifold, edges.element, edges.start),
        material_points(manifold, edges.element, edges.end),
        None if together is None else together[edges.body],
        None if weight is None else weight[edges.body],
    )
