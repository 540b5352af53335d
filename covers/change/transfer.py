"""Transfer of displacement fields from one manifold to the next by least squares.

Old and new functions are evaluated at Gauss points of the common parts of old and new elements, so
that integrals of products of polynomials are exact for any meshes. Velocities and accelerations are
projected in the mean square (L2). Displacements are projected in the energy of strains, with the
mean rigid motion of the old field: the stress of the new field balances the same loads on the new
functions, energy does not grow, and a rigid motion or any field in the new space is reproduced
exactly. Inherited unknowns are copied, and the others are solved for.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.rows import Rows
from covers.approximation.singular.rules import graded_rule
from covers.change.field_rows import FieldRows
from covers.change.normal_equations import NormalEquations
from covers.change.parentage import Parentage
from integration.arrays import Bools, Floats, Ints
from integration.rules import PointRule, polygon_rule
from integration.sparse import coo_array, csc_array, csr_array, diags_array

# Share of the mass, scaled to the stiffness, that makes rigid motions unique in the projection of
# strains; iteration removes its effect.
MADE_UNIQUE = 1e-8


@dataclass(frozen=True)
class Transfer:
    """Transfer of fields from an old manifold to a new one.

    Attributes
    ----------
    kin
        The two manifolds.
    elements
        (2, Q) old and new element of each quadrature point.
    points
        (Q, 2) reference coordinates of the points (m).
    area
        (Q,) quadrature weights (m2).
    weight
        (Q,) quadrature weights times the density of the old element (kg/m).
    inherited
        (n,) old unknown of each new one; -1 for those that are solved for, in whose support the
        points lie.
    """

    kin: Parentage
    elements: Ints
    points: Floats
    area: Floats
    weight: Floats
    inherited: Ints

    @classmethod
    def of(cls, kin: Parentage, density: Floats, inherited: Ints | None = None) -> "Transfer":
        """Return the transfer between two manifolds.

        ``density`` (E,) of the old elements weights the mean square (kg/m3). All unknowns are
        solved for unless some are ``inherited`` (n,).
        """
        taken = np.full(kin.new.n_unknowns, -1) if inherited is None else inherited
        wanted = _holding(kin.new, taken < 0)[kin.elements.child]
        rough = _rough(kin.old)[kin.elements.parent] | _rough(kin.new)[kin.elements.child]
        degree = max(kin.old.degree, kin.new.degree)
        smooth, sharp = np.flatnonzero(wanted & ~rough), np.flatnonzero(wanted & rough)
        rules = polygon_rule(kin.pieces.take(smooth), 2 * degree), _sharp_rule(kin, sharp, degree)
        owner = np.concatenate([smooth[rules[0].owner], sharp[rules[1].owner]])
        points, area = (
            np.concatenate([getattr(rule, name) for rule in rules])
            for name in ("points", "weights")
        )
        pairs = np.stack([kin.elements.parent[owner], kin.elements.child[owner]])
        return cls(kin, pairs, points, area, area * density[pairs[0]], taken)

    @cached_property
    def old(self) -> Rows:
        """Rows of the old manifold at the points."""
        return self._fields[0].rows

    @cached_property
    def new(self) -> Rows:
        """Rows of the new manifold at the points."""
        return self._fields[1].rows

    def rates(self, unknowns: Floats) -> Floats:
        """Return the unknowns (n,) of the new field nearest to the old one in the mean square."""
        found = self._given(unknowns)
        if not self._free.any():
            return found
        rest = self.old.apply(unknowns) - self.new.apply(found)
        side = self._values.T @ (self.weight[:, None] * rest).ravel()
        found[self._free] = NormalEquations(self._among(self._mass)).solve(side[self._free])
        return found

    def _given(self, unknowns: Floats) -> Floats:
        """Inherited unknowns (n,), zero elsewhere."""
        return np.where(self._free, 0.0, unknowns[np.maximum(self.inherited, 0)])

    @cached_property
    def _free(self) -> Bools:
        """(n,) whether an unknown is solved for."""
        return self.inherited < 0

    @cached_property
    def inherits_nothing(self) -> Bools:
        """(B,) whether a body inherits nothing, so that its mean motion determines its place."""
        new = self.kin.new
        body = new.unknown_body[~self._free]
        return np.asarray(np.bincount(body, minlength=new.n_bodies) == 0)

    def _among(self, matrix: csc_array) -> csc_array:
        """Submatrix of a matrix (n, n) for the unknowns that are solved for."""
        return csc_array(matrix[self._free][:, self._free])

    def deformation(self, unknowns: Floats, elasticity: Floats) -> Floats:
        """Return the unknowns (n,) of the new field of nearest strains, and the same rigid motion.

        ``elasticity`` (E, 3, 3) of the old elements is the norm of strains (Pa).
        """
        found, free = self.rates(unknowns), self._free
        if not free.any():
            return found
        n, old, new = self.kin.new.n_unknowns, *(field.strains for field in self._fields)
        weighed = self.area[:, None, None] * elasticity[self.elements[0]]
        stress = np.einsum("qij,qjl,ql->qi", weighed, old.values, unknowns[old.unknowns])
        strain = new.matrix(n)
        weighty = csc_array(strain.T @ new.times(weighed).matrix(n))
        side = strain.T @ stress.ravel() - weighty @ np.where(free, 0.0, found)
        matrix, mass = self._among(weighty), self._among(self._mass)
        stiff, heavy = matrix.diagonal().sum(), mass.diagonal().sum()
        if not stiff > 0:  # no common material has strain
            return found
        normal = NormalEquations(csc_array(matrix + MADE_UNIQUE * stiff / heavy * mass))
        start = found[free]
        found[free] = normal.iterated(matrix, side[free], start, self._without_rigid)
        return found

    def sums(self, values: Floats) -> Floats:
        """Return weighted sums (B, ...) over the new bodies of values (Q, ...) at the points."""
        body = self.kin.new.element_body[self.elements[1]]
        flat = self.weight[:, None] * values.reshape(len(values), -1)
        n = self.kin.new.n_bodies
        sums = [np.bincount(body, column, minlength=n) for column in flat.T]
        return np.asarray(np.stack(sums, axis=1).reshape(n, *values.shape[1:]), dtype=np.float64)

    @cached_property
    def _fields(self) -> tuple[FieldRows, FieldRows]:
        """Rows of both manifolds at the points: functions and slopes are found together."""
        sides = zip((self.kin.old, self.kin.new), self.elements, strict=True)
        old, new = (FieldRows.of(*manifold.both_rows(at, self.points)) for manifold, at in sides)
        return old, new

    @cached_property
    def _values(self) -> csr_array:
        return self.new.matrix(self.kin.new.n_unknowns)

    @cached_property
    def _mass(self) -> csc_array:
        weight = np.repeat(self.weight, 2)
        return csc_array(self._values.T @ _scaled(self._values, weight))

    def _without_rigid(self, free: Floats) -> Floats:
        """Remove the mean rigid motion of bodies that inherit nothing from the free unknowns."""
        if not self.inherits_nothing.any():
            return free
        unknowns = np.zeros(len(self._free))
        unknowns[self._free] = free
        chosen = diags_array(np.repeat(self.inherits_nothing, 3) * 1.0)
        modes = csc_array(self.kin.new.rigid_modes @ chosen)
        weighed = csr_array((self._mass @ modes).T)
        motion = by_body(csr_array(weighed @ modes), weighed @ unknowns)
        return np.asarray((unknowns - modes @ motion)[self._free])


def _sharp_rule(kin: Parentage, parts: Ints, degree: int) -> PointRule:
    """Points on common parts of elements with singular functions, graded about their points.

    Exact for products of strains.
    """
    place = np.unique(np.concatenate([kin.old.singular, kin.new.singular]), axis=0)
    which = np.broadcast_to(np.arange(len(place)), (len(parts), len(place)))
    return graded_rule(kin.pieces.take(parts), place, which, degree - 1)


def _holding(manifold: Manifold, unknowns: Bools) -> Bools:
    """Which elements (E,) have functions of any of the given unknowns (n,)."""
    found = np.zeros(len(manifold.elements), dtype=bool)
    for group in manifold.groups:  # a handful of groups
        found[group.elements] = unknowns[group.unknowns].any(axis=1)
    return found


def _rough(manifold: Manifold) -> Bools:
    """Which elements (E,) have singular functions."""
    found = np.zeros(len(manifold.elements), dtype=bool)
    for group in manifold.groups:  # a handful of groups
        found[group.elements] = (group.slots < 0).any()
    return found


def by_body(matrix: csr_array, sides: Floats) -> Floats:
    """Solve the 3 x 3 systems of the bodies, the diagonal blocks of ``matrix`` (3 B, 3 B)."""
    n = len(sides) // 3
    entries = coo_array(matrix)
    row, column = entries.coords
    inside = row // 3 == column // 3
    blocks = np.zeros((n, 3, 3))
    np.add.at(blocks, (row[inside] // 3, row[inside] % 3, column[inside] % 3), entries.data[inside])
    empty = np.abs(blocks).max(axis=(1, 2)) == 0
    blocks[empty] = np.eye(3)
    return np.asarray(np.linalg.solve(blocks, sides.reshape(n, 3, 1)).ravel(), dtype=np.float64)


def _scaled(matrix: csr_array, factor: Floats) -> csr_array:
    found = matrix.copy()
    found.data *= np.repeat(factor, np.diff(matrix.indptr))
    return found
