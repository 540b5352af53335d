"""What a material law is to the rest of the program."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass

from integration.arrays import Floats
from nmm.registry import Registry


@dataclass(frozen=True)
class Law(ABC):
    """Base of stress-strain laws; a frozen set of parameters in SI units."""

    @abstractmethod
    def stiffness(self, plane: str) -> Floats:
        """Return the matrix (3, 3) from strain (xx, yy, 2 xy) to stress (xx, yy, xy), Pa.

        ``plane`` is "stress" or "strain".
        """

    def kolosov(self, plane: str) -> float:
        """Return Kolosov's constant of singular fields; laws that have none give that of nu = 0.

        ``(3 - nu) / (1 + nu)`` in plane stress, ``3 - 4 nu`` in plane strain.
        """
        return 3.0

    @property
    @abstractmethod
    def modulus(self) -> float:
        """Young's modulus (Pa): the unit in which penalties are given."""


MATERIAL_LAWS = Registry[Callable[..., Law]](
    "material law", Law, {"elastic": "nmm.materials.elastic:Elastic"}
)
