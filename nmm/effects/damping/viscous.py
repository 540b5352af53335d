"""Viscous damping by mass and by stiffness (Rayleigh)."""

from typing import TYPE_CHECKING, Self

from scipy.sparse import csc_array

from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Setup

if TYPE_CHECKING:
    from nmm.effects.change import Change


class ViscousDamping(Effect):
    """Force ``-(a M + b K) v`` with the mass and the elastic stiffness of the material.

    A mode of frequency ``w`` (rad/s) is damped by ``a / (2 w) + b w / 2`` of critical damping. Mass
    damps motion against the axes of the scene, falling and flying too; stiffness damps strain
    alone, and neither joints nor supports.
    """

    name = "viscous damping"
    placed = False

    def __init__(self, model: Model, mass: float, stiffness: float) -> None:
        self._mass, self._stiffness = mass, stiffness
        self._matrix = csc_array(mass * model.mass + stiffness * model.stiffness)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[damping]``."""
        assert setup.scene.damping is not None
        coefficients = setup.scene.damping.coefficients
        assert coefficients is not None
        return cls(setup.model, *coefficients)

    def follow(self, change: "Change") -> "ViscousDamping":
        """Return the same damping of the new model."""
        return type(self)(change.new, self._mass, self._stiffness)

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        return f"{self._mass:.6g} 1/s of the mass and {self._stiffness:.6g} s of the stiffness"

    @property
    def external(self) -> bool:  # type: ignore[override]
        """Whether momentum is lost: by mass."""
        return self._mass > 0

    def damping(self, state: State) -> csc_array:
        """See `Effect.damping`; always the same object."""
        return self._matrix
