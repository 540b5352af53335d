"""Broad phase: which vertices are near which edges, kept while nothing moves far."""

from __future__ import annotations

import numpy as np

from integration.arrays import Ints, same
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import DEPTH


class NeighbourList:
    """Candidate pairs of a moving surface, searched anew only when something has moved far.

    Built, the list holds all pairs of a vertex and an edge within the skin; it is built anew once
    two points may have moved apart by half the skin (Verlet 1967). So `update` misses no gap up to
    half the skin, and no vertex that is in another body by less than `DEPTH` of the thinner body's
    thickness.

    Parameters
    ----------
    skin
        m. A wider skin makes longer lists and fewer searches.
    within_bodies
        Also pairs of one body, as the faces of a crack in it: all but the edges at the vertex, and
        those that share an end with them at a corner that is not reentrant.
    """

    def __init__(self, skin: float, within_bodies: bool = False) -> None:
        self.skin = skin
        self.within_bodies = within_bodies
        self._built: Surface | None = None
        self._last: Surface | None = None
        self._pairs = (np.empty(0, np.int64), np.empty(0, np.int64))

    def update(self, surface: Surface) -> tuple[Ints, Ints]:
        """Return vertex and edge (m,) of the candidates, sorted by vertex, then edge."""
        if surface is self._last:  # the step asks again by which it began
            return self._pairs
        if self._built is None or not self._stands(self._built, surface):
            # Compiled code is loaded by the first search, not by whoever names this module.
            from nmm.contact.detection.grid import pairs_by_grid

            depth = DEPTH * surface.thickness + 0.5 * self.skin
            distance = np.maximum(self.skin, depth)
            self._pairs = pairs_by_grid(surface, distance, self.within_bodies)
            self._built = surface
        self._last = surface
        return self._pairs

    def _stands(self, built: Surface, now: Surface) -> bool:
        """Whether the bodies are the same and no two points can have met by their motion."""
        from nmm.contact.detection.grid import spread

        alike = same(built.body, now.body) and same(built.next, now.next)
        return alike and spread(now.start, built.start) <= 0.5 * self.skin
