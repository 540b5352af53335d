"""The effect: springs between points of blocks, or a point and the ground."""

from typing import TYPE_CHECKING, Self

import numpy as np

from nmm.effects.base import Setup
from nmm.effects.members.ends import ends_of
from nmm.effects.members.fibres import Fibres
from nmm.effects.members.linked import Linked
from nmm.effects.members.links import Links
from nmm.effects.members.member_set import Members
from nmm.materials.uniaxial import Uniaxial

if TYPE_CHECKING:
    from nmm.scene.tables.members import SpringTable


class PointSprings(Linked):
    """All ``[[springs]]`` of a scene."""

    name = "springs"

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[springs]]``."""
        springs = setup.scene.springs
        links = Links.of(*ends_of(setup, "springs", springs), setup.small)
        laws = [_law(spring) for spring in springs]
        one, names = np.ones(len(springs)), tuple(spring.name for spring in springs)
        axial = Fibres.of(laws, one, one, np.array([spring.force for spring in springs]))
        return cls(setup, Members.without_slip(names, (1,) * len(names), links, axial))


def _law(spring: "SpringTable") -> Uniaxial:
    limit = spring.yield_force
    flowed, yields = ((), ()) if limit is None else ((0.0,), (limit,))
    pulls, pushes = spring.carries != "compression", spring.carries != "tension"
    return Uniaxial(spring.stiffness, flowed, yields, pulls, pushes)
