"""From one state to the next by the unknowns of a step: bodies turn, translate or only strain."""

from dataclasses import replace

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats
from integration.contraction import contract, some
from nmm.assembly.model import Model
from nmm.assembly.state import Frames, State, rotation_matrices
from nmm.frozen import with_parts
from nmm.solvers.unchecked import product


def move(model: Model, state: State, increment: Floats) -> State:
    """Return the state after the step unknowns ``increment``, with the rotation exact.

    The mean translation moves the frames, the mean rotation turns them exactly, and what remains is
    added to the deformation (for a block ``x' = c + u0 + R(r0)(I + eps)(x - c)``). Of the velocity
    only the mean translation keeps its global direction; the rest turns with the material.
    """
    modes = model.manifold.rigid_modes
    rigid = product(model.rigid_projection, increment).reshape(-1, 3)
    frames = state.frames
    shift = contract("mij,mj->mi", frames.rotation, rigid[:, :2])
    moved = Frames(
        frames.centre + shift,
        frames.angle + rigid[:, 2],
        frames.tilt,
        None if frames.way is None else frames.way + shift,
        frames.carried,
    )
    # The rounded increment of the angle: a velocity must not drift against its axes.
    turn = rotation_matrices(moved.angle - frames.angle)
    return with_parts(
        state,
        frames=moved,
        deformation=state.deformation + increment - product(modes, rigid.ravel()),
        velocity=_turn_translation(model, state.velocity, turn),
        acceleration=_turn_translation(model, state.acceleration, turn),
    )


def translate(model: Model, state: State, increment: Floats) -> State:
    """Return the state after the step unknowns ``increment``: frames translate and never turn.

    All that is not mean translation, the whole rotation among it, is added to the deformation.
    """
    rigid = (model.rigid_projection @ increment).reshape(-1, 3)
    rigid[:, 2] = 0.0
    shift, frames = rigid[:, :2], state.frames
    far = None if frames.way is None else frames.way + shift
    return replace(
        state,
        frames=replace(frames, centre=frames.centre + shift, way=far),
        deformation=state.deformation + increment - model.manifold.rigid_modes @ rigid.ravel(),
    )


def strain_only(
    model: Model, state: State, increment: Floats, rigid: Floats | None = None
) -> State:
    """Return the state after ``increment`` (n,) in small displacements: the bodies' axes stay.

    Rigid motions (3 B,) that the increment does not hold move the frames, rotations as tilts.
    """
    after = replace(state, deformation=state.deformation + increment)
    if rigid is None:
        return after
    way, frames = rigid.reshape(-1, 3), state.frames
    bodies = np.arange(len(way))
    shift = frames.to_global(bodies, way[:, :2])
    tilt = way[:, 2] if frames.tilt is None else frames.tilt + way[:, 2]
    far = None if frames.way is None else frames.way + shift
    moved = replace(frames, centre=frames.centre + shift, tilt=tilt, way=far)
    return replace(after, frames=moved)


def carried_on(state: State, ground: Floats, way: Floats, beside: Floats) -> State:
    """Return the state with its bodies carried along with ground that supports drive.

    Parameters
    ----------
    ground
        (B, 2) from where the ways of bodies count then (m).
    way, beside
        (B, 2) how far they are carried, and by how much their ways beside it change (m).
    """
    frames = state.frames
    assert frames.way is not None
    places = {"centre": frames.centre + way, "way": frames.way + beside}
    return with_parts(state, frames=replace(frames, carried=ground, **places))


def middle(before: State, after: State) -> State:
    """Return the midpoint of two states."""
    frames = Frames(
        (before.frames.centre + after.frames.centre) / 2,
        (before.frames.angle + after.frames.angle) / 2,
    )
    return with_parts(
        before, frames=frames, deformation=(before.deformation + after.deformation) / 2
    )


def rigid_rates(model: Model, state: State) -> Floats:
    """Velocity of the centroid and rate of rotation (B, 3) of the bodies, along the global axes."""
    mean = np.asarray(model.rigid_projection @ state.velocity).reshape(-1, 3)
    middle = state.frames.to_global(np.arange(len(mean)), mean[:, :2])
    return np.column_stack([middle, mean[:, 2]])


def coordinate_rounding(manifold: Manifold) -> Floats:
    """Return the unknowns (n,) of a motion of all bodies by the rounding of coordinates.

    Where nothing acts such motions are all there is, and no force is there to measure them by.
    """
    farthest = float(np.abs(manifold.elements.points).max())
    along = manifold.rigid_modes @ np.tile([1.0, 1.0, 0.0], manifold.rigid_modes.shape[1] // 3)
    return np.asarray(float(np.finfo(float).eps) * farthest * along)


def _turn_translation(model: Model, rate: Floats, turn: Floats) -> Floats:
    """Keep the mean translation of a rate fixed in space while the body's axes ``turn``."""
    if not some(rate):
        return rate
    mean = product(model.rigid_projection, rate).reshape(-1, 3)
    turned = contract("bji,bj->bi", turn, mean[:, :2])
    mean[:, :2], mean[:, 2] = turned - mean[:, :2], 0.0
    return np.asarray(rate + product(model.manifold.rigid_modes, mean.ravel()))
