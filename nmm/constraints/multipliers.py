"""Lagrange multipliers: jumps vanish when weighted by any traction of the multiplier space."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from scipy.sparse import csr_array, diags_array

from covers.concatenate import concatenate, starts
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.state import State, initial_state
from nmm.constraints.imposition import Imposition, Method, MultiplierValues
from nmm.constraints.interface import Interface, Triplets, sparse_rows
from nmm.constraints.multiplier_space import multipliers, pieces_of, traction_degree

# A condition that others imply up to this share of it is left out, and one that is this share of
# the largest: it is the rounding of none. The first is the root of what products of rows resolve.
IMPLIED, NOTHING = 1e-6, 1e-12
# More conditions than this are not looked at.
MANY = 3000


@dataclass(frozen=True)
class Multipliers(Imposition):
    """Lagrange multipliers.

    Attributes
    ----------
    basis
        (2m, k) multipliers at the points, component minor.
    found
        Their values; interfaces along one edge share them.
    """

    basis: csr_array
    found: MultiplierValues

    words: ClassVar[str] = "Lagrange multipliers"
    reads: ClassVar[frozenset[str] | None] = frozenset()
    needs_cells: ClassVar[bool] = True

    @classmethod
    def of(cls, model: Model, interface: Interface, method: Method) -> Self:
        return cls._sharing(model, [interface], method)[0]

    @classmethod
    def of_all(
        cls, model: Model, interfaces: Sequence[Interface], method: Method
    ) -> list[Imposition]:
        """See `Imposition.of_all`: those that hold the same axes share their multipliers.

        An edge of many short supports has room for no more of them than one support along it.
        """
        found: dict[int, Imposition] = {}
        axes = [tuple(one.held.tolist()) for one in interfaces]
        for held in sorted(set(axes)):  # at most three
            number = [i for i, own in enumerate(axes) if own == held]
            parts = cls._sharing(model, [interfaces[i] for i in number], method)
            found.update(zip(number, parts, strict=True))
        return [found[i] for i in range(len(interfaces))]

    @classmethod
    def _sharing(cls, model: Model, parts: Sequence[Interface], method: Method) -> list[Self]:
        """Impose conditions on interfaces by shared multipliers."""
        # A block is one cell: each of its joints has multipliers of its own.
        size = sum(one.first.weight.sum() for one in parts) if method.size is None else method.size
        each = [pieces_of(model, one) for one in parts]
        pieces = concatenate(each, {"piece": starts([len(one.start) for one in each])})
        basis = multipliers(pieces, size, traction_degree(model), parts[0].held)
        values, first, found = MultiplierValues(int(basis.shape[1])), 0, []
        for one in parts:  # supports: a handful
            last = first + 2 * len(one)
            found.append(cls(one, csr_array(basis[first:last]), values))
            first = last
        if len(found) == 1 and found[0].interface.second is not None:
            return [found[0]._independent(model)]
        return found

    def _independent(self, model: Model) -> Self:
        """Return the tie of two bodies without the conditions that others imply."""
        rows, _ = self.conditions(initial_state(model.manifold), np.zeros((len(self.interface), 2)))
        kept = independent(rows, _resistance(model))
        values = MultiplierValues(len(kept))
        return replace(self, basis=csr_array(self.basis[:, kept]), found=values)

    @property
    def shared(self) -> MultiplierValues:
        return self.found

    def matrix(self, state: State) -> Triplets:
        """None: multipliers add no stiffness."""
        none = np.zeros(0, dtype=np.int64)
        return none, none, np.zeros(0)

    def force(self, state: State, jump: Floats) -> Floats:
        """None: the multipliers are unknowns of the step."""
        return np.zeros(len(state.deformation))

    def point_forces(self, state: State, jump: Floats) -> Floats:
        return self._forces(self.found.values)

    def earlier_forces(self, state: State, jump: Floats) -> Floats:
        return self._forces(self.found.before)

    def _forces(self, values: Floats | None) -> Floats:
        if values is None:
            return np.zeros((len(self.interface), 2))
        traction = np.asarray(self.basis @ values).reshape(-1, 2)
        return np.asarray(-self.interface.area[:, None] * traction)

    def conditions(self, state: State, jump: Floats) -> tuple[csr_array, Floats]:
        area = diags_array(np.repeat(self.interface.area, 2))
        weighted = csr_array((area @ self.basis).T)
        rows = sparse_rows(*self.interface.rows(state), len(state.deformation))
        return csr_array(weighted @ rows), -(weighted @ jump.ravel())


def independent(rows: csr_array, diagonal: Floats) -> Ints:
    """Return which conditions (k, n) none of the earlier ones imply.

    Blocks that meet at a corner share conditions there. They are compared as forces on springs of
    the stiffness of the ``diagonal`` (n,).
    """
    from scipy.linalg.lapack import dpstrf

    if not 0 < rows.shape[0] <= MANY:
        return np.arange(rows.shape[0])
    soft = diags_array(np.where(diagonal > 0, 1 / np.where(diagonal > 0, diagonal, 1.0), 0.0))
    gram = np.asarray((rows @ soft @ rows.T).todense())
    size = np.sqrt(gram.diagonal())
    said = size > NOTHING * size.max()
    scale = np.where(said, 1 / np.where(said, size, 1.0), 0.0)
    _, order, rank, _ = dpstrf(scale[:, None] * gram * scale, tol=IMPLIED**2)
    return np.sort(order[:rank] - 1)


def _resistance(model: Model) -> Floats:
    """Stiffness (n,) of each unknown, motions of whole bodies held by springs of their modulus."""
    area = model.manifold.body_area[model.manifold.element_body]
    held = replace(model, density=model.modulus / area).consistent_mass
    return np.asarray(model.stiffness.diagonal() + held.diagonal())
