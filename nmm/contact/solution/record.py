"""The contact solution of a step, and what is kept of an accepted step for the next one."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

from integration.arrays import Floats, Ints
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.frozen import MadeOnce, with_parts

if TYPE_CHECKING:
    from nmm.contact.detection.contacts import Contacts
    from nmm.contact.detection.surface import Surface
    from nmm.contact.laws.step_friction import StepFriction
    from nmm.contact.points.contact_rows import ContactRows
    from nmm.contact.points.joint_book import JointBook
    from nmm.contact.problem.step_problem import StepAnswer

Breaking = Literal["all", "worst", "stop"]
"""Which bonds that cannot hold break at a time; at "stop" none, and the step is given up."""


@dataclass(frozen=True)
class ContactSolution:
    """Contact points of a step with the forces found.

    Attributes
    ----------
    contacts
        As they entered the last solution, bonds that broke on the way marked.
    answer
        Unknowns and forces.
    passes
        Linear systems solved.
    loss
        Energy lost to friction and broken springs (J).
    friction
        What of it friction took in a step of statics; None in time.
    stopped
        Whether a bond could not hold and the step was given up for it.
    sliding
        (m,) how far contacts slid under load (m); empty when the step is not accepted.
    rows
        What the forces acted through.
    broken
        The contacts at the start of the last solution, with the bonds broken that broke before it
        in the same step; None where none did.
    uncovered
        Whether ends of joints bear since then, which were no contacts of the step: it is solved
        again with them.
    between
        Work (J) that loads do within a step of statics beyond that of their mean at both ends: what
        bonds take that pass their peak between them, and along a path friction that reaches its
        limit there.
    missed
        (m,) error of linearised spring forces at the gaps that were found (N); None where springs
        are linear.
    ways
        Counts the ways in which a step along a path is not stable; None of other steps.
    """

    contacts: ContactPoints
    answer: "StepAnswer"
    passes: int
    loss: float
    friction: "StepFriction | None" = None
    stopped: bool = False
    sliding: Floats = field(default_factory=lambda: np.zeros(0))
    rows: "ContactRows | None" = None
    between: float = 0.0
    missed: Floats | None = None
    broken: "BrokenBonds | None" = None
    uncovered: bool = False
    ways: Callable[[], int] | None = None

    @MadeOnce
    def push(self) -> Floats:
        """What its forces are on the unknowns (n,), through the rows that they acted through."""
        assert self.rows is not None
        return self.rows.push(self.answer.normal_force, self.answer.shear_force)

    @property
    def pushing(self) -> Ints:
        """Sorted keys of the contacts that push."""
        return np.sort(self.contacts.key[self.answer.normal_force < 0])


@dataclass(frozen=True)
class BrokenBonds:
    """Contacts at the start of a step in which bonds broke, and the energy that these lost (J).

    ``opened`` are the keys of those that gave way where nothing pressed them.
    """

    contacts: ContactPoints
    loss: float
    opened: Ints

    def among(self, sought: ContactPoints) -> ContactPoints:
        """Return contacts of a new search for the same step, with these bonds broken."""
        joints = self.contacts.take(self.contacts.is_joint)
        return concatenate([joints, sought.take(~sought.is_joint)])

    def before(self, record: "ContactRecord") -> "ContactRecord":
        """Return the record of the step's start without these bonds."""
        return with_parts(record, book=record.book.without(self.contacts).opened_at(self.opened))


@dataclass(frozen=True)
class ContactRecord:
    """What contact keeps from accepted step to accepted step.

    Attributes
    ----------
    book
        Joints.
    found, known
        Contacts of the last search, and the same as points with forces and slip.
    stored
        See `StepAnswer.stored` (J).
    crossed
        Vertex and edge (k,) of pairs that became contacts because the step without them let them
        pass, and that pressed.
    began
        The edges where the step began that the next solution corrects; None where a step begins.
    """

    book: "JointBook"
    found: "Contacts | None" = None
    known: ContactPoints | None = None
    stored: float = 0.0
    crossed: tuple[Ints, Ints] | None = None
    began: "Surface | None" = None


def correcting(record: ContactRecord, solved: ContactSolution, began: "Surface") -> ContactRecord:
    """Return the record from which the step of a solution that it keeps is corrected.

    The friction of a correction is that of the whole step: what slid goes on sliding.
    """
    contacts = solved.contacts
    slid = np.where(contacts.bonded, 0.0, contacts.slid + solved.sliding)
    known, points = record.known, record.book.points
    if known is not None:
        known = with_parts(known, slid=slid[~contacts.is_joint])
    if points.gap.size:
        joints = np.flatnonzero(contacts.is_joint)
        joints = joints[np.isin(contacts.key[joints], points.key)]
        points = with_parts(points, slid=slid[joints])
    book = with_parts(record.book, points=points)
    return with_parts(record, book=book, known=known, began=began)


@dataclass(frozen=True)
class ContactCarried:
    """All that contact carries from accepted step to accepted step.

    Attributes
    ----------
    record
        Joints and contacts.
    barrier_width
        See `nmm.contact.iteration.memory.Memory` (m).
    unbonded
        Number of joint points that never had a bond, less those that changes have left out.
    """

    record: ContactRecord
    barrier_width: float | None = None
    unbonded: int = 0
