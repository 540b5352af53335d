"""The state of a model carried over to the next one: places, displacements, rates.

Bodies stay where they are: frames go on with the body that most of a new one comes from, and
displacements and rates are projected (`covers.change.transfer`). What the projection of rates
leaves of linear and angular momentum, as the mass of either model has them and about the deformed
place, is put right by a rigid motion of each body.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array, csc_array, csr_array

from covers.approximation.own_rule import own_rule
from covers.change.inheritance import inherited
from covers.change.parentage import Parentage
from covers.change.transfer import Transfer, by_body
from integration.arrays import Bools, Floats
from nmm.assembly.carried_history import carried_history
from nmm.assembly.model import Model
from nmm.assembly.motion import Frames, State


def carried(old: Model, new: Model, kin: Parentage, state: State, declared: State) -> State:
    """Return the state on the new model; bodies without parents start as ``declared``."""
    density = old.density if (old.density > 0).all() else np.ones_like(old.density)
    transfer = Transfer.of(kin, density, inherited(kin))
    deformation = transfer.deformation(state.deformation, old.drained)
    deformation = _without_rigid(old, new, transfer, state.deformation, deformation)
    known = ~kin.new_bodies[np.repeat(new.manifold.cover_body, np.diff(new.manifold.cover_offset))]

    def either(found: Floats, start: Floats) -> Floats:
        return np.where(known, found, start)

    frames = _frames(old, new, kin, state.frames, declared.frames)
    placed = either(deformation, declared.deformation)
    shift = _mean_way(new, kin, placed)
    frames, deformation = _centred(new, frames, placed, shift)
    moving = _Moving(old, new, transfer, state.deformation, deformation, shift)
    velocity, acceleration = (
        moving.rates(rate) if rate.any() else np.zeros_like(deformation)
        for rate in (state.velocity, state.acceleration)
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
    local = arm + tilt[:, None] * np.stack([-arm[:, 1], arm[:, 0]], axis=1)
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
    )


def _mean_way(new: Model, kin: Parentage, deformation: Floats) -> Floats:
    """Mean way (B, 2) of the deformation of parts of divided bodies; zero of the others."""
    parted = ~(_whole(kin) | kin.new_bodies)
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
    moved = Frames(frames.centre + shift, frames.angle, frames.tilt, far)
    rigid = np.column_stack([way, np.zeros(len(way))])
    return moved, np.asarray(deformation - new.manifold.rigid_modes @ rigid.ravel())


def _without_rigid(
    old: Model, new: Model, transfer: Transfer, before: Floats, after: Floats
) -> Floats:
    """Give the displacement the mean rigid motion (3 B,) that it had by the old model's measure.

    Bodies that inherit unknowns have it from these.
    """
    kin = transfer.kin
    if not transfer.loose.any():
        return after
    had = np.asarray(old.rigid_projection @ before).reshape(-1, 3)
    has = np.asarray(new.rigid_projection @ after).reshape(-1, 3)
    # Parts of a body that was divided keep the motion that they have of their own.
    whole = _whole(kin) & transfer.loose
    wrong = np.where(whole[:, None], had[np.maximum(kin.bodies.main, 0)] - has, 0.0)
    return np.asarray(after + new.manifold.rigid_modes @ wrong.ravel())


def _whole(kin: Parentage) -> Bools:
    """Which new bodies (B,) are all of one old one, and nothing else."""
    bodies = kin.bodies
    children = np.bincount(bodies.parent, minlength=bodies.n_parents)
    parents = np.bincount(bodies.child, minlength=bodies.n_children)
    main = np.maximum(bodies.main, 0)
    alone = (bodies.main >= 0) & (children[main] == 1) & (parents == 1)
    close = np.isclose(kin.old.body_area[main], kin.new.body_area, rtol=1e-9, atol=0.0)
    return np.asarray(alone & close)


@dataclass(frozen=True)
class _Moving:
    """What rates must keep: the momenta (3 B,) of bodies in their own axes.

    Frames have taken over ``shift`` (B, 2) of what the bodies' displacements ``before`` were.
    """

    old: Model
    new: Model
    transfer: Transfer
    before: Floats
    after: Floats
    shift: Floats

    def rates(self, rate: Floats) -> Floats:
        """Project a rate (n,) and put its momenta right."""
        found, modes = self.transfer.rates(rate), self.new.manifold.rigid_modes
        missing = self._had(rate) - self._rows @ found
        return np.asarray(found + modes @ by_body(csr_array(self._rows @ modes), missing))

    def _had(self, rate: Floats) -> Floats:
        """Momenta (3 B,) that the new bodies are to have."""
        kin = self.transfer.kin
        whole, main = _whole(kin), np.maximum(kin.bodies.main, 0)
        before = (momenta(self.old, self.before) @ rate).reshape(-1, 3)
        if whole.all():
            return np.asarray(before[main].ravel())
        parts = self._of_points(rate)
        parts += self._missing(before, parts)
        return np.where(whole[:, None], before[main], parts).ravel()

    def _of_points(self, rate: Floats) -> Floats:
        """The same (B, 3) by points everywhere, for bodies that were divided."""
        kin, heavy = self.transfer.kin, bool((self.old.density > 0).all())
        transfer = Transfer.of(kin, self.old.density if heavy else np.ones_like(self.old.density))
        fast = transfer.old.apply(rate)
        body = kin.new.element_body[transfer.elements[1]]
        centre = (kin.new.body_centroid + self.shift)[body]
        arm = transfer.points - centre + transfer.old.apply(self.before)
        thick = self.old.thickness if heavy else 1.0
        return thick * transfer.sums(np.column_stack([fast, _cross(arm, fast)]))

    def _missing(self, before: Floats, parts: Floats) -> Floats:
        """Share (B, 3) of each part in what parts lack of the momenta ``before`` (A, 3) of one.

        Points do not integrate singular functions to the last digit. Bodies of several parents
        lack nothing, nor do those that they share parents with.
        """
        kin, bodies = self.transfer.kin, self.transfer.kin.bodies
        main, area = np.maximum(bodies.main, 0), kin.new.body_area
        several = np.bincount(bodies.child, minlength=len(parts)) != 1
        mixed = np.bincount(bodies.parent, several[bodies.child], minlength=len(before)) > 0
        alone = ~several & ~mixed[main]

        def lacking(axis: int, values: Floats) -> Floats:
            sums = np.bincount(main, alone * values, minlength=len(before))
            return np.asarray(share * (before[:, axis] - sums)[main])

        share = alone * area / np.bincount(main, area, minlength=len(before))[main]
        found = np.zeros_like(parts)
        for axis in (0, 1):
            found[:, axis] = lacking(axis, parts[:, axis])
        arm = kin.new.body_centroid + self.shift - kin.old.body_centroid[main]
        found[:, 2] = lacking(2, parts[:, 2] + _cross(arm, (parts + found)[:, :2]))
        return found

    @cached_property
    def _rows(self) -> csr_array:
        return momenta(self.new, self.after)


def _cross(arm: Floats, way: Floats) -> Floats:
    return np.asarray(arm[:, 0] * way[:, 1] - arm[:, 1] * way[:, 0])


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
    across = np.stack([-away[:, 1], away[:, 0]], axis=1)
    share = model.density[rule.owner] * model.thickness if heavy else 1.0
    values = ((share * rule.weights)[:, None] * at.along(across)).ravel()
    row = 3 * manifold.element_body[rule.owner] + 2
    place = np.repeat(row, at.unknowns.shape[1]), at.unknowns.ravel()
    return csr_array(rows + csc_array(coo_array((values, place), shape=rows.shape)))
