"""The place of the material: a frame for each body, and a small deformation in it.

A point ``X`` of body ``b`` stands at ``x = c_b + R(theta_b) (X - Xc_b + T(X) q)``. Step unknowns
are increments in the body's axes, ``delta x = R(theta_b) T(X) d``: the covers are carried with the
material, so that stiffness and mass are assembled once and a turned body keeps its size and its
stress (MacLaughlin and Sitar 1996 name the growth of the linear update that this avoids).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from covers.approximation.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.contraction import contract
from nmm.frozen import MadeOnce


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
    carried
        (B, 2) from where the ``way`` counts (m): where the ground is that supports drive them by,
        whose springs need the digits of the way below it. None is where they were laid.
    """

    centre: Floats
    angle: Floats
    tilt: Floats | None = None
    way: Floats | None = None
    carried: Floats | None = None

    @property
    def whole_way(self) -> Floats | None:
        """(B, 2) the way with that by which ground has carried the bodies (m)."""
        if self.way is None or self.carried is None:
            return self.way
        return np.asarray(self.way + self.carried)

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
        return contract("mij,mj->mi", self.rotation[body], vectors)

    def to_body(self, body: Ints, vectors: Floats) -> Floats:
        """Turn vectors (m, 2) from global axes to body axes."""
        return contract("mji,mj->mi", self.rotation[body], vectors)


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
