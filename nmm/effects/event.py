"""What an effect asks for when blocks divide or cracks grow."""

from dataclasses import dataclass

from nmm.geometry.geometry import Geometry


@dataclass(frozen=True)
class Event:
    """A change of what is material and where it is cracked.

    Attributes
    ----------
    geometry
        Blocks and cracks from now on, in the reference place in which they are now.
    what
        What happens, for the summary: "2 blocks split".
    held
        Whether forces hold at first what is parted, so that accelerations go on as they were.
    exact
        Whether the load is sought at which it happens; else that of a step that ends near it will
        do.
    """

    geometry: Geometry
    what: str
    held: bool = False
    exact: bool = True
