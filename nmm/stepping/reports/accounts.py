"""Energies that tell where what came from nowhere came from, and how much came at once."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class EnergySources:
    """Energies (J) that tell where what came from nowhere came from.

    ``made`` is what came; ``given`` is what the integrator gave: waves of one that is not monotone
    come and go. ``contact`` is what springs and bonds of contact gave beyond what friction and
    breaking bonds ``lost``, and ``supports`` what springs of supports and glue store.
    """

    made: float = 0.0
    given: float = 0.0
    contact: float = 0.0
    lost: float = 0.0
    supports: float = 0.0

    def since(self, before: "EnergySources") -> "EnergySources":
        """Return by how much each has grown."""
        return EnergySources(
            self.made - before.made,
            self.given - before.given,
            self.contact - before.contact,
            self.lost - before.lost,
            self.supports - before.supports,
        )


@dataclass(frozen=True)
class EnergyRise:
    """Energy that came from nowhere, and in which step (its number and time, s)."""

    grown: EnergySources = field(default_factory=EnergySources)
    step: int = 0
    time: float = 0.0

    @property
    def energy(self) -> float:
        """How much (J)."""
        return self.grown.made
