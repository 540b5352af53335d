"""Classes of hard cases by name."""

from nmm.registry import Registry
from nmm.verification.hard.cases.base import HardClass

_HOME = "nmm.verification.hard.generators"

HARD = Registry[type[HardClass]](
    "hard class",
    HardClass,
    {
        "crossings": f"{_HOME}.crossings:CrossingCases",
        "corners": f"{_HOME}.corners:Corners",
        "fans": f"{_HOME}.corners:Fans",
        "seams": f"{_HOME}.seams:SeamCases",
        "drives": f"{_HOME}.drives:Drives",
        "wedges": f"{_HOME}.cracks.wedges:Wedges",
        "slopes": f"{_HOME}.slopes:Slopes",
        "slope_array": f"{_HOME}.slope_array:SlopeArray",
        "mutations": "nmm.verification.hard.spoilt.mutations:Mutations",
        "heaps": f"{_HOME}.heaps:Heaps",
        "cuts": f"{_HOME}.cracks.cuts:Cuts",
        "tips": f"{_HOME}.cracks.tips:Tips",
        "ligaments": f"{_HOME}.cracks.tips:Ligaments",
        "pieces": f"{_HOME}.cracks.pieces:PieceCases",
        "motions": f"{_HOME}.motions:Motions",
        "steps": f"{_HOME}.halving:Steps",
        "agreement": f"{_HOME}.halving:Agreement",
        "ratios": f"{_HOME}.ratios:Ratios",
        "anchored": f"{_HOME}.anchored:Anchored",
        "events": f"{_HOME}.events:Events",
        "solids": f"{_HOME}.random_solids:Solids",
        "scenes": f"{_HOME}.scenes.scenes:Scenes",
        "keys": f"{_HOME}.seldom.keys:SeldomKeys",
        "features": f"{_HOME}.features:Features",
    },
)
