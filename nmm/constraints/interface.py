"""An interface: points of one body, and the same points of another body or of the ground."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from covers.approximation.rows import Rows
from integration.arrays import Bools, Floats, Ints
from integration.sparse import csr_array
from nmm.assembly.places import Place
from nmm.assembly.state import State, rotation_matrices
from nmm.effects.base import Instant

Triplets = tuple[Ints, Ints, Floats]
"""Rows, columns and values of a sparse matrix; entries of one place add up."""


@dataclass(frozen=True)
class Interface:
    """Points of a body that are tied to another body or, for a support, to the ground.

    Attributes
    ----------
    first
        The points; their normal points out of this body.
    second
        The same points of the other body; None is the ground.
    area
        (m,) area of interface each point stands for (m2).
    name
        As the scene calls it.
    held
        (2,) whether the jump along x and along y is held.
    displacement
        From the instant to the displacement of the ground in m, (2,) or (m, 2).
    anchor
        (m, 2) displacement of the points when the ground took hold of them (m).
    acted
        (m,) whether something else acts on the face, for each side; None where nothing does.
    """

    first: Place
    second: Place | None
    area: Floats
    name: str = "interface"
    held: Bools = field(default_factory=lambda: np.ones(2, dtype=bool))
    displacement: Callable[[Instant], Floats] = lambda end: np.zeros(2)
    anchor: Floats | float = 0.0
    acted: tuple[Bools, Bools] | None = None

    def __len__(self) -> int:
        return len(self.area)

    @property
    def sides(self) -> tuple[Place, ...]:
        """The places on bodies."""
        return (self.first,) if self.second is None else (self.first, self.second)

    @property
    def bodies(self) -> Ints:
        """Numbers of the bodies that take part."""
        return np.unique(np.concatenate([side.points.body for side in self.sides]))

    def motion(self, state: State) -> Floats:
        """Return the way of the first side from the second since the reference place (m, 2).

        Sides are bonded as they lie: a gap that the search for shared edges allows is no jump.
        """
        own, carried = self.motions(state)
        return own + carried

    def motions(self, state: State) -> tuple[Floats, Floats]:
        """Return the `motion` apart from that by which driven ground has carried the sides."""
        frames = state.frames
        ways = [side.points.own_way(frames, state.deformation) for side in self.sides]
        found = [side.points.carried(frames) for side in self.sides]
        carried = [np.zeros(2) if one is None else one for one in found]
        if len(ways) == 1:
            return ways[0], carried[0]
        return np.asarray(ways[0] - ways[1]), np.asarray(carried[0] - carried[1])

    def jump(self, motions: tuple[Floats, Floats], end: Instant) -> Floats:
        """Return the part of `motions` that is held, less that of the ground (m, 2).

        The ground and what it has carried differ by no digit of the way they went together.
        """
        own, carried = motions
        return np.asarray(self.held * (own - self.anchor - (self.displacement(end) - carried)))

    def rows(self, state: State) -> tuple[Ints, Floats]:
        """Unknowns (m, L) and rows (m, 2, L) of the jump, in global axes."""
        unknowns = [side.points.rows.unknowns for side in self.sides]
        parts = []
        for sign, side in zip((1.0, -1.0), self.sides, strict=False):
            turned = sign * state.frames.rotation[side.points.body]
            parts.append((self.held[:, None] * turned) @ side.points.rows.values)
        return np.concatenate(unknowns, axis=1), np.concatenate(parts, axis=2)

    def spread(self, state: State, forces: Floats) -> Floats:
        """Return what forces (m, 2) in N on the first side, against the second, do on unknowns."""
        pushed = self.first.points.push(state, self.held * forces)
        if self.second is None:
            return pushed
        return pushed - self.second.points.push(state, self.held * forces)

    def turned(self, state: State) -> Floats:
        """Rotations (m, 2, 2) from the reference place: half way between those of both sides."""
        angles = [state.frames.angle[side.points.body] for side in self.sides]
        return rotation_matrices(np.mean(angles, axis=0))

    def normal(self, state: State) -> Floats:
        """Normals (m, 2) in global axes, out of the first side and half way to the second."""
        assert self.first.normal is not None
        return np.asarray(np.einsum("mij,mj->mi", self.turned(state), self.first.normal))


def sparse_rows(unknowns: Ints, values: Floats, n: int) -> csr_array:
    """Matrix (2m, n) of rows (m, 2, L) with unknowns (m, L), component minor."""
    found = Rows(unknowns, values).matrix(n)
    found.sum_duplicates()
    return found


def product(left: tuple[Ints, Floats], right: tuple[Ints, Floats]) -> Triplets:
    """Sum over points of ``left.T @ right``, each unknowns (m, L) and rows (m, 2, L).

    Points of one element follow one another: their sum is one dense matrix.
    """
    (row, one), (column, two) = left, right
    m = len(row)
    run = _run(np.concatenate([row, column], axis=1))
    stacked = (values.reshape(m // run, 2 * run, values.shape[2]) for values in (one, two))
    first, second = stacked
    values = np.swapaxes(first, 1, 2) @ second
    rows, columns = row[::run], column[::run]
    return (
        np.repeat(rows, columns.shape[1], axis=1).ravel(),
        np.tile(columns, (1, rows.shape[1])).ravel(),
        values.ravel(),
    )


def joined(parts: list[Triplets]) -> Triplets:
    """Return the sum of matrices."""
    row, column, value = (np.concatenate(part) for part in zip(*parts, strict=True))
    return row, column, value


def _run(unknowns: Ints) -> int:
    """Length of runs of points, all equally long, that share their unknowns."""
    change = np.flatnonzero((unknowns[1:] != unknowns[:-1]).any(axis=1)) + 1
    return int(np.gcd.reduce(np.diff([0, *change, len(unknowns)]))) or 1


def nearest(points: Floats, known: Floats, values: Floats) -> Floats:
    """Values (m, 2) of the nearest of ``known`` points for each of ``points``."""
    from scipy.spatial import KDTree

    return np.asarray(values[KDTree(known).query(points)[1]])
