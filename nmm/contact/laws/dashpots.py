"""Dampers beside the normal springs of contacts, in one step."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.frozen import with_parts

YIELDING = 0.02
"""Springs of a corner over E t up to which they give way, and not the block: the restitution of
square blocks of one strain is 0.005 off there, of 4 to 1 0.02, and 0.05 and 0.17 at 0.1."""


@dataclass(frozen=True)
class Dashpots(Transform):
    """``N = k gap + c d(gap)/dt`` while pressed, as a stiffer spring from a shifted gap.

    Attributes
    ----------
    stiffness
        (m,) ``c / dt`` (N/m), added to that of the springs.
    gap
        (m,) at the start of the step (m); of one that is open the damper starts at zero.
    """

    stiffness: Floats
    gap: Floats

    def apply(self, problem: StepProblem) -> StepProblem:
        return with_parts(
            problem,
            normal_stiffness=problem.normal_stiffness + self.stiffness,
            gap=problem.gap - self._lag(problem),
            compliant=problem.own_stiffness | (self.stiffness > 0),
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        return with_parts(answer, gap=answer.gap + self._lag(problem))

    def _lag(self, problem: StepProblem) -> Floats:
        stretch = problem.gap - np.maximum(self.gap, 0.0)
        return np.asarray(stretch * self.stiffness / (problem.normal_stiffness + self.stiffness))

    def force(self, end: Floats) -> Floats:
        """Force (m,) in N over a step to gaps (m,) at its end, of dampers that stay closed."""
        return np.asarray(self.stiffness * (end - np.minimum(self.gap, 0.0)))

    def loss(self, spring: Floats, end: Floats, force: tuple[Floats, Floats]) -> float:
        """Energy (J) taken in a step.

        Mean force times displacement, less what the springs have gained; ``end`` (m,) are the gaps
        and ``force`` those at both ends, ``spring`` (m,) the stiffness beside the damper.
        """
        work = (force[0] + force[1]) / 2 * (end - self.gap)
        before, after = (np.minimum(one, 0.0) for one in (self.gap, end))
        return float((work - spring * (after**2 - before**2) / 2)[self.stiffness > 0].sum())


@dataclass(frozen=True)
class RigidMass:
    """Mass of the bodies as contacts feel it.

    Attributes
    ----------
    edge_body
        (E,) body of each boundary edge.
    modes
        (n, 3 B) unknowns of rigid motions.
    compliance
        (3 B,) inverse of mass and moment of inertia; 0 for held bodies.
    """

    edge_body: Ints
    modes: csc_array
    compliance: Floats

    def dashpots(
        self, contacts: ContactPoints, share: Floats, spring: Floats, rows: csr_array, step: float
    ) -> Dashpots:
        """Return dampers of a ``share`` (m,) of critical damping beside springs (m,) in N/m."""
        critical = 2 * np.sqrt(spring * self.meeting(contacts, rows))
        return Dashpots(share * critical / step, contacts.gap)

    def meeting(self, contacts: ContactPoints, rows: csr_array) -> Floats:
        """Effective mass (m,) in kg of two rigid bodies that collide at each contact.

        ``1 / (G M^-1 G^T 1)`` with the normal rows ``G`` (m, n) in rigid motions: all contacts of
        one pair of bodies close together, as two do when faces meet.
        """
        body_a, body_b = self.edge_body[contacts.edge_a], self.edge_body[contacts.edge_b]
        along = csr_array(rows @ self.modes)
        pair = body_a * (len(self.compliance) // 3) + body_b
        _, number = np.unique(pair, return_inverse=True)
        m = len(number)
        size = number.max(initial=-1) + 1
        members = csr_array((np.ones(m), (number, np.arange(m))), shape=(size, m))
        together = csr_array(members @ along)[number]
        eased = np.maximum(along.multiply(together) @ self.compliance, 0.0)
        return np.asarray(np.divide(1.0, eased, out=np.zeros_like(eased), where=eased > 0))


def yielding_bodies(laws: ContactLaws, model: Model) -> str:
    """Warn that bodies deform in place of damped contacts; empty where they do not.

    A spring that is stiffer than what it pushes hardly moves, and its damper takes nothing: the
    energy of an impact becomes vibration of the bodies.
    """
    manifold = model.manifold
    stiff = laws.normal_penalty / (float(model.modulus.max()) * model.thickness)
    if not laws.damps or stiff <= YIELDING or manifold.n_unknowns == 3 * manifold.n_bodies:
        return ""
    return (
        f"contacts with damping or restitution have springs of {stiff:.3g} E, stiffer than bodies "
        "that have strain: these give way in place of the damper, and square blocks part at 0.75 "
        'of their speed whatever is requested; take [cover] functions = "rigid", or [contact] '
        f"normal_penalty of {YIELDING:g} or less"
    )
