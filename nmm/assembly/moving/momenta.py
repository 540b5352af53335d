"""Mass, momentum and angular momentum of the bodies of a model."""

import numpy as np

from covers.approximation.own_rule import own_rule
from integration.arrays import Floats
from integration.plane_vectors import counterclockwise, cross
from integration.sparse import coo_array, csc_array, csr_array
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.solvers.unchecked import product


def rigid_masses(model: Model) -> Floats:
    """Mass (kg) twice and moment of inertia (kg m2) of each body (B, 3), about its centroid."""
    modes = model.manifold.rigid_modes
    return np.asarray((modes.T @ (model.mass @ modes)).diagonal().reshape(-1, 3))


def resultants(model: Model, force: Floats) -> Floats:
    """Forces x, y (N) and moments (N m) of forces (n,) on bodies as wholes (B, 3), in their axes.

    Moments are about the centroids of bodies as they were laid.
    """
    return product(model.manifold.rigid_modes.T, force).reshape(-1, 3)


def rigid_momenta(model: Model, state: State) -> Floats:
    """Momentum x, y (N s) of each body (B, 3) in its axes, and angular momentum (N m s).

    About the centroid where it was laid: of bodies that bend by any angle see `own_momenta`.
    """
    return resultants(model, model.mass @ state.velocity)


def own_momenta(model: Model, state: State, finite: bool) -> Floats:
    """Momentum x, y (N s) of each body (B, 3) in its axes, and angular momentum (N m s).

    About where the frames' centres are; ``finite`` says whether bodies bend by any angle, so that
    it counts where their deformation has brought them.
    """
    if not finite:
        return rigid_momenta(model, state)
    return np.asarray(momenta(model, state.deformation) @ state.velocity).reshape(-1, 3)


def momenta_about(state: State, own: Floats, about: Floats) -> tuple[Floats, Floats]:
    """Momentum (B, 2) and angular momentum (B,) about a point (2,) along the global axes.

    ``own`` (B, 3) are those of each body in its axes, about where its frame's centre is.
    """
    pushed = state.frames.to_global(np.arange(len(own)), own[:, :2])
    arm = state.frames.centre - about
    return pushed, cross(arm, pushed) + own[:, 2]


def whole_momentum(model: Model, state: State, about: Floats, finite: bool = False) -> Floats:
    """Momentum x, y (N s) and angular momentum about a point (N m s) of all bodies (3,)."""
    linear, angular = momenta_about(state, own_momenta(model, state, finite), about)
    return np.array([*linear.sum(axis=0), angular.sum()])


def momenta(model: Model, deformation: Floats) -> csr_array:
    """Rows (3 B, n): linear momentum, and angular momentum about where the frames' centres are.

    They act on velocities of bodies with a deformation (n,), in body axes.
    """
    manifold, heavy = model.manifold, bool((model.density > 0).all())
    mass = model.mass if heavy else model.measure
    rows = csr_array((mass @ manifold.rigid_modes).T)
    if not deformation.any():
        return rows
    rule = own_rule(manifold)
    at = manifold.rows(rule.owner, rule.points)
    away = at.apply(deformation)
    across = counterclockwise(away)
    share = model.density[rule.owner] * model.thickness if heavy else 1.0
    values = ((share * rule.weights)[:, None] * at.along(across)).ravel()
    row = 3 * manifold.element_body[rule.owner] + 2
    place = np.repeat(row, at.unknowns.shape[1]), at.unknowns.ravel()
    return csr_array(rows + csc_array(coo_array((values, place), shape=rows.shape)))
