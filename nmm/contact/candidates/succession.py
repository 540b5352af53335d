"""Contact on a changed model: joints and contacts continue where the material does."""

from dataclasses import replace

import numpy as np

from covers.change.parentage import Parentage
from nmm.assembly.state import State
from nmm.contact.candidates.candidates import Candidates
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.continued.inheritance import (
    continued,
    continued_joints,
    heirs,
    known_joints,
    placed,
    within_one,
)
from nmm.contact.points.continued.kept_energy import stretched
from nmm.contact.points.cracks.bonded_cracks import BondedCracks
from nmm.contact.points.joint_book import standing_open
from nmm.contact.solution.record import ContactRecord

# How far open contacts are that a change of the model continues, in sizes of the domain.
HELD = 1e-6


def succeeding(
    record: ContactRecord,
    fresh: ContactRecord,
    candidates: Candidates,
    kin: Parentage,
    state: State,
    cracks: BondedCracks,
    laws: tuple[ContactLaws, ContactLaws] | None,
) -> ContactRecord:
    """Return the record of the new model that goes on from that of the old one.

    Bonds between bodies of which one is new are free of stress as they are placed; where one body
    has become two there is no bond between them, but on cracks whose faces begin bonded: these go
    on as the material was, without a jump.

    Parameters
    ----------
    record, fresh
        Of the old model, and of the new one as if a run began on it.
    candidates
        Finds the contacts of the new model.
    kin
        Which bodies of the new model come from which of the old one.
    state
        Of the new model.
    cracks
        Of the new model, those whose faces begin bonded.
    laws
        Of the old model and of the new one; None where contact has no springs. Those that become
        stiffer or softer exert what they did.
    """
    seamless = cracks.points(kin.new, fresh.book.points)
    line = heirs(kin, fresh.book.points, known_joints(record.book)).only_same(seamless)
    book, added = continued_joints(fresh.book, record.book, line)
    # Faces that a change has made inside a body are no joint, unless they begin bonded.
    inside, seamless = within_one(kin, book.points), cracks.points(kin.new, book.points)
    laid = ~(added & inside) | seamless
    book, added = book.only(laid), (added & ~(inside & seamless))[laid]
    book = placed(book, candidates.joints(book, state), added)
    book = book.opened_at(standing_open(book.points))
    size = kin.new.elements.extent
    found, points = candidates.sought(ContactRecord(book), state, HELD * size)
    book = replace(book, left=book.left.take(np.zeros(0, dtype=np.int64)))  # handed on just now
    points = points.take(~points.is_joint)
    if record.known is not None:
        line = heirs(kin, points, record.known)
        if laws is None:
            points = continued(points, record.known, line, None)
        else:
            was, now = laws
            normal, shear, own = now.springs(points)
            softer = np.where(own, 1.0, was.normal_penalty / now.normal_penalty)
            points = continued(points, record.known, line, (softer * normal, softer * shear))
            points = stretched(points, softer, slip=True)
    return ContactRecord(book, found, points)
