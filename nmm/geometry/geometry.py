"""The geometry of a model: blocks, and the cracks in them."""

from dataclasses import dataclass

from integration.arrays import Floats
from nmm.geometry.blocks import Regions


@dataclass(frozen=True)
class Geometry:
    """Blocks and cracks in the reference place, in the axes of the model.

    It is that of the scene until an effect asks for another one. Pieces of a block that was
    divided are polygons of one number (`Regions.number`): a region is a block of the scene,
    whatever has become of it.

    Attributes
    ----------
    regions
        The blocks that are there.
    cracks
        Polylines (n, 2) that cut them, m.
    bonded
        Numbers of the cracks whose faces begin bonded.
    nuclei
        Numbers of the cracks that began away from all others: at an edge with two points, inside
        with a third between.
    in_pieces
        Whether the polygons are pieces that no cover of blocks divides further.
    """

    regions: Regions
    cracks: tuple[Floats, ...] = ()
    in_pieces: bool = False
    bonded: tuple[int, ...] = ()
    nuclei: tuple[int, ...] = ()

    @property
    def bonded_cracks(self) -> tuple[Floats, ...]:
        """The cracks whose faces begin bonded."""
        return tuple(self.cracks[number] for number in self.bonded)

    @property
    def free(self) -> tuple[Floats, ...]:
        """The other cracks."""
        numbers = range(len(self.cracks))
        return tuple(self.cracks[number] for number in numbers if number not in self.bonded)
