"""The interaction integral about a tip: over elements, and over the edges among them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.singular.branches import branches
from integration.arrays import Floats, Ints
from integration.rules import polygon_rule
from integration.segments import graded_rule, segment_rule
from integration.singular import tip_rule
from nmm.assembly.model import Model
from nmm.fracture.auxiliary import Auxiliary, stresses_of
from nmm.fracture.surroundings import off_line

Field = Callable[[Floats], Floats]
Traction = Callable[[Floats, Floats], Floats]

# Degree to which smooth parts are integrated.
ORDER = 12
# Edges off the line behind the tip by more than this part of their distance are kinked.
STRAIGHT = 1e-6


@dataclass(frozen=True)
class Interaction:
    """A displacement of a model, and the fields about a tip of it.

    Attributes
    ----------
    model, unknowns
        The model and its displacements.
    fields
        About the tip.
    radius
        Of the domain (m).
    body
        In which the tip lies.
    pressure
        (k,) on the patches of projected volumes; None without.
    acceleration
        (n,) of the unknowns, which acts as a force on the volume; None without.
    """

    model: Model
    unknowns: Floats
    fields: Auxiliary
    radius: float
    body: int
    pressure: Floats | None
    acceleration: Floats | None = None

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
        """Branch of the angle about the tip on all elements; zero outside the domain."""
        found, elements = np.zeros(len(self.model.manifold.elements)), self._elements
        one_part = np.zeros(len(elements), dtype=np.int64)
        found[elements] = branches(self.model.cut, self.fields.tip, elements, one_part).bearing
        return found

    def over_elements(self, body_force: Field | None) -> Floats:
        """Return the parts (2,) of the integral over the material."""
        near, point = self._elements, self.fields.tip.point
        polygons = self.model.manifold.elements.take(near)
        reach = np.hypot(*(polygons.points - point).T)
        close = np.maximum.reduceat(reach, polygons.first_point) < 0.5 * self.radius
        total = np.zeros(2)
        # About the tip fields are singular; further out the cut-off is what is not polynomial.
        for chosen, singular in ((close, True), (~close, False)):
            index = np.flatnonzero(chosen)
            if not len(index):
                continue
            part = polygons.take(index)
            rule = tip_rule(part, point, ORDER) if singular else polygon_rule(part, ORDER)
            owner = near[index][rule.owner]
            total += rule.weights @ self._density(owner, rule.points, body_force)
        return total

    def _density(self, owner: Ints, points: Floats, body_force: Field | None) -> Floats:
        """Integrand (m, 2) of both modes at points of elements (m,)."""
        q, dq = self.fields.cutoff(points, self.radius)
        gradient, ahead = self._gradients(owner, points), self.fields.tip.direction
        stress, u1 = self._stress(owner, points, gradient), gradient @ ahead
        pull = self._pull(owner, points, body_force)
        found = np.empty((len(points), 2))
        for mode, v in enumerate(self._auxiliary(owner, points)):
            of_v, v1 = stresses_of(self.model.elasticity[owner], v), v @ ahead
            flow = np.einsum("mij,mi,mj->m", stress, v1, dq)
            flow += np.einsum("mij,mi,mj->m", of_v, u1, dq)
            found[:, mode] = flow - np.einsum("mij,mij->m", stress, v) * (dq @ ahead)
            if pull is not None:
                found[:, mode] -= np.einsum("mi,mi->m", pull, v1) * q
        return found

    def _pull(self, owner: Ints, points: Floats, body_force: Field | None) -> Floats | None:
        """Force on the volume (m, 2) at points, that of inertia with it (N/m3); None without."""
        pull = None if body_force is None else body_force(points)
        if self.acceleration is None:
            return pull
        rate = self.model.manifold.rows(owner, points).apply(self.acceleration)
        inert = -self.model.density[owner, None] * rate
        return inert if pull is None else pull + inert

    def over_faces(self, traction: Traction | None) -> Floats:
        """Return the parts (2,) of the integral over faces of cracks and over the boundary.

        Straight behind the tip nothing but a traction on the faces has a part in it, and elsewhere
        what the auxiliary fields leave on free faces too. The boundary carries what the stress
        there says.
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
        total = np.zeros(2)
        if traction is not None and len(behind):
            total += self._straight(behind, traction)
        for chosen, own in ((kinked, traction or _free), (rim, None)):
            if len(chosen):
                total += self._along(chosen, own)
        return total

    def _straight(self, edges: Ints, traction: Traction) -> Floats:
        """Edges behind the tip; graded towards it, for in ``sqrt(r)`` the integrand is smooth."""
        boundary, point = self.model.cut.boundary, self.fields.tip.point
        start, end = boundary.start[edges], boundary.end[edges]
        points, scale = graded_rule(start, end, point, ORDER)
        flat, owner = points.reshape(-1, 2), np.repeat(boundary.element[edges], scale.shape[1])
        pull = traction(flat, np.repeat(_normals(start, end), scale.shape[1], axis=0))
        q, _ = self.fields.cutoff(flat, self.radius)
        ahead = self.fields.tip.direction
        work = [np.einsum("mi,mi->m", pull, v @ ahead) * q for v in self._auxiliary(owner, flat)]
        return np.asarray([scale.ravel() @ mode for mode in work])

    def _along(self, edges: Ints, traction: Traction | None) -> Floats:
        """Any edges: tractions given, or those of the stress."""
        boundary, ahead = self.model.cut.boundary, self.fields.tip.direction
        start, end = boundary.start[edges], boundary.end[edges]
        nodes, weights = segment_rule(start, end, ORDER)
        points, owner = nodes.reshape(-1, 2), np.repeat(boundary.element[edges], nodes.shape[1])
        out = np.repeat(_normals(start, end), nodes.shape[1], axis=0)
        gradient = self._gradients(owner, points)
        stress, u1 = self._stress(owner, points, gradient), gradient @ ahead
        pull = np.einsum("mij,mj->mi", stress, out) if traction is None else traction(points, out)
        weight = weights.ravel() * self.fields.cutoff(points, self.radius)[0]
        found = np.empty(2)
        for mode, v in enumerate(self._auxiliary(owner, points)):
            of_v = stresses_of(self.model.elasticity[owner], v)
            flow = np.einsum("mi,mi->m", pull, v @ ahead)
            flow += np.einsum("mij,mj,mi->m", of_v, out, u1)
            found[mode] = weight @ (flow - np.einsum("mij,mij->m", stress, v) * (out @ ahead))
        return found

    def _auxiliary(self, owner: Ints, points: Floats) -> Floats:
        """Gradients (2, m, 2, 2) of both modes at points of elements (m,)."""
        return np.swapaxes(self.fields.gradients(points, self._branch[owner]), 0, 1)

    def _gradients(self, owner: Ints, points: Floats) -> Floats:
        index, rows = self.model.manifold.gradient_rows(owner, points)
        return np.asarray(np.einsum("mcjl,ml->mcj", rows, self.unknowns[index]))

    def _stress(self, owner: Ints, points: Floats, gradient: Floats) -> Floats:
        """Stress tensors (m, 2, 2) of the displacement, with the pressures on patches."""
        model = self.model
        if self.pressure is None:
            return stresses_of(model.elasticity[owner], gradient)
        assert model.pressures is not None
        mean = model.pressures.rows(model.manifold, owner, points) @ self.pressure
        return stresses_of(model.drained[owner], gradient) + mean[:, None, None] * np.eye(2)


def _normals(start: Floats, end: Floats) -> Floats:
    """Unit normals (n, 2) out of the material on the left of edges."""
    along = (end - start) / np.hypot(*(end - start).T)[:, None]
    return np.stack([along[:, 1], -along[:, 0]], axis=1)


def _free(points: Floats, normals: Floats) -> Floats:
    return np.zeros_like(points)
