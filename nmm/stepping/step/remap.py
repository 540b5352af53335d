"""Classical updating of geometry: after each step the blocks are laid anew where they stand.

Shi (1988) moves vertices by ``T d`` with the linear rotation ``r0``, so that a turning block grows
by ``1 + r0^2`` a step (MacLaughlin and Sitar 1996). It is kept so that old results can be repeated
and the growth be seen; bodies' axes stay parallel to the global ones, and stress does not turn.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from covers.approximation.manifold import Manifold
from covers.change.parentage import Parentage
from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.assembly.state import State, initial_frames, initial_state
from nmm.effects.change import Change
from nmm.errors import FormulationError
from nmm.model.discretisation import Discretisation
from nmm.model.planning.plan import Plan
from nmm.stepping.step.carried import LaidAnew

Lay = Callable[[Polygons], Manifold]


def laid_here(
    old: Discretisation, lay: Lay, state: State, increment: Floats, place: Floats
) -> tuple[Change, Discretisation]:
    """Lay the blocks anew where an accepted step has left them; see `remapped`."""
    change = remapped(old, lay, state, place)
    return change, with_stress_so_far(old.after(change), old, increment)


def laid_as(old: Discretisation, lay: Lay, laid: LaidAnew) -> tuple[Change, Discretisation]:
    """Lay the blocks as they were laid after another step."""
    manifold = old.model.manifold
    change = remapped(old, lay, initial_state(manifold), laid.points)
    return change, with_stress(old.after(change), laid.stress)


def remapped(discretisation: Discretisation, lay: Lay, state: State, place: Floats) -> Change:
    """Lay the blocks anew at ``place`` (P, 2), where the accepted ``state`` has left them.

    Velocities are kept unknown by unknown, and there is no deformation: what the step has left in
    the material is kept by `with_stress_so_far`.
    """
    model = discretisation.model
    manifold = lay(model.manifold.elements.with_points(place))
    frames = initial_frames(manifold)
    rest = np.zeros(manifold.n_unknowns)
    return Change(
        before=discretisation.setup,
        setup=replace(discretisation.setup, model=replace(model, manifold=manifold)),
        parentage=Parentage(model.manifold, manifold, same=True),
        state=replace(state, frames=frames, deformation=rest),
        former=state,
    )


def with_stress_so_far(
    new: Discretisation, old: Discretisation, increment: Floats
) -> Discretisation:
    """Return the new one with the stress so far as initial stress."""
    carried = old.plan.initial_stress
    stress = old.model.mean_stress(increment) + (0.0 if carried is None else carried.stress)
    return with_stress(new, stress)


def with_stress(new: Discretisation, stress: Floats) -> Discretisation:
    """Return a discretisation with another initial stress (E, 3)."""
    from nmm.effects.initial.initial_stress import InitialStress
    from nmm.effects.initial.stress_at_start import StressAtStart

    given = StressAtStart.constant(stress)
    effects = {**new.plan.effects, InitialStress.name: InitialStress(new.model, given)}
    return replace(new, plan=replace(new.plan, effects=effects))


def check_remap(plan: Plan) -> None:
    """Refuse effects that cannot follow blocks that are laid anew elsewhere.

    Raises
    ------
    FormulationError
        Naming the effects.
    """
    fixed = [name for name, effect in plan.effects.items() if effect.placed]
    if fixed:
        raise FormulationError(
            f'[rotation] update: "linear": the scene names {", ".join(fixed)}: expected effects '
            'that follow blocks laid anew each step: use update = "exact"'
        )
