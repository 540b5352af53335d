"""Iteration of what interface laws change between two solutions of a step."""

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats


@dataclass
class FixedPoint:
    """Solve ``x = image(x)`` for a short vector by Anderson's acceleration (1965).

    Attributes
    ----------
    depth
        Differences of iterates that are combined.
    """

    depth: int = 8
    _points: list[Floats] = field(default_factory=list)
    _defects: list[Floats] = field(default_factory=list)

    def next(self, point: Floats, image: Floats) -> Floats:
        """Return where to evaluate the image next, given that of ``point``."""
        self._points = [*self._points[-self.depth :], point]
        self._defects = [*self._defects[-self.depth :], image - point]
        if len(self._points) == 1:
            return image
        steps = np.diff(self._points, axis=0)
        changes = np.diff(self._defects, axis=0)
        share = np.linalg.lstsq(changes.T, self._defects[-1], rcond=1e-10)[0]
        return np.asarray(image - share @ (steps + changes))
