"""A plan made of a scene: only the effects that it names, and on a new model those that follow.

What a scene does not name is not imported and has no arrays.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from nmm.effects.base import Effect, Setup, defines
from nmm.errors import Fault, FormulationError
from nmm.geometry.tessellation.cover_types import piece_glue
from nmm.model.called_for import called_for
from nmm.model.effects_table import EFFECTS, GLUE, OWN, make_own, own_effect, with_table
from nmm.model.planning.out_of_balance import out_of_balance
from nmm.model.planning.plan import Plan

if TYPE_CHECKING:
    from nmm.effects.change import Change


def compile_plan(setup: Setup) -> Plan:
    """Import and build the effects that a scene names, with keys of its own or in tables."""
    kinds, plan = _kinds(setup), Plan({})
    for name, make in _makers(_told(setup, kinds), kinds).items():
        plan.effects[name] = plan.timed(name, make)
    if setup.kinematics.finite:
        _check_finite(plan)
    return plan.connected()


def _check_finite(plan: Plan) -> None:
    """Refuse effects that count on axes that turn with bodies.

    Raises
    ------
    FormulationError
        All of them, one line each.
    """
    found = [(name, effect.turns_with_bodies) for name, effect in plan.effects.items()]
    faults = [
        Fault(
            "[rotation] update",
            f'"finite" with {name}: {what}',
            "effects that follow a body that bends by any angle",
            'use update = "exact", or leave the effect out',
        )
        for name, what in found
        if what
    ]
    if faults:
        raise FormulationError(*faults)


def plan_after(plan: Plan, change: "Change") -> Plan:
    """Return the plan on the new model: effects follow, and those newly named are built."""
    kinds = _kinds(change.setup)
    change = replace(change, setup=_told(change.setup, kinds))
    makers = _makers(change.setup, kinds)
    for name, effect in plan.effects.items():
        if effect.stays or name in makers:
            own = replace(change, setup=with_table(change.setup, name))
            kind = kinds.get(name, type(effect))
            same = kind is type(effect)
            goes_on = effect.follow if same else partial(kind.in_place_of, effect)
            makers[name] = partial(goes_on, own)
    new = Plan({}, plan.seconds)
    for name, make in makers.items():
        new.effects[name] = effect = new.timed(name, make)
        if name not in plan.effects and defines(effect, "join_run"):
            effect.join_run(change.state)
    new.connected()
    heirs = new.having("take_over")
    if heirs and plan.supports is not None:
        left = plan.supports.left(change, new.stresses)
        for effect in heirs:
            effect.take_over(left)
    holders = new.having("receive_residual")
    if holders:
        force = out_of_balance(new, change)
        for effect in holders:
            effect.receive_residual(change, force)
    return new


def _kinds(setup: Setup) -> dict[str, type[Effect]]:
    """Return the effects that a scene names by keys of its own, in the order of the table."""
    kinds = [EFFECTS.load(name) for name, wanted in called_for(setup.scene).items() if wanted]
    if piece_glue(setup.formulation.cover) is not None:
        kinds.append(EFFECTS.load(GLUE))
    return {kind.name: kind for kind in kinds}


def _told(setup: Setup, kinds: dict[str, type[Effect]]) -> Setup:
    """Return what effects are built from, told of what all of them do to tractions at edges."""
    own = [own_effect(setup.scene, name)[0] for name in setup.scene.effects]
    beyond = any(kind.beyond_strain() for kind in (*kinds.values(), *own))
    return replace(setup, only_strained=not beyond)


def _makers(setup: Setup, kinds: dict[str, type[Effect]]) -> dict[str, Callable[[], Effect]]:
    """Return what builds effects of ``kinds`` and those of one's own."""
    makers: dict[str, Callable[[], Effect]] = {
        name: partial(kind.from_setup, setup) for name, kind in kinds.items()
    }
    return makers | {OWN + name: partial(make_own, setup, name) for name in setup.scene.effects}
