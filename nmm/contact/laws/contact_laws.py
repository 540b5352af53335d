"""Interface laws at contact points: force limits, springs, history and stored energy."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import summed
from nmm.contact.laws.law_facts import LawFacts
from nmm.contact.points.contact_points import TIED, ContactPoints
from nmm.contact.points.kept import of_pairs
from nmm.contact.problem.step_problem import Limits
from nmm.errors import SceneError
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import KEPT, History
from nmm.interfaces.response import InterfaceResponse

Springs = tuple[Floats, Floats, Bools]
"""Normal and shear stiffness (m,) in N/m, and which are a law's own."""


@dataclass(frozen=True)
class ContactLaws(LawFacts):
    """Interface laws of a scene and the springs that carry them.

    Attributes
    ----------
    thickness
        m.
    normal_penalty, shear_penalty
        N/m of a vertex contact.
    normal_bond, shear_bond
        Pa m of a joint whose law has no stiffness of its own: its spring is this times the joint's
        length over the distance of the blocks' middles, so that between Voronoi blocks a uniform
        strain gives a uniform stress on all joints (Kawai 1978).
    consistent
        Whether whole bonds whose law has no stiffness of its own are held by consistent terms.
    names
        Of the laws, as their tables in a scene have them, for what is said of them.
    """

    thickness: float
    normal_penalty: float
    shear_penalty: float
    normal_bond: float
    shear_bond: float
    consistent: bool = False
    names: tuple[str, ...] = ()

    def initial(self, interface: Ints, bonded: Bools) -> History:
        """Return the initial history (m,) of contacts with or without a bond."""
        found: dict[str, Any] = {}
        for number, law in enumerate(self.laws):
            for name, column in law.initial(bonded).items():
                kept = found.setdefault(name, np.zeros(len(bonded), dtype=column.dtype))
                found[name] = np.where(interface == number, column, kept)
        return found | ({TIED: np.zeros(len(bonded))} if self.consistent else {})

    def response(self, contacts: ContactPoints, stiffness: Floats) -> InterfaceResponse:
        """Return limits (N), springs and lift of contacts under their present history.

        ``stiffness`` (m,) is that of the whole bonds (N/m).
        """
        if not self.evolving and stiffness is self.springs(contacts)[0]:
            return self._lasting_response(contacts)
        return self._response_of(contacts, stiffness)

    @of_pairs
    def _lasting_response(self, contacts: ContactPoints) -> InterfaceResponse:
        """Return the response of laws without internal variables besides their bonds."""
        return self._response_of(contacts, self.springs(contacts)[0])

    def _response_of(self, contacts: ContactPoints, stiffness: Floats) -> InterfaceResponse:
        m = len(contacts)
        tension, cohesion, friction, rise = (np.zeros(m) for _ in range(4))
        open_share = np.ones(m)
        # Cohesion is lost with the joint: what is found by search has none.
        area = self.areas(contacts)
        for law, index, history in self.by_law(contacts):
            own = law.response(history, _over(stiffness, area)[index])
            tension[index] = _times(own.limits.tension, area[index])
            cohesion[index] = _times(own.limits.cohesion, area[index])
            friction[index] = own.limits.friction
            open_share[index], rise[index] = own.open_share, own.rise
        return InterfaceResponse(Limits(tension, cohesion, friction), open_share, rise)

    def evolved(
        self, contacts: ContactPoints, gap: Floats, sliding: Floats, stiffness: Floats
    ) -> History:
        """Return the history after a step; see `InterfaceLaw.evolved`.

        ``stiffness`` (m,) is that of the whole bonds (N/m). Columns that stay are the same objects.
        """
        after, spring = dict(contacts.history), _over(stiffness, self.areas(contacts))
        if TIED in after:  # no spring of whole bonds may be too soft: terms hold them
            spring = np.where(contacts.tied, np.inf, spring)
        for law, index, history in self.by_law(contacts):
            if index.shape == contacts.gap.shape:
                after |= law.evolved(history, gap, sliding, spring)
                continue
            given = gap[index], sliding[index], spring[index]
            for name, column in law.evolved(history, *given).items():
                if not np.array_equal(column, history[name]):
                    after[name] = after[name].copy()
                    after[name][index] = column
        if TIED not in contacts.history:
            return after
        tied = contacts.tied
        for name, column in contacts.history.items() if tied.any() else ():
            after[name] = np.where(tied, column, after[name])
        return after

    def refuse_soft(self, joints: ContactPoints) -> None:
        """Refuse bonds whose springs are too soft for the softening of their law.

        Raises
        ------
        SceneError
            As `InterfaceLaw.evolved` would in the middle of a run.
        """
        if not self.evolving or not len(joints):
            return
        spring = _over(self.normal_stiffness(joints), self.areas(joints))
        for number, (law, index, history) in enumerate(self.by_law(joints)):
            still = np.zeros(len(spring[index]))
            try:
                law.evolved(history, still, still, spring[index])
            except SceneError as error:
                told = [f"[interfaces.{name}] " for name in self.names[number : number + 1]]
                raise SceneError("".join([*told, str(error)])) from None

    @of_pairs
    def springs(self, contacts: ContactPoints) -> Springs:
        """Return the springs of whole bonds."""
        own = contacts.is_joint.copy()
        normal = np.where(own, self.normal_bond, self.normal_penalty) * contacts.spring_factor
        shear = np.where(own, self.shear_bond, self.shear_penalty) * contacts.spring_factor
        for law, index in self.stiff_laws(contacts):
            assert law.normal_stiffness is not None
            ratio = (law.shear_stiffness or law.normal_stiffness) / law.normal_stiffness
            joint = index[contacts.is_joint[index]]
            normal[joint] = law.normal_stiffness * contacts.length[joint] * self.thickness
            shear[index] = normal[index] * ratio
            own[index] = True
        return normal, shear, own

    def normal_stiffness(self, contacts: ContactPoints) -> Floats:
        """Return the normal stiffness (m,) of whole bonds (N/m)."""
        return self.springs(contacts)[0]

    def least_stiffness(self, contacts: ContactPoints) -> Floats:
        """Return the normal stiffness (m,) that springs of bonds must exceed (N/m)."""
        least = np.array([law.least_stiffness for law in self.laws])
        return np.asarray(least[contacts.interface] * self.areas(contacts))

    def energy(self, contacts: ContactPoints, own_only: bool = False) -> float:
        """Recoverable energy (J) of the contacts, without that of tied bonds.

        With ``own_only`` only of contacts whose law has a stiffness or a damper: exact contacts are
        no springs, and what they overlap by within the tolerance stores nothing. A spring that its
        damper holds back keeps the energy of its compression while no force acts.
        """
        normal, shear, own = self.springs(contacts)
        bonded, free = contacts.bonded, ~contacts.tied
        damped = self.damped(contacts) & free
        pressed_by = contacts.gap
        if self.evolving:
            response = self.response(contacts, normal)
            away = bonded & (contacts.gap > 0)
            normal = normal * np.where(away, response.open_share, 1.0)
            pressed_by = contacts.gap - response.rise
        # Bonds carry what their stretch says, also where they were laid just now.
        acts = bonded | (contacts.normal_force != 0) | (contacts.shear_force != 0)
        acts &= (own | damped | (not own_only)) & free
        stretch = np.where(bonded, pressed_by, np.minimum(pressed_by, 0.0))
        pressed = summed((normal * stretch**2)[acts | damped])
        return float(pressed + summed((shear * contacts.slip**2)[acts])) / 2

    @of_pairs
    def hold(self, contacts: ContactPoints) -> bool:
        """Return whether bonds hold any of the contacts."""
        return bool(contacts.bonded.any())

    @of_pairs
    def damping(self, contacts: ContactPoints) -> Floats:
        """Return the share (m,) of critical damping of each contact."""
        return np.array([law.damping for law in self.laws])[contacts.interface]

    def damped(self, contacts: ContactPoints) -> Bools | bool:
        """Return which contacts (m,) have a damper: in time these are springs, exact or not."""
        return self.damping(contacts) > 0 if self.damps else False

    @of_pairs
    def areas(self, contacts: ContactPoints) -> Floats:
        """Areas (m,) in m2 of joints; zero of what is found by search."""
        return np.where(contacts.is_joint, contacts.length * self.thickness, 0.0)

    def stiff_laws(self, contacts: ContactPoints) -> list[tuple[InterfaceLaw, Ints]]:
        """Return the laws that have a stiffness of their own, each with its contacts."""
        return [one for one in self._members(contacts) if one[0].normal_stiffness is not None]

    def by_law(self, contacts: ContactPoints) -> Iterator[tuple[InterfaceLaw, Ints, History]]:
        """Yield each law with its contacts and their history, columns of its own alone."""
        for law, index in self._members(contacts):
            names, known = (*KEPT, *law.columns), contacts.history
            if index.shape == contacts.gap.shape:
                yield law, index, {name: known[name] for name in names}
            else:
                yield law, index, {name: known[name][index] for name in names}

    @of_pairs
    def _members(self, contacts: ContactPoints) -> list[tuple[InterfaceLaw, Ints]]:
        """Each law with its contacts."""
        index = (np.flatnonzero(contacts.interface == number) for number in range(len(self.laws)))
        return list(zip(self.laws, index, strict=True))


def _over(force: Floats, area: Floats) -> Floats:
    """Force, or stiffness, over area (m,); itself where there is none."""
    return np.asarray(force / np.where(area > 0, area, 1.0))


def _times(stress: Floats, area: Floats) -> Floats:
    """Stress, which may be without limit, times area (m,); zero where there is none."""
    return np.where(area > 0, stress * np.where(area > 0, area, 1.0), 0.0)
