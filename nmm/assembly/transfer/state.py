"""The state of a model carried over to the next one: places, displacements, rates.

Bodies stay where they are: frames go on with the body that most of a new one comes from, and
displacements and rates are projected (`covers.change.transfer`). What the projection of rates
leaves of linear and angular momentum, as the mass of either model has them and about the deformed
place, is put right by a rigid motion of each body.
"""

from dataclasses import replace

import numpy as np

from covers.change.inheritance import inherited
from covers.change.parentage import Parentage
from covers.change.transfer import Transfer
from integration.arrays import Floats
from integration.plane_vectors import counterclockwise
from nmm.assembly.model import Model
from nmm.assembly.state import Frames, State
from nmm.assembly.transfer.history import carried_history
from nmm.assembly.transfer.rates import CarriedRates


def carried(
    old: Model, new: Model, kin: Parentage, state: State, declared: State, turning: bool = False
) -> State:
    """Return the state on the new model; bodies without parents start as ``declared``.

    ``turning`` says whether the axes of bodies turn with them.
    """
    density = old.density if (old.density > 0).all() else np.ones_like(old.density)
    transfer = Transfer.of(kin, density, inherited(kin))
    deformation = transfer.deformation(state.deformation, old.drained)
    deformation = _without_rigid(old, new, transfer, state.deformation, deformation)
    known = ~kin.new_bodies[new.manifold.unknown_body]

    def either(found: Floats, start: Floats) -> Floats:
        return np.where(known, found, start)

    frames = _frames(old, new, kin, state.frames, declared.frames)
    placed = either(deformation, declared.deformation)
    shift = _mean_way(new, kin, placed)
    frames, deformation = _centred(new, frames, placed, shift)
    moving = CarriedRates(old, new, transfer, state.deformation, deformation, shift)
    velocity, acceleration = (
        way.rates(rate) if rate.any() else np.zeros_like(deformation)
        for way, rate in (
            (replace(moving, turning=turning), state.velocity),
            (moving, state.acceleration),
        )
    )
    return replace(
        state,
        frames=frames,
        deformation=deformation,
        velocity=either(velocity, declared.velocity),
        acceleration=either(acceleration, declared.acceleration),
        history=carried_history(old, new, kin, state.history, declared.history),
    )


def _frames(old: Model, new: Model, kin: Parentage, frames: Frames, declared: Frames) -> Frames:
    """Frames of the new bodies: those of their parents, seen from their own centroids."""
    parent = np.maximum(kin.bodies.main, 0)
    arm = new.manifold.body_centroid - old.manifold.body_centroid[parent]
    tilt = np.zeros(len(parent)) if frames.tilt is None else frames.tilt[parent]
    local = arm + tilt[:, None] * counterclockwise(arm)
    far = np.zeros_like(frames.centre) if frames.way is None else frames.way
    shift = frames.to_global(parent, local)
    turned = np.einsum("bij,bj->bi", frames.turn[parent], local) + local - arm
    fresh, one = kin.new_bodies, kin.new_bodies[:, None]
    assert declared.way is not None
    return Frames(
        np.where(one, declared.centre, frames.centre[parent] + shift),
        np.where(fresh, declared.angle, frames.angle[parent]),
        None if frames.tilt is None else np.where(fresh, 0.0, tilt),
        None if frames.way is None else np.where(one, declared.way, far[parent] + turned),
        None if frames.carried is None else np.where(one, 0.0, frames.carried[parent]),
    )


def _mean_way(new: Model, kin: Parentage, deformation: Floats) -> Floats:
    """Mean way (B, 2) of the deformation of parts of divided bodies; zero of the others."""
    parted = ~(kin.whole | kin.new_bodies)
    if not parted.any():
        return np.zeros((len(parted), 2))
    mean = np.asarray(new.rigid_projection @ deformation).reshape(-1, 3)[:, :2]
    return np.where(parted[:, None], mean, 0.0)


def _centred(new: Model, frames: Frames, deformation: Floats, way: Floats) -> tuple[Frames, Floats]:
    """Let the frames take over a ``way`` (B, 2) of the deformation."""
    if not way.any():
        return frames, deformation
    shift = frames.to_global(np.arange(len(way)), way)
    far = None if frames.way is None else frames.way + shift
    moved = Frames(frames.centre + shift, frames.angle, frames.tilt, far, frames.carried)
    rigid = np.column_stack([way, np.zeros(len(way))])
    return moved, np.asarray(deformation - new.manifold.rigid_modes @ rigid.ravel())


def _without_rigid(
    old: Model, new: Model, transfer: Transfer, before: Floats, after: Floats
) -> Floats:
    """Give the displacement the mean rigid motion (3 B,) that it had by the old model's measure.

    Bodies that inherit unknowns have it from these.
    """
    kin = transfer.kin
    if not transfer.inherits_nothing.any():
        return after
    had = np.asarray(old.rigid_projection @ before).reshape(-1, 3)
    has = np.asarray(new.rigid_projection @ after).reshape(-1, 3)
    # Parts of a body that was divided keep the motion that they have of their own.
    whole = kin.whole & transfer.inherits_nothing
    wrong = np.where(whole[:, None], had[np.maximum(kin.bodies.main, 0)] - has, 0.0)
    return np.asarray(after + new.manifold.rigid_modes @ wrong.ravel())
