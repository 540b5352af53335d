"""Steps of statics with contact whose load factor is found with the unknowns.

The next event on a path is sought by a handful of steps from one state: what they share is posed
once.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.contact.detection.tolerances import FURTHER
from nmm.contact.following.path_solution import PosedPath
from nmm.contact.solution.request import StepRequest
from nmm.effects.base import Instant, Span
from nmm.solvers.linear import LinearSolver
from nmm.stepping.step.contact.contact_search import ContactSearch
from nmm.stepping.step.linear.equations import Equations
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.solution.record import ContactRecord
    from nmm.controls.path_equation import PathEquation
    from nmm.stepping.step.nonlinear.effect_forces import EffectForces

# Solutions of a step along a path, each with contacts sought further.
PATH_SOLUTIONS = 4


class PathSteps:
    """Solves them: any number from one state, each along a path of its own."""

    def __init__(self, search: ContactSearch, mover: Mover, solver: LinearSolver) -> None:
        self._search, self._mover, self._solver = search, mover, solver
        self._last: _Posed | None = None

    def attempt(self, equations: Equations, path: "PathEquation", reach: float) -> Attempt:
        """Solve a step.

        Contacts are sought up to ``reach`` (m) at first. The equations are of the load factor that
        the step begins with.

        Raises
        ------
        SolveError
            Where nothing holds a part.
        """
        still = equations.end
        for _ in range(PATH_SOLUTIONS):
            posed = self._posed(equations, reach)
            solved, change = posed.contact.solved(path, self._solver)
            end = Instant(still.time, still.load_factor + change)
            result = self._mover.after(replace(equations, end=end), solved.answer.increment)
            if result.motion <= posed.reach or not solved.answer.verdict.converged:
                break
            reach = FURTHER * result.motion
        verdict = solved.answer.verdict
        if posed.effects is not None:
            memory = posed.effects.at(solved.answer.increment, None)[1]
            result = replace(result, state=replace(result.state, memory=memory))
        return result.told(verdict.converged, verdict.sentence, solved, solved.passes)

    def losing(self, equations: Equations, reach: float) -> Floats:
        """Return the energy (n,) by unknown (J) that bonds lose from where the equations begin."""
        return self._posed(equations, reach).contact.losing

    def _posed(self, equations: Equations, reach: float) -> "_Posed":
        """Return the contact of steps from a state, that of the last one where it is the same."""
        state, contact, last = equations.state, self._search.contact, self._last
        if last is not None and last.serves(state, contact.record, reach):
            return last
        contacts = self._search.candidates(state, reach, None)
        given = equations.matrix, equations.force, self._solver
        request = StepRequest(*given, time=equations.end.time)
        joints = contact.record.book.points
        effects = self._effects(equations)
        bent = None if effects is None else partial(_beyond, effects)
        posed = PosedPath.of(contact.steps, contacts, state, request, joints, bent)
        self._last = _Posed(state, contact.record, reach, posed, effects)
        return self._last

    def _effects(self, equations: Equations) -> "EffectForces | None":
        """Return the forces of effects that bend within a step from a state; None without any."""
        current, kinematics = self._mover.current, self._mover.kinematics
        if not current.plan.bent:
            return None
        from nmm.stepping.step.nonlinear.effect_forces import EffectForces

        span = Span(None, 1.0, half=False)
        return EffectForces(current, equations.state, equations.end, span, kinematics, False)


def _beyond(effects: "EffectForces", increment: Floats) -> tuple[Floats, Callable[[], csc_array]]:
    """Return what effects resist an increment (n,) with beyond their lines, and its slope."""
    part, _ = effects.at(increment, None)
    return part.force, part.make


@dataclass(frozen=True)
class _Posed:
    """Contact and bent effects as posed from a state, contact sought up to a reach (m)."""

    state: State
    record: "ContactRecord"
    reach: float
    contact: PosedPath
    effects: "EffectForces | None"

    def serves(self, state: State, record: "ContactRecord", reach: float) -> bool:
        """Whether a step from a state, of a record, may be posed by it too."""
        return self.state is state and self.record is record and reach <= self.reach
