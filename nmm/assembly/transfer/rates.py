"""Velocities and accelerations carried over to the next model, with the momenta of bodies."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.change.transfer import Transfer, by_body
from integration.arrays import Floats
from integration.plane_vectors import counterclockwise, cross
from integration.sparse import csr_array
from nmm.assembly.model import Model
from nmm.assembly.moving.momenta import momenta


@dataclass(frozen=True)
class CarriedRates:
    """What rates must keep: the momenta (3 B,) of bodies in their own axes.

    Velocities of bodies whose axes turn are momentum over mass as the bodies were laid: those of
    the material turn by ``omega (1 - 2 s / J0)`` about strained arms (`nmm.effects.inertia`).

    Attributes
    ----------
    old, new, transfer
        Both models, and what carries fields from one to the other.
    before, after
        Deformations (n,) of the state on either.
    shift
        (B, 2) what frames have taken over of the displacements before (m).
    turning
        Whether rates are velocities of bodies whose axes turn with them.
    """

    old: Model
    new: Model
    transfer: Transfer
    before: Floats
    after: Floats
    shift: Floats
    turning: bool = False

    def rates(self, rate: Floats) -> Floats:
        """Project a rate (n,) and put its momenta right."""
        found, modes = self.transfer.rates(rate), self.new.manifold.rigid_modes
        missing = self._had(rate) - self._rows @ found
        return np.asarray(found + modes @ by_body(csr_array(self._rows @ modes), missing))

    def _had(self, rate: Floats) -> Floats:
        """Momenta (3 B,) that the new bodies are to have."""
        kin = self.transfer.kin
        whole, main = kin.whole, np.maximum(kin.bodies.main, 0)
        strained = np.zeros_like(self.before) if self.turning else self.before
        before = (momenta(self.old, strained) @ rate).reshape(-1, 3)
        if whole.all():
            return np.asarray(before[main].ravel())
        parts = self._of_points(rate)
        parts += self._missing(before, parts)
        return np.where(whole[:, None], before[main], parts).ravel()

    def _of_points(self, rate: Floats) -> Floats:
        """The same (B, 3) by points everywhere, for bodies that were divided."""
        kin, heavy = self.transfer.kin, bool((self.old.density > 0).all())
        transfer = Transfer.of(kin, self.old.density if heavy else np.ones_like(self.old.density))
        body = kin.new.element_body[transfer.elements[1]]
        centre = (kin.new.body_centroid + self.shift)[body]
        way = transfer.old.apply(self.before)
        arm, fast = transfer.points - centre + way, transfer.old.apply(rate)
        if self.turning:
            parent = kin.old.element_body[transfer.elements[0]]
            spin, slower = (one[parent, None] for one in self._spins(rate))
            about = transfer.points - kin.old.body_centroid[parent] + way
            fast = fast + spin * counterclockwise(way) - slower * counterclockwise(about)
        thick = self.old.thickness if heavy else 1.0
        return thick * transfer.sums(np.column_stack([fast, cross(arm, fast)]))

    def _spins(self, rate: Floats) -> tuple[Floats, Floats]:
        """Spin (A,) of the old bodies, and how much less they turn, ``2 omega s / J0`` (rad/s)."""
        modes = self.old.manifold.rigid_modes
        spin = (self.old.rigid_projection @ rate).reshape(-1, 3)[:, 2]
        turn = modes @ np.tile([0.0, 0.0, 1.0], len(spin))
        laid, strained = (
            (momenta(self.old, deformation) @ turn).reshape(-1, 3)[:, 2]
            for deformation in (np.zeros_like(self.before), self.before)
        )
        return spin, 2 * spin * (strained - laid) / laid

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
        found[:, 2] = lacking(2, parts[:, 2] + cross(arm, (parts + found)[:, :2]))
        return found

    @cached_property
    def _rows(self) -> csr_array:
        return momenta(self.new, np.zeros_like(self.after) if self.turning else self.after)
