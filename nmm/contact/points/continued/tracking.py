"""Contact points that search finds, from step to step: what they keep of those they continue."""

from collections.abc import Callable
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints, same
from nmm.contact.detection.contacts import Contacts, FaceContacts
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, StepAnswer
from nmm.frozen import with_parts
from nmm.interfaces.history import History

# From points to where their sides a are from their sides b (m, 2).
Apart = Callable[[ContactPoints], Floats]

# What a contact that goes on keeps.
CARRIED = ("slip", "slid", "state", "normal_force", "shear_force")


def searched_points(
    found: Contacts, interface: Ints, history: History, surface: Surface
) -> ContactPoints:
    """Return found contacts as points with the initial history of contacts without bond.

    Those that stand for a segment of a face are as stiff as that is long: as stiff as a vertex of
    the body with the shorter edges on ``surface`` when it is half of such an edge.
    """
    m = len(found.gap)
    zeros = np.zeros(m)
    length, parameter_a, factor = zeros, zeros, np.ones(m)
    if isinstance(found, FaceContacts):
        length, parameter_a = found.length, found.parameter_a
        grain = np.minimum(surface.grain[found.vertex], surface.grain[found.edge])
        factor = np.where(length > 0, length / grain, 1.0)
    return ContactPoints.unloaded(
        edge_a=found.vertex,
        parameter_a=parameter_a,
        edge_b=found.edge,
        parameter_b=found.parameter,
        normal=found.normal,
        gap=found.gap,
        length=length,
        spring_factor=factor,
        interface=interface,
        key=found.key,
        state=np.full(m, int(OPEN)),
        history=history,
    )


def remember(new: ContactPoints, before: Predecessors) -> ContactPoints:
    """Return the new points with state, forces, slip and history of the old ones they continue.

    A point that goes on under another interface keeps no history.
    """
    old, number = before.old, before.number
    if len(old) == len(new) and np.array_equal(number, np.arange(len(new))):
        return with_parts(
            new, history=old.history, **{name: getattr(old, name) for name in CARRIED}
        )
    if not old.gap.size:
        return new
    kept: dict[str, Any] = {
        name: np.where(before.known, getattr(old, name)[before.source], getattr(new, name))
        for name in CARRIED
    }
    return with_parts(new, history=new.inherited(old, number), **kept)


def continues(old: Contacts | None, new: Contacts) -> bool:
    """Whether search has found the pairs of the last step, corners before edges alone."""
    if old is None or type(old) is not Contacts or type(new) is not Contacts:
        return False
    return same(old.key, new.key)


def continued(old: ContactPoints, found: Contacts) -> ContactPoints:
    """Return the points of the last step where search finds them now, gaps as measured.

    All else are the same objects, which tells that nothing made of them alone has changed.
    """
    return with_parts(old, parameter_b=found.parameter, normal=found.normal, gap=found.gap)


def answered(points: ContactPoints, answer: StepAnswer, once_bonded: Bools) -> ContactPoints:
    """Return the points as an answer leaves them; ``once_bonded`` (m,) had a bond at the start."""
    parted = once_bonded & points.is_joint & (answer.state == int(OPEN))
    state = np.where(parted, int(BROKEN), answer.state)
    return with_parts(
        points,
        gap=answer.gap,
        slip=answer.slip,
        slid=np.zeros(len(points)),
        state=np.where(points.bonded, int(BONDED), state),
        normal_force=answer.normal_force,
        shear_force=answer.shear_force,
    )


def apart_on(surface: Surface, points: ContactPoints) -> Floats:
    """Where sides a of points are from sides b (m, 2), on the chords of the edges."""
    one, other = (surface.at(*side) for side in points.sides)
    return np.asarray(one - other)
