"""Base of the enforcements that find contact forces by the iterations of this package."""

from dataclasses import dataclass, field

from nmm.contact.enforcement.base import Enforcement
from nmm.contact.iteration.options import IterationOptions


@dataclass(frozen=True)
class IterativeEnforcement(Enforcement):
    """An enforcement whose iterations have options of their own.

    Attributes
    ----------
    iterations
        Tables ``[contact.options.iterations.alternation]``, ``springs``, ``interior``,
        ``rounds`` and ``barrier`` (`nmm.contact.iteration.options`).
    """

    iterations: IterationOptions = field(default_factory=IterationOptions, kw_only=True)
