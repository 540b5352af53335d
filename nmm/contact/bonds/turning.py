"""The part of a joint's jump by which its two sides turn against each other.

Between elements of one strain each the average traction is the same all along a joint, and answers
the mean jump alone. What is left of a jump bends both elements, which one strain cannot hold: it is
held as firmly as the material between their middles bends, ``E / h`` (Kawai 1978), not by the
penalty. Where tractions vary along a joint they answer both parts, and the penalty holds both.
"""

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.ragged import offsets, within
from integration.sparse import csr_array
from nmm.contact.points.contact_points import TIED, ContactPoints


def counted(contacts: ContactPoints, jump: Floats) -> Floats:
    """Return the jumps (m,) that the penalty holds: the joint's mean, and a share of the rest.

    The share is the column ``TIED``. A point whose joint has no other whole bond has its own jump.
    """
    tied = np.flatnonzero(contacts.tied)
    if not len(tied):
        return jump
    number, share = _numbered(_joint(contacts)[tied]), contacts.history[TIED][tied]
    mean = np.bincount(number, jump[tied]) / np.bincount(number)
    found = jump.copy()
    found[tied] = share * jump[tied] + (1 - share) * mean[number]
    return found


def counting(tied: ContactPoints, penalty: Floats) -> csr_array:
    """Return the matrix (k, k) from jumps of tied bonds to what a penalty (k,) on them holds.

    Its rows are those of `counted` times the penalty, which all points of a joint share.
    """
    number, share = _numbered(_joint(tied)), tied.history[TIED]
    size, members = np.bincount(number), np.argsort(number, kind="stable")
    length, point = size[number], np.repeat(np.arange(len(number)), size[number])
    # Entry by entry, the points of a row's joint one after the other.
    column = members[offsets(size)[number[point]] + within(length)]
    part = ((1 - share) / length)[point] + np.where(column == point, share[point], 0.0)
    shape = (len(number), len(number))
    return csr_array((penalty[point] * part, column, offsets(length)), shape=shape)


def beside(contacts: ContactPoints, gone: Bools) -> Bools:
    """Return which tied bonds (m,) are left alone in their joint as others are gone."""
    stays = contacts.tied & ~gone
    return np.asarray(stays & np.isin(_joint(contacts), _joint(contacts)[contacts.tied & gone]))


def turning_share(
    joints: ContactPoints,
    tractions: list[tuple[Ints, Floats]],
    penalty: Floats,
    bending: Floats,
) -> Floats:
    """Return the share (k,) of the penalty that holds what turns, for all points of joints.

    Parameters
    ----------
    joints
        The points, those of one joint after those of another.
    tractions
        Unknowns (k, L) and rows (k, 2, L) of either side.
    penalty, bending
        (k,) of the mean jump, and ``E / h`` (Pa/m).
    """
    number = _numbered(_joint(joints))
    first = np.unique(number, return_index=True)[1][number]
    even = np.ones(len(penalty), dtype=bool)
    for unknowns, values in tractions:
        one = values[first]
        off = np.abs(values - one).max(axis=(1, 2), initial=0.0)
        even &= off <= SAME * np.abs(one).max(axis=(1, 2), initial=0.0)
        even &= (unknowns == unknowns[first]).all(axis=1)
    uneven = np.bincount(number, ~even)[number] > 0
    return np.where(uneven, 1.0, bending / np.where(penalty > 0, penalty, 1.0))


# Tractions that differ by less along a joint are the same, relative.
SAME = 1e-9


def _joint(contacts: ContactPoints) -> Ints:
    """Number (m,) of the joint of each point: that of its two edges, which share one stretch."""
    a, b = contacts.edge_a, contacts.edge_b
    return np.asarray(a * (int(b.max(initial=0)) + 1) + b)


def _numbered(joint: Ints) -> Ints:
    """Count the joints (m,) from zero."""
    return np.asarray(np.unique(joint, return_inverse=True)[1])
