"""The enforcements that benchmarks compare: options, penalty, and the solution each is held to."""

from dataclasses import dataclass, field

Options = dict[str, object]


Reference = tuple[tuple[str, Options], ...]
"""Enforcements with options that are tried in order; the first that converges counts."""
SPRINGS: Reference = (("penalty", {"tolerance": 1e-12}),)
EXACT: Reference = (
    ("cone", {"tolerance": 1e-10, "gap_tolerance": 1e-9}),
    ("augmented", {"gap_tolerance": 1e-8}),
)
"""Where the first fails the second goes another way: the cone again would confirm itself."""


@dataclass(frozen=True)
class Kind:
    """An enforcement.

    Attributes
    ----------
    name
        Its name in `[contact] enforcement`.
    penalty
        Normal penalty (Young's modulus times thickness).
    options
        `[contact.options]`.
    reference
        The solution its forces are held to: the same law, solved tightly.
    """

    name: str
    penalty: float
    options: Options = field(default_factory=dict)
    reference: Reference = EXACT


OPEN_CLOSE: Options = {"iteration": "open_close", "max_passes": 40}
KINDS = {
    "open-close 1 E": Kind("penalty", 1.0, OPEN_CLOSE, SPRINGS),
    "open-close 10 E": Kind("penalty", 10.0, OPEN_CLOSE, SPRINGS),
    "penalty 1 E": Kind("penalty", 1.0, reference=SPRINGS),
    "penalty 10 E": Kind("penalty", 10.0, reference=SPRINGS),
    "penalty 100 E": Kind("penalty", 100.0, reference=SPRINGS),
    "augmented": Kind("augmented", 10.0),
    "lagrange": Kind("lagrange", 10.0),
    "cone": Kind("cone", 10.0),
    "barrier": Kind("barrier", 10.0),
}
"""Shi's own passes first, as the classical reference."""
DEFAULT = "penalty 10 E"
"""What a formulation that says nothing has."""
USUAL = ("penalty 1 E", DEFAULT)
"""What most runs of many blocks have."""
