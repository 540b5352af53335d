"""Soft anchors of blocks in statics, and words for how a block moves.

Where statics with contact finds no equilibrium, every body is anchored by springs of `ANCHOR` times
its own stiffness to where it stands when a solution begins. Solutions are repeated from the moved
place until nothing moves (`nmm.stepping.drive.equilibrium.settling`), so that the anchors carry
nothing in the end: it is the proximal point iteration (Rockafellar 1976). A block that no load
moves, a piece without weight that came loose or one in neutral equilibrium, stays where it is; one
that a load moves goes far.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State

# Stiffness of anchors in that of the bodies: far below what holds any block, far above rounding.
ANCHOR = 1e-8


def anchors(model: Model) -> csc_array:
    """Return springs (n, n) of Young's modulus times thickness over each body, times `ANCHOR`."""
    area = model.manifold.body_area[model.manifold.element_body]
    return csc_array(ANCHOR * replace(model, density=model.modulus / area).mass)


def anchor_stiffness(model: Model) -> Floats:
    """Return the stiffness (B,) of the anchor of each body against its motion (N/m)."""
    manifold = model.manifold
    strong = np.bincount(manifold.element_body, model.modulus * manifold.elements.areas)
    return ANCHOR * model.thickness * strong / manifold.body_area


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
