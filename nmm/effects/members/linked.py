"""The base of effects of members: axial forces along links between points, with memory."""

from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.kept import forget_kept, kept, kept_of_object
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.given.resistance import Resistance
from nmm.effects.members.chains.chains import ChainAnswer
from nmm.effects.members.kept_matrix import LIKE, KeptMatrix
from nmm.effects.members.member_set import AXIAL, BOND, SLIP, WIDTH, Members
from nmm.effects.members.reports import largest, segments
from nmm.errors import SolveError
from nmm.quantity import MemberSegments

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.members.fibres import Fibres

    Pair = tuple[Floats, Floats]
    Ends = tuple[Pair, Pair]


class Linked(Effect):
    """Members whose axial forces follow from the elongation between their ends."""

    on_paths = True

    def __init__(self, setup: Setup, members: Members) -> None:
        self.members = members
        self.external = members.links.grounded
        self._model = setup.model
        self._offset = np.zeros(len(members.links))
        self._kept = KeptMatrix(setup)

    @property
    def nonlinear(self) -> bool:
        return not (self.members.links.small and self.members.chains.linear)

    @property
    def limited(self) -> bool:
        """See `Effect.limited`: yielding, sliding bond, and slack cables."""
        return not self.members.chains.linear

    def force(self, state: State, end: Instant) -> Floats:
        return self._force(state)

    @kept_of_object
    def _force(self, state: State) -> Floats:
        links = self.members.links
        return links.pull(state, links.lines(state), self._answer(state).axial.force)

    def applied_forces(self, state: State) -> AppliedForces:
        links = self.members.links
        pull = self._answer(state).axial.force[:, None] * links.lines(state).along
        return joined([links.first.pushed(pull), links.second.pushed(-pull)])

    def matrix(self, state: State) -> csc_array:
        """See `Effect.matrix`; the same object while its inputs hardly change (`KeptMatrix`)."""
        return self._stiffness(state)

    @kept_of_object
    def _stiffness(self, state: State) -> csc_array:
        members, found = self.members, self._answer(state)
        if len(found.broken):
            raise SolveError(self._lost(found))
        links, force = members.links, found.axial.force
        lines = links.lines(state)
        axial = found.axial.tangent
        made_of = *self._kept.parts(links, state, lines, force, axial), found.bond.tangent

        def made() -> csc_array:
            return links.stiffness(state, lines, members.chains.tangent(found), force)

        return self._kept.of(made_of, LIKE if self.nonlinear else 0.0, made)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        members, links, weight = self.members, self.members.links, span.weight
        start = self._answer(before)
        end = self._answer(after) if members.chains.linear else self._answered(after)
        if len(end.broken):
            raise SolveError(self._lost(end))
        force = weight * end.axial.force
        if span.half:
            lines = links.mean_lines(before, after)
            force = force + (1 - weight) * start.axial.force
            pull = links.pull(before, lines, force)
            pull += links.moment_correction(self._model, before, after, lines, force)
        else:
            lines = links.lines(after)
            pull = links.pull(before, lines, force)
            if weight < 1:
                earlier = (1 - weight) * start.axial.force
                pull += links.pull(before, links.lines(before), earlier)

        def stiffness() -> csc_array:
            tangent = weight * members.chains.tangent(end)
            return links.stiffness(before, lines, tangent, force)

        return StepForce(pull, stiffness, self._remembered(before, end))

    def resistance(self, state: State) -> Resistance:
        """See `Effect.resistance`: axial forces, and the bond that brings them in."""
        members, found = self.members, self._answer(state)
        links, chains = members.links, members.chains
        lines, memory = links.lines(state), found.axial.memory
        way = links.stretch(state) - self._offset + chains.layout.opening @ found.slip
        across = links.rows(state, lines.normal * (lines.across > 0)[:, None])
        return Resistance(
            links.rows(state, lines.along),
            across,
            *chains.axial.limits(memory),
            found.axial.force,
            chains.axial.slack(way, memory),
            csr_array(chains.layout.opening.T),
            chains.bond.limits(found.bond.memory)[1],
        )

    def energy(self, state: State) -> float:
        chains, found = self.members.chains, self._answer(state)
        return chains.axial.energy(found.axial.force) + chains.bond.energy(found.bond.force)

    def loss(self, before: State, after: State) -> float:
        """See `Effect.loss`: by yielding and by sliding bond."""
        return sum(fibres.loss(*ends) for fibres, ends in self._ends(before, after))

    def missed_loss(self, before: State, after: State) -> float:
        """See `Effect.missed_loss`: where flow begins within the step."""
        if self.members.chains.elastic and not len(self.members.slip_owner):
            return 0.0
        return sum(fibres.missed_loss(*ends) for fibres, ends in self._ends(before, after))

    def _ends(self, before: State, after: State) -> "list[tuple[Fibres, Ends]]":
        """Return links and slips, each with forces and memories at both ends of a step."""
        chains = self.members.chains
        ends = [self._answer(one) for one in (before, after)]
        pairs = ((chains.axial, [e.axial for e in ends]), (chains.bond, [e.bond for e in ends]))
        return [
            (fibres, ((one.force, two.force), (one.memory, two.memory)))
            for fibres, (one, two) in pairs
        ]

    def first_work(self, before: State, after: State) -> float:
        """See `Effect.first_work`: half of the work of the forces at the start."""
        links, force = self.members.links, self._answer(before).axial.force
        way = links.stretch(after) - links.stretch(before)
        return float(force @ way) / 2

    def history(self, state: State) -> dict[str, float]:
        """Return the largest axial force (N) and the largest slip (m) of each member."""
        return largest(self.members, self._answer(state))

    def segments(self, state: State) -> MemberSegments:
        return segments(self.members, state, self._answer(state))

    def carried(self) -> tuple[Floats]:
        """See `Effect.carried`: elongations at which links were installed."""
        return (self._offset,)

    def carry(self, carried: tuple[Floats]) -> None:
        self._offset = np.array(carried[0])
        self.forget()

    def join_run(self, state: State) -> None:
        """See `Effect.join_run`: members are free of stretch in this state, but for prestress."""
        self._offset = self.members.links.stretch(state)
        self.forget()

    def forget(self) -> None:
        forget_kept(self)
        self._kept.forget()

    def follow(self, change: "Change") -> Self:
        """Return the members on the new model; new ones are installed in the present state."""
        new = type(self).from_setup(change.setup)
        known = self._offset_on(new.members, change)
        now = new.members.links.stretch(change.state)
        new._offset = np.where(np.isnan(known), now, known)
        return new

    def _offset_on(self, members: Members, change: "Change") -> Floats:
        """Elongation (m,) at which links of the new model were installed; nan for new ones (m)."""
        return np.asarray(members.memory(self._offsets(), np.nan)[members.of_link, 0])

    def _offsets(self) -> dict[str, Floats]:
        """Return the elongation at installation at each place of memory, by member."""
        whole = np.zeros((sum(self.members.places), WIDTH))
        whole[self.members.of_link, 0] = self._offset
        return self.members.remembered(whole)

    def _told_by(self, state: State) -> tuple[int, ...]:
        """Tell answers apart: of linear laws by the place, as the end of a step starts the next."""
        if self.members.chains.linear:
            return id(state.frames), id(state.deformation)
        return (id(state),)

    @kept(_told_by, most=3)
    def _answer(self, state: State) -> ChainAnswer:
        """Return the answer at the start of a step, or at one of two of its iterates."""
        return self._answered(state)

    def _answered(self, state: State) -> ChainAnswer:
        members = self.members
        memory = members.memory(state.memory)
        stretch = members.links.stretch(state) - self._offset
        known = memory[members.of_link, AXIAL], memory[members.of_slip, BOND]
        return members.chains.answer(stretch, memory[members.of_slip, SLIP], known)

    def _remembered(self, before: State, end: ChainAnswer) -> dict[str, Floats]:
        members = self.members
        if members.chains.elastic and not len(end.slip):
            return {}
        whole = members.memory(before.memory)
        whole[members.of_link, AXIAL] = end.axial.memory
        whole[members.of_slip, SLIP] = end.slip
        whole[members.of_slip, BOND] = end.bond.memory
        return members.remembered(whole)

    def _lost(self, end: ChainAnswer) -> str:
        names = dict.fromkeys(self.members.names[at] for at in self.members.slip_owner[end.broken])
        return (
            f"{self.name} {', '.join(names)}: no stable slips of its bond under this motion of its "
            "ends, as where it loses force faster than the bar unloads (snap-back)"
        )
