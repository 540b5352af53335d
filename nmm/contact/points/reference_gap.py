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
        givers = left if old is None else concatenate([left, old.take(old.length > 0)])
        taker, slip = new.take(instead), new.slip.copy()
        share = _share(taker, givers, stiffness, body)
        reference[instead] = taker.gap * (1 - share)
        slip[instead] = share * _mean_slip(taker, left, body)
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


def _share(
    new: ContactPoints,
    old: ContactPoints,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
) -> Floats:
    """Share (m,) of overlaps with which springs hold no more energy than those of ``old`` did.

    Energies are of all contacts of two bodies; what they overlap by is what they are pressed by.
    """
    _, which = np.unique(
        np.concatenate([_pairs(old, body), _pairs(new, body)]), return_inverse=True
    )
    held, asked = (
        np.bincount(which[some], stiffness(one) * np.minimum(one.gap, 0.0) ** 2, which.max() + 1)
        for one, some in ((old, slice(len(old))), (new, slice(len(old), None)))
    )
    wanted = np.maximum(asked, np.finfo(float).tiny)
    return np.sqrt(np.minimum(held / wanted, 1.0))[which[len(old) :]]


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
    pair_old, pair_born = _pairs(faces, body), _pairs(born, body)
    pair, which = np.unique(np.concatenate([pair_old, pair_born]), return_inverse=True)
    least = np.zeros(len(pair))
    np.minimum.at(least, which[: len(faces)], faces.gap)
    return least[which[len(faces) :]]


def _pairs(points: ContactPoints, body: Ints) -> Ints:
    """Key (m,) of the two bodies of each point."""
    count = int(body.max(initial=0)) + 1
    return unordered_key(body[points.edge_a], body[points.edge_b], count)
