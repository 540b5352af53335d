"""Statistical joint sets.

A set is a family of parallel lines; dip, spacing and trace length are normally distributed, each
line is a row of traces and gaps: the description used by UDEC (Itasca, `jset`) and in field
mapping. Persistence is the jointed fraction of a line, trace / (trace + gap).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import Fault, GeometryError

# Smaller steps and traces would only be made by the tail of a wide normal distribution.
_LEAST = 0.05  # of the mean
_MOST_LINES = 100_000
# Of the reach of a line: longer gaps leave it as empty, and the longest are beyond all numbers.
_LONGEST_GAP = 1e6


@dataclass(frozen=True)
class JointSetGeometry:
    """A joint set in numbers: lengths in m, angles in rad, scatters are standard deviations.

    Attributes
    ----------
    dip, dip_scatter
        Angle of the joints from the x axis, counter-clockwise.
    spacing, spacing_scatter
        Distance of neighbouring lines, measured across the mean dip.
    persistence
        Jointed fraction of a line in (0, 1].
    trace, trace_scatter
        Length of a joint; needed when `persistence` is less than 1.
    origin
        A point that one line meets; None draws the first line's position.
    seed
        Seed of all draws of the set (NumPy's PCG64).
    """

    dip: float
    spacing: float
    dip_scatter: float = 0.0
    spacing_scatter: float = 0.0
    persistence: float = 1.0
    trace: float | None = None
    trace_scatter: float = 0.0
    origin: tuple[float, float] | None = None
    seed: int | tuple[int, ...] = 0

    def segments(self, low: Floats, high: Floats, place: str = "joint set") -> Floats:
        """Joints (m, 2, 2) of the set that cover a box.

        Raises
        ------
        GeometryError
            The spacing is so small that the box would hold more than 100 000 lines.
        """
        generator = np.random.Generator(np.random.PCG64(self.seed))
        centre, half = (low + high) / 2, float(np.hypot(*(high - low))) / 2
        if 2 * half / self.spacing > _MOST_LINES:
            fault = Fault(
                place,
                f"spacing {self.spacing:g} m in a region of {2 * half:g} m",
                f"at most {_MOST_LINES} lines",
                "increase the spacing",
            )
            raise GeometryError(fault)
        across = np.array([-np.sin(self.dip), np.cos(self.dip)])
        offsets = self._offsets(centre, half, across, generator, place)
        angles = self.dip + self.dip_scatter * generator.standard_normal(len(offsets))
        middle = centre + offsets[:, None] * across
        along = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        # A turned line must still cross the whole box.
        reach = 2 * half
        if self.persistence == 1 or self.trace is None:
            return np.stack([middle - reach * along, middle + reach * along], axis=1)
        rows = [
            point + direction * self._traces(reach, self.trace, generator)[:, :, None]
            for point, direction in zip(middle, along, strict=True)  # a few lines
        ]
        return np.concatenate([np.empty((0, 2, 2)), *rows])

    def _offsets(
        self,
        centre: Floats,
        half: float,
        across: Floats,
        generator: np.random.Generator,
        place: str,
    ) -> Floats:
        """Positions of the lines across the mean dip, from the box's centre."""
        if self.origin is None:
            first = self.spacing * generator.random()
        else:
            first = float((np.asarray(self.origin) - centre) @ across)
            if abs(first) > _MOST_LINES * self.spacing:
                away = f"origin {abs(first):.3g} m away from the blocks"
                expected = f"an origin within {_MOST_LINES} spacings, as lines are drawn from there"
                raise GeometryError(Fault(place, away, expected, "move it nearer"))
        count = int(np.ceil((half + abs(first)) / self.spacing)) + 2
        steps = _positive(self.spacing, self.spacing_scatter, (2, 2 * count), generator)
        up, down = np.cumsum(steps, axis=1)
        offsets = np.concatenate([first - down[::-1], [first], first + up])
        return np.asarray(offsets[np.abs(offsets) <= half])

    def _traces(self, reach: float, trace: float, generator: np.random.Generator) -> Floats:
        """Begin and end (k, 2) of the traces on a line from -reach to reach."""
        gap = min(trace * (1 - self.persistence) / self.persistence, _LONGEST_GAP * reach)
        count = int(np.ceil(2 * reach / (trace + gap) / (1 - _LEAST))) + 2
        traces = _positive(trace, self.trace_scatter, (2 * count,), generator)
        gaps = traces * (gap / trace)
        ends = np.cumsum(traces + gaps) - reach - (trace + gap) * generator.random()
        pairs = np.stack([ends - traces - gaps, ends - gaps], axis=1)
        return np.asarray(pairs[(pairs[:, 1] > -reach) & (pairs[:, 0] < reach)])


def _positive(
    mean: float, deviation: float, shape: tuple[int, ...], generator: np.random.Generator
) -> Floats:
    drawn = mean + deviation * generator.standard_normal(shape)
    return np.maximum(drawn, _LEAST * mean)
