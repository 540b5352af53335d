"""How supports are imposed on boundaries that no mesh follows.

- springs: Shi's fixed points (1988); a stiff spring for every point.
- Nitsche (1971): consistent, symmetric; the penalty of order ``gamma / h`` only has to outweigh the
  traction on small cuts, with a ghost term that ties cut elements to their neighbours.
- Lagrange: multipliers on intervals longer than cells, polynomials of the degree of the stress.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.places import Place
from nmm.effects.base import Instant

# (x, y) in which a support may hold a point.
AXES = np.eye(2)

Triplets = tuple[Ints, Ints, Floats]


@dataclass(frozen=True)
class Support(ABC):
    """One support.

    Attributes
    ----------
    name
        As the scene calls it.
    place
        The points held.
    held
        (2,) whether x and y are held.
    displacement
        From the instant to the prescribed displacement in m, (2,) or (m, 2).
    """

    name: str
    place: Place
    held: Bools
    displacement: Callable[[Instant], Floats]

    @abstractmethod
    def stiffness(self, state: State) -> Triplets:
        """Rows, columns and values of the matrix that joins the stiffness."""

    @abstractmethod
    def pull(self, state: State, lag: Floats, n: int) -> Floats:
        """Force (n,) on the unknowns when the points lag (m, 2) behind where they should be."""

    @abstractmethod
    def reaction(self, state: State, lag: Floats) -> Floats:
        """Force (2,) in N on the bodies."""

    def energy(self, lag: Floats) -> float:
        """Energy stored (J)."""
        return 0.0

    @property
    def turns(self) -> bool:
        """Whether the matrix changes when bodies turn."""
        return not self.held.all()


@dataclass(frozen=True)
class Springs(Support):
    """Springs of ``spring`` (m,) N/m at the points."""

    spring: Floats

    def stiffness(self, state: State) -> Triplets:
        """See `Support.stiffness`."""
        points = self.place.points
        m, size = points.rows.unknowns.shape
        total = np.zeros((m, size, size))
        if self.held.all():
            values = points.rows.values
            total = np.einsum("mca,m,mcb->mab", values, self.spring, values)
        else:
            for axis in np.flatnonzero(self.held).tolist():
                rows = points.along(state.frames, np.tile(AXES[axis], (m, 1)))
                total += np.einsum("ma,m,mb->mab", rows, self.spring, rows)
        return _triplets(points.rows.unknowns, total)

    def pull(self, state: State, lag: Floats, n: int) -> Floats:
        """See `Support.pull`."""
        points = self.place.points
        local = points.along(state.frames, self.spring[:, None] * self.held * lag)
        total = np.bincount(points.rows.unknowns.ravel(), local.ravel(), minlength=n)
        return np.asarray(total, dtype=float)

    def reaction(self, state: State, lag: Floats) -> Floats:
        """See `Support.reaction`."""
        return np.asarray(np.sum(self.spring[:, None] * self.held * lag, axis=0))

    def energy(self, lag: Floats) -> float:
        """See `Support.energy`."""
        return 0.5 * float(np.sum(self.spring[:, None] * self.held * lag**2))


@dataclass(frozen=True)
class Nitsche(Support):
    """Nitsche's terms at Gauss points of an edge.

    Attributes
    ----------
    weight
        (m,) area of boundary of each point (m2).
    penalty
        (m,) Pa/m.
    traction
        (m, 2, L) rows of the traction in body axes.
    ghost
        Stabilising matrix of the elements on the edge.
    """

    weight: Floats
    penalty: Floats
    traction: Floats
    ghost: csc_array

    def stiffness(self, state: State) -> Triplets:
        """See `Support.stiffness`."""
        points = self.place.points
        m, size = points.rows.unknowns.shape
        together = _points_together(self.place.elements)
        runs = (m // together, together, size)
        total = np.zeros((runs[0], size, size))
        for axis in np.flatnonzero(self.held).tolist():
            rows, traction = (part.reshape(runs) for part in self._along(state, axis))
            weighted = np.swapaxes(rows * self.weight.reshape(runs[:2])[:, :, None], 1, 2)
            cross = weighted @ traction
            total -= cross + np.swapaxes(cross, 1, 2)
            total += weighted @ (rows * self.penalty.reshape(runs[:2])[:, :, None])
        row, column, value = _triplets(points.rows.unknowns[::together], total)
        tie = self.ghost.tocoo()
        return (
            np.concatenate([row, tie.coords[0]]),
            np.concatenate([column, tie.coords[1]]),
            np.concatenate([value, tie.data]),
        )

    def pull(self, state: State, lag: Floats, n: int) -> Floats:
        """See `Support.pull`."""
        unknowns = self.place.points.rows.unknowns
        total = -(self.ghost @ state.deformation)
        for axis in np.flatnonzero(self.held).tolist():
            rows, traction = self._along(state, axis)
            now = np.einsum("ml,ml->m", traction, state.deformation[unknowns])
            push = (self.weight * (now + self.penalty * lag[:, axis]))[:, None] * rows
            push -= (self.weight * lag[:, axis])[:, None] * traction
            total += np.bincount(unknowns.ravel(), push.ravel(), minlength=n)
        return np.asarray(total)

    def reaction(self, state: State, lag: Floats) -> Floats:
        """See `Support.reaction`."""
        unknowns = self.place.points.rows.unknowns
        force = np.zeros(2)
        for axis in np.flatnonzero(self.held).tolist():
            now = np.einsum("ml,ml->m", self._along(state, axis)[1], state.deformation[unknowns])
            force[axis] = np.sum(self.weight * (now + self.penalty * lag[:, axis]))
        return force

    @property
    def turns(self) -> bool:
        """See `Support.turns`."""
        return True

    def _along(self, state: State, axis: int) -> tuple[Floats, Floats]:
        points = self.place.points
        toward = state.frames.to_body(points.body, np.tile(AXES[axis], (len(self.weight), 1)))
        return points.rows.along(toward), np.einsum("mcl,mc->ml", self.traction, toward)


@dataclass(frozen=True)
class Multipliers(Support):
    """Lagrange multipliers.

    Attributes
    ----------
    weight
        (m,) area of boundary of each point (m2).
    basis
        (m, k) multiplier functions at the points.
    found
        Tractions of the last solution, (held axes k,), Pa.
    """

    weight: Floats
    basis: Floats
    found: dict[str, Floats] = field(default_factory=dict)

    def stiffness(self, state: State) -> Triplets:
        """Nothing joins the stiffness."""
        none = np.zeros(0, dtype=np.int64)
        return none, none, np.zeros(0)

    def pull(self, state: State, lag: Floats, n: int) -> Floats:
        """Nothing pulls: the multipliers are unknowns of the step."""
        return np.zeros(n)

    def reaction(self, state: State, lag: Floats) -> Floats:
        """See `Support.reaction`."""
        force = np.zeros(2)
        if "traction" in self.found:
            share = self.weight @ self.basis
            values = self.found["traction"].reshape(-1, self.basis.shape[1])
            force[self.held] = -values @ share
        return force

    def border(self, state: State, lag: Floats, n: int) -> tuple[csr_array, Floats]:
        """Rows (k, n) and right-hand sides of the conditions on the step's unknowns."""
        points = self.place.points
        rows, sides = [], []
        heavy = self.weight[:, None] * self.basis
        for axis in np.flatnonzero(self.held).tolist():
            values = points.along(state.frames, np.tile(AXES[axis], (len(self.weight), 1)))
            offsets = np.arange(len(values) + 1) * values.shape[1]
            flat = (values.ravel(), points.rows.unknowns.ravel(), offsets)
            rows.append(csr_array(heavy.T) @ csr_array(flat, shape=(len(values), n)))
            sides.append(heavy.T @ lag[:, axis])
        from scipy.sparse import vstack

        return csr_array(vstack(rows)), np.concatenate(sides)


def traction_rows(model: Model, place: Place) -> Floats:
    """Rows (m, 2, L) of the traction ``sigma n`` in body axes at points of the boundary."""
    assert place.normal is not None
    _, gradient = model.manifold.gradient_rows(place.elements, place.position)
    strain = np.stack(
        [gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1
    )
    stress = np.einsum("mij,mjl->mil", model.elasticity[place.elements], strain)
    n = place.normal[:, :, None]
    return np.stack(
        [
            n[:, 0] * stress[:, 0] + n[:, 1] * stress[:, 2],
            n[:, 0] * stress[:, 2] + n[:, 1] * stress[:, 1],
        ],
        axis=1,
    )


def multiplier_basis(place: Place, size: float, degree: int) -> Floats:
    """Legendre polynomials (m, k) on intervals of two cells or more along each straight line held.

    Multipliers on every cut piece of boundary would be too many for the displacements to answer
    (Béchet, Moës and Wohlmuth 2009); on intervals longer than cells they are not.
    """
    parts = []
    lines = _lines(place, size)
    for number in range(int(lines.max(initial=-1)) + 1):  # the straight lines of a support
        chosen = np.flatnonzero(lines == number)
        part = _on_line(place.position[chosen], size, degree)
        parts.append(np.zeros((len(lines), part.shape[1])))
        parts[-1][chosen] = part
    return np.concatenate(parts, axis=1)


def _lines(place: Place, size: float) -> Ints:
    """The straight line (m,) on which each point lies."""
    assert place.normal is not None
    offset = np.einsum("mi,mi->m", place.normal, place.position) / size
    rows = np.round(np.column_stack([place.normal, offset]) / 1e-6).astype(np.int64)
    return np.unique(rows, axis=0, return_inverse=True)[1].ravel()


def _on_line(points: Floats, size: float, degree: int) -> Floats:
    from numpy.polynomial.legendre import legvander

    away = points - points[0]
    along = away[np.argmax(np.abs(away).sum(axis=1))]
    s = away @ along / max(float(np.hypot(*along)), 1e-300)
    low, high = float(s.min()), float(s.max())
    number = max(int((high - low) / (2 * size)), 1)
    # One constant would leave the turn about the middle free.
    degree = max(degree, 1) if number == 1 else degree
    width = max(high - low, 1e-300) / number
    interval = np.clip(((s - low) / width).astype(int), 0, number - 1)
    values = legvander(2 * (s - low - interval * width) / width - 1, degree)
    basis = np.zeros((len(s), number, degree + 1))
    basis[np.arange(len(s)), interval] = values
    return basis.reshape(len(s), -1)


def _points_together(elements: Ints) -> int:
    """Length of runs of points, all equally long, that lie in one element each."""
    change = np.flatnonzero(np.diff(elements)) + 1
    lengths = np.diff(np.concatenate([[0], change, [len(elements)]]))
    return int(np.gcd.reduce(lengths)) or 1


def _triplets(unknowns: Ints, matrices: Floats) -> Triplets:
    if len(unknowns) > 1:
        # Points of one element follow one another: they make one matrix.
        new = np.concatenate([[True], (unknowns[1:] != unknowns[:-1]).any(axis=1)])
        first = np.flatnonzero(new)
        unknowns, matrices = unknowns[first], np.add.reduceat(matrices, first, axis=0)
    row = np.repeat(unknowns[:, :, None], unknowns.shape[1], axis=2)
    return row.ravel(), np.swapaxes(row, 1, 2).ravel(), matrices.ravel()
