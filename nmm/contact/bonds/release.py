"""From consistent terms to the bond's own law, at the instant and place where it is called for.

The law's spring takes over the traction that the terms carried there. Where the bond stands open it
is as soft as that asks for, so that what is open counts; elsewhere the distance at which it is free
of stress is laid so. A bond that softens passes from one to the other without a jump, and one that
breaks while it is pressed stays pressed.
"""

from dataclasses import replace
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.points.contact_points import TIED, ContactPoints
from nmm.interfaces.limits import Limits

# Stiffness of the springs that go on, in penalties of the terms: of broken bonds, which press at
# most, and most of those that soften. These unload by their strength over it while they open, which
# is missing in the energy that they take.
FIRM, RIGID = 100.0, 1e4

# Normal and shear stiffness (m,) in N/m, and which are a law's own.
Springs = tuple[Floats, Floats, Bools]


class LoadedContacts(Protocol):
    """Forces and jumps (m,) of contacts at an instant."""

    @property
    def normal_force(self) -> Floats:
        """Pull (N)."""

    @property
    def shear_force(self) -> Floats:
        """Shear (N)."""

    @property
    def gap(self) -> Floats:
        """Gap (m)."""

    @property
    def slip(self) -> Floats:
        """Slip (m)."""


def released(
    contacts: ContactPoints, gone: Bools, answer: LoadedContacts, springs: Springs, limits: Limits
) -> tuple[ContactPoints, float]:
    """Return the contacts with bonds that their laws hold, or have lost, from now on.

    And by how much energy (J) the terms held more, as the step began, than the springs that go on.

    Parameters
    ----------
    contacts
        Of the step that the answer is of; bonds that break at once are marked as broken.
    gone
        (m,) which bonds are released.
    answer
        What the terms carried, at the end of the step.
    springs
        Of whole bonds, as stiff as the penalty of the terms.
    limits
        Of the laws; what goes beyond is not taken over.
    """
    held, (penalty, shear_penalty, _) = contacts.bonded, springs
    firm = np.where(held, _firm(answer.normal_force, answer.gap, penalty), FIRM)
    normal, tangent = firm * penalty, firm * shear_penalty
    pull = np.minimum(answer.normal_force, np.where(held, limits.tension, 0.0))
    bound = limits.cohesion + limits.friction * np.maximum(-pull, 0.0)
    shear = np.where(held, np.clip(answer.shear_force, -bound, bound), 0.0)
    # A broken bond that nothing presses is free where it lies.
    pressed = gone & (held | (pull < 0))
    lag = np.where(pressed, answer.gap - pull / normal, 0.0)
    slid = np.where(gone & held, answer.slip - shear / tangent, 0.0)
    history = contacts.history
    found = replace(
        contacts,
        gap=contacts.gap - lag,
        slip=contacts.slip - slid,
        reference=contacts.reference + lag,
        spring_factor=np.where(gone, firm, 1.0) * contacts.spring_factor,
        history={
            **history,
            TIED: np.where(gone, 0.0, history[TIED]),
            "plastic_slip": history["plastic_slip"] + slid,
        },
    )
    kept = gone & held
    terms = tied_energy(contacts.normal_force, contacts.gap, penalty)
    terms += tied_energy(contacts.shear_force, contacts.slip, penalty)
    anew = normal * found.gap**2 / 2 + tangent * found.slip**2 / 2
    return found, float((terms - anew)[kept].sum())


def tied_energy(force: Floats, jump: Floats, penalty: Floats) -> Floats:
    """Energy (m,) of terms: ``g (A S q + gamma A g / 2)`` with ``f = A S q + gamma A g`` (J)."""
    return np.asarray(jump * (force - penalty * jump / 2))


def _firm(pull: Floats, gap: Floats, penalty: Floats) -> Floats:
    """Stiffness (m,) in penalties of springs that carry a pull where bonds stand open already.

    Terms let a bond open a little where stress varies from cell to cell. A spring that is as long
    goes on without a jump of the traction, and what is open counts as opened.
    """
    is_open = (pull > 0) & (gap > 0)
    found = pull / np.where(is_open, penalty * gap, 1.0)
    return np.where(is_open, np.clip(found, 1.0, RIGID), RIGID)
