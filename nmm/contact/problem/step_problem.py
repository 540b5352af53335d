"""One step's contact problem, free of geometry, and its answer.

Signs: gap positive open, normal force positive in tension, shear force along the tangent row. With
``N`` and ``T`` the answer's forces the step is in balance when

    matrix @ d + normal_rows.T @ N + tangent_rows.T @ T = force.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints, same
from integration.sparse import csc_array, csr_array
from nmm.contact.problem.contact_state import ContactState
from nmm.contact.problem.residual_kernel import weighted
from nmm.contact.problem.row_products import Compressed, along, compressed, pushed, stretched
from nmm.frozen import MadeOnce
from nmm.interfaces.limits import Limits as Limits
from nmm.solvers.accuracy.known import known_load

OPEN, STICK, SLIDE, BONDED, BROKEN = ContactState
STIFFNESSES = ("normal_stiffness", "shear_stiffness")
COLUMNS = ("gap", "slip", *STIFFNESSES, "state", "normal_force", "shear_force")
"""What a problem has of each contact beside its rows, limits and whose stiffness it is."""


@dataclass(frozen=True)
class StepProblem:
    """Balance of one step with ``n`` unknowns and ``m`` contact points.

    Attributes
    ----------
    matrix
        (n, n) symmetric, all that is constant in the step: elasticity, inertia, supports.
    force
        (n,) right-hand side.
    normal_rows, tangent_rows
        (m, n); the end gap is ``gap + normal_rows @ d``, the end slip ``slip + tangent_rows @ d``.
    gap
        (m,) gap at the start (m).
    slip
        (m,) elastic stretch of the shear spring at the start (m): ``StepAnswer.slip`` of the step
        before, 0 for a contact that is new.
    normal_stiffness, shear_stiffness
        (m,) N/m, > 0: a penalty, or the joint's own.
    limits
        Largest forces.
    state
        (m,) states at the start (`ContactState`).
    normal_force, shear_force
        (m,) forces of the step before (N), where the search for the new ones starts.
    compliant
        (m,) true where the stiffness is the joint's own: a law that every enforcement honours,
        ``N = normal_stiffness * gap`` up to the limit. False (or None for all) where it is a
        numerical penalty, which the exact enforcements replace by ``gap >= 0``.
    start
        (n,) unknowns near the answer, where the search for it starts; None where none are known.
        No part of the problem: the answer is the same wherever the search starts.
    among
        (n,) size of the forces that ``force`` is the sum of, where these cancel and functions
        depend on one another; None elsewhere.
    """

    matrix: csc_array
    force: Floats
    normal_rows: csr_array
    tangent_rows: csr_array
    gap: Floats
    slip: Floats
    normal_stiffness: Floats
    shear_stiffness: Floats
    limits: Limits
    state: Ints
    normal_force: Floats
    shear_force: Floats
    compliant: Bools | None = None
    start: Floats | None = None
    among: Floats | None = None

    def least(self, weight: Floats) -> float:
        """Size of forces, weighted, below which none is looked at: see `known_load`."""
        return 0.0 if self.among is None else known_load(weight * self.among)

    @property
    def n_contacts(self) -> int:
        """Number of contact points."""
        return len(self.gap)

    @property
    def own_stiffness(self) -> Bools:
        """(m,) ``compliant`` with None written out."""
        if self.compliant is None:
            return np.zeros(self.n_contacts, dtype=bool)
        return self.compliant

    def columns_of(self, contacts: Ints | Bools) -> dict[str, Any]:
        """Return all that a problem has of some contacts but their rows, by name."""
        found: dict[str, Any] = {name: getattr(self, name)[contacts] for name in COLUMNS}
        found["limits"] = Limits(*(bound[contacts] for bound in vars(self.limits).values()))
        return found | {"compliant": None if self.compliant is None else self.compliant[contacts]}

    @property
    def rows(self) -> tuple[csr_array, csr_array]:
        """Normal and tangent rows."""
        return self.normal_rows, self.tangent_rows

    @MadeOnce
    def compressed_rows(self) -> tuple[Compressed, Compressed]:
        """Normal and tangent rows as compiled code takes them."""
        return compressed(self.normal_rows), compressed(self.tangent_rows)

    @MadeOnce
    def weight(self) -> Floats:
        """(n,) weights of out-of-balance forces: inverse roots of the diagonal with all springs.

        Forces on translations, rotations and strains become comparable: ``|weight * r|`` is
        invariant under a change of the units of single unknowns.
        """
        return self.weight_with(self.stiffness)

    @MadeOnce
    def stiffness(self) -> Floats:
        """(2, m) normal and shear stiffness (N/m)."""
        return np.array((self.normal_stiffness, self.shear_stiffness))

    def weight_with(self, stiffness: Floats) -> Floats:
        """The same with another stiffness (2, m) of the springs."""
        return np.asarray(weighted(compressed(self.matrix), *self.compressed_rows, stiffness))

    @MadeOnce
    def paired(self) -> bool:
        """Whether normal and tangent rows hold the same unknowns, entry by entry."""
        normal, tangent = self.normal_rows, self.tangent_rows
        return same(normal.indptr, tangent.indptr) and same(normal.indices, tangent.indices)

    def gaps(self, increment: Floats) -> Floats:
        """(m,) gaps at the end of the step."""
        return self.gap + along(self.normal_rows, increment)

    def slips(self, increment: Floats) -> Floats:
        """(m,) total slips at the end of the step, elastic and sliding part."""
        return self.slip + along(self.tangent_rows, increment)

    def jumps(self, increment: Floats) -> Floats:
        """(2, m) the same gaps and slips."""
        return np.array((self.gap, self.slip)) + stretched(*self.rows, increment)

    def pushed(self, normal: Floats, shear: Floats) -> Floats:
        """(n,) what contact forces (N) do on the unknowns."""
        return pushed(*self.rows, normal, shear)

    def out_of_balance(self, increment: Floats, normal: Floats, shear: Floats) -> Floats:
        """(n,) ``matrix @ d + normal_rows.T @ N + tangent_rows.T @ T - force``."""
        inner = self.matrix @ increment - self.force
        return np.asarray(inner + self.normal_rows.T @ normal + self.tangent_rows.T @ shear)


@dataclass(frozen=True)
class Verdict:
    """How a solution ended, as a sentence for the log.

    Attributes
    ----------
    converged
        True only when forces are admissible, gaps and slips fit them, and the step is in balance,
        each within the enforcement's tolerance.
    code
        "converged", "cycle", "passes", "singular" or "stalled".
    sentence
        Passes, contacts and remedy in words; contacts by their row in the problem.
    contacts
        Rows of the contacts at fault, worst first; empty when converged.
    """

    converged: bool
    code: str
    sentence: str
    contacts: tuple[int, ...] = ()


@dataclass(frozen=True)
class StepAnswer:
    """Solution of a `StepProblem`; not to be stored unless ``verdict.converged``.

    Attributes
    ----------
    increment
        (n,) unknowns of the step.
    normal_force, shear_force
        (m,) forces at the end (N).
    gap
        (m,) gaps at the end (m).
    slip
        (m,) elastic part of the slip (m), to be carried to the next step; 0 for open contacts.
    state
        (m,) states at the end. A bonded contact that stays below its limits is BONDED, one that
        reached its pull is BROKEN, one that reached its shear is SLIDE.
    passes
        Linear systems solved with a new contact state or force.
    residual
        Out-of-balance force relative to the largest of load, contact and internal force, in
        the norm weighted with the diagonal of matrix and contact springs.
    verdict
        How it ended.
    factorisations
        Matrices factorised; fewer than passes where a factor was kept.
    solver
        Name of the linear solver.
    stored
        Energy (J) at the end in the enforcement's own potential, besides springs of contacts.
    multipliers
        (k,) of the conditions that were eliminated; None without any.
    """

    increment: Floats
    normal_force: Floats
    shear_force: Floats
    gap: Floats
    slip: Floats
    state: Ints
    passes: int
    residual: float
    verdict: Verdict
    factorisations: int = 0
    solver: str = ""
    stored: float = 0.0
    multipliers: Floats | None = None
