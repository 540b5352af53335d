"""What contact knows of a new model: joints and contacts go on where the material does."""

from collections.abc import Callable

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Bools, Floats
from nmm.assembly.motion import State
from nmm.contact.candidates.candidates import Candidates
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.inheritance import (
    continued,
    continued_joints,
    heirs,
    known_joints,
    placed,
)
from nmm.contact.solution.record import ContactRecord

# How far open contacts are that a change of the model continues, in sizes of the domain.
HELD = 1e-6


def succeeding(
    record: ContactRecord,
    fresh: ContactRecord,
    candidates: Candidates,
    manifolds: tuple[Manifold, Manifold],
    state: State,
    springs: Callable[[ContactPoints], tuple[Floats, Floats, Bools]] | None,
) -> ContactRecord:
    """Return the record of the new model that goes on from that of the old one.

    Bonds between bodies of which one is new are free of stress as they are placed.

    Parameters
    ----------
    record, fresh
        Of the old model, and of the new one as if a run began on it.
    candidates
        Finds the contacts of the new model.
    manifolds
        The old one and the new one.
    state
        Of the new model.
    springs
        Of contact points, see `ContactLaws.springs`; None where contact has no springs.
    """
    old, new = manifolds
    line = heirs((new, fresh.book.points), (old, known_joints(record.book)))
    book, added = continued_joints(fresh.book, record.book, line)
    book = placed(book, candidates.joints(book, state), added)
    size = float(np.hypot(*np.ptp(new.elements.points, axis=0)))
    found, points = candidates.sought(ContactRecord(book), state, HELD * size)
    points = points.take(~points.is_joint)
    if record.known is not None:
        line = heirs((new, points), (old, record.known))
        stiffness = None if springs is None else springs(points)[:2]
        points = continued(points, record.known, line, stiffness)
    return ContactRecord(book, found, points)
