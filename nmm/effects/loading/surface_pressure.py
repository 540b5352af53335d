"""Follower pressure on parts of the boundary: its forces, and the load stiffness."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from integration.plane_vectors import QUARTER_TURN, clockwise
from nmm.assembly.places import Place
from nmm.assembly.state import State
from nmm.effects.base import Instant, Span, StepForce


@dataclass(frozen=True)
class SurfacePressure:
    """Pressure on k parts of the boundary with q points each, m = k q.

    Attributes
    ----------
    name
        Name in the scene.
    place
        The points.
    slopes
        (k, q, q) from the places of the points of a part to the weighted tangent at each, with the
        material on its left; exact where places are polynomials of degree q - 1 along the part.
    size
        Pressure times thickness (N/m).
    factor
        Load factor as a function of the instant.
    steady
        Whether it is constant in time.
    follows
        Whether the forces follow the deformed surface; else the reference one, as in the theory of
        small displacements.
    """

    name: str
    place: Place
    slopes: Floats
    size: float
    factor: Callable[[Instant], float]
    steady: bool
    follows: bool = True

    def forces(self, state: State, end: Instant) -> Floats:
        """Forces (m, 2) on the points at their present places, in global axes (N)."""
        places = self.place.position
        if self.follows:
            places = self.place.points.place(state.frames, state.deformation)
        shape = (*self.slopes.shape[:2], 2)
        along = (self.slopes @ places.reshape(shape)).reshape(-1, 2)
        return np.asarray(-self.factor(end) * self.size * clockwise(along))

    def stiffness(self, n: int) -> csr_array:
        """Load stiffness (n, n) at factor 1: minus the derivative of the force by the unknowns.

        It is symmetric but for terms of the ends of an open surface.
        """
        rows = self.place.points.rows.matrix(n)
        k, q, _ = self.slopes.shape
        turned = np.einsum("kij,ab->kiajb", self.slopes, -QUARTER_TURN).reshape(k, 2 * q, 2 * q)
        first = np.arange(k)[:, None, None] * 2 * q + np.arange(2 * q)
        index = np.broadcast_to(first, turned.shape)
        entries = (turned.ravel(), (np.swapaxes(index, 1, 2).ravel(), index.ravel()))
        blocks = csr_array(entries, shape=(2 * k * q, 2 * k * q))
        return csr_array(self.size * (rows.T @ blocks @ rows))


@dataclass(frozen=True)
class PressedSurfaces:
    """Pressures on a model of ``n`` unknowns."""

    surfaces: tuple[SurfacePressure, ...]
    n: int

    def force(self, state: State, end: Instant) -> Floats:
        """See `Effect.force`: the pressures on the present surfaces, in the axes of the bodies."""
        total = np.zeros(self.n)
        for one in self.surfaces:  # a handful
            total += one.place.points.push(state, one.forces(state, end))
        return total

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: the weighted forces at both ends."""
        end = Instant.of(after)
        force = span.weight * self.force(after, end)
        if span.weight < 1:
            force += (1 - span.weight) * self.force(before, Instant.of(before))

        def stiffness() -> csc_array:
            none = csc_array((self.n, self.n))
            pairs = zip(self.surfaces, self.stiffness, strict=True)
            return csc_array(sum((span.weight * p.factor(end) * k for p, k in pairs), start=none))

        return StepForce(force, stiffness)

    @cached_property
    def stiffness(self) -> list[csr_array]:
        """Load stiffness (n, n) of each at factor 1."""
        return [one.stiffness(self.n) for one in self.surfaces]


def along_surface(place: Place) -> Floats:
    """Return `SurfacePressure.slopes` (k, q, q) at the Gauss points of a place."""
    assert place.piece is not None
    assert place.normal is not None
    k = int(place.piece[-1]) + 1
    q = len(place) // k
    # On the interval (-1, 1), whose weights sum to 2.
    nodes, weights = np.polynomial.legendre.leggauss(q)
    slopes = weights[:, None] * _derivatives(nodes)
    ends = place.position.reshape(k, q, 2)
    normal = place.normal.reshape(k, q, 2)[:, 0]
    way = np.einsum("ij,kjc->kic", slopes, ends).sum(axis=1)
    # With the material on the left, the outward normal is the tangent turned clockwise.
    sense = np.sign(np.sum(clockwise(way) * normal, axis=1))
    return np.asarray(sense[:, None, None] * slopes)


def _derivatives(nodes: Floats) -> Floats:
    """Differentiation matrix (q, q) of the polynomial through values at nodes (q,)."""
    powers = np.vander(nodes, increasing=True)
    slopes = np.zeros_like(powers)
    slopes[:, 1:] = powers[:, :-1] * np.arange(1, len(nodes))
    return np.asarray(slopes @ np.linalg.inv(powers))
