"""Ties of bodies that rotate within a step: where their forces act, and in which axes.

A force that acts on bodies in the axes of the start of a step has the arms of the start. Half way
it keeps the angular momentum of two bodies that are tied.
"""

import numpy as np

from integration.arrays import Floats
from integration.sparse import bsr_array, csr_array, eye_array
from nmm.assembly.model import Model
from nmm.assembly.state import State, rotation_matrices
from nmm.constraints.imposition import Imposition
from nmm.effects.base import Setup
from nmm.integrators.base import make_integrator

# Of a body: forces half way couple all of them.
MOST_UNKNOWNS = 100


def turning(setup: Setup) -> Model | None:
    """Return the model of a scene whose ties are solved for their forces at the end of steps.

    That is one in time of bodies that turn and have few unknowns, under a rule that takes forces at
    the end alone: means of both ends let the force of a stiff tie go to and fro, and grow.
    """
    model, scene = setup.model, setup.scene
    if scene.inertia is None or not setup.kinematics.turns:
        return None
    rule = make_integrator(setup.formulation.integrator)
    rule = rule.among_contacts if scene.contact is not None else rule
    unknowns = np.diff(model.rigid_projection.indptr).max(initial=0)
    return model if rule.end_weight == 1 and unknowns <= MOST_UNKNOWNS else None


def turned_axes(model: Model, before: State, at: State) -> csr_array:
    """Matrix (n, n) from the unknowns of a step to those in axes that have turned on since.

    All but the mean translation of a body turns with its axes.
    """
    turn = rotation_matrices(before.frames.angle - at.frames.angle) - np.eye(2)
    blocks = np.zeros((len(turn), 3, 3))
    blocks[:, :2, :2] = turn
    bodies = np.arange(len(turn) + 1)
    size = 3 * len(turn)
    shifted = bsr_array((blocks, bodies[:-1], bodies), shape=(size, size))
    more = model.manifold.rigid_modes @ shifted @ model.rigid_projection
    return csr_array(eye_array(len(before.deformation)) + more)


def rounded(tie: Imposition, state: State) -> Floats:
    """Forces (m, 2) in N at the points of a tie that come from rounded coordinates (m)."""
    interface = tie.interface
    far = max(float(np.abs(side.points.arm).max(initial=0.0)) for side in interface.sides)
    far = max(far, float(np.abs(interface.motion(state)).max(initial=0.0)))
    none = np.zeros((len(interface), 2))
    tiny = tie.point_forces(state, none + float(np.finfo(float).eps) * far)
    return np.asarray(tiny - tie.point_forces(state, none))
