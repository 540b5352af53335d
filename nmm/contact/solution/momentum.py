"""What keeps momentum and angular momentum where bodies touch: midpoints, and what is owed."""

from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.momenta import rigid_masses
from nmm.assembly.motion import State, middle
from nmm.assembly.moved_bodies import entries
from nmm.contact.detection.tolerances import MIDPOINT_GAPS
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import StepAnswer
from nmm.contact.solution.record import ContactSolution
from nmm.contact.solution.turning import Pressing, foreseen, matters, owed


class Momentum:
    """Inertia of the bodies as contact needs it.

    Parameters
    ----------
    model, sides
        Manifold with its masses, and its boundary edges.
    held
        (B,) bodies that a support holds as a whole.
    curved
        Whether contacts act at points of the material, where forces stay at the start of a step.
    """

    def __init__(self, model: Model, sides: Sides, held: Bools, curved: bool) -> None:
        self._model, self._sides = model, sides
        self._held, self._curved = held, curved

    def midpoint(
        self, solved: ContactSolution, before: State, after: State, used: State | None
    ) -> State | None:
        """Where the forces of a step should have acted; None if ``used`` (None: before) will do.

        Gaps are off by about a rotation times a motion; that matters beside the penetrations.
        """
        if not self._of_blocks or self._curved:
            return None
        turn, way = _motion(before, after)
        turn, way = turn / 2, way / 2
        turned, moved = turn, way
        if used is not None:
            turned, moved = _motion(used, middle(before, after))
        motions = turn, way + turn * self._across, turned, moved
        pressing = _pressing(solved.contacts, solved.answer)
        if not matters(pressing, self._bodies, motions, MIDPOINT_GAPS):
            return None
        return middle(before, after)

    def foreseen(
        self, contacts: ContactPoints, flight: Floats, acceleration: Floats, half: float
    ) -> Floats | None:
        """Return the way (n,) of a step that turns bodies so far that forces should act half way.

        None of one that does not. ``flight`` (n,) is a step's way at the velocity now, ``half``
        half the square of the step (s2).
        """
        if not self._of_blocks or self._curved:
            return None
        turns, way = foreseen(
            # That of the last step, had its acceleration not changed.
            (flight, flight - half * acceleration),
            entries(self._model.rigid_projection),
            _pressing(contacts, contacts),
            (self._bodies, self._across),
            MIDPOINT_GAPS,
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
        edges = self._model.manifold.boundary
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
            step * self._compliance_of_all,
        )

    @property
    def _bodies(self) -> Ints:
        """(n,) bodies of the boundary edges."""
        return self._model.manifold.boundary.body

    @cached_property
    def _across(self) -> Floats:
        """(B,) how wide bodies are (m)."""
        return np.sqrt(self._model.manifold.body_area)

    @cached_property
    def _of_blocks(self) -> bool:
        """Whether every body is one element, whose points' rows hold all its unknowns."""
        manifold = self._model.manifold
        return len(manifold.elements) == manifold.n_bodies == manifold.n_covers

    @cached_property
    def _compliance_of_all(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those without mass."""
        rigid = rigid_masses(self._model).ravel()
        return np.asarray(np.divide(1.0, rigid, out=np.zeros_like(rigid), where=rigid > 0))

    @property
    def compliance(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those that are held."""
        return np.where(np.repeat(self._held, 3), 0.0, self._compliance_of_all)


def _pressing(contacts: ContactPoints, found: ContactPoints | StepAnswer) -> Pressing:
    """Return edges of contacts with forces and gaps that were found."""
    return contacts.edge_a, contacts.edge_b, found.normal_force, found.gap


def _motion(one: State, other: State) -> tuple[Floats, Floats]:
    """Rotation (B,) in rad and way of the centre (B,) in m of bodies between two states."""
    way = other.frames.centre - one.frames.centre
    return np.abs(other.frames.angle - one.frames.angle), np.hypot(way[:, 0], way[:, 1])
