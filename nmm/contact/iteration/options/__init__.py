"""Numbers that steer the iterations: tables ``[contact.options.iterations.*]`` of formulations.

They change what a step costs and whether it is found, never what is accepted: that is said by the
tolerances of the enforcement. The defaults were measured on walls and piles of 100 to 10 000
blocks.
"""

from dataclasses import dataclass, field

from nmm.contact.iteration.options.barrier import BarrierOptions
from nmm.contact.iteration.options.exact import InteriorOptions, RoundOptions
from nmm.contact.iteration.options.springs import (
    AlternationOptions,
    IslandOptions,
    MemoryOptions,
    SpringOptions,
    WayOptions,
)


@dataclass(frozen=True)
class IterationOptions:
    """Of all iterations an enforcement may call."""

    alternation: AlternationOptions = field(default_factory=AlternationOptions)
    springs: SpringOptions = field(default_factory=SpringOptions)
    ways: WayOptions = field(default_factory=WayOptions)
    interior: InteriorOptions = field(default_factory=InteriorOptions)
    rounds: RoundOptions = field(default_factory=RoundOptions)
    barrier: BarrierOptions = field(default_factory=BarrierOptions)
    memory: MemoryOptions = field(default_factory=MemoryOptions)
    islands: IslandOptions = field(default_factory=IslandOptions)


DEFAULT = IterationOptions()
