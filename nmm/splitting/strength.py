"""The base class of strengths: from stresses to their share of the strength, and planes."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

from integration.arrays import Bools, Floats
from nmm.registry import Registry


@dataclass(frozen=True)
class SplitJudgement:
    """Stress over strength of blocks, and the planes of failure.

    Attributes
    ----------
    use
        (m,) share of the strength that is used; a block splits at 1.
    planes
        (m, 2) directions of the planes along which each would split, counter-clockwise from x
        (rad); NaN in the place of the second where there is one alone.
    tension
        (m,) whether it would split by tension, else by shear.
    """

    use: Floats
    planes: Floats
    tension: Bools


class BlockStrength(ABC):
    """Base of strengths: pure functions of the stress.

    Planes turn with the stress, blocks know nothing of each other, and a stress on the way to its
    strength does not use less of it.
    """

    @abstractmethod
    def judged(self, stress: Floats) -> SplitJudgement:
        """Compare stresses (m, 3) as xx, yy, xy (Pa), tension positive, with the strength."""


STRENGTHS: Registry[type[BlockStrength]] = Registry(
    "strength",
    BlockStrength,
    {"mohr_coulomb": "nmm.splitting.coulomb:CoulombStrength"},
)
