"""Bonds that a solution overloads, and contacts after these bonds have broken."""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import BROKEN, Limits, StepAnswer

# Loads on bonds of a symmetric structure agree to rounding only; those within this of the worst
# break together, so that a symmetric mesh stays symmetric.
TIE = 1e-6


def breaking(
    laws: ContactLaws, contacts: ContactPoints, answer: StepAnswer, worst_only: bool
) -> Bools:
    """Return which intact bonds (m,) are overloaded by the forces of a solution.

    With ``worst_only`` only the most overloaded ones; the others are judged again after forces
    have been redistributed, so that the order of failure does not depend on the load increment.
    Whole bonds that begin to soften do so together, since no force jumps.
    """
    if not laws.hold(contacts):
        return np.zeros(contacts.gap.shape, dtype=bool)
    load = overload(laws, contacts, answer)
    over, brittle = load > 1, laws.brittle[contacts.interface]
    if worst_only and (over & brittle).any():
        over &= ~brittle | (load >= load[brittle].max() * (1 - TIE))
    return over


def overload(
    laws: ContactLaws,
    contacts: ContactPoints,
    answer: StepAnswer | ContactPoints,
    beginning: Bools | None = None,
) -> Floats:
    """Return load over strength (m,) of the bonds that break or begin to soften above one.

    ``beginning`` (m,) are those that begin to soften beside the ones that are tied.
    """
    load = np.zeros(len(contacts))
    bonds = np.flatnonzero(contacts.bonded)
    area = contacts.length[bonds] * laws.thickness
    for number, law in enumerate(laws.laws if len(bonds) else ()):
        mine = contacts.interface[bonds] == number
        index = bonds[mine]
        forces = (answer.normal_force[index], answer.shear_force[index])
        stress = [force / area[mine] for force in forces]
        whole = contacts.tied[index]
        whole = whole if beginning is None else whole | beginning[index]
        load[index] = np.where(whole, law.onset(*stress), law.overload(*stress))
    return load


def break_bonds(laws: ContactLaws, contacts: ContactPoints, broken: Bools) -> ContactPoints:
    """Return the contacts with some bonds broken for good, their forces gone."""
    history = {name: column.copy() for name, column in contacts.history.items()}
    for law, index, own in laws.by_law(contacts):
        gone, lost = broken[index], law.broken(own)
        for name, column in lost.items():
            history[name][index[gone]] = column[gone]
    return replace(
        contacts,
        history=history,
        state=np.where(broken, int(BROKEN), contacts.state),
        normal_force=np.where(broken, 0.0, contacts.normal_force),
        shear_force=np.where(broken, 0.0, contacts.shear_force),
        slip=np.where(broken, 0.0, contacts.slip),
    )


def strength(laws: ContactLaws, contacts: ContactPoints) -> Limits:
    """Return the force limits with the strength of intact bonds, which steps judge apart.

    The shear that a bond which softens bears is ``c + mu max(p, 0)``, not less under tension ``T``.
    No line of slope ``mu`` below ``c + mu (p + T)`` bounds that.
    """
    limits = laws.response(contacts, laws.springs(contacts)[0]).limits
    tension, cohesion = limits.tension.copy(), limits.cohesion.copy()
    for law, index, _ in laws.by_law(contacts):
        area = contacts.length[index] * laws.thickness
        tension[index] = np.minimum(tension[index], law.tensile_strength * area)
        cohesion[index] = np.where(
            np.isfinite(cohesion[index]), cohesion[index], law.cohesion * area
        )
    softens = contacts.bonded & ~laws.brittle[contacts.interface]
    cohesion += np.where(softens, limits.friction * tension, 0.0)
    return Limits(tension, cohesion, limits.friction)
