"""Numbers that steer the iterations: tables ``[contact.options.iterations.*]`` of formulations.

They change what a step costs and whether it is found, never what is accepted: that is said by the
tolerances of the enforcement. The defaults were measured on walls and piles of 100 to 10 000
blocks.
"""

from nmm.contact.iteration.options.barrier import BarrierOptions
from nmm.contact.iteration.options.budgets import SMALL, IterationBudget, Patience
from nmm.contact.iteration.options.exact import InteriorOptions, RoundOptions
from nmm.contact.iteration.options.springs import (
    AlternationOptions,
    IslandOptions,
    MemoryOptions,
    SpringOptions,
    WayOptions,
)
from nmm.contact.iteration.options.tables import DEFAULT, IterationOptions

__all__ = [
    "DEFAULT",
    "SMALL",
    "AlternationOptions",
    "BarrierOptions",
    "InteriorOptions",
    "IslandOptions",
    "IterationBudget",
    "IterationOptions",
    "MemoryOptions",
    "Patience",
    "RoundOptions",
    "SpringOptions",
    "WayOptions",
]
