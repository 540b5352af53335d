"""The enforcements that benchmarks compare."""

from typing import NamedTuple

from nmm.contact.enforcement.base import Enforcement, make_enforcement


class Variant(NamedTuple):
    """An enforcement: its name, normal penalty (Young's modulus), and options."""

    name: str
    penalty: float = 10.0
    options: dict[str, object] = {}  # noqa: RUF012 a tuple's default, never written to

    def make(self) -> Enforcement:
        """Return the enforcement itself."""
        return make_enforcement(self.name, self.options)


DEFAULT = "penalty 10 E"
"""What a formulation that says nothing has."""
VARIANTS = {
    DEFAULT: Variant("penalty"),
    "penalty 1 E": Variant("penalty", 1.0),
    "penalty 100 E": Variant("penalty", 100.0),
    # Shi's own passes on soft springs, as the classical reference
    "open-close 1 E": Variant("penalty", 1.0, {"iteration": "open_close", "max_passes": 40}),
    "augmented": Variant("augmented"),
    "lagrange": Variant("lagrange"),
    "cone": Variant("cone"),
    "barrier": Variant("barrier"),
}
"""The default first: ratios are to it."""
