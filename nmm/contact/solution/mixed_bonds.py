"""Softening bonds in a mixed form, the same for whole, softening and broken bonds.

Let ``t`` be the average traction and ``k`` the penalty on a face. The form of Lorentz (2008) has
the crack's own width ``w`` beside the jump ``u`` of the displacements,

    E = Pi(w) + t (u - w) + k (u - w)^2 / 2,

and ``w`` is what its law gives at every point: that of a spring ``k`` in series with the crack,
stretched by ``g = u + t / k``. So with ``Phi`` the energy of both

    E = Phi(g) - t^2 / (2 k):

the law and its spring act on ``g`` in place of ``u``, and the rest is linear. A whole bond has
Nitsche's terms; one that softens does so where the traction meets the criterion, without a jump and
in the midst of a step; a broken one that is pressed has Nitsche's terms of contact. The penalty is
no stiffness: results depend on it only within the error of the discretisation.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import csc_array, csr_array, diags_array
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.contact.bonds.consistent_bonds import ConsistentBonds
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.solution.record import ContactSolution
from nmm.contact.solution.request import StepRequest


@dataclass(frozen=True)
class AverageStress:
    """Average traction on springs (k,) in one direction at the start of a step.

    Attributes
    ----------
    compliance
        Of the springs (m/N).
    force
        (k,) stress times area (N).
    rows
        (k, n) the same by unknowns.
    """

    compliance: Floats
    force: Floats
    rows: csr_array

    def stretch(self, increment: Floats | None = None) -> Floats:
        """Return the stretch (k,) of springs beyond the jump after an increment (m)."""
        more = 0.0 if increment is None else self.rows @ increment
        return np.asarray(self.compliance * (self.force + more))

    def added_to(self, rows: csr_array, index: Ints) -> csr_array:
        """Return the rows (m, n) of jumps with those of the stretch at some of them."""
        k = len(index)
        place = csr_array((self.compliance, (index, np.arange(k))), shape=(rows.shape[0], k))
        return csr_array(rows + place @ self.rows)

    @property
    def matrix(self) -> csc_array:
        """Part of the springs' matrix (n, n) that the mixed form does not have."""
        return csc_array(self.rows.T @ (diags_array(self.compliance) @ self.rows))

    @property
    def push(self) -> Floats:
        """Part of their forces on the unknowns (n,) at the start that it does not have."""
        return np.asarray(self.rows.T @ (self.compliance * self.force))

    @property
    def energy(self) -> float:
        """Part of their energy at the start (J) that it does not have."""
        return float(self.compliance @ self.force**2) / 2


@dataclass(frozen=True)
class MixedBonds:
    """Contacts of a step whose law acts in the mixed form.

    Attributes
    ----------
    index
        (k,) the contacts, rising.
    normal, tangent
        The two directions.
    """

    index: Ints
    normal: AverageStress
    tangent: AverageStress

    @classmethod
    def of(
        cls,
        bonds: ConsistentBonds,
        laws: ContactLaws,
        contacts: ContactPoints,
        state: State,
        stresses: Sequence[StressAt],
        time: float | None,
    ) -> "MixedBonds | None":
        """Take them from the contacts of a step that starts at ``state``; None without any.

        ``stresses`` are added by effects, see `ConsistentBonds.averages`.
        """
        index = np.flatnonzero(bonds.mixed_among(contacts))
        if not len(index):
            return None
        some = contacts.take(index)
        averages = bonds.averages(some, state, stresses, time)
        normal, tangent = (
            AverageStress(1 / spring[index], *average)
            for spring, average in zip(laws.springs(contacts)[:2], averages, strict=True)
        )
        return cls(index, normal, tangent)

    def stretched(self, contacts: ContactPoints) -> ContactPoints:
        """Return the contacts with the stretch of their springs as gap and slip."""
        gap, slip = contacts.gap.copy(), contacts.slip.copy()
        gap[self.index] += self.normal.stretch()
        slip[self.index] += self.tangent.stretch()
        return replace(contacts, gap=gap, slip=slip)

    def posed(
        self, contacts: ContactPoints, rows: ContactRows, request: StepRequest
    ) -> tuple[ContactPoints, ContactRows, StepRequest]:
        """Return the problem of a step with these springs in place of those of the jumps."""
        normal = self.normal.added_to(rows.normal, self.index)
        tangent = self.tangent.added_to(rows.tangent, self.index)
        force = request.force + self.normal.push + self.tangent.push
        matrix = csc_array(request.matrix - self._matrix)
        return (
            self.stretched(contacts),
            replace(rows, normal=normal, tangent=tangent),
            replace(request, matrix=matrix, force=force),
        )

    def told(self, solved: ContactSolution, contacts: ContactPoints) -> ContactSolution:
        """Return a solution with the jumps as gap and slip; ``contacts`` are those of the step."""
        answer, index = solved.answer, self.index
        gap, slip = answer.gap.copy(), answer.slip.copy()
        gap[index] -= self.normal.stretch(answer.increment)
        slip[index] -= self.tangent.stretch(answer.increment)
        points = replace(solved.contacts, gap=contacts.gap, slip=contacts.slip)
        return replace(solved, contacts=points, answer=replace(answer, gap=gap, slip=slip))

    @cached_property
    def _matrix(self) -> csc_array:
        return csc_array(self.normal.matrix + self.tangent.matrix)

    @property
    def energy(self) -> float:
        """Energy of springs beyond that of the mixed form at the start (J)."""
        return self.normal.energy + self.tangent.energy
