"""Which bodies may meet, and by which law.

Every two bodies meet by the interface of their materials. Where the scene has none, they must not
touch: at the start that is a fault of the scene, later it ends the run at the step before. The
sub-blocks of one block are glued and never meet.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Ints

# Numbers that stand in for an interface: pieces of one block, which are glued and never meet, and
# bodies that must not touch.
GLUED, MISSING = -1, -2


@dataclass(frozen=True)
class Pairs:
    """The interface of any two regions, by their materials.

    Attributes
    ----------
    table
        (M, M) index of the interface of two materials; MISSING where the scene has none.
    material
        (N,) of the regions.
    glued
        Whether pieces of one region are glued and never meet.
    """

    table: Ints
    material: Ints
    glued: bool

    def interface(self, one: Ints, other: Ints) -> Ints:
        """Index (m,) of the interface between regions; GLUED and MISSING are negative."""
        found = self.table[self.material[one], self.material[other]]
        return np.where(one == other, GLUED, found) if self.glued else found


def no_interface(x: float, y: float) -> str:
    """Say that blocks met at a point (m) though their materials have no interface."""
    return (
        f"[interfaces]: blocks meet at ({x:.10g}, {y:.10g}) whose materials have none: "
        'expected an interface between the two: add one, or one with between = "any"'
    )
