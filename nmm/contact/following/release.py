"""Bonds that give way between two steps of a path."""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools
from nmm.contact.bonds.release import released
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.problem.step_problem import BROKEN
from nmm.contact.solution.record import ContactRecord, ContactSolution


def let_go(
    record: ContactRecord, laws: ContactLaws, solved: ContactSolution, gone: Bools
) -> ContactRecord:
    """Return the record with bonds (m,) handed to their laws, or lost, as a solution has them.

    The solution is the step that the record was left by, or one that began with it.
    """
    contacts, springs = solved.contacts, laws.springs(solved.contacts)
    limits = laws.response(contacts, springs[0]).limits
    freed, lost = gone & contacts.tied, gone & laws.brittle[contacts.interface]
    after = laws.break_bonds(contacts, lost)
    if freed.any():
        after, _ = released(after, freed, solved.answer, springs, limits)
    points = record.book.points
    order = np.argsort(contacts.key)
    at = order[np.searchsorted(contacts.key[order], points.key)]
    dropped = lost[at]
    history = {
        name: np.where(gone[at], after.history[name][at], column)
        for name, column in points.history.items()
    }
    points = replace(
        points,
        reference=after.reference[at],
        spring_factor=after.spring_factor[at],
        state=np.where(dropped, int(BROKEN), points.state),
        normal_force=np.where(dropped, 0.0, points.normal_force),
        shear_force=np.where(dropped, 0.0, points.shear_force),
        history=history,
    )
    return replace(record, book=replace(record.book, points=points))
