"""Errors over sizes: what an order of convergence is read off."""

from collections.abc import Sequence
from dataclasses import dataclass

from nmm.study.cost.orders import Order, observed_order


@dataclass(frozen=True)
class Series:
    """Errors of one quantity over sizes.

    Attributes
    ----------
    sizes, errors
        One value a run; what the sizes are, ``x`` says.
    theory
        Order that the errors should fall by.
    x
        What the sizes are, with their unit: "size of covers (m)".
    """

    sizes: tuple[float, ...]
    errors: tuple[float, ...]
    theory: float
    x: str = "size of covers (m)"

    @classmethod
    def of(
        cls,
        sizes: Sequence[float],
        errors: Sequence[float],
        theory: float,
        x: str = "size of covers (m)",
    ) -> "Series":
        """Make a series of any sequences of numbers."""
        return cls(tuple(map(float, sizes)), tuple(map(float, errors)), theory, x)

    @property
    def observed(self) -> Order:
        """Slope through all points, with its 95 % confidence."""
        return observed_order(self.sizes, self.errors)
