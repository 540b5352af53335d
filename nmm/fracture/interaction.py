"""The interaction integral about a crack tip: over elements, crack faces and the boundary.

It is linear in the displacement. So its value is kept as factors of the displacement gradient, of
stresses and of forces at quadrature points, which hold for every displacement. See
`nmm.fracture.stress_intensity` for the formula.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.singular.branches import branches
from integration.arrays import Floats, Ints
from integration.plane_vectors import clockwise
from integration.rules import polygon_rule
from integration.segments import graded_rule, segment_rule, spread_rule
from integration.singular import tip_rule
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.model import Model
from nmm.fracture.auxiliary import Auxiliary, stresses_of
from nmm.fracture.interaction_weights import ForceWeights, InteractionWeights
from nmm.fracture.surroundings import off_line

Field = Callable[[Floats], Floats]
Traction = Callable[[Floats, Floats], Floats]

# Degree of the quadrature.
SMOOTH_ORDER = 12
# Elements whose centroid is nearer to the tip than this multiple of their size get a singular rule.
BESIDE = 1.5
# Faces off the line behind the tip by more than this share of their distance belong to a kink.
STRAIGHT = 1e-6


@dataclass(frozen=True)
class Interaction:
    """The domain about a tip of a model, with the auxiliary fields.

    Attributes
    ----------
    model
        The model.
    fields
        Auxiliary fields about the tip.
    radius
        Radius of the domain (m).
    body
        The body in which the tip lies.
    """

    model: Model
    fields: Auxiliary
    radius: float
    body: int

    @cached_property
    def _elements(self) -> Ints:
        """Elements of the domain."""
        manifold, reach = self.model.manifold, 2 * self.radius
        away = np.hypot(*(manifold.elements.points - self.fields.tip.point).T)
        near = np.minimum.reduceat(away, manifold.elements.first_point) < self.radius
        near |= np.hypot(*(manifold.elements.centroids - self.fields.tip.point).T) < reach
        return np.flatnonzero(near & (manifold.element_body == self.body))

    @cached_property
    def _branch(self) -> Floats:
        """Direction (E,) about which angles are taken in each element; zero outside the domain."""
        found, elements = np.zeros(len(self.model.manifold.elements)), self._elements
        one_part = np.zeros(len(elements), dtype=np.int64)
        found[elements] = branches(self.model.cut, self.fields.tip, elements, one_part).bearing
        return found

    def over_elements(self) -> Iterator[tuple[InteractionWeights, ForceWeights]]:
        """Yield the factors at the points of the elements: those near tips, then the others."""
        near = self._elements
        polygons = self.model.manifold.elements.take(near)
        middle = polygons.centroids
        out = np.hypot(*(polygons.points - middle[polygons.polygon_of_point]).T)
        size = np.maximum.reduceat(out, polygons.first_point)
        # Near tips the fields are singular; further out only the weight q is not polynomial.
        tips = self.model.cut.tips.point
        nearest, away = _nearest(tips, middle)
        close = away < BESIDE * size
        for chosen, singular in ((close, True), (~close, False)):
            index = np.flatnonzero(chosen)
            if not len(index):
                continue
            part = polygons.take(index)
            rule = (
                tip_rule(part, tips[nearest[index]], SMOOTH_ORDER)
                if singular
                else polygon_rule(part, SMOOTH_ORDER)
            )
            yield self._density(near[index][rule.owner], rule.points, rule.weights)

    def _density(
        self, owner: Ints, points: Floats, weights: Floats
    ) -> tuple[InteractionWeights, ForceWeights]:
        """Factors at points (m, 2) of elements (m,) with quadrature weights (m,) (m2)."""
        q, dq = self.fields.cutoff(points, self.radius)
        inside = (q != 0) | dq.any(axis=1)  # elements reach beyond the domain
        owner, points, weights = owner[inside], points[inside], weights[inside]
        q, dq = q[inside], dq[inside]
        ahead, both = self.fields.tip.direction, self._auxiliary(owner, points)
        on_slope = (-q * weights)[:, None, None, None] * both
        on_force = (on_slope.reshape(-1, 2) @ ahead).reshape(-1, 2, 2)
        force_weights = ForceWeights(owner, points, on_force, on_slope)
        # Near the tip q is constant, and only body forces contribute.
        falls = dq.any(axis=1)
        owner, points, weights, dq = owner[falls], points[falls], weights[falls], dq[falls]
        on_stress, on_gradient = [], []
        for v in np.swapaxes(both[falls], 0, 1):
            of_v = stresses_of(self.model.elasticity[owner], v)
            on_stress.append(_outer(v @ ahead, dq) - (dq @ ahead)[:, None, None] * v)
            on_gradient.append(_outer(np.einsum("mij,mj->mi", of_v, dq), ahead))
        return self._weights(owner, points, weights, on_stress, on_gradient), force_weights

    def over_faces(self, traction: Traction | None) -> Iterator[InteractionWeights | Floats]:
        """Yield the factors on crack faces and on the boundary, and constant contributions (2,).

        Faces straight behind the tip contribute by their traction alone. On kinked faces the
        auxiliary fields leave tractions, which contribute too. On the boundary the traction is
        that of the stress there.
        """
        edges, point = self.model.cut.boundary, self.fields.tip.point
        low, high = np.minimum(edges.start, edges.end), np.maximum(edges.start, edges.end)
        gap = np.maximum(np.maximum(low - point, point - high), 0.0)
        near = (np.hypot(*gap.T) < self.radius) & (edges.body == self.body)
        bent = off_line(edges.start, edges.end, point, self.fields.tip.direction, STRAIGHT)
        behind = np.flatnonzero(near & ~bent & (edges.crack >= 0))
        kinked, rim = (
            np.flatnonzero(near & bent & part) for part in (edges.crack >= 0, edges.crack < 0)
        )
        if traction is not None:
            for part in self._graded(np.concatenate([behind, kinked])):
                yield self._of_traction(*part, traction)
        for part in self._graded(kinked):
            yield self._along(*part, loaded=False)
        if len(rim):
            yield self._along(rim, *self._even(rim), loaded=True)

    def of_point_forces(self, forces: AppliedForces) -> Floats:
        """Contribution (2,) of point forces and face tractions in the axes of the body (N/m)."""
        tip, owner = self.fields.tip.point, forces.element
        away = (np.hypot(*(end - tip).T) for end in (forces.start, forces.end))
        reach = np.minimum(*away)
        near = (reach < self.radius) & (self.model.manifold.element_body[owner] == self.body)
        if not near.any():
            return np.zeros(2)
        found = forces.take(near)
        points, weights = spread_rule(found.start, found.end, tip, SMOOTH_ORDER)
        q = weights.shape[1]
        force = weights.reshape(-1, 1) * np.repeat(found.force, q, axis=0)
        return self._of_forces(np.repeat(found.element, q), points.reshape(-1, 2), force)

    def _graded(self, edges: Ints) -> Iterator[tuple[Ints, Floats, Floats]]:
        """Yield edges of cracks with rules that are smooth in the root of the distance to a tip."""
        boundary, tips = self.model.cut.boundary, self.model.cut.tips
        start, end = boundary.start[edges], boundary.end[edges]
        nearest, _ = _nearest(tips.point, (start + end) / 2)
        about, ahead = tips.point[nearest], tips.direction[nearest]
        straight = ~off_line(start, end, about, ahead, STRAIGHT)
        if straight.any():
            ends = start[straight], end[straight], about[straight]
            yield edges[straight], *graded_rule(*ends, SMOOTH_ORDER)
        if not straight.all():
            yield edges[~straight], *self._even(edges[~straight])

    def _even(self, edges: Ints) -> tuple[Floats, Floats]:
        boundary = self.model.cut.boundary
        return segment_rule(boundary.start[edges], boundary.end[edges], SMOOTH_ORDER)

    def _of_traction(
        self, edges: Ints, points: Floats, weights: Floats, traction: Traction
    ) -> Floats:
        """Contribution (2,) of a traction on edges."""
        owner, flat, out = self._flat(edges, points)
        return self._of_forces(owner, flat, weights.reshape(-1, 1) * traction(flat, out))

    def _of_forces(self, owner: Ints, points: Floats, force: Floats) -> Floats:
        """Contribution (2,) of forces (m, 2) at points (m, 2) of elements (m,) (N/m)."""
        ahead = self.fields.tip.direction
        pull = -self.fields.cutoff(points, self.radius)[0][:, None] * force
        modes = (self._auxiliary(owner, points).reshape(-1, 2) @ ahead).reshape(-1, 2, 2)
        return np.asarray(np.einsum("mi,mni->n", pull, modes))

    def _along(
        self, edges: Ints, points: Floats, weights: Floats, loaded: bool
    ) -> InteractionWeights:
        """Factors on edges; with the traction of the stress there where edges are ``loaded``."""
        owner, flat, out = self._flat(edges, points)
        ahead = self.fields.tip.direction
        on_stress, on_gradient = [], []
        for v in np.swapaxes(self._auxiliary(owner, flat), 0, 1):
            of_v, v1 = stresses_of(self.model.elasticity[owner], v), v @ ahead
            pull = -(out @ ahead)[:, None, None] * v
            on_stress.append(pull + _outer(v1, out) if loaded else pull)
            on_gradient.append(_outer(np.einsum("mij,mj->mi", of_v, out), ahead))
        share = -weights.ravel() * self.fields.cutoff(flat, self.radius)[0]
        return self._weights(owner, flat, share, on_stress, on_gradient)

    def _flat(self, edges: Ints, points: Floats) -> tuple[Ints, Floats, Floats]:
        """Elements (m,), points (m, 2) and outward normals (m, 2) of points (k, q, 2) on edges."""
        boundary, q = self.model.cut.boundary, points.shape[1]
        out = _normals(boundary.start[edges], boundary.end[edges])
        return np.repeat(boundary.element[edges], q), points.reshape(-1, 2), np.repeat(out, q, 0)

    def _weights(
        self,
        owner: Ints,
        points: Floats,
        weights: Floats,
        on_stress: list[Floats],
        on_gradient: list[Floats],
    ) -> InteractionWeights:
        """Combine the factors (m, 2, 2) of stress and gradient of both modes, times weights."""
        model = self.model
        law = model.drained[owner] if model.projected else model.elasticity[owner]
        parts = [
            stresses_of(law, stress) + gradient
            for stress, gradient in zip(on_stress, on_gradient, strict=True)  # two modes
        ]
        scale = weights[:, None, None, None]
        return InteractionWeights(
            owner, points, scale * np.stack(parts, axis=1), scale * np.stack(on_stress, axis=1)
        )

    def _auxiliary(self, owner: Ints, points: Floats) -> Floats:
        """Auxiliary displacement gradients (m, 2 modes, 2, 2) at points of elements (m,)."""
        return self.fields.gradients(points, self._branch[owner])


def _nearest(points: Floats, places: Floats) -> tuple[Ints, Floats]:
    """Number (n,) of the nearest of some points (k, 2) to each place (n, 2), and how far it is."""
    away = np.hypot(*(places[:, None] - points).transpose(2, 0, 1))
    return away.argmin(axis=1), away.min(axis=1)


def _outer(a: Floats, b: Floats) -> Floats:
    """Products (m, 2, 2) of vectors (m, 2) with vectors (m, 2) or one (2,)."""
    return np.asarray(a[:, :, None] * (b[:, None, :] if b.ndim == 2 else b))


def _normals(start: Floats, end: Floats) -> Floats:
    """Outward unit normals (n, 2) of edges with the material on their left."""
    along = (end - start) / np.hypot(*(end - start).T)[:, None]
    return clockwise(along)
