"""Nonlinear internal forces within a step: of materials and of effects."""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.moving.kinematics import Kinematics
from nmm.assembly.state import State
from nmm.effects.base import Instant, Span
from nmm.integrators.base import Integrator
from nmm.model.discretisation import CurrentDiscretisation
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.assembly import BALANCED
from nmm.stepping.step.nonlinear.effect_forces import EffectForces
from nmm.stepping.step.nonlinear.iterate import Iterate
from nmm.stepping.step.nonlinear.matter_forces import MatterForces

# Out-of-balance force of a step whose energy is kept: what it leaves adds up over steps.
CONSERVED = 1e-13


class InternalForces:
    """Internal forces of one step that starts at a state.

    Parameters
    ----------
    kinematics
        How bodies move.
    symmetric
        Whether tangents are to be.

    Attributes
    ----------
    start
        (n,) internal force of matter at the start of the step.
    elastic
        (n, n) elastic stiffness of matter.
    symmetric
        Whether tangents are.
    size
        Diagonal of the domain (m): matter that moves as far holds by a trace of stiffness.
    flows, softens
        Whether matter may flow, and lose strength as it does.
    searches
        Whether iterations are shortened where forces overshoot: not under finite strain, whose
        tangents foresee how slender bodies stretch as they turn.
    tolerance
        Out-of-balance force, as a share of the forces, at which an iterate is the solution.
    """

    def __init__(
        self,
        current: CurrentDiscretisation,
        state: State,
        end: Instant,
        step: float | None,
        rule: Integrator,
        kinematics: Kinematics,
        symmetric: bool,
        clock: Clock,
    ) -> None:
        self._clock, matter = clock, current.model.matter
        conserves = step is not None and rule.conserves
        weight = 1.0 if step is None else rule.end_weight
        span = Span(step, weight, half=step is not None and not rule.carries)
        even = all(one.symmetric for one in current.plan.bent.values())
        kept = matter is None or (matter.symmetric and not conserves)
        self.symmetric = symmetric or (kept and even)
        self.flows = matter is not None and matter.flows
        self.softens = matter is not None and matter.softens
        self.searches = matter is None or matter.flows
        self.tolerance = CONSERVED if conserves else BALANCED
        swelling = current.plan.swelling(state, end) if self.flows else None
        given = current.model, state, step, weight, conserves
        self._matter = MatterForces(*given, self.symmetric, swelling)
        symmetrised = self.symmetric and not even
        self._effects = EffectForces(current, state, end, span, kinematics, symmetrised)
        self.elastic, self.start = self._matter.elastic, self._matter.start
        self.scale = current.model.force_scale
        self.size = current.model.manifold.elements.extent
        self._current = current

    def stiffness(self, at: Iterate) -> csc_array:
        """Return the tangent (n, n): that of matter itself where effects add nothing."""
        parts = [at.matter.stiffness, at.effects.stiffness]
        if not parts[1].nnz:
            return parts[0]
        return self._current.plan.total("internal forces", parts, lambda: parts[0] + parts[1])

    def at(
        self, increment: Floats, before: Iterate | None = None, after: State | None = None
    ) -> Iterate:
        """Return the internal forces at an increment (n,) of the step.

        ``before`` is the iterate from which it was found, ``after`` the state that it leads to
        where that is known.

        Raises
        ------
        SolveError
            Where an effect has none.
        """
        with self._clock.phase("material"):
            last = None if before is None else before.increment
            matter, history = self._matter.at(increment, last)
        effects, memory = self._effects.at(increment, after)
        return Iterate(increment, matter, effects, history, memory)

    def imbalance(
        self,
        now: Iterate,
        then: Iterate,
        scale: Floats,
        applied: Floats,
        touching: Floats | None = None,
    ) -> float:
        """Return what the tangents at ``now`` missed at ``then``, as a share of the forces.

        Effects are held to their own forces: those that hold supports may be far larger.
        ``scale`` (n,) are factors by which forces compare, ``applied`` (n,) those of the step,
        ``touching`` (n,) what contact missed of its own.
        """
        way, sizes = then.increment - now.increment, (scale, applied)
        matter = self._matter.imbalance(now.matter, then.matter, way, *sizes, touching)
        pulls = now.effects, then.effects
        effects = self._effects.imbalance(*pulls, way, then.increment, *sizes)
        return float(np.max((matter, effects)))  # what is no number stays none
