"""A free surface that rises and falls: pores fill and drain as water flows (Boussinesq 1904).

With the drainable porosity ``n`` ground holds ``n s`` of water in a unit of volume, ``s`` the share
of filled pores of `nmm.water.free_surface`, besides what it holds by being squeezed. A step from
``h0`` to ``h1`` is

    M (h1 - h0) + W(h1) - W(h0) + dt (K h1 - f - int k (1 - s) dphi / dy) = 0,
    W = int n s phi,

whose tangent is that of the steady surface with ``int n s' phi phi`` more. What is missing below
the surface, half of the width ``l``, moves along with it: the volume that a rise takes is right
whatever ``l`` is.
"""

from dataclasses import dataclass, fields
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.diffusion.problem import step_between
from nmm.errors import SolveError
from nmm.water.free_surface import WIDTHS, FreeSurface, Unbalanced


@dataclass(frozen=True, kw_only=True)
class MovingSurface(FreeSurface):
    """The head of ground that fills and drains.

    Attributes
    ----------
    room
        (n, Q) values of the functions times drainable volume (m3) at the points of the filling.
    """

    room: csr_array

    @classmethod
    def draining(cls, surface: FreeSurface, drainable: Floats) -> Self:
        """Return a problem whose elements drain volumes (E,) (m3) when they are emptied."""
        parts = {one.name: getattr(surface, one.name) for one in fields(FreeSurface)}
        filling = surface.filling
        volume = drainable[filling.owner] * filling.share
        room = csr_array(csr_array(filling.rows.T) @ diags_array(volume))
        return cls(**parts, room=room)

    def stepped(
        self, before: Floats, begin: float, end: float, theta: float, room: Floats | None = None
    ) -> Floats:
        """See `DiffusionProblem.stepped`; ``theta`` is 1.

        Where no head is found from that before, it is followed through surfaces that are wider.

        Raises
        ------
        SolveError
            Where none is found so either.
        """
        found = before.copy()
        found[~self.free] = self.held(end)[~self.free]
        try:
            return self._filled(found, before, begin, end, 1.0)
        except SolveError:
            for wider in WIDTHS:
                found = self._filled(found, before, begin, end, wider)
            return found

    def _filled(
        self, near: Floats, before: Floats, begin: float, end: float, wider: float
    ) -> Floats:
        """Return the head (n,) after a step with widths so much wider, from one nearby."""
        assert self.capacity is not None
        step, load, capacity = step_between(begin, end), self.load(end), self.capacity
        had = capacity @ before + self._content(before, wider)
        through = csc_array(capacity + step * self.matrix)

        def missing(head: Floats) -> Floats:
            gained = capacity @ head + self._content(head, wider) - had
            flow = load + self.filling.load(head, wider) - self.matrix @ head
            return np.asarray(step * flow - gained)

        def tangent(head: Floats) -> csc_array:
            filled = self._content_slope(head, wider)
            return csc_array(through + step * self.filling.slope(head, wider) + filled)

        flows = load + self.filling.load(before, wider)
        size = float(np.linalg.norm(step * flows) + np.linalg.norm(had))
        return self._balanced(near, Unbalanced(missing, tangent, size))

    def stored(self, unknowns: Floats) -> float:
        """See `DiffusionProblem.stored`: what fills pores as well."""
        return super().stored(unknowns) + self.total(self._content(unknowns, 1.0))

    def _content(self, head: Floats, wider: float) -> Floats:
        filling = self.filling
        return np.asarray(self.room @ filling.filled(filling.depth(head), filling.owner, wider))

    def _content_slope(self, head: Floats, wider: float) -> csc_array:
        steep = self.filling.steepness(head, wider)
        return csc_array(self.room @ (diags_array(steep) @ self.filling.rows))
