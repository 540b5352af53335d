"""Position and velocity of bodies after an increment, and the motion of their points."""

from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats, Ints
from integration.contraction import contract, largest
from nmm.assembly.kept import forget_kept, kept_of_place
from nmm.assembly.material_points import vertex_points
from nmm.assembly.model import Model
from nmm.assembly.moving.kinematics import Kinematics
from nmm.assembly.moving.motion import move as plainly
from nmm.assembly.state import State
from nmm.frozen import with_parts
from nmm.model.discretisation import CurrentDiscretisation
from nmm.solvers.linear import Factor, LinearSolver
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.linear.equations import Equations
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.effects.change import Change


class Mover:
    """Moves the bodies of one run.

    Parameters
    ----------
    current
        What is solved.
    kinematics
        How bodies move.

    Attributes
    ----------
    current, kinematics
        The same.
    vertices
        The elements' vertices, which are followed.
    """

    def __init__(
        self,
        current: CurrentDiscretisation,
        solver: LinearSolver,
        kinematics: Kinematics,
        clock: Clock,
    ) -> None:
        self.current, self.solver, self._clock = current, solver, clock
        self.kinematics = kinematics
        self._masses: tuple[csc_array, Ints, Factor] | None = None
        self._follow(self.current.model)

    def follow(self, change: "Change") -> None:
        """Follow the vertices of the new model."""
        self._follow(change.new)

    def _follow(self, model: Model) -> None:
        self.vertices = vertex_points(model.manifold)
        forget_kept(self)

    def forget(self) -> None:
        """Drop what is kept for speed alone."""
        self._masses = None
        forget_kept(self)

    def after(self, equations: Equations, increment: Floats, push: Floats | None = None) -> Attempt:
        """Move by ``increment``; ``push`` (n,) is the contact force if its acceleration counts."""
        with self._clock.phase("update"):
            state, end = equations.state, equations.end
            moved = self.moved(self._faster(equations, increment, push), increment)
            moved = with_parts(moved, time=end.time, load_factor=end.load_factor)
            way = self.place(moved) - self.place(state)
            motion = float(np.sqrt(largest(contract("ij,ij->i", way, way))))
        return Attempt(True, "converged", moved, increment, motion, 0.0, 1)

    @kept_of_place
    def place(self, state: State) -> Floats:
        """Return where the elements' vertices are (P, 2)."""
        contact = self.current.plan.contact
        if contact is not None and contact.partners.sides.whole:
            # The same points, which contact is requested too.
            return contact.partners.surface(state).start
        return self.vertices.place(state.frames, state.deformation)

    def moved(self, state: State, increment: Floats) -> State:
        """Return a state moved by ``increment`` (n,), by compiled code where bodies may touch."""
        move, frames = self.kinematics.move, state.frames
        if move is plainly and self.current.plan.contact is not None and frames.way is not None:
            from nmm.assembly.moving.moved_bodies import move
        return move(self.current.model, state, increment)

    def _faster(self, equations: Equations, increment: Floats, push: Floats | None) -> State:
        """Return the state at the start with the rates of the end."""
        state, step, rule = equations.origin, equations.step, equations.rule
        if step is None or equations.inertia is None:
            return state
        before, less = rule.kinetic_factor * state.velocity, equations.inertia.turned_less
        spun = increment if less is None else increment + less
        velocity, acceleration = rule.rates(spun, before, state.acceleration, step)
        if push is not None:
            fast, more = rule.contact_kick
            kick = self._accelerated(push)
            velocity, acceleration = velocity + fast * step * kick, acceleration + more * kick
        return with_parts(state, velocity=velocity, acceleration=acceleration)

    def _accelerated(self, push: Floats) -> Floats:
        """Return the acceleration (n,) by a force; none of what has no mass.

        The force is what was left of the others, rounding among it. Where functions are dependent
        that part has no acceleration, which says nothing: the solution is not judged.
        """
        inertia = self.current.plan.inertia
        assert inertia is not None
        mass = inertia.mass
        if self._masses is None or self._masses[0] is not mass:
            heavy = np.flatnonzero(mass.diagonal() > 0)
            factor = self.solver.factorise(csc_array(mass[heavy][:, heavy]))
            self._masses = mass, heavy, factor
        _, heavy, factor = self._masses
        found = np.zeros_like(push)
        found[heavy] = factor.refined(push[heavy])
        return found
