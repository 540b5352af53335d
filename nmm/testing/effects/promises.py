"""What every effect is held to: its forces, what it declares, and what it carries."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.kinematics import SMALL, Kinematics
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, defines
from nmm.quantity import PLACES, Quantity
from nmm.testing.claims import claim, finite
from nmm.testing.effects.forces import check_force, check_forces

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene


def check_effect_of(
    scene: "Scene",
    name: str,
    formulation: "Formulation | None" = None,
    allow_code: Sequence[str] = (),
) -> None:
    """Hold the effect ``[effects.NAME]`` of a scene, or a built-in one, to `check_effect`.

    Where neither call nor scene has a formulation it is checked on blocks, whose unknowns are few
    and all at every point, and on a mesh of triangles, where points know some of them.

    Raises
    ------
    AssertionError
        As `check_effect`.
    KeyError
        When the scene has no such effect.
    """
    from nmm.formulation import Formulation
    from nmm.model.effects_table import OWN
    from nmm.stepping.prepare import prepare
    from nmm.trust import allowing, beside

    given = formulation or scene.formulation
    with allowing(*allow_code, folder=beside(scene.source.name, allow_code)):
        prepared = [prepare(scene, given or Formulation())]
        if given is None:
            size = float(np.ptp(prepared[0].stepper.model.manifold.elements.points)) / 4
            mesh = {"cover": {"type": "triangles", "size": size, "degree": 1}}
            prepared.append(prepare(scene, Formulation.model_validate(mesh)))
    for made in prepared:
        effects = made.stepper.plan.effects
        found = effects[OWN + name if OWN + name in effects else name]
        check_effect(found, made.stepper.model, made.start, kinematics=made.stepper.kinematics)


def check_effect(
    effect: Effect, model: Model, state: State, seed: int = 0, kinematics: Kinematics = SMALL
) -> None:
    """Hold an effect to what every one promises, at a state and at ones near it.

    Forces, matrices, tangents, work and energy fit each other (`nmm.testing.effects.forces`),
    where bodies move through a step as ``kinematics`` say; quantities and
    numbers that it declares are finite or nan, and fit what they belong to. What it carries for
    checkpoints gives it back as it was. Hooks change nothing of what they are given.

    Parameters
    ----------
    effect
        Built for the model.
    model, state
        What it acts on; a state in time may have velocities.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    name = type(effect).__name__
    kept = _copy(state)
    if defines(effect, "force"):
        check_force(effect, name, state, model.manifold.n_unknowns)
    _declared(effect, name, model, state)
    _unchanged(name, state, kept)
    check_forces(effect, name, model, state, seed, kinematics)
    if defines(effect, "carried"):
        _carried(effect, name, state)
    _unchanged(name, state, kept)


def _copy(state: State) -> dict[str, Floats]:
    return {one: getattr(state, one).copy() for one in ("deformation", "velocity", "acceleration")}


def _unchanged(name: str, state: State, kept: dict[str, Floats]) -> None:
    for field, before in kept.items():
        claim(np.array_equal(before, getattr(state, field)), f"{name}: a hook changed the {field}")


def _carried(effect: Effect, name: str, state: State) -> None:
    """What a checkpoint holds of an effect gives it back as it was."""
    claim(defines(effect, "carry"), f"{name}: it defines carried and not carry")
    forces = []
    for _ in range(2):
        if defines(effect, "force"):
            forces.append(np.array(effect.force(state, Instant.of(state))))
        effect.carry(effect.carried())
    same = all(np.array_equal(forces[0], one) for one in forces)
    claim(same, f"{name}: the force differs after carry(carried())")


def _declared(effect: Effect, name: str, model: Model, state: State) -> None:
    """Ask for all that is said of the state itself; numbers and quantities are what they say."""
    if defines(effect, "energy"):
        finite(f"{name}: energy", effect.energy(state))
    if defines(effect, "work"):
        finite(f"{name}: work of no motion", effect.work(state, state))
    if defines(effect, "history"):
        for key, value in effect.history(state).items():
            finite(f"{name}: history {key}", value)
    if defines(effect, "segments"):
        for key, one in effect.segments(state).quantities.items():
            finite(f"{name}: {key}", one.values)
    if defines(effect, "outputs"):
        for key, one in effect.outputs(state).items():
            check_quantity(f"{name}: quantity {key}", one, model)


def check_quantity(what: str, one: Quantity, model: Model, contacts: int = 0) -> None:
    """Hold a quantity to fitting what it belongs to.

    Raises
    ------
    AssertionError
        Naming what does not fit.
    """
    manifold = model.manifold
    sizes = (len(manifold.elements.points), len(manifold.elements), manifold.n_bodies)
    # Members are those of `Effect.segments`; cracks and tips are as many as there are.
    counts = (*sizes, contacts, 0, len(one.values), len(one.values))
    claim(one.on in PLACES, f"{what}: on {one.on!r}, expected one of {', '.join(PLACES)}")
    expected = dict(zip(PLACES, counts, strict=True))[one.on]
    values = np.asarray(one.values)
    claim(values.dtype.kind == "f", f"{what}: values of type {values.dtype}, expected numbers")
    claim(values.ndim in (1, 2), f"{what}: values of shape {values.shape}, expected (n,) or (n, k)")
    claim(len(values) == expected, f"{what}: {len(values)} rows, expected {expected} on {one.on}")
    claim(not np.isinf(values).any(), f"{what}: infinite values")
    width = values.shape[1] if values.ndim == 2 else 1
    named = len(one.components)
    claim(named in (0, width), f"{what}: {named} names for {width} components")
