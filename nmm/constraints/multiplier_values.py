"""The last values of multipliers, which interfaces may share."""

from dataclasses import dataclass

from integration.arrays import Floats


@dataclass
class MultiplierValues:
    """What a step found for them.

    Attributes
    ----------
    size
        Number k of multipliers.
    values, before
        (k,) Pa, and as they were when the step began; None before any solution.
    """

    size: int
    values: Floats | None = None
    before: Floats | None = None
