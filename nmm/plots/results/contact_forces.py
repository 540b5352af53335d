"""Contact forces as lines along the force, their width its size."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import PathLike, extent_of, finished, frame_plane, legend_below
from nmm.plots.results.deformed import moment
from nmm.plots.results.faint_blocks import faint_blocks
from nmm.plots.units import prefixed
from nmm.results.sink import RunData
from nmm.results.viewing.grids import contact_vectors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

PUSH, PULL = "#1d4e89", "#c1121f"
WIDEST = 4.0  # points
SMALLEST = 0.01  # of the largest force; below, nothing is drawn


def contact_forces(
    run: RunData,
    *,
    frame: int = -1,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw the contact forces of one frame over faint blocks.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    frame
        Number of the frame, counted from the end when negative.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.
    """
    from matplotlib.collections import LineCollection

    axes, shown, polygons = faint_blocks(run, frame, ax)
    vectors = contact_vectors(shown)
    sizes = np.hypot(*vectors.T)
    largest = float(sizes.max(initial=0.0))
    kept = sizes > SMALLEST * largest
    vectors, sizes = vectors[kept], sizes[kept]
    reach = 0.3 * float(np.sqrt(np.mean(run.topologies[shown.topology].elements.areas)))
    arms = reach * vectors / sizes[:, None]
    middle = shown.contact_position[kept]
    pull = shown.contact_force[kept, 0] > 0
    axes.add_collection(
        LineCollection(
            list(np.stack([middle - arms, middle + arms], axis=1)),
            colors=np.where(pull, PULL, PUSH).tolist(),
            linewidths=WIDEST * sizes / (largest or 1.0),
            capstyle="round",
        )
    )
    factor, unit = prefixed(np.array([largest]), "N")
    text = f"largest {factor * largest:.3g} {unit}" if len(sizes) else "none acts"
    frame_plane(axes, extent_of(polygons.points), f"contact forces, {moment(shown)}, {text}")
    legend_below(axes, _handles(bool(pull.any()), bool((~pull).any())))
    return finished(axes, path, fit=ax is None)


def _handles(pull: bool, push: bool) -> "list[Line2D]":
    from matplotlib.lines import Line2D

    named = [(PUSH, "compression")] * push + [(PULL, "tension")] * pull
    return [Line2D([], [], color=colour, lw=3, label=name) for colour, name in named]
