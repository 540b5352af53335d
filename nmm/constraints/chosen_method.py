"""The method that a formulation means where it leaves the choice, and where it names one."""

from typing import TYPE_CHECKING

from nmm.assembly.model import Model
from nmm.constraints.imposition import IMPOSITIONS, Method
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.formulation import SupportMethod


def chosen(model: Model, asked: str, springs: str) -> str:
    """Return what is ``asked``; "auto" is ``springs`` where matter is not linear, else Nitsche's.

    Multipliers hold an edge in means over cells, whose tractions cannot follow stresses that jump:
    the plastic limit of a beam held so on two cells of its depth is 1.19 in place of 1.5 times the
    first yield, 1.49 by springs.
    """
    if asked != "auto":
        return asked
    return springs if model.may_bend else "nitsche"


def support_method(
    model: Model,
    part: "SupportMethod",
    size: float | None,
    degree: int,
    only_strained: bool = False,
) -> Method:
    """Return the method that a formulation names; "auto" is springs for blocks.

    Edges of finite strain are held by Nitsche's method where it knows their traction, as that is
    of the strain alone (`Setup.only_strained`), else by springs.
    """
    blocks = size is None and part.method == "auto"
    springs = "nitsche" if model.finite and only_strained else "penalty"
    kind = "penalty" if blocks else chosen(model, part.method, springs)
    if size is None and IMPOSITIONS.load(kind).needs_cells:
        raise FormulationError(
            f'[supports] method: "{kind}": for covers of meshes: expected "penalty" with type = '
            '"block": change the method or the cover'
        )
    if model.finite and kind == "nitsche" and not only_strained:
        raise FormulationError(
            f'[supports] method: "nitsche": with {model.bent} its traction is that of the strain '
            "in statics: expected no inertia, contact, stages, stress at the start, heat, water or "
            'effects of one\'s own that add stress: use method = "lagrange" or "penalty"'
        )
    return Method(kind, size, degree, part.stiffness, part.gamma, part.ghost)
