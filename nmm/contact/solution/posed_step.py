"""The contact problem of a step under the present history, and the transforms applied to it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from integration.contraction import some
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.dashpots import Dashpots, RigidMass
from nmm.contact.laws.history_iteration import HistoryIteration, slid_under_load
from nmm.contact.laws.late_cohesion import LateCohesion
from nmm.contact.laws.time_weighting import RaisedFaces, TimeWeighting, end_shares
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.points.half_way.mean_motion import MeanMotion
from nmm.contact.problem.row_products import along
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.contact.solution.request import StepRequest
from nmm.frozen import with_parts


@dataclass(frozen=True)
class PosedStep:
    """The contact problem of a step, and the transforms applied before it is solved.

    Attributes
    ----------
    problem
        Springs, limits and rows of the contact points.
    transforms
        In the order of their application.
    springs
        The one of them that weights springs over the time of the step; None without.
    dashpots
        Dampers among them; None without.
    weight
        (m,) weight of the end of the step in the stretch of each spring.
    whole
        What the mean motions of bodies add to the rows; None where rows are all.
    """

    problem: StepProblem
    transforms: list[Transform]
    springs: TimeWeighting | None
    dashpots: Dashpots | None
    weight: Floats
    whole: MeanMotion | None = None

    def slid(self, answer: StepAnswer, softening: Bools, before: Floats) -> Floats:
        """Return how far (m,) contacts slid under load, see `slid_under_load`."""
        problem = self.problem
        if self.whole is not None:
            problem = with_parts(problem, slip=problem.slip + self.whole.opened[1])
        return slid_under_load(problem, answer, softening, before)

    def missed(self, answer: StepAnswer) -> Floats | None:
        """See `ContactSolution.missed`."""
        if self.springs is None:
            return None
        damper = 0.0 if self.dashpots is None else self.dashpots.force(answer.gap)
        return self.springs.missed(answer, self.problem, damper)

    def loss(self, contacts: ContactPoints, answer: StepAnswer) -> float:
        """Energy (J) that dampers took in the step."""
        if self.dashpots is None:
            return 0.0
        end = answer.normal_force
        start = np.where(self.weight < 1, end, contacts.normal_force)
        return self.dashpots.loss(self.problem.normal_stiffness, answer.gap, (start, end))


@dataclass(frozen=True)
class Posing:
    """What all contact problems of a run have in common.

    Attributes
    ----------
    laws
        Interface laws.
    softness
        (n,) Young's moduli of the edges over the largest (-): between two soft bodies the modulus
        of the stiffest one is no measure.
    mass
        Of the bodies, for dampers.
    exact
        Whether contacts whose law has no stiffness are rigid, not penalty springs.
    """

    laws: ContactLaws
    softness: Floats
    mass: RigidMass
    exact: bool

    def posed(
        self,
        iteration: HistoryIteration,
        rows: ContactRows,
        request: StepRequest,
        more: Sequence[Transform],
        start: Floats | None,
    ) -> PosedStep:
        """Return the problem under the present history, and its transforms; ``more`` come last."""
        problem = self._problem(iteration, rows, request, start)
        response, contacts = iteration.response, iteration.start
        weight = end_shares(request.weight, self.exact, problem.own_stiffness, iteration.softening)
        rises = iteration.before.rise, response.rise
        springs = _weighted(weight, rises, problem, contacts, request.foreseen)
        late = None if request.step is None else LateCohesion.of(problem.limits, contacts)
        dashpots = self._dashpots(contacts, problem, request.step)
        raised = RaisedFaces(response.rise) if some(response.rise) else None
        transforms = [late, springs, dashpots, raised, rows.whole, iteration.asymmetric]
        given = [one for one in transforms if one is not None]
        return PosedStep(problem, [*given, *more], springs, dashpots, weight, rows.whole)

    def _problem(
        self,
        iteration: HistoryIteration,
        rows: ContactRows,
        request: StepRequest,
        start: Floats | None,
    ) -> StepProblem:
        contacts, (normal, shear, own) = iteration.start, iteration.springs
        if request.step is not None and self.laws.damps:
            own = own | self.laws.damped(contacts)
        if self.exact:
            # Exact enforcements take stiffnesses as a measure of how stiff the bodies are there.
            one, other = self.softness[contacts.edge_a], self.softness[contacts.edge_b]
            share = np.where(own, 1.0, np.minimum(one, other))
            normal, shear = share * normal, share * shear
        gap, slip = moved_jumps(contacts, rows, request)
        return StepProblem(
            matrix=request.matrix,
            force=request.force,
            normal_rows=rows.normal,
            tangent_rows=rows.tangent,
            gap=gap,
            slip=slip + contacts.slid,
            normal_stiffness=normal,
            shear_stiffness=shear,
            limits=iteration.response.limits,
            state=contacts.state,
            normal_force=contacts.normal_force,
            shear_force=contacts.shear_force,
            compliant=own,
            start=start,
            among=request.among,
        )

    def _dashpots(
        self, contacts: ContactPoints, problem: StepProblem, step: float | None
    ) -> Dashpots | None:
        """Return dampers of a step in time; None without."""
        if step is None or not self.laws.damps:
            return None
        damping, stiffness = self.laws.damping(contacts), problem.normal_stiffness
        return self.mass.dashpots(contacts, damping, stiffness, problem.normal_rows, step)


def moved_jumps(
    contacts: ContactPoints, rows: ContactRows, request: StepRequest
) -> tuple[Floats, Floats]:
    """Return gaps and slips (m,) where driven ground has carried bodies (m)."""
    gap, slip, way = contacts.gap, contacts.slip, request.carried
    if way is None:
        return gap, slip
    return gap + along(rows.normal, way), slip + along(rows.tangent, way)


def _weighted(
    weight: Floats,
    rises: tuple[Floats, Floats],
    problem: StepProblem,
    contacts: ContactPoints,
    foreseen: Floats | None,
) -> TimeWeighting | None:
    """Return the time weighting of springs; None where they act as at the end of the step.

    ``rises`` (m,) are the lifts of the faces at both ends (m).
    """
    if not some(weight < 1):
        return None
    if foreseen is None:
        return TimeWeighting(weight, rises[0], contacts.bonded)
    from nmm.contact.laws.conserving_springs import ConservingSprings

    given = weight, rises[0], contacts.bonded
    return ConservingSprings(*given, problem.gaps(foreseen), rises[1])
