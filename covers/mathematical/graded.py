"""Triangles that grow with the distance from given points, the foci."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from covers.mathematical.regular_grids import Net, grid_cells, regular_net
from covers.mathematical.stars import star_sizes
from covers.mathematical.triangles import Triangles
from integration.arrays import Floats

# Largest number of lines of one direction.
MOST_LINES = 20_000


class Graded(Triangles):
    """Rectangles divided by a diagonal, between lines whose spacing grows away from the foci.

    Lines extend through the whole mesh, so that rectangles are slender beside a focus. No angle
    exceeds 90 degrees, which is what linear interpolation needs (Babuska and Aziz 1976).
    """

    coordinates: ClassVar[tuple[str, ...]] = ("focus",)

    @classmethod
    def foreseen(cls, bounds: npt.ArrayLike, size: float, **options: Any) -> float:
        """See `Cover.foreseen`; computed from the lines."""
        _, x, y = _net(bounds, size, **options)
        return 2.0 * (len(x) - 1) * (len(y) - 1)

    @classmethod
    def regular(
        cls,
        bounds: npt.ArrayLike,
        size: float,
        *,
        angle: float = 0.0,
        shift: tuple[float, float] = (0.0, 0.0),
        focus: Sequence[Sequence[float]] = (),
        radius: float = 0.0,
        growth: float = 0.2,
        coarsest: float | None = None,
    ) -> Self:
        """Return a mesh over a box, fine near the foci.

        Parameters
        ----------
        bounds : (2, 2)
            lower and upper corner of the box, m.
        size : float
            spacing of lines at the foci, m.
        angle, shift
            rotation of the mesh, rad, and its shift in fractions of ``size``.
        focus : (n, 2)
            points about which the mesh is fine; without any it is uniform.
        radius : float
            distance from a focus within which the spacing is ``size``, m.
        growth : float
            increase of the spacing over the distance from the focus.
        coarsest : float, optional
            largest spacing, m.

        Raises
        ------
        ValueError
            Sizes are inconsistent, or there are more than 20 000 lines.
        """
        net, x, y = _net(bounds, size, angle, shift, focus, radius, growth, coarsest)
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        a, b, c, d = grid_cells(len(x) - 1, len(y) - 1).T
        cells = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
        vertices = net.origin + grid @ (net.axes / size)
        # Without foci the cells are translates of two.
        half = np.repeat(np.arange(2), len(a))
        shapes = np.full_like(half, -1) if len(focus) else half
        return cls._of(vertices, cells, star_sizes(vertices, cells), shapes)


def _net(
    bounds: npt.ArrayLike,
    size: float,
    angle: float = 0.0,
    shift: tuple[float, float] = (0.0, 0.0),
    focus: Sequence[Sequence[float]] = (),
    radius: float = 0.0,
    growth: float = 0.2,
    coarsest: float | None = None,
) -> tuple[Net, Floats, Floats]:
    """Return the uniform grid, and the places (m) of the lines along its two axes."""
    net = regular_net(bounds, (size, size), angle, shift)
    if not (growth >= 0 and radius >= 0 and (coarsest is None or coarsest >= size)):
        raise ValueError(
            f"growth {growth}, radius {radius}, coarsest {coarsest}: numbers >= 0 and a "
            f"coarsest size of at least {size} expected: correct the options of the cover"
        )
    frame = net.axes / size
    points = np.array(focus, dtype=float).reshape(-1, 2)
    at = (points - net.origin) @ frame.T
    most = np.inf if coarsest is None else coarsest
    x, y = (
        _lines(steps * size, at[:, axis], (size, most), radius, growth)
        for axis, steps in enumerate((net.columns, net.rows))
    )
    return net, x, y


def _lines(
    length: float, focus: Floats, sizes: tuple[float, float], radius: float, growth: float
) -> Floats:
    """Places from 0 to ``length`` whose spacing follows the wanted size.

    The number of lines is the integral of ``1 / size``, and they lie where it reaches equal steps.
    """
    if not len(focus):
        focus, growth = np.zeros(1), 0.0
    # The size is piecewise linear, with kinks at the foci, at their radius, at its bound, and
    # midway between foci; the sampling resolves it.
    least, most = sizes
    reach = np.concatenate([[0.0], np.geomspace(min(least, length), length, 4000)])
    around = np.concatenate([focus[:, None] + reach, focus[:, None] - reach]).ravel()
    even = np.linspace(0.0, length, 1 + min(int(4 * length / least) + 1, MOST_LINES))
    place = np.unique(np.clip(np.concatenate([around, even]), 0.0, length))
    off = np.maximum(np.abs(place[:, None] - focus).min(axis=1) - radius, 0.0)
    density = 1.0 / np.minimum(least + growth * off, most)
    steps = np.diff(place) * (density[1:] + density[:-1]) / 2
    count = np.concatenate([[0.0], np.cumsum(steps)])
    number = max(int(np.ceil(count[-1] * (1 - 1e-9))), 1)
    if number > MOST_LINES:
        raise ValueError(
            f"size {least}: {number} lines over {length} m: at most {MOST_LINES} expected: let the "
            "size grow away from a focus"
        )
    return np.asarray(np.interp(np.linspace(0.0, count[-1], number + 1), count, place))
