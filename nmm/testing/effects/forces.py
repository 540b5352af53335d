"""What a force of an effect is, and how force, matrix, work, energy and loss fit each other.

Forces are finite, one for each unknown, and the same when asked again. What an effect gives in a
small motion, its work less what it stores more and takes, is its force times the way. The
matrix is symmetric, and less the change of the force with the motion (by central differences,
extrapolated); of a force that depends on the length of the step, in one of `STEP`. So is the
tangent of `Effect.step_force` at trial ends of a step, under the rules of `SPANS`.

Forces with limits have kinks: members that go slack, yield or slide. Motions of these, and of
members that turn, are made of `PIECES`, and a matrix is compared in motions in which its force
meets no kink and hardly bends.
"""

from itertools import pairwise

import numpy as np
from scipy.integrate import simpson, trapezoid
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.kinematics import SMALL, Kinematics
from nmm.assembly.moving.motion import strain_only
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Span, StepForce, defines
from nmm.frozen import with_parts
from nmm.testing.claims import claim, close, finite

# Motions, in sizes of the model, at which forces and energies are compared.
WAYS = (1e-6, 1e-4)
# Of what is linear in the motion, or quadratic: rounding over the smallest motion.
LINEAR, ENERGY = 1e-6, 1e-6
# Pieces of a motion beyond limits, and what kinks within them cost: of the order of 1 / PIECES^2.
PIECES, KINKED = 64, 1e-3
# Length of the step (in units of the run's time) in which a force is asked for that needs one.
STEP = 0.1
# A step of statics, and steps in time of rules that take forces at its end, at both, and half way.
SPANS = (Span(None, 1.0, False), Span(STEP, 1.0, False), Span(STEP, 0.5, False))
HALF_WAY = (Span(STEP, 1.0, True), Span(STEP, 0.5, True))
# Share of a motion over which forces through a step are differenced, and what a tangent may lack of
# those half way, whose corrections of moments iterations follow.
NEAR, LAGS = 1e-3, 2e-3
# Turn (rad) of bodies in a motion of the size of the model, at most.
TURNS = 5.0


def check_forces(
    effect: Effect,
    name: str,
    model: Model,
    state: State,
    seed: int,
    kinematics: Kinematics = SMALL,
) -> None:
    """Hold an effect to what its force, matrix, work, energy and loss owe each other.

    ``kinematics`` say how bodies move through a step.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    ways = _ways(model, seed)
    if defines(effect, "force"):
        claim(
            any(defines(effect, one) for one in ("work", "energy", "loss")),
            f"{name}: its force does work that it does not declare: define work, energy or loss",
        )
        for way in ways:
            _work(effect, name, model, _at_rest(state), way)
    if defines(effect, "matrix"):
        _matrix(effect, name, model, state, ways)
    if defines(effect, "resistance"):
        _within_limits(effect, name, state)
    if defines(effect, "step_force") and effect.nonlinear:
        for span in SPANS + HALF_WAY:
            _tangent(effect, name, model, state, span, kinematics, seed)
    for hook in ("damping", "added_mass"):
        if defines(effect, hook):
            _resistance(name, hook, getattr(effect, hook)(state), ways)


def _within_limits(effect: Effect, name: str, state: State) -> None:
    """Compare its force with what it may exert in limit analysis."""
    found, force = effect.resistance(state), effect.force(state, Instant.of(state))
    unit = float(np.abs(force).max()) or 1.0
    close(f"{name}: force of its links", -found.along.T @ found.force / unit, force / unit, LINEAR)
    over = np.maximum(found.lowest - found.force, found.force - found.highest)
    most = float(np.abs(found.force).max(initial=0.0))
    claim(
        bool((over <= LINEAR * most).all()), f"{name}: forces beyond the limits of its resistance"
    )
    slides = np.abs(found.bond @ found.force) - found.strength
    claim(bool((slides <= LINEAR * most).all()), f"{name}: bond beyond the strength it tells")


def _ways(model: Model, seed: int) -> list[Floats]:
    """Motions (n,) of the unknowns whose places move by `WAYS` of the model's size."""
    manifold, random = model.manifold, np.random.default_rng(seed)
    points = manifold.elements.points
    rows = manifold.rows(manifold.elements.polygon_of_point, points)
    size = float(np.ptp(points, axis=0).max())
    way = random.normal(size=manifold.n_unknowns)
    moved = float(np.abs(rows.apply(way)).max())
    return [share * size / moved * way for share in WAYS]


def _at_rest(state: State) -> State:
    """Return the state without spin, whose centrifugal force is the inertia of axes that turn."""
    return with_parts(state, velocity=np.zeros_like(state.velocity))


def check_force(effect: Effect, name: str, state: State, n: int) -> None:
    """Hold a force to being (n,) finite numbers, and the same when asked again.

    Raises
    ------
    AssertionError
        Naming what it is not.
    """
    force = np.asarray(effect.force(state, Instant.of(state)))
    claim(force.shape == (n,), f"{name}: force of shape {force.shape}, expected {(n,)}")
    finite(f"{name}: force", force)
    again = effect.force(state, Instant.of(state))
    claim(np.array_equal(force, again), f"{name}: the force differs when it is asked for again")


def _work(effect: Effect, name: str, model: Model, state: State, way: Floats) -> None:
    """Compare what the effect gives on a way with its force times it.

    That is found by Simpson's rule where the force is curved, and of lines with a kink where the
    way begins by the trapezoidal one.
    """
    integral = simpson if _curved(effect) else trapezoid
    shares = np.linspace(0, 1, PIECES + 1) if _curved(effect) else np.array([-0.5, 0.0, 0.5])
    places = [strain_only(model, state, share * way) for share in shares]
    forces = np.array([effect.force(one, Instant.of(one)) for one in places])
    given = sum(_given(effect, *pair) for pair in pairwise(places))
    expected = float(integral(forces @ way, x=shares))
    size = float(integral(np.abs(forces) @ np.abs(way), x=shares))
    stored = effect.energy(places[-1]) if defines(effect, "energy") else 0.0
    unit = size + 1e-3 * abs(stored) or 1.0
    what = f"{name}: work less the gain of energy and the loss, over the force times the way"
    close(what, given / unit, expected / unit, KINKED if effect.limited else ENERGY)


def _curved(effect: Effect) -> bool:
    """Whether the force is no line in the unknowns."""
    return effect.limited or (defines(effect, "step_force") and effect.nonlinear)


def _given(effect: Effect, before: State, after: State) -> float:
    """Work (J) less what is stored more and lost."""
    given = 0.0
    if defines(effect, "work"):
        given += effect.work(before, after)
    if defines(effect, "energy"):
        given -= effect.energy(after) - effect.energy(before)
    if defines(effect, "loss"):
        given -= effect.loss(before, after)
    return given


def _matrix(effect: Effect, name: str, model: Model, state: State, ways: list[Floats]) -> None:
    end = Instant.of(state)
    if not effect.steady:
        end = Instant(state.time + STEP, state.load_factor)
    here = effect.force(state, end) if defines(effect, "force") else None
    matrix, n = effect.matrix(state), model.manifold.n_unknowns
    claim(matrix.shape == (n, n), f"{name}: matrix of shape {matrix.shape}, expected {(n, n)}")
    finite(f"{name}: matrix", matrix.data)
    _symmetric(f"{name}: matrix", matrix)
    if here is None:
        return
    for way in ways:
        change = {
            share: effect.force(strain_only(model, state, share * way), end) - here
            for share in (-0.5, -0.25, 0.25, 0.5)
        }
        expected = -(matrix @ way)
        unit = float(np.abs(expected).max()) or 1.0
        off = (np.abs(one - 2 * share * change[0.5]).max() for share, one in change.items())
        if _curved(effect) and max(off) > KINKED * unit:
            continue
        whole, half = (change[share] - change[-share] for share in (0.5, 0.25))
        what = f"{name}: change of the force with the motion against the matrix"
        close(what, (8 * half - whole) / 3 / unit, expected / unit, LINEAR)


def _tangent(
    effect: Effect,
    name: str,
    model: Model,
    state: State,
    span: Span,
    kinematics: Kinematics,
    seed: int,
) -> None:
    """Compare the tangent at trial ends of a step with differences of the force around them."""

    def at(increment: Floats) -> StepForce:
        end = kinematics.move(model, state, increment)
        return effect.step_force(state, with_parts(end, time=state.time + (span.step or 0.0)), span)

    for share, trial, way in zip(WAYS, _ways(model, seed), _ways(model, seed + 1), strict=True):
        if defines(effect, "forget"):
            effect.forget()  # a tangent that is kept may be that of another place
        here, ends = at(trial), [at(trial + side * NEAR * way) for side in (-1, 1)]
        expected, found = here.stiffness() @ way, (ends[0].force - ends[1].force) / (2 * NEAR)
        unit = float(np.abs(expected).max()) or 1.0
        bent = np.abs(ends[0].force + ends[1].force - 2 * here.force).max() / NEAR
        if effect.limited and bent > KINKED * unit:
            continue
        # Axes that turn with bodies leave a tangent behind by as much as these turn.
        tolerance = LAGS if span in HALF_WAY else LINEAR + TURNS * share
        what = f"{name}: change of the force through a step of {span} against its tangent"
        close(what, found / unit, expected / unit, tolerance)


def _resistance(name: str, hook: str, matrix: csc_array, ways: list[Floats]) -> None:
    """Dampers take energy at any velocity; what joins the mass is symmetric as they are."""
    finite(f"{name}: {hook}", matrix.data)
    size = _symmetric(f"{name}: {hook}", matrix)
    for way in ways if hook == "damping" else ():
        taken, most = float(way @ (matrix @ way)), size * float(way @ way)
        claim(taken >= -1e-12 * most, f"{name}: damping gives {-taken:.3g} W, it may only take")


def _symmetric(what: str, matrix: csc_array) -> float:
    """Claim that a matrix is symmetric, and return its size."""
    size = float(abs(matrix).max()) if matrix.nnz else 0.0
    off = float(abs(matrix - matrix.T).max()) if matrix.nnz else 0.0
    claim(off <= 1e-12 * size, f"{what} off from symmetric by {off:.3g} of {size:.3g}")
    return size
