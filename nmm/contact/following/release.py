"""Bonds that break or begin to soften between two steps of a path."""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools
from nmm.contact.bonds.release import given_way
from nmm.contact.bonds.turning import beside
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import AT_ENDS
from nmm.contact.points.joint_book import not_pressed
from nmm.contact.problem.step_problem import BROKEN
from nmm.contact.solution.record import ContactRecord, ContactSolution

# Damage of bonds that have come to their limit and soften from there on.
BEGUN = 1e-12


def let_go(
    record: ContactRecord, laws: ContactLaws, solved: ContactSolution, gone: Bools
) -> tuple[ContactRecord, float]:
    """Return the record with bonds (m,) handed to their laws, or lost, as a solution has them.

    And by how much energy (J) the terms of those that soften held more than the springs that go on.

    The solution is the step that the record was left by, or one that began with it.
    """
    contacts, springs = solved.contacts, laws.springs(solved.contacts)
    limits = laws.response(contacts, springs[0]).limits
    freed, lost = gone & contacts.tied, gone & laws.brittle[contacts.interface]
    ended = replace(contacts, **{name: getattr(solved.answer, name) for name in AT_ENDS})
    after, shed = given_way(laws, ended, (gone, lost), solved.answer, springs, limits)
    points = record.book.points
    order = np.argsort(contacts.key)
    at = order[np.searchsorted(contacts.key[order], points.key)]
    dropped = lost[at]
    changed = (gone | beside(contacts, freed))[at]
    history = {
        name: np.where(changed, after.history[name][at], column)
        for name, column in points.history.items()
    }
    if (soft := (gone & ~freed & ~lost)[at]).any():
        history["damage"] = np.where(soft, np.maximum(history["damage"], BEGUN), history["damage"])
    points = replace(
        points,
        reference=after.reference[at],
        spring_factor=after.spring_factor[at],
        state=np.where(dropped, int(BROKEN), points.state),
        normal_force=np.where(dropped, 0.0, points.normal_force),
        shear_force=np.where(dropped, 0.0, points.shear_force),
        history=history,
    )
    opened = not_pressed(contacts, gone, solved.answer.normal_force)
    return replace(record, book=replace(record.book, points=points).opened_at(opened)), shed
