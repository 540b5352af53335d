"""The place of the material: a frame for each body, and a small deformation in it.

A point ``X`` of body ``b`` stands at ``x = c_b + R(theta_b) (X - Xc_b + T(X) q)``. Step unknowns
are increments in the body's axes, ``delta x = R(theta_b) T(X) d``: the covers are carried with the
material, so that stiffness and mass are assembled once and a turned body keeps its size and its
stress (MacLaughlin and Sitar 1996 name the growth of the linear update that this avoids).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.rows import Rows
from integration.arrays import Floats, Ints
from integration.contraction import contract, some
from nmm.assembly.model import Model
from nmm.frozen import MadeOnce, with_parts
from nmm.solvers.unchecked import product


@dataclass(frozen=True)
class Frames:
    """Place of the bodies.

    Attributes
    ----------
    centre
        (B, 2) where the bodies' centroids are now (m).
    angle
        (B,) how far the bodies have turned, counter-clockwise (rad).
    tilt
        (B,) linear rotations besides, of small displacements that are kept apart from the strain;
        None is none.
    way
        (B, 2) how far the centroids have come from where they were laid (m): what differences of
        places have lost to the rounding of coordinates. None where it was not followed.
    """

    centre: Floats
    angle: Floats
    tilt: Floats | None = None
    way: Floats | None = None

    @MadeOnce
    def rotation(self) -> Floats:
        """(B, 2, 2) from body axes to global axes."""
        return rotation_matrices(self.angle)

    @MadeOnce
    def turn(self) -> Floats:
        """(B, 2, 2) the rotation minus the identity, without cancellation."""
        found = np.empty((len(self.angle), 2, 2))
        found[:, 0, 0] = found[:, 1, 1] = -2 * np.sin(self.angle / 2) ** 2
        found[:, 1, 0] = np.sin(self.angle)
        found[:, 0, 1] = -found[:, 1, 0]
        return found

    def to_global(self, body: Ints, vectors: Floats) -> Floats:
        """Turn vectors (m, 2) from body axes to global axes."""
        return np.asarray(contract("mij,mj->mi", self.rotation[body], vectors))

    def to_body(self, body: Ints, vectors: Floats) -> Floats:
        """Turn vectors (m, 2) from global axes to body axes."""
        return np.asarray(contract("mji,mj->mi", self.rotation[body], vectors))


@dataclass(frozen=True)
class State:
    """What the step loop carries from step to step.

    Attributes
    ----------
    time, load_factor
        s; factor on the scaled loads.
    frames
        Place of the bodies.
    deformation
        (n,) unknowns of the deformation in body axes, without rigid part.
    velocity, acceleration
        (n,) rates of the unknowns in body axes.
    history
        Internal variables (Q, h) of material points by name, as the last accepted step left them
        (`Model.history`); empty where all matter is linear.
    memory
        What effects remember by the names of their members, as the last accepted step left it.
    """

    time: float
    load_factor: float
    frames: Frames
    deformation: Floats
    velocity: Floats
    acceleration: Floats
    history: Mapping[str, Floats] = field(default_factory=dict)
    memory: Mapping[str, Floats] = field(default_factory=dict)


def rotation_matrices(angle: Floats) -> Floats:
    """Return the matrices (..., 2, 2) of rotations by ``angle`` (...,), counter-clockwise."""
    c, s = np.cos(angle), np.sin(angle)
    found = np.empty((*np.shape(angle), 2, 2))
    found[..., 0, 0], found[..., 0, 1] = c, -s
    found[..., 1, 0], found[..., 1, 1] = s, c
    return found


def initial_frames(manifold: Manifold) -> Frames:
    """Return the frames of bodies in the reference configuration."""
    # Writable, as all later ones are, so that functions are compiled for one type.
    centre = manifold.body_centroid.copy()
    return Frames(centre, np.zeros(manifold.n_bodies), way=np.zeros_like(centre))


def initial_state(manifold: Manifold) -> State:
    """Return the state at rest in the reference configuration."""
    n = manifold.n_unknowns
    return State(0.0, 0.0, initial_frames(manifold), np.zeros(n), np.zeros(n), np.zeros(n))


def coordinate_rounding(manifold: Manifold) -> Floats:
    """Return the unknowns (n,) of a motion of all bodies by the rounding of coordinates.

    Where nothing acts such motions are all there is, and no force is there to measure them by.
    """
    farthest = float(np.abs(manifold.elements.points).max())
    along = manifold.rigid_modes @ np.tile([1.0, 1.0, 0.0], manifold.rigid_modes.shape[1] // 3)
    return np.asarray(float(np.finfo(float).eps) * farthest * along)


@dataclass(frozen=True)
class MaterialPoints:
    """Points that move with the material.

    Attributes
    ----------
    body
        (m,) the body each belongs to.
    arm
        (m, 2) reference place from the body's centroid.
    rows
        Evaluation rows in body axes.
    """

    body: Ints
    arm: Floats
    rows: Rows

    def place(self, frames: Frames, deformation: Floats) -> Floats:
        """Return the current place (m, 2)."""
        local = self.arm + self.rows.apply(deformation)
        if frames.tilt is not None:
            across = np.stack([-self.arm[:, 1], self.arm[:, 0]], axis=1)
            local = local + frames.tilt[self.body, None] * across
        return frames.centre[self.body] + frames.to_global(self.body, local)

    def way(self, before: State, after: State) -> Floats:
        """Return the displacement (m, 2) from one state to another (m)."""
        start = self.place(before.frames, before.deformation)
        return self.place(after.frames, after.deformation) - start

    def moved(self, frames: Frames, deformation: Floats) -> Floats:
        """Return the displacement (m, 2) from the reference place, without cancellation."""
        assert frames.way is not None
        local = self.rows.apply(deformation)
        if frames.tilt is not None:
            across = np.stack([-self.arm[:, 1], self.arm[:, 0]], axis=1)
            local = local + frames.tilt[self.body, None] * across
        found = frames.way[self.body] + frames.to_global(self.body, local)
        if some(frames.angle):
            found = found + contract("mij,mj->mi", frames.turn[self.body], self.arm)
        return np.asarray(found)

    def along(self, frames: Frames, directions: Floats) -> Floats:
        """Rows (m, L) of the motion along global directions (m, 2)."""
        return self.rows.along(frames.to_body(self.body, directions))

    def push(self, state: State, forces: Floats) -> Floats:
        """Return the load vector (n,) of forces (m, 2) in global axes (N)."""
        local = state.frames.to_body(self.body, forces)
        return self.rows.spread(local, len(state.deformation))

    def work(self, before: State, after: State, force: Floats) -> float:
        """Return the work (J) of mean forces (m, 2) of a step in global axes (N)."""
        return float(np.sum(force * self.way(before, after)))

    def take(self, index: Ints) -> "MaterialPoints":
        """Return some of the points."""
        return MaterialPoints(self.body[index], self.arm[index], self.rows.take(index))


def material_points(manifold: Manifold, elements: Ints, points: Floats) -> MaterialPoints:
    """Return reference points (m, 2) in elements (m,) as material points."""
    body = manifold.element_body[elements]
    return MaterialPoints(
        body, points - manifold.body_centroid[body], manifold.rows(elements, points)
    )


def vertex_points(manifold: Manifold) -> MaterialPoints:
    """Return the elements' vertices (P) as material points."""
    elements = manifold.elements
    return material_points(manifold, elements.polygon_of_point, elements.points)


def move(model: Model, state: State, increment: Floats) -> State:
    """Return the state after the step unknowns ``increment``, with the rotation exact.

    The mean translation moves the frames, the mean rotation turns them exactly, and what remains is
    added to the deformation (for a block ``x' = c + u0 + R(r0)(I + eps)(x - c)``). Of the velocity
    only the mean translation keeps its global direction; the rest turns with the material.
    """
    modes = model.manifold.rigid_modes
    rigid = product(model.rigid_projection, increment).reshape(-1, 3)
    frames = state.frames
    shift = np.asarray(contract("mij,mj->mi", frames.rotation, rigid[:, :2]))
    moved = Frames(
        frames.centre + shift,
        frames.angle + rigid[:, 2],
        frames.tilt,
        None if frames.way is None else frames.way + shift,
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


def _turn_translation(model: Model, rate: Floats, turn: Floats) -> Floats:
    """Keep the mean translation of a rate fixed in space while the body's axes ``turn``."""
    if not some(rate):
        return rate
    mean = product(model.rigid_projection, rate).reshape(-1, 3)
    turned = contract("bji,bj->bi", turn, mean[:, :2])
    mean[:, :2], mean[:, 2] = turned - mean[:, :2], 0.0
    return np.asarray(rate + product(model.manifold.rigid_modes, mean.ravel()))


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
