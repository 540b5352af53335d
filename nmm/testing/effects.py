"""What every effect is held to: its force, its matrix, its work and its energy fit each other."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State, strain_only
from nmm.effects.base import Effect, Instant, defines
from nmm.quantity import PLACES, Quantity
from nmm.testing.claims import claim, close, finite

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene

# Motions, in sizes of the model, at which forces and energies are compared.
WAYS = (1e-6, 1e-4)
# Of what is linear in the motion, or quadratic: rounding over the smallest motion.
LINEAR, ENERGY = 1e-6, 1e-6


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
        check_effect(found, made.stepper.model, made.start)


def check_effect(effect: Effect, model: Model, state: State, seed: int = 0) -> None:
    """Hold an effect to what every one promises, at a state and at ones near it.

    Forces are finite, one for each unknown, and the same when asked again; the matrix is symmetric,
    and less the change of the force with the motion (by central differences); what the effect
    gives in a small motion, its work less what it stores more, is its mean force times the way;
    quantities and numbers that it declares are finite or nan, and fit what they belong to. What it
    carries for checkpoints gives it back as it was. Hooks change nothing of what they are given.

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
    ways = _ways(model, seed)
    if defines(effect, "force"):
        _force(effect, name, state, model.manifold.n_unknowns)
        claim(
            defines(effect, "work") or defines(effect, "energy"),
            f"{name}: its force does work that it does not declare: define work or energy",
        )
        for way in ways:
            _work(effect, name, model, state, way)
    if defines(effect, "matrix"):
        _matrix(effect, name, model, state, ways)
    for hook in ("damping", "added_mass"):
        if defines(effect, hook):
            _resistance(name, hook, getattr(effect, hook)(state), ways)
    if defines(effect, "carried"):
        _carried(effect, name, state)
    _declared(effect, name, model, state)
    for field, before in kept.items():
        claim(np.array_equal(before, getattr(state, field)), f"{name}: a hook changed the {field}")


def _copy(state: State) -> dict[str, Floats]:
    return {one: getattr(state, one).copy() for one in ("deformation", "velocity", "acceleration")}


def _ways(model: Model, seed: int) -> list[Floats]:
    """Motions (n,) of the unknowns whose places move by `WAYS` of the model's size."""
    manifold, random = model.manifold, np.random.default_rng(seed)
    points = manifold.elements.points
    rows = manifold.rows(manifold.elements.polygon_of_point, points)
    size = float(np.ptp(points, axis=0).max())
    way = random.normal(size=manifold.n_unknowns)
    moved = float(np.abs(rows.apply(way)).max())
    return [share * size / moved * way for share in WAYS]


def _force(effect: Effect, name: str, state: State, n: int) -> None:
    force = np.asarray(effect.force(state, Instant.of(state)))
    claim(force.shape == (n,), f"{name}: force of shape {force.shape}, expected {(n,)}")
    finite(f"{name}: force", force)
    again = effect.force(state, Instant.of(state))
    claim(np.array_equal(force, again), f"{name}: the force differs when it is asked for again")


def _work(effect: Effect, name: str, model: Model, state: State, way: Floats) -> None:
    """Compare work less stored energy with the mean force times the way, about the state."""
    before, after = (strain_only(model, state, sign * way) for sign in (-0.5, 0.5))
    forces = [effect.force(one, Instant.of(one)) for one in (before, after)]
    mean = (forces[0] + forces[1]) / 2
    expected = float(mean @ way)
    done = effect.work(before, after) if defines(effect, "work") else 0.0
    energies = [0.0, 0.0]
    if defines(effect, "energy"):
        energies = [effect.energy(before), effect.energy(after)]
    given = done - (energies[1] - energies[0])
    size = float(np.abs(mean) @ np.abs(way)) + 1e-3 * max(map(abs, energies))
    what = f"{name}: work less the gain of energy over the mean force times the way"
    unit = size or 1.0
    close(what, given / unit, expected / unit, ENERGY)


def _matrix(effect: Effect, name: str, model: Model, state: State, ways: list[Floats]) -> None:
    matrix, n = effect.matrix(state), model.manifold.n_unknowns
    claim(matrix.shape == (n, n), f"{name}: matrix of shape {matrix.shape}, expected {(n, n)}")
    finite(f"{name}: matrix", matrix.data)
    size = float(abs(matrix).max()) if matrix.nnz else 0.0
    off = float(abs(matrix - matrix.T).max()) if matrix.nnz else 0.0
    claim(off <= 1e-12 * size, f"{name}: matrix off from symmetric by {off:.3g} of {size:.3g}")
    if not defines(effect, "force"):
        return
    for way in ways:
        ends = [strain_only(model, state, sign * way) for sign in (0.5, -0.5)]
        change = effect.force(ends[0], Instant.of(state)) - effect.force(ends[1], Instant.of(state))
        expected = -(matrix @ way)
        unit = float(np.abs(expected).max()) or 1.0
        what = f"{name}: change of the force with the motion against the matrix"
        close(what, change / unit, expected / unit, LINEAR)


def _resistance(name: str, hook: str, matrix: csc_array, ways: list[Floats]) -> None:
    """Dampers take energy at any velocity; what joins the mass is symmetric as they are."""
    finite(f"{name}: {hook}", matrix.data)
    size = float(abs(matrix).max()) if matrix.nnz else 0.0
    off = float(abs(matrix - matrix.T).max()) if matrix.nnz else 0.0
    claim(off <= 1e-12 * size, f"{name}: {hook} off from symmetric by {off:.3g} of {size:.3g}")
    for way in ways if hook == "damping" else ():
        taken, most = float(way @ (matrix @ way)), size * float(way @ way)
        claim(taken >= -1e-12 * most, f"{name}: damping gives {-taken:.3g} W, it may only take")


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
