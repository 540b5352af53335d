"""Pressure on a surface: it turns with it, and grows where it stretches."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.places import Place
from nmm.assembly.pushes import Pushes, joined
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.load_factor import load_factor

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable

# A vector turned clockwise: the way along a surface gives the way out of it.
CLOCKWISE = np.array([[0.0, 1.0], [-1.0, 0.0]])


@dataclass(frozen=True)
class SurfacePressure:
    """Pressure on q points of each of k pieces of boundary, k q = m of them.

    Attributes
    ----------
    name
        As the scene calls it.
    place
        The points.
    slopes
        (k, q, q) from places of the points of a piece to the way along the surface that each of
        them stands for, the material to its left; exact where places are polynomials of degree
        q - 1 along the piece.
    size
        Pressure times thickness (N/m).
    factor
        From the instant to the factor.
    steady
        Whether it has no history.
    """

    name: str
    place: Place
    slopes: Floats
    size: float
    factor: Callable[[Instant], float]
    steady: bool

    def forces(self, state: State, end: Instant) -> Floats:
        """Forces (m, 2) on the points where they are (N)."""
        places = self.place.points.place(state.frames, state.deformation)
        shape = (*self.slopes.shape[:2], 2)
        along = (self.slopes @ places.reshape(shape)).reshape(-1, 2)
        return np.asarray(-self.factor(end) * self.size * along @ CLOCKWISE.T)

    def stiffness(self, n: int) -> csr_array:
        """Matrix (n, n) by which the force falls with the motion, at factor 1.

        What is not symmetric of it is of the ends of an open surface alone.
        """
        rows = self.place.points.rows.matrix(n)
        k, q, _ = self.slopes.shape
        turned = np.einsum("kij,ab->kiajb", self.slopes, CLOCKWISE).reshape(k, 2 * q, 2 * q)
        first = np.arange(k)[:, None, None] * 2 * q + np.arange(2 * q)
        index = np.broadcast_to(first, turned.shape)
        entries = (turned.ravel(), (np.swapaxes(index, 1, 2).ravel(), index.ravel()))
        blocks = csr_array(entries, shape=(2 * k * q, 2 * k * q))
        return csr_array(self.size * (rows.T @ blocks @ rows))


class SurfacePressures(Effect):
    """All pressures of a scene.

    A closed surface under an even pressure is in balance however it turns and bends. Where axes
    turn with bodies what is left of a turn in a step waits for the next solution; under finite
    strain all of it is in the deformation, and steps are solved for it.
    """

    name = "pressures"

    def __init__(self, pressures: list[SurfacePressure], model: Model, bends: bool = False) -> None:
        self.pressures, self._model, self._bends = pressures, model, bends
        self._n = model.manifold.n_unknowns
        self._whole = [one.stiffness(self._n) for one in pressures]
        self._parts = [csr_array((whole + whole.T) / 2) for whole in self._whole]
        self._kept: tuple[tuple[float, ...], csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` of kind "pressure"."""
        found = [_pressure(setup, one) for one in setup.scene.loads if one.kind == "pressure"]
        return cls(found, setup.model, setup.kinematics.finite)

    @property
    def steady(self) -> bool:
        """See `Effect.steady`."""
        return all(one.steady for one in self.pressures)

    @property
    def bends(self) -> bool:
        """See `Effect.bends`."""
        return self._bends

    @property
    def symmetric(self) -> bool:
        """See `Effect.symmetric`: ends of open surfaces turn and store nothing."""
        return False

    def through(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.through`: the forces at both ends, which are lines in the places."""
        end = Instant.of(after)
        force = span.weight * self.force(after, end)
        if span.weight < 1:
            force += (1 - span.weight) * self.force(before, Instant.of(before))

        def stiffness() -> csc_array:
            none = csc_array((self._n, self._n))
            pairs = zip(self.pressures, self._whole, strict=True)
            return csc_array(sum((span.weight * p.factor(end) * k for p, k in pairs), start=none))

        return StepForce(force, stiffness)

    def pushes(self, state: State) -> Pushes:
        """See `Effect.pushes`: those on faces of cracks."""
        now = Instant.of(state)
        parts = ((one.place, one.forces(state, now)) for one in self.pressures)
        return joined(Pushes.on(self._model, place, force) for place, force in parts)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the pressures on the surfaces as they are, in the bodies' axes."""
        total = np.zeros(self._n)
        for one in self.pressures:  # a handful
            total += one.place.points.push(state, one.forces(state, end))
        return total

    def matrix(self, state: State) -> csc_array:
        """Return how the forces fall with the motion; the same object while the factors stay."""
        now = Instant.of(state)
        factors = tuple(one.factor(now) for one in self.pressures)
        if self._kept is None or self._kept[0] != factors:
            none = csc_array((self._n, self._n))
            pairs = zip(factors, self._parts, strict=True)
            self._kept = factors, csc_array(sum((f * part for f, part in pairs), start=none))
        return self._kept[1]

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._kept = None

    def work(self, before: State, after: State) -> float:
        """Mean of the forces at both ends times the way: exact, as they are linear in the place."""
        total = 0.0
        for one in self.pressures:
            first, last = (one.forces(state, Instant.of(state)) for state in (before, after))
            total += one.place.points.work(before, after, (first + last) / 2)
        return total


def _pressure(setup: Setup, load: "LoadTable") -> SurfacePressure:
    assert load.pressure is not None
    # As many points on a piece as functions along it.
    order = 2 * max(setup.model.manifold.degree, 1) + 1
    place = edge_place(setup, "loads", load, order)
    size, factor = load.pressure * setup.model.thickness, load_factor(setup, load)
    return SurfacePressure(
        load.name, place, along_surface(place), size, factor, load.history is None
    )


def along_surface(place: Place) -> Floats:
    """Weights (k, q, q) of the points' places in the way that each stands for: `slopes`."""
    assert place.piece is not None
    assert place.normal is not None
    k = int(place.piece[-1]) + 1
    q = len(place) // k
    # Shares of the piece at which Gauss points lie; the sum of weights is its length.
    nodes, weights = np.polynomial.legendre.leggauss(q)
    slopes = weights[:, None] * _derivatives(nodes)
    ends = place.position.reshape(k, q, 2)
    normal = place.normal.reshape(k, q, 2)[:, 0]
    way = np.einsum("ij,kjc->kic", slopes, ends).sum(axis=1)
    # Along the surface with the material to the left the outward normal is turned clockwise.
    sense = np.sign(np.sum(way @ CLOCKWISE.T * normal, axis=1))
    return np.asarray(sense[:, None, None] * slopes)


def _derivatives(nodes: Floats) -> Floats:
    """Matrix (q, q) from values at nodes to the derivatives of the polynomial through them."""
    powers = np.vander(nodes, increasing=True)
    slopes = np.zeros_like(powers)
    slopes[:, 1:] = powers[:, :-1] * np.arange(1, len(nodes))
    return np.asarray(slopes @ np.linalg.inv(powers))
