"""Classes of hard cases by name."""

from nmm.registry import Registry
from nmm.verification.hard.base import HardClass

_HOME = "nmm.verification.hard"

HARD = Registry[type[HardClass]](
    "hard class",
    HardClass,
    {
        "crossings": f"{_HOME}.crossings:Crossings",
        "corners": f"{_HOME}.corners:Corners",
        "fans": f"{_HOME}.corners:Fans",
        "seams": f"{_HOME}.seams:Seams",
        "wedges": f"{_HOME}.wedges:Wedges",
        "slopes": f"{_HOME}.slopes:Slopes",
        "heaps": f"{_HOME}.heaps:Heaps",
    },
)
