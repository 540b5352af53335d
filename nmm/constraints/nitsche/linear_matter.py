"""Nitsche's method needs the traction of a linear material; others are held by springs.

Multipliers hold an edge in means over cells, whose tractions cannot follow stresses that jump: the
plastic limit of a beam held so on two cells of its depth is 1.19 in place of 1.5 times the first
yield, 1.49 by springs.
"""

from nmm.assembly.model import Model
from nmm.errors import FormulationError


def method_for(model: Model, asked: str, springs: str) -> str:
    """Return ``springs`` for "auto" where a material is not linear, else what was ``asked``."""
    return springs if asked == "auto" and model.may_bend else asked


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
