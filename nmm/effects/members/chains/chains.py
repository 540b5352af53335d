"""Chains of links with slip at their inner points: bonded bars.

The elongation of a link is that of the ground between its points, plus the difference of its slips
there. Slips follow from the equilibrium of the bar, whose axial force changes from link to link by
the bond force. They are found by Newton's method on one tridiagonal system for each bar, and
statically condensed, so that the step sees axial forces and their tangent alone. Links without
slip, as springs, are chains of one link.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.linalg import LinAlgError, cho_solve_banded, cholesky_banded
from scipy.sparse import block_diag, coo_array, csr_array, diags_array

from integration.arrays import Floats, Ints
from nmm.effects.members.chains.layout import NONE, SlipLayout
from nmm.effects.members.fibres import FibreAnswer, Fibres
from nmm.solvers.unchecked import product

# Residual of a bar, over its forces, at which slips have converged, and the largest number of
# iterations.
BALANCED, MOST = 1e-13, 60
# A residual that falls no further for rounding is accepted up to this share.
ROUNDED = 1e-9
ROUNDING = 10 * float(np.finfo(float).eps)
# Shortest step of the line search on slips.
SHORTEST = 0.5**7
# The same where a bar that slides and yields all along is held by `LEFT` alone, which says nothing
# of how far it is to where some of it is elastic again.
FARTHEST = 0.5**40
# Share of its elastic stiffness that a bond always keeps in the iteration, so that a bar without
# bond stays where it is.
LEFT = 1e-10


@dataclass(frozen=True)
class ChainAnswer:
    """The response of chains to elongations.

    Attributes
    ----------
    axial, bond
        Forces of m links and of the bond at p slips.
    slip
        (p,) slips (m).
    broken
        Numbers of the slips of bars without stable equilibrium; empty where there are none.
    """

    axial: FibreAnswer
    bond: FibreAnswer
    slip: Floats
    broken: Ints


@dataclass(frozen=True)
class Chains:
    """Links in chains; the slips of a chain are consecutive.

    Attributes
    ----------
    axial
        Laws of m links.
    bond
        Laws of the bond at p slips.
    left, right
        (m,) number of the slip at either end of a link; -1 for a fixed end.
    """

    axial: Fibres
    bond: Fibres
    left: Ints
    right: Ints

    @classmethod
    def without_slip(cls, axial: Fibres) -> Self:
        """Return links that are a chain each."""
        none = Fibres.of([], np.zeros(0), np.zeros(0))
        fixed = np.full(len(axial), -1)
        return cls(axial, none, fixed, fixed)

    @cached_property
    def layout(self) -> SlipLayout:
        """Where the slips are."""
        return SlipLayout(self.left, self.right, len(self.bond))

    @property
    def elastic(self) -> bool:
        """Whether nothing yields, so that there is no memory."""
        return bool(self.axial.elastic.all() and self.bond.elastic.all())

    @cached_property
    def linear(self) -> bool:
        """Whether axial forces are linear in the elongations."""
        return self.axial.linear and self.bond.linear

    def answer(self, stretch: Floats, slip: Floats, memory: tuple[Floats, Floats]) -> ChainAnswer:
        """Return the response to elongations (m,) (m), by iteration from slips (p,) (m).

        That of linear laws begins where they balance, whatever ``slip`` is. ``memory`` is that of
        links (m, 2) and of bonds (p, 2) at the start of the step.
        """
        begun = self._linear_slips(stretch) if self.linear and len(slip) else slip
        now = self._at(stretch, begun, memory)
        if not len(slip):
            return now
        size = before = np.inf
        out, scale = self._residual(now)
        for _ in range(MOST):
            size = float(np.abs(out).max()) / scale if scale else 0.0
            if size <= BALANCED or (size <= ROUNDED and size > before / 2):
                break
            before = size
            now, (out, scale) = self._nearer(now, out, stretch, memory)
        _, unstable = self._factors(now)
        lost = np.arange(len(slip)) if size > ROUNDED else unstable
        return ChainAnswer(now.axial, now.bond, now.slip, lost)

    def tangent(self, found: ChainAnswer) -> csr_array:
        """Tangent (m, m) of axial forces by elongations, with slips condensed (N/m)."""
        own = found.axial.tangent
        if not len(found.slip):
            return csr_array(diags_array(own))
        band, values = self._band(found), []
        for links, slips, opening in self.layout.bars:  # each bar has a small system of its own
            block = np.diag(own[links])
            if len(slips):
                stiff = own[links, None] * opening
                factor = cholesky_banded(band[:, slips])
                block = block - stiff @ cho_solve_banded((factor, False), stiff.T)
            values.append(block.ravel())
        shape = (len(own), len(own))
        return csr_array(coo_array((np.concatenate(values), self.layout.places), shape=shape))

    def _at(self, stretch: Floats, slip: Floats, memory: tuple[Floats, Floats]) -> ChainAnswer:
        axial = self.axial.answer(stretch + self.layout.opened(slip), memory[0])
        return ChainAnswer(axial, self.bond.answer(slip, memory[1]), slip, NONE)

    def _linear_slips(self, stretch: Floats) -> Floats:
        """Return the slips (p,) at which linear laws balance under elongations (m,)."""
        axial, bond = self.axial, self.bond
        held = self.layout.pulled(axial.area * axial.start + axial.stiffness * stretch)
        return -product(self._compliance, held + bond.area * bond.start)

    @cached_property
    def _compliance(self) -> csr_array:
        """(p, p) from forces at slips to the slips of linear laws."""
        factor = cholesky_banded(self._elastic)
        bars = [slips for _, slips, _ in self.layout.bars if len(slips)]  # one after the other
        parts = [cho_solve_banded((factor[:, one], False), np.eye(len(one))) for one in bars]
        return csr_array(block_diag(parts))

    def _residual(self, at: ChainAnswer) -> tuple[Floats, float]:
        """Residual forces (p,), and the magnitude of forces or of their rounding (N)."""
        out = at.bond.force + self.layout.pulled(at.axial.force)
        rounded = self._stiffest * float(np.abs(at.slip).max(initial=0.0)) * ROUNDING / BALANCED
        forces = (at.axial.force, at.bond.force)
        return out, max(rounded, *(float(np.abs(one).max(initial=0.0)) for one in forces))

    @cached_property
    def _stiffest(self) -> float:
        return float(self.axial.stiffness.max(initial=0.0))

    def _nearer(
        self, now: ChainAnswer, out: Floats, stretch: Floats, memory: tuple[Floats, Floats]
    ) -> tuple[ChainAnswer, tuple[Floats, float]]:
        """Return the next iterate of Newton's method with line search, and its residual."""
        factors, unstable = self._factors(now)
        if len(unstable):
            factors = cholesky_banded(self._elastic)
        way = -cho_solve_banded((factors, False), out)
        was, part, shortest = float(np.linalg.norm(out)), 1.0, SHORTEST
        while True:
            found = self._at(stretch, now.slip + part * way, memory)
            left = self._residual(found)
            beyond = bool(left[0] @ way > -(out @ way))  # the least energy on the way
            shortest = FARTHEST if beyond else shortest
            if (np.linalg.norm(left[0]) < was and not beyond) or part <= shortest:
                return found, left
            part /= 2

    def _factors(self, at: ChainAnswer) -> tuple[Floats, Ints]:
        """Factor of the tridiagonal matrix, and the slips of bars in which it is indefinite."""
        if self.linear:
            return self._linear_factor, NONE
        band = self._band(at)
        try:
            return cholesky_banded(band), NONE
        except LinAlgError:
            return band, np.concatenate(
                [s for _, s, _ in self.layout.bars if not _positive(band[:, s])]
            )

    @cached_property
    def _linear_factor(self) -> Floats:
        """Factor of the tridiagonal matrix of linear laws."""
        bond = (1 + LEFT) * self.bond.stiffness
        return np.asarray(cholesky_banded(self.layout.matrix(self.axial.stiffness, bond)))

    def _band(self, at: ChainAnswer) -> Floats:
        return self.layout.matrix(at.axial.tangent, at.bond.tangent + LEFT * self.bond.stiffness)

    @cached_property
    def _elastic(self) -> Floats:
        return self.layout.matrix(self.axial.stiffness, self.bond.stiffness)


def _positive(band: Floats) -> bool:
    try:
        cholesky_banded(band)
    except LinAlgError:
        return False
    return True
