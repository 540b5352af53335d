"""What laws that soften check alike: what strength is left, and cells in which they answer."""

from integration.arrays import Floats
from nmm.errors import FormulationError


def check_cells(energy: float, size: Floats, most: float, remedy: str = "") -> None:
    """Refuse cells of sizes (m,) of which one is ``most`` or more (m).

    There flow takes more strain than the stress that it relieves gives back. What helps besides
    smaller cells is the ``remedy``.
    """
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
