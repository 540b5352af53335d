"""From consistent terms to the bond's own law, when and where the bond is overloaded.

The law's spring takes over the traction that the terms carried there. Where the bond stands open it
is as soft as that asks for, so that what is open counts; elsewhere the distance at which it is free
of stress is laid so. A bond that softens passes from one to the other without a jump, and one that
breaks while it is pressed stays pressed. The bond that is left alone in the joint keeps its
traction too: what the penalty counts of its jump is from then on all of it.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.bonds.turning import beside, counted
from nmm.contact.laws.contact_laws import ContactLaws, Springs
from nmm.contact.laws.failing_bonds import break_bonds
from nmm.contact.points.contact_points import TIED, ContactPoints
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.interfaces.limits import Limits

# Stiffness of the springs that go on, in penalties of the terms: of bonds that are broken or shear
# under pressure, and most of those that soften in tension. These unload by their strength over it
# while they open, which is missing in the energy that they take. With the second under pressure,
# too, friction beside them did not come to balance.
FIRM, RIGID = 100.0, 1e4
# Stiffness of the softest springs, in those under which force would fall at a standstill. At ``a``
# times that damage grows by ``a / (a - 1)`` of what opens: at 2 iterations stall.
ABOVE_LEAST = 10.0

# Contacts with forces and jumps (m,) at an instant: as they stand, or as an answer leaves them.
LoadedContacts = ContactPoints | StepAnswer


def given_way(
    laws: ContactLaws,
    contacts: ContactPoints,
    gone: tuple[Bools, Bools],
    loaded: LoadedContacts,
    springs: Springs,
    limits: Limits,
) -> tuple[ContactPoints, float]:
    """Return contacts with overloaded bonds released or broken, and the energy of `released` (J).

    ``gone`` marks the overloaded bonds (m,), and the brittle ones among them.
    """
    (overloaded, brittle), stored = gone, 0.0
    freed = overloaded & contacts.tied
    if freed.any():
        least = laws.least_stiffness(contacts)
        contacts, stored = released(contacts, freed, brittle, loaded, springs, limits, least)
    return break_bonds(laws, contacts, brittle), stored


def released(
    contacts: ContactPoints,
    gone: Bools,
    lost: Bools,
    loaded: LoadedContacts,
    springs: Springs,
    limits: Limits,
    least: Floats,
) -> tuple[ContactPoints, float]:
    """Return the contacts with bonds handed over to their laws, or broken, from now on.

    And the energy (J) of the terms as they are taken over less that of the springs that follow:
    firm springs tell nothing where the step begins, from which a coarse increment may stretch them
    far.

    Parameters
    ----------
    contacts
        As the step begins, still whole.
    gone, lost
        (m,) which tied bonds are released, and which bonds break at once.
    loaded
        What the terms carried that is taken over: in statics at the end of the step, under the load
        that breaks them, and in time at its start, which springs act from.
    springs
        Of whole bonds, as stiff as the penalty of the terms.
    limits
        Of the laws; what goes beyond is not taken over.
    least
        (m,) normal stiffness that springs of the laws must exceed (N/m).
    """
    held, (penalty, shear_penalty, _) = contacts.bonded & ~lost, springs
    firm = np.where(held, _firm(loaded.normal_force, loaded.gap, penalty, least), FIRM)
    normal, tangent = firm * penalty, firm * shear_penalty
    pull = np.minimum(loaded.normal_force, np.where(held, limits.tension, 0.0))
    bound = limits.cohesion + limits.friction * np.maximum(-pull, 0.0)
    shear = np.where(held, np.clip(loaded.shear_force, -bound, bound), 0.0)
    # A broken bond that nothing presses is free where it lies.
    pressed, left = gone & (held | (pull < 0)), beside(contacts, gone)
    lag = np.where(pressed, loaded.gap - pull / normal, 0.0)
    slid = np.where(gone & held, loaded.slip - shear / tangent, 0.0)
    lag = np.where(left, loaded.gap - counted(contacts, loaded.gap), lag)
    slid = np.where(left, loaded.slip - counted(contacts, loaded.slip), slid)
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
    firms, jumps = (penalty, shear_penalty), (loaded.gap - lag, loaded.slip - slid)
    before = tied_energy(contacts, loaded, firms)
    springs_hold = normal * jumps[0] ** 2 / 2 + tangent * jumps[1] ** 2 / 2
    after = np.where(left, _alone(contacts, loaded, jumps, firms), springs_hold)
    kept = gone & held
    return found, float((before - after)[kept | beside(contacts, kept)].sum())


def _firm(pull: Floats, gap: Floats, penalty: Floats, least: Floats) -> Floats:
    """Stiffness (m,) in penalties of springs that carry a pull where bonds stand open already.

    Terms let a bond open a little where stress varies from cell to cell. A spring that is as long
    goes on without a jump of the traction, and what is open counts as opened, as far as that
    leaves it as firm as its law asks for. What is pressed is as firm as a broken bond.
    """
    is_open = (pull > 0) & (gap > 0)
    found = pull / np.where(is_open, penalty * gap, 1.0)
    found = np.where(is_open, np.clip(found, 1.0, RIGID), np.where(pull < 0, FIRM, RIGID))
    return np.asarray(np.maximum(found, ABOVE_LEAST * least / penalty))


def _alone(
    contacts: ContactPoints,
    loaded: LoadedContacts,
    jumps: tuple[Floats, Floats],
    penalty: tuple[Floats, Floats],
) -> Floats:
    """Energy (m,) of terms under a load once all of their ``jumps`` (m) count (J)."""
    total = np.zeros(len(contacts))
    rows = (loaded.normal_force, loaded.gap), (loaded.shear_force, loaded.slip)
    for (force, jump), anew, firm in zip(rows, jumps, penalty, strict=True):
        total += anew * (force - firm * counted(contacts, jump) + firm * anew / 2)
    return total


def tied_energy(
    contacts: ContactPoints, loaded: LoadedContacts, penalty: tuple[Floats, Floats]
) -> Floats:
    """Energy (m,) of terms, ``g (A S q + h / 2)`` with the held part ``h`` of ``f = A S q + h``."""
    total = np.zeros(len(contacts))
    both = (loaded.normal_force, loaded.gap), (loaded.shear_force, loaded.slip)
    for (force, jump), firm in zip(both, penalty, strict=True):
        total += jump * (force - firm * counted(contacts, jump) / 2)
    return total


def lost_energy(
    problem: StepProblem, loaded: LoadedContacts, broken: Bools, contacts: ContactPoints
) -> float:
    """Energy (J) of tension and shear that breaking bonds lose, in springs or consistent terms.

    The energy of compression stays in the spring of the joint.
    """
    stiffness = problem.normal_stiffness, problem.shear_stiffness
    springs = stiffness[0] * np.maximum(loaded.gap, 0.0) ** 2 + stiffness[1] * loaded.slip**2
    terms = tied_energy(contacts, loaded, stiffness)
    return float(np.where(contacts.tied, terms, springs / 2)[broken].sum())
