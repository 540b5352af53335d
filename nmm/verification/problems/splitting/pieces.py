"""A block in flight that is cut through its centroid: what its pieces take over."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from covers.approximation.own_rule import own_rule
from nmm.assembly.moving.momenta import rigid_masses, whole_momentum
from nmm.assembly.moving.motion import rigid_rates
from nmm.assembly.state import State, initial_state
from nmm.splitting.cuts import pieces
from nmm.splitting.division import replaced
from nmm.verification import text
from nmm.verification.base import Case, Check, Checks, limit

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.effects.change import Change
    from nmm.stepping.step.stepper import Stepper

SPIN = ((0.0, -2.0), (2.0, 0.0))
GRADIENT = ((0.3, -0.2), (0.5, -0.1))
SPEED = (3.0, 1.0)
"""Velocity of the centroid (m/s), and gradients (1/s) of a spin and of any linear motion."""


def flying_block() -> str:
    """Scene of a block of 2 x 1 m and 4000 kg that nothing holds."""
    return text.scene(
        'title = "block"\nplane = "stress"\nthickness = 0.25\nduration = "1 s"\n'
        "[inertia]\n[contact]\n",
        [
            text.material("rock", modulus=1e9, poisson=0.2, density=8000.0),
            text.block("block", "rock", text.rectangle((0, 0), (2, 1))),
            text.interface("any", 30.0),
        ],
    )


def moving(model: "Model", velocity: Sequence[float], gradient: Sequence[Sequence[float]]) -> State:
    """Return a state whose velocity is linear in the place from the centroid on."""
    manifold, rule = model.manifold, own_rule(model.manifold)
    rows = manifold.rows(rule.owner, rule.points)
    away = rule.points - manifold.body_centroid[0]
    wanted = np.asarray(velocity) + away @ np.asarray(gradient).T
    matrix = rows.matrix(manifold.n_unknowns).toarray()
    found = np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)[0]
    return replace(initial_state(manifold), velocity=found)


def split(stepper: "Stepper", state: State, angle: float, number: int = 0) -> "Change":
    """Cut body ``number`` through its centroid at an angle (rad)."""
    setup = stepper.discretisation.setup
    regions = setup.geometry.regions
    polygon = regions.polygons.to_shapely()[number]
    middle = np.array(polygon.centroid.coords[0])
    found, parent = replaced(regions.polygons, {number: pieces(polygon, middle, [angle])})
    return stepper.reshape(replace(setup.geometry, regions=regions.divided(found, parent)), state)


@dataclass(frozen=True)
class PiecesInFlight(Case):
    """A block that spins, or moves linearly, is cut at 50 degrees."""

    spins: bool = True
    name = "SP1"
    title = "Pieces of a block in flight go on as its points did"
    source = "Rigid-body mechanics: velocities of the centroids, nothing lost"
    formulations = ("dda", "degree 2", "manifold", "bilinear quads")
    # A spin, and a motion with a gradient of velocity.
    parameters: ClassVar = {"spins": (True, False)}

    @property
    def variant(self) -> str:
        return "spin" if self.spins else "gradient of velocity"

    def checks(self, formulation: str) -> Checks:
        """Cut the block; compare places, velocities, momenta and energy."""
        from nmm.scene import parse_scene
        from nmm.stepping.prepare import prepare
        from nmm.verification.formulations import chosen

        scene = parse_scene(flying_block(), "benchmark SP1")
        stepper = prepare(scene, chosen(formulation, scene.formulation)).stepper
        state = moving(stepper.model, SPEED, SPIN if self.spins else GRADIENT)
        middle = state.frames.centre[0]
        change = split(stepper, state, float(np.radians(50)))
        after, mass = change.state, rigid_masses(change.new)
        *momentum, angular = whole_momentum(change.new, after, middle)
        centre, velocity = after.frames.centre, rigid_rates(change.new, after)
        order = np.argsort(centre[:, 0])
        energy = float(after.velocity @ (change.new.mass @ after.velocity) / 2)
        fast = (
            [[2.860150061, 0.05867401592], [3.139849939, 1.941325984]]
            if self.spins
            else [[2.844816109, 0.7576760071], [3.155183891, 1.242323993]]
        )
        known = (23333.33333333, 3333.3333333333) if self.spins else (20235.0, 733.3333333333)
        places = [[0.529337008, 0.5699249693], [1.470662992, 0.4300750307]]
        digits, kept = "digits of the table", "rounding"
        checks = {
            "mass off": limit(float(np.abs(mass[:, 0] / 2000 - 1).max()), 1e-12, kept),
            "momentum off (N s)": limit(
                float(np.abs(np.subtract(momentum, [12000, 4000])).max()), 1e-8, kept
            ),
            "angular momentum (N m s)": Check(float(angular), known[1], 1e-9, kept),
            "energy (J)": Check(energy, known[0], 1e-10, kept),
            "centroids off (m)": limit(float(np.abs(centre[order] - places).max()), 1e-9, digits),
            "velocities off (m/s)": limit(
                float(np.abs(velocity[order, :2] - fast).max()), 1e-8, digits
            ),
        }
        if self.spins:
            off = float(np.abs(velocity[:, 2] - 2).max())
            checks["spin off (rad/s)"] = limit(off, 1e-8, digits)
        return checks
