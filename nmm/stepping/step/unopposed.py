"""Blocks that nothing holds: which they are, and which motions of theirs nothing opposes."""

from collections.abc import Sequence

import numpy as np
from scipy.sparse import csc_array, diags_array

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.moving.momenta import resultants
from nmm.assembly.state import State
from nmm.solvers.factor import Factor
from nmm.stepping.step.anchors import anchor_stiffness, anchors, block_name, manner
from nmm.stepping.step.stepper import Stepper

# Share of a motion of all bodies that one follows if nothing but its anchor holds it.
FREE = 0.5
# So many blocks are named one by one.
NAMED = 5


def too_weak(stepper: Stepper) -> bool:
    """Whether no anchors could balance what the last solution with contact left.

    Some body is pushed by more than its anchor carries over the size of the domain.
    """
    model, contact = stepper.model, stepper.plan.contact
    left = None if contact is None else contact.solver.unbalanced()
    # Conditions that multipliers hold beside contact leave fewer unknowns, which are not judged.
    if left is None or len(left) != model.manifold.n_unknowns:
        return False
    push = resultants(model, left)
    return bool((np.hypot(push[:, 0], push[:, 1]) > anchor_stiffness(model) * stepper.size).any())


def unheld(stepper: Stepper, state: State, names: Sequence[str], balanced: bool) -> list[str]:
    """Say which blocks are unsupported, and how they could move; no load does if ``balanced``.

    A solver may leave a part without load where it stands, so they are asked where no anchors were
    used too.
    """
    model, found = stepper.model, unopposed(stepper, state if balanced else None)
    radius = np.sqrt(model.manifold.body_area)
    stands = "in neutral equilibrium" if balanced else "held by nothing"
    return [
        f"block {block_name(model, body, names)} is {stands}: "
        f"{manner(state, body, motion, float(radius[body]))} unopposed"
        for body, motion in sorted(found.items())[:NAMED]
    ] + ([f"and {len(found) - NAMED} blocks more"] if len(found) > NAMED else [])


def unopposed(stepper: Stepper, at: State | None = None) -> dict[int, Floats]:
    """Return the bodies that nothing holds, each with a rigid motion (3,) that nothing opposes.

    In the equilibrium ``at``, where it is given, loads oppose turns too, see `_turned_back`, and so
    does friction where contacts that slid would slide back: a block that its weight spreads on a
    floor, both corners outwards, sticks on one of them whichever way it is pushed.
    Anchors drag a motion of all bodies along where nothing else holds them, and only there. Strain
    makes none stiffer, so that rigid motions alone are asked.
    """
    stiffness = _against_rigid_motions(stepper)
    if stiffness is None:
        return {}
    held = np.zeros(stiffness.shape[0]) if at is None else _turned_back(stepper, at)
    soft, ways = _soft(stepper.model), _ways(stepper.model)
    factor = stepper.solver.factorise(csc_array(stiffness + diags_array(soft + held)))
    found: dict[int, Floats] = {}
    for kind, way in enumerate(ways):
        free = _dragged(factor, soft, way, kind)
        if at is not None and free:
            free = _either_way(stepper, held, free, kind)
        found = free | found
    return found


def _soft(model: Model) -> Floats:
    """Return stiffnesses (3 B,) of anchors against the rigid motions of bodies."""
    arm = np.sqrt(model.manifold.body_area)[:, None] ** [0, 0, 2]
    return np.asarray(anchor_stiffness(model)[:, None] * arm).ravel()


def _ways(model: Model) -> Floats:
    """Return motions (3, B, 3) of all bodies alike: along x, along y, and turns."""
    radius = np.sqrt(model.manifold.body_area)
    ways = np.zeros((3, len(radius), 3))
    ways[0, :, 0], ways[1, :, 1], ways[2, :, 2] = 1.0, 1.0, 1 / radius
    return ways


def _dragged(factor: Factor, soft: Floats, way: Floats, kind: int) -> dict[int, Floats]:
    """Return the bodies that anchors drag along in a motion (B, 3) of one kind, each with its own.

    ``factor`` is of the stiffness (3 B, 3 B) with the anchors, ``soft`` (3 B,) theirs.
    """
    dragged = factor.refined(soft * way.ravel()).reshape(-1, 3)
    far = np.abs(dragged[:, kind]) > FREE * way[:, kind]
    return {body: dragged[body] for body in np.flatnonzero(far).tolist()}


def _either_way(
    stepper: Stepper, held: Floats, free: dict[int, Floats], kind: int
) -> dict[int, Floats]:
    """Return those of the ``free`` bodies that friction lets go one way or the other."""
    soft, way = _soft(stepper.model), _ways(stepper.model)[kind]
    motion = np.zeros_like(way)
    motion[list(free)] = list(free.values())
    found: dict[int, Floats] = {}
    for back in (motion, -motion):
        stiffness = _against_rigid_motions(stepper, back.ravel())
        if stiffness is not None:
            factor = stepper.solver.factorise(csc_array(stiffness + diags_array(soft + held)))
            found |= _dragged(factor, soft, way, kind)
    return found


def _turned_back(stepper: Stepper, at: State) -> Floats:
    """Return by what rigid motions (3 B,) are opposed as arms of loads turn: turns alone (N m).

    In equilibrium ``sum F . x`` of forces that keep their direction is ``int tr(sigma) dV``, about
    any point. None of bodies that others touch, whose forces turn with faces, nor where pressures
    follow; what is turned on is not judged.
    """
    model, plan = stepper.model, stepper.plan
    manifold, added = model.manifold, plan.added_stress(at)
    stress = model.stress(at) if added is None else model.stress(at) + added
    moment = model.thickness * manifold.elements.areas * (stress[:, 0] + stress[:, 1])
    back = np.maximum(np.bincount(manifold.element_body, moment, manifold.n_bodies), 0.0)
    back[_pressed(stepper)] = 0.0
    if not all(effect.symmetric for effect in plan.effects.values()):
        back[:] = 0.0
    return np.stack([0.0 * back, 0.0 * back, back], axis=1).ravel()


def _pressed(stepper: Stepper) -> Ints:
    """Return bodies on which contacts of the last accepted state press, with repetitions."""
    contact = stepper.plan.contact
    if contact is None:
        return np.zeros(0, dtype=np.int64)
    points = contact.standing
    edges = np.concatenate([points.edge_a, points.edge_b])[np.tile(points.normal_force != 0, 2)]
    return np.asarray(stepper.model.manifold.boundary.body[edges])


def left_alone(stepper: Stepper) -> bool:
    """Whether some body is held by nothing, and no such body is pressed by another."""
    alone = list(unopposed(stepper))
    return bool(alone) and not np.isin(alone, _pressed(stepper)).any()


def _against_rigid_motions(stepper: Stepper, back: Floats | None = None) -> csc_array | None:
    """Return the stiffness (3 B, 3 B) of the last system but for anchors; None where not known.

    Contacts that slid stick where the rigid motions ``back`` (3 B,) would turn them back.
    """
    model, contact = stepper.model, stepper.plan.contact
    n, modes = model.manifold.n_unknowns, model.manifold.rigid_modes
    if contact is not None:
        matrix = contact.solver.acting(None if back is None else modes @ back)
    else:
        matrix = None if stepper.factor is None else stepper.factor.matrix
    # Conditions that multipliers hold beside contact leave fewer unknowns, which are not judged.
    if matrix is None or matrix.shape[0] < n:
        return None
    own = matrix if matrix.shape[0] == n else csc_array(matrix[:n, :n])
    if stepper.anchored:
        own = csc_array(own - anchors(model))
    stiffness = modes.T @ (own @ modes)
    if matrix.shape[0] > n:
        held = csc_array(matrix[n:, :n]) @ modes
        stiffness = stiffness + abs(own.diagonal()).max() * (held.T @ held)
    return csc_array(stiffness)
