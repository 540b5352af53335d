"""Gradual release of the tractions on new crack faces.

New faces carry at first the traction that the intact material had there, so that cutting a segment
gives no impulse. The traction falls linearly to zero while the tip runs through the segment, and
the work of the opening faces against it is the fracture energy. Forces come in pairs of fixed
direction in space, so that linear momentum is conserved to rounding.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from covers.change.relation import Relation
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import clockwise
from integration.rules import PointRule
from integration.segments import graded_rule
from nmm.assembly.material_points import MaterialPoints, material_points
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.fracture.acting_stress import acting_stress

if TYPE_CHECKING:
    from nmm.effects.change import Change

# Degree of the quadrature of tractions in the square root of the distance from the tip.
TRACTION_ORDER = 8
# Points nearer to an element than this share of the size of the domain lie in it.
NEAR = 1e-9


@dataclass(frozen=True)
class ReleasedTractions:
    """Points on both faces of new segments, with the forces that are being released.

    Attributes
    ----------
    model
        The model on whose boundary they lie.
    edge
        (m,) edges of the boundary.
    position
        (m, 2) reference places (m).
    force
        (m, 2) forces on the material at the start of the release, in global axes (N).
    begin, span
        (m,) start and duration of the release (s).
    """

    model: Model
    edge: Ints
    position: Floats
    force: Floats
    begin: Floats
    span: Floats

    @classmethod
    def none(cls, model: Model) -> "ReleasedTractions":
        """Return none on a model."""
        pairs, empty = np.zeros((0, 2)), np.zeros(0)
        return cls(model, np.zeros(0, dtype=np.int64), pairs, pairs, empty, empty)

    @classmethod
    def of_arrays(cls, model: Model, arrays: tuple[Any, ...]) -> "ReleasedTractions":
        """Return the tractions from their `arrays`."""
        return cls(model, *arrays)

    @property
    def arrays(self) -> tuple[Any, ...]:
        """All attributes but the model."""
        return self.edge, self.position, self.force, self.begin, self.span

    def __len__(self) -> int:
        return len(self.edge)

    def share(self, time: float) -> Floats:
        """Share (m,) of the forces that is left at a time (s)."""
        return np.clip(1 - (time - self.begin) / self.span, 0.0, 1.0)

    def push(self, state: State, time: float) -> Floats:
        """Return the force (n,) on the unknowns of what is left at a time (s)."""
        if not len(self):
            return np.zeros_like(state.deformation)
        return self._points.push(state, self.share(time)[:, None] * self.force)

    def work_against(self, before: State, after: State) -> float:
        """Work (J) done against the forces in a step."""
        if not len(self):
            return 0.0
        share = (self.share(before.time) + self.share(after.time)) / 2
        return -self._points.work(before, after, share[:, None] * self.force)

    def followed(self, change: "Change") -> "ReleasedTractions":
        """Return what is left after a change, on the new model."""
        model = change.new
        left = self._take(self.share(change.state.time) > 0)
        edge, known = _edges_after(left, change.parentage.edges, model)
        return replace(left, model=model, edge=edge)._take(known)

    def joined(self, more: "ReleasedTractions") -> "ReleasedTractions":
        """Return these and others on the same model."""
        pairs = zip(self.arrays, more.arrays, strict=True)
        return ReleasedTractions(self.model, *(np.concatenate(pair) for pair in pairs))

    def _take(self, chosen: Bools) -> "ReleasedTractions":
        return ReleasedTractions(self.model, *(one[chosen] for one in self.arrays))

    @cached_property
    def _points(self) -> MaterialPoints:
        manifold = self.model.manifold
        return material_points(manifold, manifold.boundary.element[self.edge], self.position)


def tractions_on_new_faces(
    change: "Change", tip: Floats, span: Floats, added: Sequence[StressAt]
) -> ReleasedTractions:
    """Return the tractions on new crack faces, those that the intact material had there.

    Parameters
    ----------
    tip
        (k, 2) places of the grown tips before the change (m).
    span
        (k,) duration of the release behind each (s).
    added
        Stresses of the old model that do not follow from its strain.
    """
    edges, model = change.new.cut.boundary, change.new
    fresh = (edges.crack >= 0) & (change.parentage.edges.main < 0)
    one = np.flatnonzero(fresh & (edges.opposite > np.arange(len(edges))))
    if not len(one):
        return ReleasedTractions.none(model)
    start, end = edges.start[one], edges.end[one]
    away = np.hypot(*np.moveaxis(((start + end) / 2)[:, None] - tip, -1, 0))
    front = np.argmin(away, axis=1)
    points, weights = graded_rule(start, end, tip[front], TRACTION_ORDER)
    q = weights.shape[1]
    flat, along = points.reshape(-1, 2), (end - start) / np.hypot(*(end - start).T)[:, None]
    out = np.repeat(clockwise(along), q, axis=0)
    pull = _tractions(change, np.repeat(edges.element[one], q), flat, out, added)
    force = model.thickness * weights.ravel()[:, None] * pull
    # The same points on the opposite edges, so that forces are pairs to the last digit.
    both = np.repeat(np.concatenate([one, edges.opposite[one]]), q)
    twice = np.tile(np.repeat(span[front], q), 2)
    return ReleasedTractions(
        model,
        both,
        np.tile(flat, (2, 1)),
        np.concatenate([force, -force]),
        np.full(len(both), change.state.time),
        twice,
    )


def _tractions(
    change: "Change", child: Ints, points: Floats, out: Floats, added: Sequence[StressAt]
) -> Floats:
    """Tractions (m, 2) of the old field in global axes, at points of new elements (m,) (Pa)."""
    old, kin = change.old, change.parentage.elements
    near = np.unique(kin.parent[np.isin(kin.child, child)])
    shapes = old.manifold.elements.take(near).to_shapely()
    reach = NEAR * old.manifold.elements.extent
    row, found = shapely.STRtree(shapes).query(
        shapely.points(points), predicate="dwithin", distance=reach
    )
    _, first = np.unique(row, return_index=True)
    element = near[found[first]]
    rule = PointRule(points, np.ones(len(points)), element)
    xx, yy, xy = acting_stress(old, change.former, added, rule).T
    local = np.stack([xx * out[:, 0] + xy * out[:, 1], xy * out[:, 0] + yy * out[:, 1]], axis=1)
    return change.former.frames.to_global(old.manifold.element_body[element], local)


def _edges_after(released: ReleasedTractions, kin: Relation, model: Model) -> tuple[Ints, Bools]:
    """Edges (m,) of the new boundary on which the points lie, and whether there is one (m,)."""
    edges = model.manifold.boundary
    row, pair = np.nonzero(released.edge[:, None] == kin.parent)
    child = kin.child[pair]
    way = edges.end[child] - edges.start[child]
    along = ((released.position[row] - edges.start[child]) * way).sum(axis=1) / (way**2).sum(axis=1)
    off = np.abs(along - 0.5)
    order = np.lexsort((child, off, row))
    rows, first = np.unique(row[order], return_index=True)
    found, known = np.zeros(len(released), dtype=np.int64), np.zeros(len(released), dtype=bool)
    found[rows], known[rows] = child[order][first], True
    return found, known
