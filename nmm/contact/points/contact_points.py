"""Contact points of a step: where they are, what gap and slip they have, what is remembered."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.interfaces.history import History

AT_ENDS = ("gap", "slip", "normal_force", "shear_force")
"""What contacts have at both ends of a step."""


@dataclass(frozen=True)
class ContactPoints:
    """Contact points, one row each; side b's edge gives the normal, from b to a.

    Attributes
    ----------
    edge_a, parameter_a, edge_b, parameter_b
        The two sides.
    normal
        (m, 2) at the start of the step.
    gap
        (m,) normal distance (m), positive open, counted from the reference.
    slip
        (m,) stretch of the shear spring at the start of the step (m).
    slid
        (m,) how far contacts have slid in the step that is corrected (m); zero where one begins.
    length
        (m,) tributary length (m); zero where a contact is a mere vertex.
    spring_factor
        (m,) what the penalty is multiplied by: tributary length over the distance between the
        middles of the two elements, less by as much as these are softer than the stiffest material.
        1 for a mere vertex.
    interface
        (m,) index among the scene's interfaces.
    key
        (m,) identity over steps; joints count -1, -2, ... and the others are not negative.
    state, normal_force, shear_force
        (m,) what the last step left, the warm start of this one.
    reference
        (m,) overlap that no step has made, as a gap (m); positive is what a stress at the start
        had closed, or a softer spring would have; see `nmm.contact.points.continued.reference_gap`.
    history
        What interface laws remember: columns (m,) by name (`nmm.interfaces.history`).
    """

    edge_a: Ints
    parameter_a: Floats
    edge_b: Ints
    parameter_b: Floats
    normal: Floats
    gap: Floats
    slip: Floats
    slid: Floats
    length: Floats
    spring_factor: Floats
    interface: Ints
    key: Ints
    state: Ints
    normal_force: Floats
    shear_force: Floats
    reference: Floats
    history: History

    @classmethod
    def unloaded(cls, **given: Any) -> "ContactPoints":
        """Return points (m,) without slip, forces and reference; all else is given."""
        zeros = np.zeros(len(given["gap"]))
        names = ("slip", "slid", "normal_force", "shear_force", "reference")
        none: dict[str, Any] = dict.fromkeys(names, zeros)
        return cls(**none, **given)

    def __len__(self) -> int:
        return len(self.gap)

    def take(self, index: Ints | Bools) -> "ContactPoints":
        """Return some of the contacts."""
        if index.dtype == bool and index.all():
            return self
        history = {name: column[index] for name, column in self.history.items()}
        parts: dict[str, Any] = {name: getattr(self, name)[index] for name in PARTS}
        return ContactPoints(**parts, history=history)

    @property
    def sides(self) -> tuple[tuple[Ints, Floats], tuple[Ints, Floats]]:
        """Edge and parameter (m,) of sides a and b."""
        return (self.edge_a, self.parameter_a), (self.edge_b, self.parameter_b)

    @property
    def distance(self) -> Floats:
        """Normal distance (m,) of the sides (m), wherever gaps are counted from."""
        return self.gap + self.reference

    def inherited(self, old: "ContactPoints", parent: Ints) -> dict[str, Any]:
        """Return internal variables (m,) by name, taken from old points of the same interface.

        ``parent`` (m,) are the numbers of the old points; -1 of points that continue none.
        """
        if not len(old):
            return dict(self.history)
        source = np.maximum(parent, 0)
        alike = (parent >= 0) & (old.interface[source] == self.interface)
        return {
            name: np.where(alike, old.history[name][source], first)
            if name in old.history
            else first
            for name, first in self.history.items()
        }

    @property
    def is_joint(self) -> Bools:
        """Which contacts are points of joints."""
        return self.key < 0

    @property
    def bonded(self) -> Bools:
        """Which contacts are bonds of joints that hold still."""
        return np.asarray(self.history["bonded"])

    @property
    def tied(self) -> Bools:
        """Which of the bonds consistent terms hold (`nmm.contact.bonds`)."""
        if TIED not in self.history:
            return np.zeros(self.gap.shape, dtype=bool)
        return np.asarray(self.bonded & (self.history[TIED] > 0))


TIED = "tied"
"""The column of contacts that consistent terms hold: see `nmm.contact.bonds.turning.counted`.

Zero where none does, else the share of their penalty that holds what turns in a joint.
"""
PARTS = tuple(part.name for part in fields(ContactPoints) if part.name != "history")


def concatenate(parts: list[ContactPoints]) -> ContactPoints:
    """Join contact points."""
    some = [part for part in parts if part.key.size] or parts[:1]
    if not some[1:]:
        return some[0]
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(part, name) for part in some]) for name in PARTS
    }
    history = {
        name: np.concatenate([part.history[name] for part in some]) for name in some[0].history
    }
    return ContactPoints(**joined, history=history)
