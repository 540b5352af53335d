"""Events: changes of geometry that effects call for, as when blocks split or cracks grow."""

from dataclasses import dataclass

from nmm.geometry.geometry import Geometry


@dataclass(frozen=True)
class Event:
    """A change of the geometry.

    Attributes
    ----------
    geometry
        Blocks and cracks after it, in the present reference configuration.
    what
        What happens, in words for the summary, as "2 blocks split".
    held
        Whether forces hold new faces together at first, so that accelerations are continuous.
    exact
        Whether the load of the event is searched for; else the end of a step near it will do.
    """

    geometry: Geometry
    what: str
    held: bool = False
    exact: bool = True
