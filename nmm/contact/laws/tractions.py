"""Contact forces from gap and slip by the interface laws, with tangents and history."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.laws.contact_laws import ContactLaws, Springs
from nmm.contact.points.contact_points import ContactPoints
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import History
from nmm.interfaces.response import Traction


@dataclass(frozen=True)
class ContactForces:
    """Response of the contacts.

    Attributes
    ----------
    force
        (m, 2) pull and shear (N).
    history
        Of the laws, afterwards.
    slopes
        Computes `tangent` when it is first read.
    """

    force: Floats
    history: History
    slopes: Callable[[], Floats]

    @cached_property
    def tangent(self) -> Floats:
        """Derivatives (m, 2, 2) of the force by gap and slip (N/m)."""
        return self.slopes()


def contact_forces(
    laws: ContactLaws,
    contacts: ContactPoints,
    gap: Floats,
    slip: Floats,
    springs: Springs,
    whole: Bools,
) -> ContactForces:
    """Return the forces at gaps and elastic slips (m,) in m; see `InterfaceLaw.update`.

    ``whole`` (m,) are springs without limits: when they break, or soften, is judged elsewhere.
    """
    m = len(contacts)
    force, answers = np.zeros((m, 2)), list[tuple[Ints, Traction]]()
    after = {name: column.copy() for name, column in contacts.history.items()}
    area = np.where(contacts.is_joint, contacts.length * laws.thickness, 1.0)
    for law, index, history in laws.by_law(contacts):
        for joints in (True, False):
            some = index[(contacts.is_joint[index] == joints) & ~whole[index]]
            if not len(some):
                continue
            known = {name: contacts.history[name][some] for name in history}
            stiff = (springs[0][some] / area[some], springs[1][some] / area[some])
            total = slip[some] + known["plastic_slip"]
            found = _lasting(law, joints).update(known, gap[some], total, stiff)
            force[some] = found.traction * area[some, None]
            answers.append((some, found))
            for name, column in found.history.items():
                after[name][some] = column
    for axis, way in enumerate((gap, slip)):
        force[whole, axis] = springs[axis][whole] * way[whole]

    def slopes() -> Floats:
        tangent = np.zeros((m, 2, 2))
        for some, found in answers:
            tangent[some] = found.tangent * area[some, None, None]
        for axis in range(2):
            tangent[whole, axis, axis] = springs[axis][whole]
        return tangent

    return ContactForces(force, after, slopes)


def _lasting(law: InterfaceLaw, joints: bool) -> InterfaceLaw:
    """Return a law without cohesion for what is found by search, which has no area."""
    return law if joints or not law.cohesion else replace(law, cohesion=0.0)
