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
    continuous
        Whether accelerations are: forces hold new faces together at first.
    exact
        Whether the load of the event is searched for; else the end of a step near it will do.
    """

    geometry: Geometry
    what: str
    continuous: bool = False
    exact: bool = True
