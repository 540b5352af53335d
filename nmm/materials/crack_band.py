"""Plastic laws that may soften, regularised by the crack band model: the largest cell size."""

from abc import abstractmethod
from dataclasses import dataclass, field

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.plasticity import Plastic


@dataclass(frozen=True)
class SofteningPlasticity(Plastic):
    """Base of plastic laws that soften if they have a softening energy.

    Attributes
    ----------
    softening_energy
        Energy per area of a localisation band (J/m2) until it has softened; None: no softening.
    """

    softening_energy: float | None = field(default=None, kw_only=True)

    @abstractmethod
    def cell_limit(self, energy: float) -> tuple[float, str]:
        """Return the largest cell size (m) without snap-back, and what else would raise it.

        In larger cells plastic strain would exceed the elastic strain that unloading releases.
        """

    @property
    def sized(self) -> bool:
        return self.softening_energy is not None

    def check_size(self, size: Floats) -> None:
        energy = self.softening_energy
        if energy is None:
            return
        most, remedy = self.cell_limit(energy)
        if size.max(initial=0.0) >= most:
            raise FormulationError(
                f"softening_energy: {energy}: cells of {size.max():.4g} m: expected cells below "
                f"{most:.4g} m, where they unload more slowly than they soften: refine the cover"
                + remedy
            )


def check_residual(
    energy: float | None, residual: tuple[str, float], most: float, expected: str
) -> None:
    """Refuse a residual strength, by name, of a law that does not soften or of ``most`` and more.

    ``expected`` says what it may be, up to the strength that it falls from (Pa).
    """
    name, value = residual
    if energy is None and value:
        raise FormulationError(
            f"{name}: {value}: expected a law that softens: add softening_energy"
        )
    if energy is not None and not 0 <= value < most:
        raise FormulationError(f"{name}: {value}: expected {expected} of {most:.6g} Pa: lower it")
