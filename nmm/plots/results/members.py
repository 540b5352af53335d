"""Springs, dashpots and bars as lines, coloured by their axial force."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.canvas import BESIDE, PathLike, colour_bar, extent_of, finished, frame_plane
from nmm.plots.results.deformed import moment
from nmm.plots.results.faint_blocks import faint_blocks
from nmm.plots.units import label, prefixed
from nmm.quantity import MemberSegments
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 2.5  # points
RIM = "#6b6b6b"  # about members, which are white where nothing pulls


def members(
    run: RunData,
    *,
    frame: int = -1,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw the members of one frame over faint blocks, tension positive.

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
    known = shown.on("members")
    ends = known[MemberSegments.ENDS].values.reshape(-1, 2, 2) if known else np.zeros((0, 2, 2))
    force = known["members:force"].values if known else np.zeros(0)
    factor, unit = prefixed(force, "N")
    pulled = bool((force >= 0).all())
    drawn = LineCollection(
        list(ends), linewidths=WIDTH, capstyle="butt", cmap="viridis_r" if pulled else "RdBu_r"
    )
    rim = LineCollection(list(ends), linewidths=WIDTH + 1.0, capstyle="butt", colors=RIM)
    axes.add_collection(rim)
    drawn.set_array(factor * force)
    most = factor * float(np.abs(force).max(initial=0.0)) or 1.0
    drawn.set_clim(0.0 if pulled else -most, most)
    axes.add_collection(drawn)
    frame_plane(
        axes, extent_of(polygons.points, ends.reshape(-1, 2)), f"axial forces, {moment(shown)}"
    )
    colour_bar(axes, drawn, label("axial force", unit))
    return finished(axes, path, fit=ax is None, beside=BESIDE + 0.9)
