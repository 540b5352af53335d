"""Faces that a tip is running through: what held them together before is withdrawn evenly.

New faces carry at first the traction that the material had there, so that nothing is struck when a
crack is cut further. It falls to zero while the tip runs through the piece, and the work that the
opening faces do against it is what growth takes. Forces come in pairs and keep their direction in
space, so that momentum stays to rounding, where a piece comes free as well.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely

from covers.change.relation import Relation
from integration.arrays import Bools, Floats, Ints
from integration.rules import PointRule
from integration.segments import graded_rule
from nmm.assembly.model import Model
from nmm.assembly.motion import MaterialPoints, State, material_points
from nmm.assembly.stress_points import StressAt
from nmm.fracture.acting_stress import acting_stress

if TYPE_CHECKING:
    from nmm.effects.change import Change

# Degree to which tractions are integrated, in the root of the distance from the tip.
TRACTION_ORDER = 8
# Points nearer to an element than this share of the domain lie in it.
NEAR = 1e-9


@dataclass(frozen=True)
class HeldFaces:
    """Points on both faces of new pieces, with the forces that held them.

    Attributes
    ----------
    model
        On whose boundary they lie.
    edge
        (m,) edges of the boundary.
    position
        (m, 2) reference places (m).
    force
        (m, 2) on the material at the start, in global axes (N).
    begin, span
        (m,) when it begins to fall (s), and how long it takes to zero (s).
    """

    model: Model
    edge: Ints
    position: Floats
    force: Floats
    begin: Floats
    span: Floats

    @classmethod
    def none(cls, model: Model) -> "HeldFaces":
        """Return no faces."""
        pairs, empty = np.zeros((0, 2)), np.zeros(0)
        return cls(model, np.zeros(0, dtype=np.int64), pairs, pairs, empty, empty)

    @classmethod
    def of_arrays(cls, model: Model, arrays: tuple[Any, ...]) -> "HeldFaces":
        """Return what `arrays` were of."""
        return cls(model, *arrays)

    @property
    def arrays(self) -> tuple[Any, ...]:
        """All but the model."""
        return self.edge, self.position, self.force, self.begin, self.span

    def __len__(self) -> int:
        return len(self.edge)

    def share(self, time: float) -> Floats:
        """Share (m,) of the forces that is left at a time."""
        return np.clip(1 - (time - self.begin) / self.span, 0.0, 1.0)

    def push(self, state: State, time: float) -> Floats:
        """Return what is left of the forces at a time, on the unknowns (n,)."""
        if not len(self):
            return np.zeros_like(state.deformation)
        return self._points.push(state, self.share(time)[:, None] * self.force)

    def taken(self, before: State, after: State) -> float:
        """Work (J) done against the forces in a step."""
        if not len(self):
            return 0.0
        share = (self.share(before.time) + self.share(after.time)) / 2
        return -self._points.work(before, after, share[:, None] * self.force)

    def followed(self, change: "Change") -> "HeldFaces":
        """Return what is still held, on the new model."""
        model = change.new
        left = self._only(self.share(change.state.time) > 0)
        edge, known = _followed(left, change.parentage.edges, model)
        return replace(left, model=model, edge=edge)._only(known)

    def joined(self, more: "HeldFaces") -> "HeldFaces":
        """Return these and others on the same model."""
        pairs = zip(self.arrays, more.arrays, strict=True)
        return HeldFaces(self.model, *(np.concatenate(pair) for pair in pairs))

    def _only(self, chosen: Bools) -> "HeldFaces":
        return HeldFaces(self.model, *(one[chosen] for one in self.arrays))

    @cached_property
    def _points(self) -> MaterialPoints:
        manifold = self.model.manifold
        return material_points(manifold, manifold.boundary.element[self.edge], self.position)


def newly_held(change: "Change", tip: Floats, span: Floats, added: Sequence[StressAt]) -> HeldFaces:
    """Return the new faces of cracks with what held them before.

    Parameters
    ----------
    tip
        (k, 2) where tips were that have grown (m).
    span
        (k,) how long each takes through its piece (s).
    added
        Stresses of the old model that are no strain's.
    """
    edges, model = change.new.cut.boundary, change.new
    fresh = (edges.crack >= 0) & (change.parentage.edges.main < 0)
    one = np.flatnonzero(fresh & (edges.opposite > np.arange(len(edges))))
    if not len(one):
        return HeldFaces.none(model)
    start, end = edges.start[one], edges.end[one]
    away = np.hypot(*np.moveaxis(((start + end) / 2)[:, None] - tip, -1, 0))
    front = np.argmin(away, axis=1)
    points, weights = graded_rule(start, end, tip[front], TRACTION_ORDER)
    q = weights.shape[1]
    flat, along = points.reshape(-1, 2), (end - start) / np.hypot(*(end - start).T)[:, None]
    out = np.repeat(np.stack([along[:, 1], -along[:, 0]], axis=1), q, axis=0)
    pull = _tractions(change, np.repeat(edges.element[one], q), flat, out, added)
    force = model.thickness * weights.ravel()[:, None] * pull
    # The same points on the edges across, so that forces are pairs to the last digit.
    both = np.repeat(np.concatenate([one, edges.opposite[one]]), q)
    twice = np.tile(np.repeat(span[front], q), 2)
    return HeldFaces(
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
    """Tractions (m, 2) in global axes that the old field had on places of new elements (m,)."""
    old, kin = change.old, change.parentage.elements
    near = np.unique(kin.parent[np.isin(kin.child, child)])
    shapes = old.manifold.elements.take(near).to_shapely()
    reach = NEAR * float(np.hypot(*np.ptp(old.manifold.elements.points, axis=0)))
    row, found = shapely.STRtree(shapes).query(
        shapely.points(points), predicate="dwithin", distance=reach
    )
    _, first = np.unique(row, return_index=True)
    element = near[found[first]]
    rule = PointRule(points, np.ones(len(points)), element)
    xx, yy, xy = acting_stress(old, change.former, added, rule).T
    local = np.stack([xx * out[:, 0] + xy * out[:, 1], xy * out[:, 0] + yy * out[:, 1]], axis=1)
    return change.former.frames.to_global(old.manifold.element_body[element], local)


def _followed(held: HeldFaces, kin: Relation, model: Model) -> tuple[Ints, Bools]:
    """Edges (m,) of the new boundary that the points lie on, and whether there is one."""
    edges = model.manifold.boundary
    row, pair = np.nonzero(held.edge[:, None] == kin.parent)
    child = kin.child[pair]
    way = edges.end[child] - edges.start[child]
    along = ((held.position[row] - edges.start[child]) * way).sum(axis=1) / (way**2).sum(axis=1)
    off = np.abs(along - 0.5)
    order = np.lexsort((child, off, row))
    rows, first = np.unique(row[order], return_index=True)
    found, known = np.zeros(len(held), dtype=np.int64), np.zeros(len(held), dtype=bool)
    found[rows], known[rows] = child[order][first], True
    return found, known
