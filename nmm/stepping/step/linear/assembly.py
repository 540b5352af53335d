"""Makes the equations of steps, of material, inertia, supports and loads."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.moving.motion import coordinate_rounding, move
from nmm.assembly.state import State
from nmm.effects.base import Instant, defines
from nmm.effects.half_way import HalfWay
from nmm.frozen import with_parts
from nmm.integrators.base import Integrator
from nmm.integrators.damping import Damping
from nmm.model.discretisation import ModelWithEffects
from nmm.solvers.accuracy.known import gross, is_rounding
from nmm.solvers.unchecked import product
from nmm.stepping.step.anchors import anchors
from nmm.stepping.step.linear.equations import Equations, InertiaTerms, Linearisation
from nmm.stepping.step.linear.kept_sum import KeptSum

# An out-of-balance force below this share of the forces that it is the difference of is rounding;
# what iterations about matter leave of it is no more.
ROUNDING, BALANCED = 1e-12, 1e-10


class Assembly:
    """Makes the equations of steps; a matrix of the same parts is the same object."""

    def __init__(self, solved: ModelWithEffects) -> None:
        self._solved = solved
        self.forget()

    def forget(self) -> None:
        """Drop the sums of matrices."""
        self._added, self._weighted = KeptSum(), KeptSum()
        self._soft: tuple[csc_array, csc_array] | None = None

    def of(
        self,
        state: State,
        end: Instant,
        step: float | None,
        rule: Integrator,
        anchored: bool,
        matter: Linearisation | None = None,
    ) -> Equations:
        """Return the equations of a step; ``anchored``: see `nmm.stepping.step.anchors`.

        ``matter`` is None where it is linear.
        """
        model, plan = self._solved.model, self._solved.plan
        line = Linearisation.linear(model, state) if matter is None else matter
        half = self._half_way(state, step, rule)
        parts = list(plan.forces(state, end, half))
        applied = sum(parts, start=np.zeros(state.deformation.shape))
        force = applied - line.force
        among, rests = None, step is None or plan.inertia is None
        if model.manifold.dependent or not rests:
            among = np.abs(line.force)
            for part in parts:
                among = among + np.abs(part)
        if rests:
            nothing = ROUNDING if matter is None else BALANCED
            held = self._anchored(line.stiffness) if anchored else line.stiffness
            matrix, even = plan.matrix(state, held), line.symmetric
            if among is not None and (
                is_rounding(force, [*parts, line.force], nothing, matrix, state.deformation)
                or self._nothing_acts(parts, force, matrix)
            ):
                force = np.zeros_like(force)
            return Equations(state, end, step, rule, matrix, force, symmetric=even, among=among)
        even = line.symmetric
        given = Equations(
            state, end, step, rule, line.stiffness, force, symmetric=even, among=among
        )
        same = plan.steady and end.load_factor == state.load_factor
        before = applied if same else plan.force_at_start(state, end, half, parts)
        return self._in_time(given, line, matter is None, before)

    def _nothing_acts(self, parts: Sequence[Floats], force: Floats, matrix: csc_array) -> bool:
        """Whether a force (n,) is left of earlier loads: no more than places are rounded by.

        ``parts`` (n,) are those of the effects; what has no stiffness acts by itself.
        """
        effects = (effect for _, effect in self._solved.plan.named("force"))
        pairs = zip(effects, parts, strict=True)
        if any(part.any() for effect, part in pairs if not defines(effect, "matrix")):
            return False
        rounded = coordinate_rounding(self._solved.model.manifold)
        return float(np.linalg.norm(force)) < gross(matrix, rounded)

    def _half_way(self, state: State, step: float | None, rule: Integrator) -> HalfWay | None:
        """Return where dead forces act; None where they do as the step begins.

        Under a rule that carries accelerations that is where it asks for forces.
        """
        plan, model = self._solved.plan, self._solved.model
        if step is None or plan.inertia is None or not (plan.dead and rule.end_weight):
            return None
        spin = plan.inertia.through(state, step, rule.kinetic_factor)
        if spin is None:
            return None
        share = rule.end_weight if rule.carries else 0.5
        way = step * rule.kinetic_factor * state.velocity - plan.inertia.turned_less(spin, step)
        return HalfWay(model, move(model, state, share * way))

    def _in_time(
        self, static: Equations, line: Linearisation, linear: bool, before: Floats
    ) -> Equations:
        """Return the equations with inertia, over the factor of contact forces.

        ``before`` (n,) are the forces of effects at the instant of the start.
        """
        plan, rule, state, step = self._solved.plan, static.rule, static.state, static.step
        assert step is not None
        assert plan.inertia is not None
        force, gain, applied = self._weighed(static, line, plan.steady and linear, before)
        velocity, mass = rule.kinetic_factor * state.velocity, plan.inertia.mass
        rates, factor = rule.momentum(velocity, state.acceleration, step), rule.mass_factor(step)
        spin, less = plan.inertia.through(state, step, rule.kinetic_factor), None
        if spin is not None:
            less = plan.inertia.turned_less(spin, step)
            rates = rates - factor * less
        momentum = product(mass, rates)
        resisting = plan.damping(state), plan.added_mass(state)
        damping = Damping.of(*resisting, rule, velocity, state.acceleration, step)
        pushed = force + momentum
        if damping is not None:
            pushed += damping.force()
            pushed += sum(one @ rates for one in damping.masses.values())
        share = 1.0 if plan.contact is None else rule.contact_factor
        outwards = plan.inertia.force(state, static.end)
        given = mass, factor, momentum, rates, outwards, rule.end_weight, share
        terms = InertiaTerms(*given, gain, applied, damping, None, spin, less)
        if not terms.weight:  # explicit: what is elastic joins no matrix
            terms = replace(terms, elastic=plan.matrix(state, line.stiffness))
        matrix = self._matrix_in_time(state, line, terms)
        return with_parts(static, matrix=matrix, force=pushed / share, inertia=terms)

    def _weighed(
        self, static: Equations, line: Linearisation, steady: bool, before: Floats
    ) -> tuple[Floats, Floats | None, Floats | None]:
        """Return the force (n,) as the integrator weighs both ends, and what of it grows.

        See `InertiaTerms` for ``gain`` and ``applied``, which are None where forces are steady.
        """
        weight, force, state = static.rule.end_weight, static.force, static.state
        if weight == 1 and steady:
            return force, None, None
        gain: Floats | None = None
        applied: Floats | None = None
        earlier = before - line.start
        if not steady:
            gain = force - earlier
            if weight > 0.5:  # means of both ends do what effects say they do
                applied = gain + line.force - line.start - self._driven(state, static.end)
        return force if weight == 1 else weight * force + (1 - weight) * earlier, gain, applied

    def _matrix_in_time(self, state: State, line: Linearisation, terms: InertiaTerms) -> csc_array:
        """Return the matrix of a step, over the factor of contact forces."""
        weight, factor, damping = terms.weight, terms.factor, terms.damping
        heavy = [terms.mass, *(() if damping is None else damping.masses.values())]
        if not weight:
            return self._added.of([(factor / terms.contact_factor, one) for one in heavy])
        parts = [(1.0, line.stiffness), *((factor / weight, one) for one in heavy)]
        if damping is not None:
            parts += [(damping.rate / weight, one) for one in damping.dampers.values()]
        whole = self._solved.plan.matrix(state, self._added.of(parts))
        return self._weighted.of([(weight / terms.contact_factor, whole)])

    def _driven(self, state: State, end: Instant) -> Floats | float:
        """Return by how much the ground's motion in a step stretches what holds bodies (n,)."""
        supports = self._solved.plan.supports
        if supports is None:
            return 0.0
        return supports.force(state, end) - supports.force(state, Instant.of(state))

    def _anchored(self, stiffness: csc_array) -> csc_array:
        """Return a stiffness with anchors."""
        kept = self._soft
        if kept is None or kept[0] is not stiffness:
            kept = stiffness, csc_array(stiffness + anchors(self._solved.model))
            self._soft = kept
        return kept[1]
