"""Cells in which matter that softens has an answer."""

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
