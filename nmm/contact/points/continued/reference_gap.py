"""The gap from which a contact counts: an overlap that no step has made stores no energy.

Search may find a vertex already inside a body: two corners have passed each other, or the scene
began so. A spring that entered loaded would push with energy from nowhere. Such a contact counts
its gap from what it was when it appeared, its *reference*. A contact that continues another one, at
the corner of a body or on the next body, takes over the stretch of that one's spring, and unless
springs are lasting a segment of two faces that are pressed together already is pressed like its
neighbours. What is found in place of a joint that has slid apart is pressed as the joint was.

The reference recovers without work: when the contact opens, what is left of the overlap becomes the
new reference, and it never grows again. Contacts that carry a stress of the ground as they are
drawn have one above zero until they open: they come apart by what that stress had closed them by.
So do those whose springs a change of the model has made softer.
"""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats, Ints
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.of_neighbours import beside, found_for, in_place_of
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.frozen import with_parts


def counted(
    new: ContactPoints,
    before: Predecessors,
    stiffness: Callable[[ContactPoints], Floats],
    body: Ints,
    left: ContactPoints,
    ahead: bool = False,
) -> ContactPoints:
    """Return new points with gaps counted from their references.

    Parameters
    ----------
    new, before
        Points as found, their gaps as measured (m), and what they continue.
    stiffness
        Normal stiffness (N/m) of contact points.
    body
        (E,) of the boundary edges.
    left
        Points of joints that the last step gave up, with gap and slip as it left them (m).
    ahead
        Whether contacts push before their sides touch.
    """
    reference, on_face, old = np.minimum(new.gap, 0.0), new.length > 0, before.old
    if len(old) and len(new):
        source, stays = before.source, before.stay(new)
        reference = np.where(stays, _shrunk(new.gap, old.take(source), ahead), reference)
        most = np.maximum(old.reference[source], 0.0)
        handed = np.flatnonzero(before.known & ~stays & (new.gap < most))
        if len(handed):
            giver, taker = old.take(source[handed]), new.take(handed)
            stretch = _passed_on(giver.gap, stiffness(giver) / stiffness(taker))
            reference[handed] = _from_stretch(taker.gap, stretch, most[handed])
        # A new segment of lasting springs is not pressed.
        born = np.flatnonzero(~before.known & on_face & ~before.lasting)
        if len(born):
            taker = new.take(born)
            stretch, most = beside(taker, old, body)
            reference[born] = _from_stretch(taker.gap, stretch, most)
    if len(left):
        # A joint stands for all of its length: segments beside it were not pressed so far.
        instead = (on_face | ~before.known) & (new.gap < 0) & found_for(left, new, body)
        reference, slip = reference.copy(), new.slip.copy()
        reference[instead], slip[instead] = in_place_of(
            new.take(instead), old, stiffness, body, left
        )
        new = with_parts(new, slip=slip)
    return with_parts(new, gap=new.gap - reference, reference=reference)


def counted_on(points: ContactPoints, ahead: bool = False) -> ContactPoints:
    """Return points that all go on, their gaps as measured (m), with gaps counted as they were."""
    reference = _shrunk(points.gap, points, ahead)
    return with_parts(points, gap=points.gap - reference, reference=reference)


def _shrunk(gap: Floats, old: ContactPoints, ahead: bool) -> Floats:
    """References (m,) of contacts that go on: an overlap that has become less is followed.

    Not while they push ``ahead`` of touch: they would begin anew, and push further, every time.
    """
    stays = gap < old.reference
    if ahead:
        stays |= (old.normal_force < 0) & (old.reference < 0)
    return np.where(stays, old.reference, np.minimum(gap, 0.0))


def _from_stretch(gap: Floats, stretch: Floats, most: Floats) -> Floats:
    """Reference (m,) with which contacts are stretched by so much, or as far as they overlap.

    What is open by less than ``most`` (m,) continues one that carried a stress as it was drawn.
    """
    wanted = np.minimum(gap - np.minimum(stretch, 0.0), most)
    return np.where(gap < most, wanted, np.minimum(gap, 0.0))


def _passed_on(stretch: Floats, ratio: Floats) -> Floats:
    """Stretch (m,) that gives a spring neither more force nor more energy than the last one had.

    ``ratio`` (m,) is the stiffness of the last one over that of the new one.
    """
    return stretch * np.minimum(ratio, np.sqrt(ratio))
