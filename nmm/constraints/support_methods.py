"""How supports are imposed on boundaries that no mesh follows.

- springs: Shi's fixed points (1988); a stiff spring for every point.
- Nitsche (1971): consistent, symmetric; the penalty of order ``gamma / h`` only has to outweigh the
  traction on small cuts, with a ghost term that ties cut elements to their neighbours.
- Lagrange: multipliers on intervals longer than cells, tractions of polynomial stresses.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.places import Place
from nmm.constraints.multiplier_space import join, multipliers, pieces_of, traction_degree
from nmm.constraints.rows import AXES, sparse_rows
from nmm.constraints.volume_lift import Lift
from nmm.effects.base import Instant

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

    def energy(self, state: State, lag: Floats) -> float:
        """Energy stored (J): `pull` is what it loses with the motion, `reaction` with the lag."""
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

    def energy(self, state: State, lag: Floats) -> float:
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
    lift
        The part of pressures; None where the material has none.
    """

    weight: Floats
    penalty: Floats
    traction: Floats
    ghost: csc_array
    lift: Lift | None = None

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
        more = self.ghost
        if self.lift is not None:
            more = more + self.lift.matrix(self._across(state, self.ghost.shape[0]))
        tie = more.tocoo()
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
        if self.lift is not None:
            gap = -self._normal_part(state, lag)
            total += self.lift.force(self._across(state, n), state.deformation, gap)
        return np.asarray(total)

    def reaction(self, state: State, lag: Floats) -> Floats:
        """See `Support.reaction`."""
        unknowns = self.place.points.rows.unknowns
        force = np.zeros(2)
        for axis in np.flatnonzero(self.held).tolist():
            now = np.einsum("ml,ml->m", self._along(state, axis)[1], state.deformation[unknowns])
            force[axis] = np.sum(self.weight * (now + self.penalty * lag[:, axis]))
        if self.lift is not None:
            pressure = self.lift.pressure(state.deformation, -self._normal_part(state, lag))
            force += self.held * (pressure @ self._normal(state))
        return force

    def energy(self, state: State, lag: Floats) -> float:
        """Tractions times lags, half the penalty's and the ghost's; it may be negative."""
        unknowns, q = self.place.points.rows.unknowns, state.deformation
        total = 0.5 * float(q @ (self.ghost @ q))
        for axis in np.flatnonzero(self.held).tolist():
            now = np.einsum("ml,ml->m", self._along(state, axis)[1], q[unknowns])
            late = lag[:, axis]
            total += float(np.sum(self.weight * late * (now + self.penalty * late / 2)))
        if self.lift is not None:
            total += self.lift.energy(q, -self._normal_part(state, lag))
        return total

    def gap_volume(self, state: State, lag: Floats, k: int) -> Floats:
        """Volumes (k,) that lie between the edge and where it should be (m2)."""
        if self.lift is None:
            return np.zeros(k)
        return self.lift.gap_volume(-self._normal_part(state, lag), k)

    @property
    def turns(self) -> bool:
        """See `Support.turns`."""
        return True

    def _normal(self, state: State) -> Floats:
        """Outward normals (m, 2) in global axes."""
        assert self.place.normal is not None
        return state.frames.to_global(self.place.points.body, self.place.normal)

    def _normal_part(self, state: State, way: Floats) -> Floats:
        """What ways (m, 2) along the held axes do along the normal (m,)."""
        return np.asarray(np.sum(self.held * way * self._normal(state), axis=1))

    def _across(self, state: State, n: int) -> csr_array:
        """Rows (m, n) of the motion of the held axes along the normal."""
        points = self.place.points
        rows = points.along(state.frames, self.held * self._normal(state))
        m, length = rows.shape
        entries = rows.ravel(), points.rows.unknowns.ravel(), np.arange(m + 1) * length
        return csr_array(entries, shape=(m, n))

    def _along(self, state: State, axis: int) -> tuple[Floats, Floats]:
        points = self.place.points
        toward = state.frames.to_body(points.body, np.tile(AXES[axis], (len(self.weight), 1)))
        return points.rows.along(toward), np.einsum("mcl,mc->ml", self.traction, toward)


@dataclass
class Tractions:
    """Multipliers that supports share, as they were found last.

    Attributes
    ----------
    size
        Number k of multipliers.
    values
        (k,) Pa.
    before
        (k,) Pa, as they were when the step began.
    """

    size: int
    values: Floats | None = None
    before: Floats | None = None


@dataclass(frozen=True)
class Multipliers(Support):
    """Lagrange multipliers.

    Attributes
    ----------
    weight
        (m,) area of boundary of each point (m2).
    basis
        (2m, k) multipliers at the points, component minor.
    shared
        The multipliers; supports along one edge share them.
    """

    weight: Floats
    basis: csr_array
    shared: Tractions

    def stiffness(self, state: State) -> Triplets:
        """Nothing joins the stiffness."""
        none = np.zeros(0, dtype=np.int64)
        return none, none, np.zeros(0)

    def pull(self, state: State, lag: Floats, n: int) -> Floats:
        """Nothing pulls: the multipliers are unknowns of the step."""
        return np.zeros(n)

    def reaction(self, state: State, lag: Floats) -> Floats:
        """See `Support.reaction`."""
        return self._force(self.shared.values)

    def earlier(self) -> Floats:
        """Force (2,) in N on the bodies when the step began."""
        return self._force(self.shared.before)

    def _force(self, values: Floats | None) -> Floats:
        if values is None:
            return np.zeros(2)
        traction = (self.basis @ values).reshape(-1, 2)
        return np.asarray(-self.weight @ traction)

    def border(self, state: State, lag: Floats, n: int) -> tuple[csr_array, Floats]:
        """Rows (k, n) and right-hand sides of the conditions on the step's unknowns."""
        points, m = self.place.points, len(self.weight)
        values = [points.along(state.frames, np.tile(axis, (m, 1))) for axis in AXES]
        rows = sparse_rows(points.rows.unknowns, np.stack(values, axis=1), n)
        heavy = csr_array((diags_array(np.repeat(self.weight, 2)) @ self.basis).T)
        return csr_array(heavy @ rows), heavy @ lag.ravel()


def share_multipliers(model: Model, supports: Sequence[Support], size: float) -> list[Support]:
    """Return the supports, those by multipliers that hold the same axes with multipliers in common.

    An edge of many short supports has room for no more multipliers than one support along it.
    """
    found = list(supports)
    axes = {tuple(s.held.tolist()) for s in supports if isinstance(s, Multipliers)}
    for held in sorted(axes):  # at most three
        number = [
            i
            for i, s in enumerate(supports)
            if isinstance(s, Multipliers) and tuple(s.held.tolist()) == held
        ]
        parts = [supports[i] for i in number]
        pieces = join([pieces_of(model, part.place, size) for part in parts])
        basis = multipliers(pieces, size, traction_degree(model), parts[0].held)
        shared, first = Tractions(int(basis.shape[1])), 0
        for i, part in zip(number, parts, strict=True):  # supports: a handful
            assert isinstance(part, Multipliers)
            last = first + 2 * len(part.weight)
            found[i] = replace(part, basis=csr_array(basis[first:last]), shared=shared)
            first = last
    return found


def traction_rows(model: Model, place: Place) -> Floats:
    """Rows (m, 2, L) of the traction ``sigma n`` in body axes at points of the boundary.

    Without the part of pressures, which `nmm.constraints.volume_lift` gives.
    """
    assert place.normal is not None
    _, gradient = model.manifold.gradient_rows(place.elements, place.position)
    strain = np.stack(
        [gradient[:, 0, 0], gradient[:, 1, 1], gradient[:, 0, 1] + gradient[:, 1, 0]], axis=1
    )
    stress = np.einsum("mij,mjl->mil", model.drained[place.elements], strain)
    n = place.normal[:, :, None]
    return np.stack(
        [
            n[:, 0] * stress[:, 0] + n[:, 1] * stress[:, 2],
            n[:, 0] * stress[:, 2] + n[:, 1] * stress[:, 1],
        ],
        axis=1,
    )


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
