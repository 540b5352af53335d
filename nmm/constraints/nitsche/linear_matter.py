"""Nitsche's method needs the traction of a linear material."""

from nmm.assembly.model import Model
from nmm.errors import FormulationError


def check_linear(model: Model, place: str, instead: str) -> None:
    """Refuse Nitsche's method on a material that is not linear.

    Raises
    ------
    FormulationError
        Naming the ``place`` in the formulation, and what to use ``instead``.
    """
    if model.matter is not None:
        raise FormulationError(
            f'{place}: "nitsche": with {model.bent}: its traction is that of linear matter: '
            f"expected a method that reads no stress: use {instead}"
        )
