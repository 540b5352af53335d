"""Benchmarks by name."""

from nmm.registry import Registry
from nmm.verification.base import Case

_HOME = "nmm.verification.problems"

CASES = Registry[type[Case]](
    "benchmark",
    {
        "B1 friction": f"{_HOME}.incline:Threshold",
        "B1 cohesion": f"{_HOME}.incline:CohesiveThreshold",
        "B2": f"{_HOME}.incline:Sliding",
        "B4": f"{_HOME}.incline:Train",
        "B9 damping": f"{_HOME}.time_integration:SpringBlock",
        "B9 order": f"{_HOME}.time_integration:Order",
    },
)
