"""What keeps momentum and angular momentum where bodies touch: midpoints, and what is owed."""

from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross
from nmm.assembly.model import Model
from nmm.assembly.moving.momenta import rigid_masses
from nmm.assembly.moving.motion import middle
from nmm.assembly.moving.moved_bodies import entries
from nmm.assembly.state import State
from nmm.contact.detection.tolerances import (
    MIDPOINT_GAPS,
    MIDPOINT_GAPS_OF_MESHES,
    MIDPOINT_STRAIN,
    MIDPOINT_WAYS,
    MIDPOINT_WAYS_OF_MESHES,
)
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.half_way.mean_motion import MeanMotion
from nmm.contact.problem.step_problem import StepAnswer
from nmm.contact.solution.record import ContactSolution
from nmm.contact.solution.turning import Pressing, foreseen, matters, owed
from nmm.solvers.unchecked import product


class Momentum:
    """Inertia of the bodies as contact needs it.

    Parameters
    ----------
    model, sides
        Manifold with its masses, and its boundary edges.
    held
        (B,) bodies that a support holds as a whole.
    from_start
        Whether forces stay where they act at the start of a step.
    """

    def __init__(self, model: Model, sides: Sides, held: Bools, from_start: bool) -> None:
        self._model, self._sides = model, sides
        self._held, self._from_start = held, from_start

    def midpoint(
        self, solved: ContactSolution, before: State, after: State, used: State | None
    ) -> State | None:
        """Where the forces of a step should have acted; None if ``used`` (None: before) will do.

        Gaps are off by about a rotation times a motion, and at the start of a step, whose rows turn
        bodies as if they were not strained, times that; it matters beside the penetrations.
        """
        if self._from_start:
            return None
        turn, way = _motion(before, after)
        turn, way = turn / 2, way / 2
        turned, moved = turn, way
        if used is not None:
            turned, moved = _motion(used, middle(before, after))
        else:
            moved = moved + MIDPOINT_STRAIN * self._strained(before)
        motions = turn, way + turn * self._across, turned, moved
        edge_a, edge_b, force, gap = _pressing(solved.contacts, solved.answer)
        share, least = MIDPOINT_GAPS, MIDPOINT_WAYS
        if not self._model.of_blocks:
            share, least = MIDPOINT_GAPS_OF_MESHES, MIDPOINT_WAYS_OF_MESHES
            gap = np.maximum(np.abs(gap), least * way.max(initial=0.0))
        pressing = edge_a, edge_b, force, gap
        if matters(pressing, self._bodies, motions, share, least) or _lags(solved, gap, share):
            return middle(before, after)
        return None

    def foreseen(
        self, contacts: ContactPoints, flight: Floats, acceleration: Floats, half: float
    ) -> Floats | None:
        """Return the way (n,) of a step that turns bodies so far that forces should act half way.

        None of one that does not. ``flight`` (n,) is a step's way at the velocity now, ``half``
        half the square of the step (s2).
        """
        if self._from_start:
            return None
        turns, way = foreseen(
            # That of the last step, had its acceleration not changed.
            (flight, flight - half * acceleration),
            entries(self._model.rigid_projection),
            _pressing(contacts, contacts),
            (self._bodies, self._across),
            MIDPOINT_GAPS,
            MIDPOINT_WAYS,
        )
        return way if turns else None

    def kept(
        self, solved: ContactSolution, before: State, after: State, step: float, balance: Floats
    ) -> Floats:
        """Velocity (n,) that a step lacks of what keeps momentum and angular momentum.

        The moments that contact forces owe, and the sum of what is left of the forces ``balance``
        (n,), load less inner forces, when contact has taken its own. A force of the step, on two
        bodies at one point half way, changes the angular momentum of both together by nothing, as
        the place of a centre changes by the mean of its velocities. What the rows have made of the
        forces differs by the turn and the strain of the bodies in the step.
        """
        assert solved.rows is not None
        contacts, answer, half = solved.contacts, solved.answer, middle(before, after)
        gain, edges = step * self._compliance_of_all, self._model.manifold.boundary
        if solved.rows.whole is not None:
            left = self._left(solved, solved.rows.whole, (before, after), balance)
            return product(self._model.manifold.rigid_modes, gain * left)
        return owed(
            balance,
            solved.push,
            entries(self._model.manifold.rigid_modes),
            (self._sides.places(half.frames, half.deformation), edges.next, edges.body),
            half.frames.centre,
            (
                *(contacts.edge_a, contacts.edge_b, contacts.parameter_a, contacts.parameter_b),
                contacts.key,
            ),
            (solved.rows.direction, answer.normal_force, answer.shear_force),
            gain,
        )

    def _left(
        self, solved: ContactSolution, whole: MeanMotion, ends: tuple[State, State], rest: Floats
    ) -> Floats:
        """Forces and moments (3 B,) that bodies lack beside what their rows have made of them.

        ``rest`` (n,) is what is left of the forces. Through mean motions those of the last solution
        have acted, about centres half way as that foresaw them.
        """
        before, after = (state.frames for state in ends)
        modes, every = self._model.manifold.rigid_modes.T, np.arange(len(before.angle))
        left, acted = (
            product(modes, force).reshape(-1, 3) for force in (rest - solved.push, solved.push)
        )
        way, known = after.centre - before.centre, whole.motion.reshape(-1, 3)[:, :2]
        lacking, force = (before.to_global(every, one[:, :2]) for one in (left, acted))
        acting = whole.acting(solved.answer.normal_force, solved.answer.shear_force)
        acting += cross(before.to_global(every, known) - way, force) / 2
        turned = left[:, 2] + acted[:, 2] - acting - cross(way, lacking) / 2
        return np.column_stack([after.to_body(every, lacking), turned]).ravel()

    def _strained(self, state: State) -> Floats:
        """Return how far (B,) the strain of bodies moves their corners at most (m)."""
        away = self._sides.start.rows.apply(state.deformation)
        found = np.zeros(len(state.frames.angle))
        np.maximum.at(found, self._bodies, np.hypot(away[:, 0], away[:, 1]))
        return found

    @property
    def _bodies(self) -> Ints:
        """(n,) bodies of the boundary edges."""
        return self._model.manifold.boundary.body

    @cached_property
    def _across(self) -> Floats:
        """(B,) how wide bodies are (m)."""
        return np.sqrt(self._model.manifold.body_area)

    @cached_property
    def _compliance_of_all(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those without mass."""
        rigid = rigid_masses(self._model).ravel()
        return np.asarray(np.divide(1.0, rigid, out=np.zeros_like(rigid), where=rigid > 0))

    @property
    def compliance(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those that are held."""
        return np.where(np.repeat(self._held, 3), 0.0, self._compliance_of_all)


def _lags(solved: ContactSolution, gap: Floats, share: float) -> bool:
    """Whether forces did other work than before, by a ``share`` of theirs through gaps (m,)."""
    if solved.rows is None or solved.rows.whole is None:
        return False
    answer = solved.answer
    return solved.rows.whole.missed(answer) > share * float(np.abs(answer.normal_force) @ gap)


def _pressing(contacts: ContactPoints, found: ContactPoints | StepAnswer) -> Pressing:
    """Return edges of contacts with forces and gaps that were found."""
    return contacts.edge_a, contacts.edge_b, found.normal_force, found.gap


def _motion(one: State, other: State) -> tuple[Floats, Floats]:
    """Rotation (B,) in rad and way of the centre (B,) in m of bodies between two states."""
    way = other.frames.centre - one.frames.centre
    return np.abs(other.frames.angle - one.frames.angle), np.hypot(way[:, 0], way[:, 1])
