"""Which laws act at contact points: limits, springs, and bonds that break for good."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import BROKEN, Limits, StepAnswer
from nmm.interfaces.base import InterfaceLaw

# Loads on bonds of a symmetric structure agree to rounding only; those within this of the worst
# break together, so that a symmetric mesh stays symmetric.
TIE = 1e-6


@dataclass(frozen=True)
class Laws:
    """Interface laws of a scene and the springs that carry them.

    Attributes
    ----------
    laws
        One for each interface.
    thickness
        m.
    normal_penalty, shear_penalty
        N/m of a vertex contact.
    normal_bond, shear_bond
        Pa m of a joint whose law has no stiffness of its own: its spring is this times the joint's
        length over the distance of the blocks' middles, so that between Voronoi blocks a uniform
        strain gives a uniform stress on all joints (Kawai 1978).
    """

    laws: Sequence[InterfaceLaw]
    thickness: float
    normal_penalty: float
    shear_penalty: float
    normal_bond: float
    shear_bond: float

    def limits(self, contacts: ContactPoints) -> Limits:
        """Return the largest forces of the contacts; those without an interface are smooth."""
        tension, cohesion, friction = (np.zeros(len(contacts)) for _ in range(3))
        for law, index in self._by_law(contacts):
            # Cohesion is lost with the joint: what is found by search has none.
            length = np.where(contacts.is_joint, contacts.length, 0.0)[index]
            limits = law.limits(length, contacts.damage[index], self.thickness)
            tension[index], cohesion[index] = limits.tension, limits.cohesion
            friction[index] = limits.friction
        return Limits(tension, cohesion, friction)

    def strength(self, contacts: ContactPoints) -> Limits:
        """Return the limits with the strength of intact bonds, which has none within a step."""
        limits = self.limits(contacts)
        tension, cohesion = limits.tension.copy(), limits.cohesion.copy()
        for law, index in self._by_law(contacts):
            area = contacts.length[index] * self.thickness
            tension[index] = np.minimum(tension[index], law.tensile_strength * area)
            cohesion[index] = np.where(
                np.isfinite(cohesion[index]), cohesion[index], law.cohesion * area
            )
        return Limits(tension, cohesion, limits.friction)

    def springs(
        self, contacts: ContactPoints, opened: Bools | None = None
    ) -> tuple[Floats, Floats, Bools]:
        """Return normal and shear stiffness (N/m) and which are a law's own.

        Bonds that soften have what is left of their normal stiffness where they are ``opened``
        (m,), by default where the gap is positive.
        """
        own = contacts.is_joint.copy()
        normal = np.where(own, self.normal_bond, self.normal_penalty) * contacts.slenderness
        shear = np.where(own, self.shear_bond, self.shear_penalty) * contacts.slenderness
        for law, index in self._by_law(contacts):
            if law.normal_stiffness is not None:
                found = index[~contacts.is_joint[index]]
                own[found] = True
                shear[found] = normal[found] * _shear_ratio(law)
            index = index[contacts.is_joint[index]]
            area = contacts.length[index] * self.thickness
            if law.normal_stiffness is not None:
                normal[index] = law.normal_stiffness * area
                shear[index] = normal[index] * _shear_ratio(law)
            if law.softens:
                damage = contacts.damage[index]
                away = (contacts.gap > 0 if opened is None else opened)[index] & (damage < 1)
                share = law.secant(damage, normal[index] / area)
                normal[index] *= np.where(away, share, 1.0)
        return normal, shear, own

    def sized(self, contacts: ContactPoints, surface: Surface) -> ContactPoints:
        """Return found contacts as stiff as their laws ask for.

        A stretch of a face has its length; a mere vertex stands for half the edge that faces the
        other body, or half the other's if that is shorter, so that the two corners of a face that
        lies on a longer one carry all of it.
        """
        slenderness = contacts.slenderness.copy()
        for law, index in self._by_law(contacts):
            if law.normal_stiffness is not None:
                some = contacts.take(index)
                mere = _half_edge(surface, some.edge_a, some.edge_b)
                length = np.where(some.length > 0, some.length, mere)
                spring = law.normal_stiffness * length * self.thickness
                slenderness[index] = spring / self.normal_penalty
        return replace(contacts, slenderness=slenderness)

    @cached_property
    def stiff(self) -> bool:
        """Whether any law has a stiffness of its own."""
        return any(law.normal_stiffness is not None for law in self.laws)

    def energy(self, contacts: ContactPoints, own_only: bool = False) -> float:
        """Energy (J) that comes back when the contacts are unloaded.

        With ``own_only`` of those alone whose stiffness is a law's: exact contacts are no springs,
        what they overlap by, within a tolerance, stores nothing.
        """
        normal, shear, own = self.springs(contacts)
        acts = (contacts.normal_force != 0) | (contacts.shear_force != 0)
        acts &= own | (not own_only)
        stretch = np.where(contacts.damage < 1, contacts.gap, np.minimum(contacts.gap, 0.0))
        elastic = normal * stretch**2 + shear * contacts.slip**2
        return float(elastic[acts].sum() / 2)

    def softening(self, contacts: ContactPoints) -> Bools:
        """Return which contacts are bonds that lose their strength by and by."""
        soft: Bools = np.zeros(len(contacts), dtype=bool)
        for law, index in self._by_law(contacts):
            soft[index] = law.softens
        held: Bools = soft & contacts.is_joint & (contacts.damage < 1)
        return held

    def damaged(
        self, contacts: ContactPoints, opening: Floats, sliding: Floats, stiffness: Floats
    ) -> Floats:
        """Return the damage (m,) of bonds that soften after an opening and a sliding (m,).

        ``stiffness`` (m,) is that of the whole bonds (N/m); see `InterfaceLaw.damaged`.
        """
        damage = contacts.damage.copy()
        soft = self.softening(contacts)
        for law, index in self._by_law(contacts):
            if law.softens:
                index = index[soft[index]]
                area = contacts.length[index] * self.thickness
                damage[index] = law.damaged(
                    damage[index],
                    opening[index],
                    np.abs(sliding[index]),
                    stiffness[index] / area,
                )
        return damage

    def lift(self, contacts: ContactPoints, worn: Floats) -> Floats:
        """Return by how much faces that have slid by ``worn`` (m,) ride up on each other (m)."""
        rise = np.zeros(len(contacts))
        for law, index in self._by_law(contacts):
            if law.dilation_angle:
                way = np.minimum(worn[index], law.dilation_slip)
                rise[index] = np.tan(law.dilation_angle) * way
        return rise

    def normal_stiffness(self, contacts: ContactPoints) -> Floats:
        """Return the normal stiffness (m,) in N/m."""
        return self.springs(contacts)[0]

    @cached_property
    def makes_joints(self) -> Bools:
        """(n,) whether shared edges of each law are followed as joints."""
        return np.array([law.makes_joints for law in self.laws], dtype=bool)

    @cached_property
    def bonded(self) -> Bools:
        """(n,) whether joints of each law hold together at the start."""
        return np.array([law.bonded for law in self.laws], dtype=bool)

    @cached_property
    def dilates(self) -> bool:
        """Whether any law has a dilation angle."""
        return any(law.dilation_angle for law in self.laws)

    @cached_property
    def damps(self) -> bool:
        """Whether any law has damping."""
        return any(law.damping for law in self.laws)

    def damping(self, contacts: ContactPoints) -> Floats:
        """Return the share (m,) of critical damping of each contact."""
        share = np.zeros(len(contacts))
        for law, index in self._by_law(contacts):
            share[index] = law.damping
        return share

    def breaking(
        self, contacts: ContactPoints, answer: StepAnswer, worst_only: bool
    ) -> tuple[Bools, Floats]:
        """Return which intact bonds cannot hold the forces of an answer, and all overloads (m,).

        With ``worst_only`` the most loaded ones alone, the others being judged again after the
        forces have moved: the order of failure then does not depend on the load increment.
        """
        load = np.zeros(len(contacts))
        for law, index in self._by_law(contacts):
            if law.bonded:
                index = index[contacts.damage[index] < 1]
                load[index] = law.overload(
                    answer.normal_force[index],
                    answer.shear_force[index],
                    contacts.length[index],
                    self.thickness,
                )
        over = load > 1
        if worst_only and over.any():
            over &= load >= load.max() * (1 - TIE)
        return over, load

    def _by_law(self, contacts: ContactPoints) -> list[tuple[InterfaceLaw, Ints]]:
        return [
            (law, np.flatnonzero(contacts.interface == number))
            for number, law in enumerate(self.laws)
        ]


def break_bonds(contacts: ContactPoints, broken: Bools) -> ContactPoints:
    """Return the contacts with some bonds broken for good, their forces gone."""
    return replace(
        contacts,
        damage=np.where(broken, 1.0, contacts.damage),
        state=np.where(broken, int(BROKEN), contacts.state),
        normal_force=np.where(broken, 0.0, contacts.normal_force),
        shear_force=np.where(broken, 0.0, contacts.shear_force),
        slip=np.where(broken, 0.0, contacts.slip),
    )


def _shear_ratio(law: InterfaceLaw) -> float:
    """Shear over normal stiffness of a law that has one."""
    assert law.normal_stiffness is not None
    return (law.shear_stiffness or law.normal_stiffness) / law.normal_stiffness


def _half_edge(surface: Surface, vertex: Ints, edge: Ints) -> Floats:
    """Half the length (m,) of the edge at a vertex that faces ``edge``, or of that if shorter."""
    before, along = surface.previous[vertex], surface.direction[edge]
    faces = [np.einsum("ij,ij->i", surface.direction[own], along) for own in (vertex, before)]
    facing = np.where(faces[0] <= faces[1], vertex, before)
    return np.asarray(np.minimum(surface.length[facing], surface.length[edge]) / 2)
