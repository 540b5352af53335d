"""Classical updating of geometry: after each step the blocks are laid anew where they stand.

Shi (1988) moves vertices by ``T d`` with the linear rotation ``r0``, so that a turning block grows
by ``1 + r0^2`` a step (MacLaughlin and Sitar 1996). It is kept so that old results can be repeated
and the growth be seen; bodies' axes stay parallel to the global ones, and stress does not turn.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.model import Model
from nmm.assembly.motion import Frames, State
from nmm.effects.base import defines
from nmm.errors import FormulationError
from nmm.model.plan import Plan

Lay = Callable[[Polygons], Manifold]


@dataclass
class Laid:
    """The model, and the plan of effects on it, as the blocks lie now."""

    model: Model
    plan: Plan


def relay(
    model: Model, plan: Plan, lay: Lay, state: State, increment: Floats, place: Floats
) -> tuple[Model, Plan, State]:
    """Lay the blocks anew at ``place`` (P, 2), where the accepted ``state`` has left them.

    Returns
    -------
    The new model; the plan of effects on it, with the stress so far as initial stress; and the
    state, with velocities kept unknown by unknown and no deformation.
    """
    from nmm.effects.initial_stress import InitialStress

    carried = plan.initial_stress
    stress = model.mean_stress(increment) + (0.0 if carried is None else carried.stress)
    manifold = lay(model.manifold.elements.with_points(place))
    new = replace(model, manifold=manifold)
    effects = {name: effect.relaid(new) for name, effect in plan.effects.items()}
    effects[InitialStress.name] = InitialStress(new, stress)
    centre = manifold.body_centroid
    frames = Frames(centre, np.zeros(manifold.n_bodies), way=np.zeros_like(centre))
    rest = np.zeros(manifold.n_unknowns)
    return new, replace(plan, effects=effects), replace(state, frames=frames, deformation=rest)


def check_relay(plan: Plan) -> None:
    """Refuse effects that cannot follow blocks that are laid anew.

    Raises
    ------
    FormulationError
        Naming the effects.
    """
    fixed = [name for name, effect in plan.effects.items() if not defines(effect, "relaid")]
    if fixed:
        raise FormulationError(
            f'[rotation] update: "linear": the scene names {", ".join(fixed)}: expected effects '
            'that follow blocks laid anew each step: use update = "exact"'
        )
