"""What is given of a scalar field in bodies: sources in the volume, and fields of whole bodies."""

from dataclasses import dataclass

from integration.arrays import Bools, Floats
from nmm.diffusion.edges import Factor


@dataclass(frozen=True)
class VolumeSource:
    """A source in the volume: its load (n,) at factor 1, and its factor."""

    name: str
    load: Floats
    factor: Factor


@dataclass(frozen=True)
class GivenField:
    """Prescribed field of whole bodies: which functions (n,), their unknowns (n,), and a factor."""

    name: str
    chosen: Bools
    unknowns: Floats
    factor: Factor
