"""What keeps momentum and angular momentum where bodies touch: midpoints, and what is owed."""

from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.momenta import rigid_masses
from nmm.assembly.motion import State
from nmm.contact.detection.tolerances import MIDPOINT_GAPS
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.midpoint import middle, missing_moments
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
        acts = solved.answer.normal_force != 0
        if not acts.any() or not self._of_blocks or self._curved:
            return None
        half, was = middle(before, after), before if used is None else used
        deepest = MIDPOINT_GAPS * np.abs(solved.answer.gap[acts]).max()
        # Most steps turn no body by as much as would matter to those that touch.
        if self._off(before, was, half, np.arange(len(self._held))) <= deepest:
            return None
        edges, touched = self._model.manifold.boundary.body, np.zeros(len(self._held), dtype=bool)
        for edge in (solved.contacts.edge_a, solved.contacts.edge_b):
            touched[edges[edge[acts]]] = True
        return half if self._off(before, was, half, np.flatnonzero(touched)) > deepest else None

    def _off(self, before: State, was: State, half: State, body: Ints) -> float:
        """By how much (m) gaps are off with forces where bodies ``was`` and not half way."""
        rotation, shift = _largest_motion(before, half, body)
        rotated, shifted = (rotation, shift) if was is before else _largest_motion(was, half, body)
        shift += rotation * float(np.sqrt(self._model.manifold.body_area[body].max()))
        return 2 * (rotated * shift + shifted * rotation)

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
        push = through.push(*forces)
        owed = product(self._modes_turned, balance - push).reshape(-1, 3)
        acted = product(self._modes_turned, push)
        owed[:, 2] += missing_moments(through, forces, solved.contacts, self._sides, half, acted)
        return product(modes, step * self._compliance_of_all * owed.ravel())

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


def _largest_motion(one: State, other: State, body: Ints) -> tuple[float, float]:
    """Largest rotation (rad) and way of a centre (m) of bodies between two states."""
    turned = np.abs(other.frames.angle - one.frames.angle)[body].max()
    return float(turned), float(np.hypot(*(other.frames.centre - one.frames.centre)[body].T).max())
