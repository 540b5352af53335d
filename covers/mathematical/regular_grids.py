"""What the regular nets of covers share: a turned grid of steps that reaches around a box."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints

# Steps along a side, far more than memory holds.
MOST_STEPS = 1e8


@dataclass(frozen=True)
class Net:
    """A grid of ``columns`` by ``rows`` steps that holds a box.

    Attributes
    ----------
    origin, axes : (2,), (2, 2)
        corner of the net, m, and the steps along its columns and rows as rows of a matrix, m.
    columns, rows : int
        number of steps along the two axes.
    """

    origin: Floats
    axes: Floats
    columns: int
    rows: int

    def points(self, i: npt.ArrayLike, j: npt.ArrayLike) -> Floats:
        """Points (..., 2) at ``i`` steps along the columns and ``j`` along the rows."""
        steps = np.stack(np.broadcast_arrays(np.asarray(i, float), np.asarray(j, float)), axis=-1)
        return np.asarray(self.origin + steps @ self.axes)


def regular_net(
    bounds: npt.ArrayLike, step: tuple[float, float], angle: float, shift: tuple[float, float]
) -> Net:
    """Return the net of steps (m) turned by ``angle`` (rad) that covers a box.

    Parameters
    ----------
    bounds : (2, 2)
        lower and upper corner of the box, m.
    shift : (2,)
        displacement of the net from the box's first corner in fractions of a step; only the
        fraction counts. Without shift and angle the net's lines run along the box's lower and left
        side, and along the others when the sides are multiples of the steps.

    Raises
    ------
    ValueError
        A step that is not positive and finite, or a box without area.
    """
    low, high = np.array(bounds, dtype=float).reshape(2, 2)
    if not (np.isfinite([low, high]).all() and (high > low).all()):
        raise ValueError(
            f"bounds: {low.tolist()}, {high.tolist()}: lower and upper corner of a box expected: "
            "give [[xmin, ymin], [xmax, ymax]]"
        )
    if not (np.isfinite(step).all() and min(step) > 0):
        raise ValueError(f"size: {step}: a positive length expected: give the edge of a cell in m")
    cosine, sine = np.cos(angle), np.sin(angle)
    frame = np.array([[cosine, sine], [-sine, cosine]])
    corners = np.array([[0, 0], [high[0] - low[0], 0], high - low, [0, high[1] - low[1]]]) @ frame.T
    first = corners.min(axis=0) / step
    extent = corners.max(axis=0) / step - first
    if extent.max() > MOST_STEPS:
        raise ValueError(
            f"size: {step}: {extent.max():.3g} steps along a side: at most {MOST_STEPS:g} "
            "expected: take a larger size"
        )
    begin = np.mod(shift, 1.0)
    begin[begin > 0] -= 1.0
    # Sides that are multiples of the step up to rounding need no further column.
    count = np.ceil((extent - begin) * (1 - 8 * np.finfo(float).eps)).astype(int)
    axes = frame * np.array(step)[:, None]
    return Net(low + (first + begin) @ axes, axes, int(count[0]), int(count[1]))


def grid_cells(columns: int, rows: int) -> Ints:
    """Corners (columns * rows, 4) of the cells of a grid of vertices, counter-clockwise."""
    i, j = np.meshgrid(np.arange(columns), np.arange(rows))
    corner = (i + j * (columns + 1)).ravel()
    return np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)


def grid_vertices(net: Net) -> Floats:
    """Vertices of the net, column by column, row after row."""
    i, j = np.meshgrid(np.arange(net.columns + 1), np.arange(net.rows + 1))
    return net.points(i.ravel(), j.ravel())
