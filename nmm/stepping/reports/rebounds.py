"""Bodies that an exact enforcement throws apart where steps do not resolve their impact.

A force that lasts a step and closes a gap in it moves bodies by half of what it changes their
velocities by: in that step or the next they part by where the impact fell in the step, between not
at all and as fast as they met. Rigid bodies that meet without restitution stay together (Moreau
1988). Velocities are those of bodies as a whole, and bodies whose waves steps resolve, which
rebound truly, are left out.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import some
from integration.plane_vectors import counterclockwise, cross
from nmm.assembly.moving.momenta import resultants
from nmm.assembly.state import State

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.contact.model_contact import ModelContact
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.solution.record import ContactSolution


@dataclass(frozen=True)
class Rebound:
    """What bodies have as they part at the end of a step at whose start they approached.

    Attributes
    ----------
    energy
        Of separation, the reduced mass of both at their contact times half the square of how fast
        they part there (J); the sum of all pairs.
    met, parts
        How fast those of the largest energy met and part (m/s).
    bodies
        (2,) their numbers.
    """

    energy: float
    met: float
    parts: float
    bodies: Ints


def rebound(
    model: "Model",
    contact: "ModelContact",
    solved: "ContactSolution",
    before: State,
    after: State,
    force: Callable[[], Floats],
) -> Rebound | None:
    """Return the energy of bodies that an impact parts in one step; None where none does.

    ``force`` returns what acts on the unknowns but contact (n,), in N.
    """
    contacts = solved.contacts
    presses = (solved.answer.normal_force < 0) & ~contacts.bonded
    presses &= ~contact.laws.has_stiffness[contacts.interface]
    if not some(presses):
        return None
    points = contacts.take(presses)
    owner = model.manifold.boundary.body
    bodies = np.stack([owner[points.edge_a], owner[points.edge_b]])
    place = contact.partners.surface(before).at(*points.sides[0])
    first, last = (_parting(model, state, points, place, bodies) for state in (before, after))
    thrown = (first < 0) & (last > 0)
    if not some(thrown):
        return None
    given, step = _given(model, contact.momentum.compliance, force()), after.time - before.time
    thrown &= _crossed(model)[bodies].min(axis=0) < step
    # What rests is shaken by no more than what weight gives in a step.
    thrown &= -first > step * given[bodies].sum(axis=0)
    each = _reduced(contact.momentum.compliance, before, points, place, bodies) * last**2 / 2
    each = np.where(thrown, each, 0.0)
    at = int(each.argmax())
    if each[at] == 0:
        return None
    return Rebound(_of_pairs(each, bodies), -float(first[at]), float(last[at]), bodies[:, at])


def _given(model: "Model", compliance: Floats, force: Floats) -> Floats:
    """Acceleration (B,) in m/s2 that forces (n,) give to bodies as a whole."""
    pull = resultants(model, force) * compliance.reshape(-1, 3)
    return np.asarray(np.hypot(*pull[:, :2].T))


def _crossed(model: "Model") -> Floats:
    """Time (B,) in s in which waves cross bodies, a bar's of their mean stiffness and mass."""
    manifold = model.manifold
    area, owner = manifold.body_area, manifold.element_body
    weighed = (model.density * model.element_area, model.modulus * model.element_area)
    mass, stiffness = (np.bincount(owner, one, len(area)) for one in weighed)
    return np.asarray(np.sqrt(area * mass / stiffness))


def _parting(
    model: "Model", state: State, points: "ContactPoints", place: Floats, bodies: Ints
) -> Floats:
    """Velocity (m,) at which rigid bodies (2, m) part at places (m, 2) along the normals."""
    rigid = np.asarray(model.rigid_projection @ state.velocity).reshape(-1, 3)
    one, other = (
        state.frames.to_global(body, rigid[body, :2])
        + rigid[body, 2:] * counterclockwise(place - state.frames.centre[body])
        for body in bodies
    )
    return np.asarray(((one - other) * points.normal).sum(axis=1))


def _reduced(
    compliance: Floats, state: State, points: "ContactPoints", place: Floats, bodies: Ints
) -> Floats:
    """Reduced mass (m,) in kg of bodies (2, m) for a push along the normals; 0 if none moves."""
    inverse = compliance.reshape(-1, 3)
    each = (
        inverse[body, 0]
        + inverse[body, 2] * cross(place - state.frames.centre[body], points.normal) ** 2
        for body in bodies
    )
    gives = np.asarray(sum(each))
    return np.asarray(np.divide(1.0, gives, out=np.zeros(len(place)), where=gives > 0))


def _of_pairs(each: Floats, bodies: Ints) -> float:
    """Sum over pairs of bodies (2, m) of the largest of their energies (m,), J."""
    _, pair = np.unique(np.sort(bodies, axis=0), axis=1, return_inverse=True)
    largest = np.zeros(len(each))
    np.maximum.at(largest, pair.ravel(), each)
    return float(largest.sum())
