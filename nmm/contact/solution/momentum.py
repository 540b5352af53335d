"""What keeps momentum and angular momentum where bodies touch: midpoints, and what is owed."""

from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.momenta import rigid_masses
from nmm.assembly.motion import State, middle
from nmm.contact.detection.tolerances import MIDPOINT_GAPS
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.midpoint import missing_moments
from nmm.contact.problem.step_problem import StepAnswer
from nmm.contact.solution.record import ContactSolution
from nmm.solvers.unchecked import product


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
        if not _matters(solved.contacts, solved.answer, motions, self._bodies):
            return None
        return middle(before, after)

    def turns(self, contacts: ContactPoints, way: Floats) -> bool:
        """Whether a step of ``way`` (n,) turns bodies so far that forces should act half way."""
        if not self._of_blocks or self._curved:
            return False
        whole = product(self._model.rigid_projection, way).reshape(-1, 3)
        turn, moved = np.abs(whole[:, 2]) / 2, np.hypot(whole[:, 0], whole[:, 1]) / 2
        motions = turn, moved + turn * self._across, turn, moved
        return _matters(contacts, contacts, motions, self._bodies)

    def kept(
        self, solved: ContactSolution, before: State, after: State, step: float, balance: Floats
    ) -> Floats:
        """Velocity (n,) that a step lacks of what keeps momentum and angular momentum.

        The moments that contact forces owe (`midpoint.missing_moments`), and the sum of what is
        left of the forces ``balance`` (n,), load less inner forces, when contact has taken its own.
        """
        assert solved.rows is not None
        through, modes = solved.rows, self._model.manifold.rigid_modes
        forces = solved.answer.normal_force, solved.answer.shear_force
        half = middle(before, after)
        push = solved.push
        owed = product(self._modes_turned, balance - push).reshape(-1, 3)
        acted = product(self._modes_turned, push)
        owed[:, 2] += missing_moments(through, forces, solved.contacts, self._sides, half, acted)
        return product(modes, step * self._compliance_of_all * owed.ravel())

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
    def _modes_turned(self) -> csr_array:
        """(3 B, n) forces and moments on the bodies from forces on the unknowns."""
        return csr_array(self._model.manifold.rigid_modes.T)

    @cached_property
    def _compliance_of_all(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those without mass."""
        rigid = rigid_masses(self._model).ravel()
        return np.asarray(np.divide(1.0, rigid, out=np.zeros_like(rigid), where=rigid > 0))

    @property
    def compliance(self) -> Floats:
        """(3 B,) inverse of mass and moment of inertia of the bodies; 0 of those that are held."""
        return np.where(np.repeat(self._held, 3), 0.0, self._compliance_of_all)


largest = np.maximum.reduce  # an array's own `max` is three calls


def _matters(
    contacts: ContactPoints,
    found: ContactPoints | StepAnswer,
    motions: tuple[Floats, Floats, Floats, Floats],
    body: Ints,
) -> bool:
    """Whether gaps are off, with forces not half way, by what counts beside those ``found``.

    ``motions`` of bodies (B,): turns (rad) and ways (m) to half way and to there from where forces
    act.
    """
    acts = found.normal_force != 0
    deepest = largest(np.abs(found.gap[acts]), initial=0.0)
    turn, way, turned, moved = motions
    # Most steps turn no body by as much as would matter to any.
    most = largest(turned) * largest(way) + largest(moved) * largest(turn)
    if not 2 * most > MIDPOINT_GAPS * deepest > 0:
        return False
    a, b = body[contacts.edge_a[acts]], body[contacts.edge_b[acts]]
    turn, way, turned, moved = (np.maximum(one[a], one[b]) for one in motions)
    return bool(2 * (turned * way + moved * turn).max() > MIDPOINT_GAPS * deepest)


def _motion(one: State, other: State) -> tuple[Floats, Floats]:
    """Rotation (B,) in rad and way of the centre (B,) in m of bodies between two states."""
    way = other.frames.centre - one.frames.centre
    return np.abs(other.frames.angle - one.frames.angle), np.hypot(way[:, 0], way[:, 1])
