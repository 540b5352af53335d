"""An effect of a scene that is laid elsewhere and turned gives the same force, matrix and energy.

Covers of both scenes need not match: what is compared is the work of forces, and the quadratic
forms of matrices, on motions that every cover holds: on each body, displacements that are linear
in position.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from integration.rules import polygon_rule
from nmm.assembly.model import Model
from nmm.assembly.moving.motion import strain_only
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, defines
from nmm.testing.claims import claim, close
from nmm.trust import allowing, beside

if TYPE_CHECKING:
    from nmm.scene import Scene

# Degree of the rule whose points tell motions of covers apart.
FINE = 8
# Gradients of displacements: a rotation and three strains.
GRADIENTS = np.array([[[0, -1], [1, 0]], [[1, 0], [0, 0]], [[0, 0], [0, 1]], [[0, 1], [1, 0]]])
# Error, over its size, of a motion that a cover holds: rounding of unknowns that nearly depend.
HELD = 1e-9
# Strains and rotations of the deformed state.
STRAIN = 1e-5
# Relative error after a shift by a thousand sizes of the scene: coordinates are rounded
# to 1e-13 of it, and gaps and arms of forces are differences of them.
EXACT = 1e-8
# Work, over the stiffness of the bodies, of what is rounding alone.
NOTHING = 1e-15


def check_moved_effect(
    scene: "Scene",
    moved: "Scene",
    name: str,
    turn: float = 0.0,
    tolerance: float = EXACT,
    allow_code: Sequence[str] = (),
) -> None:
    """Hold an effect to the same answer in a scene that is shifted and turned as a whole.

    Parameters
    ----------
    scene, moved
        The same scene twice, with its formulation, the second elsewhere.
    name
        The effect in the plan, as in the scene's ``[effects.NAME]``.
    turn
        Angle (rad) by which the second is turned.
    tolerance
        Relative to the largest work, or entry, of the first.
    allow_code
        Modules beside the scene that it may import.

    Raises
    ------
    AssertionError
        Naming what differs, by how much, and what was tolerated.
    KeyError
        When a scene has no such effect.
    """
    with allowing(*allow_code, folder=beside(scene.source.name, allow_code)):
        here, there = _Placed(scene, name, 0.0), _Placed(moved, name, turn)
    claim(
        here.motions.shape[1] == there.motions.shape[1],
        f"{name}: {here.motions.shape[1]} linear motions, {there.motions.shape[1]} when moved",
    )
    for strained in (False, True):
        expected, found = here.answers(strained), there.answers(strained)
        for what, values in expected.items():
            unit = max(float(np.abs(values).max()), NOTHING * here.stiffness)
            when = "strained bodies" if strained else "the start"
            told = f"{name}: {what} at {when}, moved against unmoved over the largest"
            close(told, found[what] / unit, values / unit, tolerance)


class _Placed:
    """An effect where a scene lays it, with linear motions of its bodies along turned axes."""

    def __init__(self, scene: "Scene", name: str, turn: float) -> None:
        from nmm.formulation import Formulation
        from nmm.model.effects_table import OWN
        from nmm.stepping.prepare import prepare

        made = prepare(scene, scene.formulation or Formulation())
        # Effects hold one another weakly: their plan keeps those that this one asks.
        self.plan = made.stepper.plan
        effects = self.plan.effects
        self.effect: Effect = effects[OWN + name if OWN + name in effects else name]
        self.model, self.start = made.stepper.model, made.start
        self.stiffness = float(self.model.modulus.max() * self.model.element_area.sum())
        self.motions = linear_motions(self.model, turn)

    def answers(self, strained: bool) -> dict[str, Floats]:
        """Return works, quadratic forms and energies, at the start or at strained bodies."""
        effect, motions, answers = self.effect, self.motions, dict[str, Floats]()
        state = self._strained() if strained else self.start
        if defines(effect, "force"):
            answers["force"] = motions.T @ effect.force(state, Instant.of(state))
        for hook in ("matrix", "damping", "added_mass"):
            if defines(effect, hook):
                answers[hook] = motions.T @ (getattr(effect, hook)(state) @ motions)
        if defines(effect, "energy"):
            answers["energy"] = np.array([effect.energy(state)])
        for hook in ("work", "loss"):
            if defines(effect, hook):
                answers[hook] = np.array([getattr(effect, hook)(self.start, state)])
        return answers

    def _strained(self) -> State:
        """Return the state after a random linear motion of every body."""
        share = np.random.default_rng(0).uniform(-STRAIN, STRAIN, self.motions.shape[1])
        return strain_only(self.model, self.start, self.motions @ share)


def linear_motions(model: Model, turn: float) -> Floats:
    """Return unknowns (n, k) of displacements linear in position, along axes turned by ``turn``.

    Of each body two shifts, a rotation and three strains, but for those that covers do not hold,
    as rigid ones do not hold strains.
    """
    manifold = model.manifold
    rule = polygon_rule(manifold.elements, FINE)
    body = manifold.element_body[rule.owner]
    axes = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    fields = np.zeros((len(rule.points), 2, manifold.n_bodies, len(GRADIENTS) + 2))
    for number in range(manifold.n_bodies):  # scenes of suites have a few bodies
        inside = body == number
        points, weights = rule.points[inside], rule.weights[inside]
        along = (points - np.average(points, axis=0, weights=weights)) @ axes.T
        gradients = np.einsum("kij,pj->pik", GRADIENTS, along)
        shifts = np.broadcast_to(np.sqrt(weights.sum()) * np.eye(2), (len(along), 2, 2))
        local = np.concatenate([shifts, gradients], axis=2)
        fields[inside, :, number] = np.einsum("ia,pik->pak", axes, local)
    wanted = fields.reshape(2 * len(rule.points), -1)
    rows = manifold.rows(rule.owner, rule.points)
    matrix = np.stack([rows.apply(one).ravel() for one in np.eye(manifold.n_unknowns)], axis=1)
    motions, *_ = np.linalg.lstsq(matrix, wanted, rcond=1e-12)
    held = np.abs(matrix @ motions - wanted).max(axis=0) < HELD * np.abs(wanted).max(axis=0)
    return np.asarray(motions[:, held])
