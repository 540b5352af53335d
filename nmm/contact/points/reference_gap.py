"""The gap from which a contact counts: an overlap that no step has made stores no energy.

Search may find a vertex already inside a body: two corners have passed each other, or the scene
began so. A spring that entered loaded would push with energy from nowhere. Such a contact counts
its gap from what it was when it appeared, its *reference*. A contact that continues another one, at
the corner of a body or on the next body, takes over the stretch of that one's spring, and a stretch
of two faces that are pressed together already is pressed like its neighbours. What is found in
place of a joint that has slid apart is pressed as the joint was.

The reference recovers without work: when the contact opens, what is left of the overlap becomes the
new reference, and it never grows again.
"""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats, Ints
from nmm.contact.detection.pair_keys import unordered_key
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.frozen import with_parts


def counted(
    new: ContactPoints,
    old: ContactPoints | None,
    predecessor: Ints,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
    left: ContactPoints,
) -> ContactPoints:
    """Return new points with gaps counted from their references.

    Parameters
    ----------
    new
        Points as found, their gaps as measured (m).
    old
        Points of the last accepted step with gaps as counted (m); None before the first.
    predecessor
        (m,) which of the old points each new one continues, -1 where it is new.
    stiffness
        Normal stiffness (N/m) of contact points.
    body
        (E,) of the boundary edges.
    left
        Points of joints that the last step gave up, with gap and slip as it left them (m).
    """
    reference = np.minimum(new.gap, 0.0)
    known, on_face = predecessor >= 0, new.length > 0
    if old is not None and len(old) and len(new):
        source = np.where(known, predecessor, 0)
        stays = known & (old.key[source] == new.key)
        # An overlap that has become less is followed.
        reference = np.where(stays, np.maximum(reference, old.reference[source]), reference)
        handed = np.flatnonzero(known & ~stays & (new.gap < 0))
        if len(handed):
            giver, taker = old.take(source[handed]), new.take(handed)
            stretch = _passed_on(giver.gap, stiffness(giver) / stiffness(taker))
            reference[handed] = _from_stretch(taker.gap, stretch)
        born = np.flatnonzero(~known & on_face & (new.gap < 0))
        if len(born):
            taker = new.take(born)
            reference[born] = _from_stretch(taker.gap, _beside(taker, old, body))
    if len(left):
        # A joint stands for all of its length: stretches beside it were not pressed so far.
        instead = (on_face | ~known) & (new.gap < 0)
        instead &= np.isin(_pairs(new, body), _pairs(left, body))
        reference, slip = reference.copy(), new.slip.copy()
        reference[instead], slip[instead] = _in_place(new.take(instead), old, stiffness, body, left)
        new = with_parts(new, slip=slip)
    return with_parts(new, gap=new.gap - reference, reference=reference)


def counted_on(points: ContactPoints) -> ContactPoints:
    """Return points that all go on, their gaps as measured (m), with gaps counted as they were."""
    reference = np.maximum(np.minimum(points.gap, 0.0), points.reference)
    return with_parts(points, gap=points.gap - reference, reference=reference)


def _from_stretch(gap: Floats, stretch: Floats) -> Floats:
    """Reference (m,) with which contacts are stretched by so much, or as far as they overlap."""
    return np.minimum(gap - np.minimum(stretch, 0.0), 0.0)


def _passed_on(stretch: Floats, ratio: Floats) -> Floats:
    """Stretch (m,) that gives a spring neither more force nor more energy than the last one had.

    ``ratio`` (m,) is the stiffness of the last one over that of the new one.
    """
    return stretch * np.minimum(ratio, np.sqrt(ratio))


def _in_place(
    new: ContactPoints,
    old: ContactPoints | None,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
    left: ContactPoints,
) -> tuple[Floats, Floats]:
    """Reference and slip (m,) of what is found in place of joints that were ``left``.

    It is pressed by what it overlaps, or by the share of that with which all springs between two
    bodies hold no more energy than joints and faces did.
    """
    old = left if old is None else concatenate([left, old.take(old.length > 0)])
    pair_old, pair_new = _matched(old, new, body)
    held, asked = (
        np.bincount(pair, stiffness(one) * np.minimum(one.gap, 0.0) ** 2, 1 + pair_old.max())
        for one, pair in ((old, pair_old), (new, pair_new))
    )
    wanted = np.maximum(asked, np.finfo(float).tiny)
    share = np.sqrt(np.minimum(held / wanted, 1.0))[pair_new]
    return new.gap * (1 - share), share * _mean_slip(new, left, body)


def _mean_slip(new: ContactPoints, left: ContactPoints, body: Ints) -> Floats:
    """Stretch (m,) along the faces that pressed joints of the same two bodies had, by length."""
    pair, which = np.unique(_pairs(left, body), return_inverse=True)
    weight = np.where(left.normal_force < 0, left.length, 0.0)
    total, length = (np.bincount(which, weight * one) for one in (left.slip, np.ones(len(left))))
    mean = np.divide(total, length, out=np.zeros(len(pair)), where=length > 0)
    return mean[np.searchsorted(pair, _pairs(new, body))]


def _beside(born: ContactPoints, old: ContactPoints, body: Ints) -> Floats:
    """Stretch (m,) of the most pressed contact that the same two bodies had on faces."""
    faces = old.take(old.length > 0)
    pair_old, pair_born = _matched(faces, born, body)
    least = np.zeros(1 + int(max(pair_old.max(initial=0), pair_born.max(initial=0))))
    np.minimum.at(least, pair_old, faces.gap)
    return least[pair_born]


def _matched(old: ContactPoints, new: ContactPoints, body: Ints) -> tuple[Ints, Ints]:
    """Numbers of the two bodies of old and new points, the same for the same bodies."""
    pairs = np.concatenate([_pairs(old, body), _pairs(new, body)])
    which = np.unique(pairs, return_inverse=True)[1]
    return which[: len(old)], which[len(old) :]


def _pairs(points: ContactPoints, body: Ints) -> Ints:
    """Key (m,) of the two bodies of each point."""
    count = int(body.max(initial=0)) + 1
    return unordered_key(body[points.edge_a], body[points.edge_b], count)
