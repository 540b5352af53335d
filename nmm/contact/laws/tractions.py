"""Forces of contact points as their laws answer a gap and a slip, with tangents and history."""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import History

# Normal and shear stiffness (m,) in N/m, and which are a law's own.
Springs = tuple[Floats, Floats, Bools]


@dataclass(frozen=True)
class ContactForces:
    """What contacts answer.

    Attributes
    ----------
    force
        (m, 2) pull and shear (N).
    tangent
        (m, 2, 2) by gap and slip (N/m).
    history
        Of the laws, afterwards.
    """

    force: Floats
    tangent: Floats
    history: History


def contact_forces(
    laws: ContactLaws, contacts: ContactPoints, gap: Floats, slip: Floats, springs: Springs
) -> ContactForces:
    """Return the forces at gaps and elastic slips (m,) in m; see `InterfaceLaw.update`.

    Bonds that break at once are springs here: when they break is judged elsewhere.
    """
    m = len(contacts)
    force, tangent = np.zeros((m, 2)), np.zeros((m, 2, 2))
    after = {name: column.copy() for name, column in contacts.history.items()}
    area = np.where(contacts.is_joint, contacts.length * laws.thickness, 1.0)
    whole = contacts.bonded & laws.brittle[contacts.interface]
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
            tangent[some] = found.tangent * area[some, None, None]
            for name, column in found.history.items():
                after[name][some] = column
    for axis, way in enumerate((gap, slip)):
        force[whole, axis] = springs[axis][whole] * way[whole]
        tangent[whole, axis, axis] = springs[axis][whole]
    return ContactForces(force, tangent, after)


def _lasting(law: InterfaceLaw, joints: bool) -> InterfaceLaw:
    """Return a law without cohesion for what is found by search, which has no area."""
    return law if joints or not law.cohesion else replace(law, cohesion=0.0)
