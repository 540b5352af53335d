"""Points that move with the material: where they stand, how they move, forces on them."""

from dataclasses import dataclass

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.rows import Rows
from integration.arrays import Floats, Ints
from integration.contraction import contract, some
from integration.plane_vectors import counterclockwise
from nmm.assembly.state import Frames, State


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

    def place(self, frames: Frames, deformation: Floats | None) -> Floats:
        """Return the current place (m, 2); None is that of bodies without deformation."""
        local = self.arm if deformation is None else self.arm + self.rows.apply(deformation)
        if frames.tilt is not None:
            across = counterclockwise(self.arm)
            local = local + frames.tilt[self.body, None] * across
        return frames.centre[self.body] + frames.to_global(self.body, local)

    def velocity(self, state: State, turning: tuple[Floats, Floats] | None) -> Floats:
        """Return the rate (m, 2) of the current place (m/s).

        ``turning`` is how fast the bodies' axes turn (B,), which carries strained points along, and
        by how much slower (B,) than the velocity of the state says (rad/s); None where none turn.
        """
        local = self.rows.apply(state.velocity)
        if turning is not None:
            rate, slower = turning
            bent = self.rows.apply(state.deformation)
            arm = rate[self.body, None] * bent - slower[self.body, None] * self.arm
            local = local + counterclockwise(arm)
        return state.frames.to_global(self.body, local)

    def way(self, before: State, after: State) -> Floats:
        """Return the displacement (m, 2) from one state to another (m)."""
        start = self.place(before.frames, before.deformation)
        return self.place(after.frames, after.deformation) - start

    def moved(self, frames: Frames, deformation: Floats) -> Floats:
        """Return the displacement (m, 2) from the reference place, without cancellation."""
        own, carried = self.own_way(frames, deformation), self.carried(frames)
        return own if carried is None else own + carried

    def carried(self, frames: Frames) -> Floats | None:
        """Return how far driven ground has carried the points (m, 2); None where nowhere (m)."""
        return None if frames.carried is None else frames.carried[self.body]

    def own_way(self, frames: Frames, deformation: Floats) -> Floats:
        """Return the displacement (m, 2) beside that by which driven ground has carried them."""
        assert frames.way is not None
        local = self.rows.apply(deformation)
        if frames.tilt is not None:
            across = counterclockwise(self.arm)
            local = local + frames.tilt[self.body, None] * across
        found = frames.way[self.body] + frames.to_global(self.body, local)
        if some(frames.angle):
            found = found + contract("mij,mj->mi", frames.turn[self.body], self.arm)
        return found

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
