"""Steps along a path as they are tried, and the bonds that give way in one."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.material_points import MaterialPoints
from nmm.controls.base import PathState
from nmm.controls.path_equation import PathEquation
from nmm.stepping.control.locating import TriedStep
from nmm.stepping.control.position import OnPath
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints

# Share of the largest load over strength within which bonds give way together.
TIE = 1e-6


@dataclass(frozen=True)
class Trials:
    """Tries steps from where a path stands; ``monitors`` are points of the scene, by name."""

    stepper: Stepper
    monitors: Mapping[str, MaterialPoints]

    def standing(self, at: OnPath) -> PathState:
        """Return what controls ask of where a path stands."""
        plan = self.stepper.plan
        load, dead = plan.unit_load(at.state), plan.dead_load(at.state, at.way)
        losing = partial(self.stepper.losing, at.state)
        return PathState(at.state, load, dead, self.monitors, at.way, losing)

    def along(self, at: PathState, path: PathEquation) -> TriedStep:
        """Try a step along a path."""
        attempt = self.stepper.along(at.state, path)
        if attempt.converged and attempt.motion > self.stepper.size:
            attempt = replace(attempt, converged=False, sentence="points leave the domain")
        each = self._by_joint(attempt) if attempt.converged else np.full(1, np.inf)
        return TriedStep(path.target, attempt, each)

    def of_load(self, at: PathState, change: float) -> TriedStep:
        """Try a step by which the load factor changes so much."""
        return self.along(at, PathEquation(at.load, 0 * at.way, 1.0, change))

    def loads(self) -> Floats:
        """Return load over strength of the points of joints where the path stands.

        Of those that are followed still: joints that came apart are in no step.
        """
        contact = self.stepper.plan.contact
        assert contact is not None
        points = contact.record.book.points
        return _in_order(points, contact.bonds.overload(points, points, points))

    def may_give_way(self) -> bool:
        """Whether any bond is left that breaks at once, or begins to soften, at a limit."""
        contact = self.stepper.plan.contact
        assert contact is not None
        return contact.bonds.may_give_way(contact.standing, contact.record.book.points)

    def give_way(self, attempt: Attempt) -> tuple[bool, float]:
        """Let the bonds that are loaded most give way.

        Say whether any of them breaks at once, and how much less energy the others hold (J).
        """
        contact, solved = self.stepper.plan.contact, attempt.solved
        assert contact is not None
        assert solved is not None
        load = self._overload(attempt)
        gone: Bools = load >= load.max() * (1 - TIE)
        shed = contact.release(solved, gone)
        return bool(contact.laws.brittle[solved.contacts.interface[gone]].any()), shed

    def _by_joint(self, attempt: Attempt) -> Floats:
        """Return load over strength of the points of joints."""
        assert attempt.solved is not None
        return _in_order(attempt.solved.contacts, self._overload(attempt))

    def _overload(self, attempt: Attempt) -> Floats:
        """Return load over strength (m,) of the bonds of an attempt."""
        contact, solved = self.stepper.plan.contact, attempt.solved
        assert contact is not None
        assert solved is not None
        joints = contact.record.book.points
        return contact.bonds.overload(solved.contacts, solved.answer, joints)


def _in_order(contacts: "ContactPoints", load: Floats) -> Floats:
    """Return the loads (m,) of points of joints alone, in the joints' order."""
    joints = contacts.is_joint
    return np.asarray(load[joints][np.argsort(-contacts.key[joints])])
