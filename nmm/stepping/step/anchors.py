"""Blocks that nothing holds: soft anchors in statics, and words for how a block moves.

Where statics with contact finds no equilibrium, every body is anchored by springs of `ANCHOR` times
its own stiffness to where it stands when a solution begins. Solutions are repeated from the moved
place until nothing moves (`nmm.stepping.drive.settling.settle`), so that the anchors carry nothing
in the end: it is the proximal point iteration (Rockafellar 1976). A block that no load moves, a
piece without weight that came loose or one in neutral equilibrium, stays where it is; one that a
load moves goes far.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State

if TYPE_CHECKING:
    from nmm.stepping.step.stepper import Stepper

# Stiffness of anchors in that of the bodies: far below what holds any block, far above rounding.
ANCHOR = 1e-8
# Share of a motion of all bodies that one follows if nothing but its anchor holds it.
FREE = 0.5
# So many blocks are named one by one.
NAMED = 5


def anchors(model: Model) -> csc_array:
    """Return springs (n, n) of Young's modulus times thickness over each body, times `ANCHOR`."""
    area = model.manifold.body_area[model.manifold.element_body]
    return csc_array(ANCHOR * replace(model, density=model.modulus / area).mass)


def neutral(stepper: "Stepper", state: State, names: Sequence[str]) -> list[str]:
    """Say which blocks could move though no load moves them, and how.

    Anchors drag a motion of all bodies along where nothing else holds them, and only there. A
    solver may leave a part without load where it stands, so they are asked where none were used.
    """
    model, contact = stepper.model, stepper.plan.contact
    matrix = None if contact is None else contact.solver.acting()
    # Conditions held by multipliers leave a system of fewer unknowns, which is not judged.
    if matrix is None or matrix.shape[0] != model.manifold.n_unknowns:
        return []
    soft = anchors(model)
    factor = stepper.solver.factorise(matrix if stepper.anchored else csc_array(matrix + soft))
    modes = model.manifold.rigid_modes
    found: dict[int, str] = {}
    radius = np.sqrt(model.manifold.body_area)
    for kind, size in enumerate((np.ones_like(radius), np.ones_like(radius), radius)):
        motion = np.zeros((model.manifold.n_bodies, 3))
        motion[:, kind] = 1 / size
        dragged = factor.refined(np.asarray(soft @ (modes @ motion.ravel())))
        rigid = np.asarray(model.rigid_projection @ dragged).reshape(-1, 3)
        for body in np.flatnonzero(np.abs(rigid[:, kind]) * size > FREE).tolist():
            found.setdefault(body, manner(state, body, rigid[body], float(radius[body])))
    return [
        f"block {block_name(model, body, names)} is in neutral equilibrium: {how} unopposed"
        for body, how in sorted(found.items())[:NAMED]
    ] + ([f"and {len(found) - NAMED} blocks more"] if len(found) > NAMED else [])


def largest_mover(model: Model, state: State, increment: Floats) -> tuple[int, str]:
    """Return the body that moves most, and how in words."""
    rigid = (model.rigid_projection @ increment).reshape(-1, 3)
    radius = np.sqrt(model.manifold.body_area)
    turn, shift = np.abs(rigid[:, 2]) * radius, np.hypot(rigid[:, 0], rigid[:, 1])
    body = int(np.argmax(np.maximum(turn, shift)))
    return body, manner(state, body, rigid[body], float(radius[body]))


def manner(state: State, body: int, rigid: Floats, radius: float) -> str:
    """Say how a mean motion (3,) in the body's axes moves it."""
    shift = float(np.hypot(*rigid[:2]))
    if abs(rigid[2]) * radius > shift:
        return f"it turns {'counter-clockwise' if rigid[2] > 0 else 'clockwise'}"
    if shift == 0:
        return "it stays where it is"
    x, y = state.frames.to_global(np.array([body]), rigid[None, :2])[0] / shift
    return f"it moves along ({x:.2f}, {y:.2f})"


def block_name(model: Model, body: int, names: Sequence[str]) -> str:
    """Return the name of the region of a body; ``names`` (N,) are those of the regions."""
    manifold = model.manifold
    region = manifold.element_region[np.flatnonzero(manifold.element_body == body)[0]]
    return names[region] if len(names) else f"number {body}"
