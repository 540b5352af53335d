"""Transient seepage with a free surface: pores fill and drain (Boussinesq 1904).

With the drainable porosity ``n``, a unit volume of ground holds the water ``n s``, where ``s`` is
the saturation of `nmm.water.free_surface`, besides its specific storage. A step from ``h0`` to
``h1`` is

    M (h1 - h0) + W(h1) - W(h0) + dt (K h1 - f - int k (1 - s) dphi / dy) = 0,
    W = int n s phi,

whose tangent is that of steady seepage plus ``int n s' phi phi``. The water that is missing below
the surface, half of the width ``l``, moves along with it, so that the volume of a rise is right for
any ``l``.
"""

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.diffusion.problem import step_between
from nmm.errors import SolveError
from nmm.water.free_surface import WIDTHS, FlowResidual, FreeSurface


@dataclass(frozen=True, kw_only=True)
class MovingSurface(FreeSurface):
    """The hydraulic head of ground that fills and drains.

    Attributes
    ----------
    room
        (n, Q) values of the functions times drainable volume (m3) at the quadrature points.
    """

    room: csr_array

    @classmethod
    def draining(cls, surface: FreeSurface, drainable: Floats) -> Self:
        """Return the problem with drainable volumes (E,) of the elements (m3)."""
        parts = {one.name: getattr(surface, one.name) for one in fields(FreeSurface)}
        filling = surface.filling
        volume = drainable[filling.owner] * filling.share
        room = csr_array(csr_array(filling.rows.T) @ diags_array(volume))
        return cls(**parts, room=room)

    def stepped(
        self, before: Floats, begin: float, end: float, theta: float, room: Floats | None = None
    ) -> Floats:
        """See `DiffusionProblem.stepped`; ``theta`` is 1.

        If Newton's method fails from the last head, the width of the surface is reduced in steps.

        Raises
        ------
        SolveError
            That fails, too.
        """
        found = before.copy()
        found[~self.free] = self.prescribed(end)[~self.free]
        try:
            return self._filled(found, before, begin, end, 1.0)
        except SolveError:
            for wider in WIDTHS:
                found = self._filled(found, before, begin, end, wider)
            return found

    def _filled(
        self, near: Floats, before: Floats, begin: float, end: float, wider: float
    ) -> Floats:
        """Return the head (n,) after a step with widths times ``wider``, from a nearby one."""
        assert self.capacity is not None
        step, load, capacity = step_between(begin, end), self.load(end), self.capacity
        had = capacity @ before + self._content(before, wider)
        through = csc_array(capacity + step * self.matrix)

        def residual_of(head: Floats) -> Floats:
            gained = capacity @ head + self._content(head, wider) - had
            flow = load + self.filling.load(head, wider) - self.matrix @ head
            return np.asarray(step * flow - gained)

        def tangent(head: Floats) -> csc_array:
            filled = self._content_slope(head, wider)
            return csc_array(through + step * self.filling.slope(head, wider) + filled)

        flows = load + self.filling.load(before, wider)
        size = float(np.linalg.norm(step * flows) + np.linalg.norm(had))
        return self._balanced(near, FlowResidual(residual_of, tangent, size))

    def stored(self, unknowns: Floats) -> float:
        """See `DiffusionProblem.stored`; with the water in drainable pores."""
        return super().stored(unknowns) + self.total(self._content(unknowns, 1.0))

    def _content(self, head: Floats, wider: float) -> Floats:
        filling = self.filling
        return np.asarray(self.room @ filling.filled(filling.depth(head), filling.owner, wider))

    def _content_slope(self, head: Floats, wider: float) -> csc_array:
        steep = self.filling.steepness(head, wider)
        return csc_array(self.room @ (diags_array(steep) @ self.filling.rows))
