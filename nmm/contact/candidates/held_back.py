"""Pairs that the last step let through: contacts of the next one from its start, while they push.

Search chooses the edge that a corner meets from where bodies are and go. Where two corners stand
at each other's edge ends it may leave out a pair in every step that the answer without it lets
through, and each step would be solved twice. A pair that pushes and stands over its edge would be
let through again without its force; one that no longer pushes is left to search.
"""

import numpy as np

from integration.arrays import Ints
from nmm.contact.detection.measures import measure
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.solution.record import ContactSolution

Crossed = tuple[Ints, Ints]
"""Vertex and edge (k,) of pairs that a step let through each other."""


def joined(one: Crossed | None, other: Crossed | None) -> Crossed | None:
    """Return pairs of both; None without any."""
    if one is None or other is None:
        return other if one is None else one
    return np.concatenate([one[0], other[0]]), np.concatenate([one[1], other[1]])


def held_back(pairs: Crossed, solved: ContactSolution, surface: Surface) -> Crossed | None:
    """Return those of the pairs that push over their edges, as ``surface`` stands; else None."""
    vertex, edge = pairs
    standing = pair_key(surface, *pushing(solved))
    along, _ = measure(surface, vertex, edge)
    keep = (along >= 0) & (along <= surface.length[edge])
    keep &= np.isin(pair_key(surface, vertex, edge), standing)
    return (vertex[keep], edge[keep]) if keep.any() else None


def pushing(solved: ContactSolution) -> Crossed:
    """Return the pairs, those of joints apart, whose springs push at the end of the step."""
    contacts = solved.contacts
    contacts = contacts.take((solved.answer.normal_force < 0) & ~contacts.is_joint)
    return contacts.edge_a, contacts.edge_b
