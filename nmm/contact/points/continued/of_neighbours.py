"""What points between two bodies take over from others between the same bodies.

They continue none of them: what is found in place of a joint that has slid apart, and segments of
faces that are pressed together already.
"""

from collections.abc import Callable

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.surface import unordered_key
from nmm.contact.points.contact_points import ContactPoints, concatenate


def found_for(left: ContactPoints, new: ContactPoints, body: Ints) -> Bools:
    """Which new points (m,) are of two bodies that were joined by a joint that was ``left``."""
    return np.isin(_pairs(new, body), _pairs(left, body))


def in_place_of(
    new: ContactPoints,
    old: ContactPoints,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
    left: ContactPoints,
) -> tuple[Floats, Floats]:
    """Reference and slip (m,) of what is found in place of joints that were ``left``.

    It is pressed by what it overlaps, or by the share of that with which all springs between two
    bodies hold no more energy than joints and faces did.
    """
    old = concatenate([left, old.take(old.length > 0)])
    pair_old, pair_new = matched(old, new, body)
    held, asked = (
        np.bincount(pair, stiffness(one) * np.minimum(one.gap, 0.0) ** 2, 1 + pair_old.max())
        for one, pair in ((old, pair_old), (new, pair_new))
    )
    wanted = np.maximum(asked, np.finfo(float).tiny)
    share = np.sqrt(np.minimum(held, wanted) / wanted)[pair_new]
    return new.gap * (1 - share), share * _mean_slip(new, left, body)


def _mean_slip(new: ContactPoints, left: ContactPoints, body: Ints) -> Floats:
    """Stretch (m,) along the faces that pressed joints of the same two bodies had, by length."""
    pair, which = np.unique(_pairs(left, body), return_inverse=True)
    weight = np.where(left.normal_force < 0, left.length, 0.0)
    total, length = (np.bincount(which, weight * one) for one in (left.slip, np.ones(len(left))))
    mean = np.divide(total, length, out=np.zeros(len(pair)), where=length > 0)
    return mean[np.searchsorted(pair, _pairs(new, body))]


def beside(born: ContactPoints, old: ContactPoints, body: Ints) -> tuple[Floats, Floats]:
    """Stretch (m,) of the most pressed contact that the same two bodies had on faces.

    And the largest reference (m,) of these, if above zero.
    """
    faces = old.take(old.length > 0)
    pair_old, pair_born = matched(faces, born, body)
    least, most = np.zeros((2, 1 + int(max(pair_old.max(initial=0), pair_born.max(initial=0)))))
    np.minimum.at(least, pair_old, faces.gap)
    np.maximum.at(most, pair_old, faces.reference)
    return least[pair_born], most[pair_born]


def matched(old: ContactPoints, new: ContactPoints, body: Ints) -> tuple[Ints, Ints]:
    """Numbers of the two bodies of old and new points, the same for the same bodies."""
    pairs = np.concatenate([_pairs(old, body), _pairs(new, body)])
    which = np.unique(pairs, return_inverse=True)[1]
    return which[: len(old)], which[len(old) :]


def _pairs(points: ContactPoints, body: Ints) -> Ints:
    """Key (m,) of the two bodies of each point."""
    count = int(body.max(initial=0)) + 1
    return unordered_key(body[points.edge_a], body[points.edge_b], count)
