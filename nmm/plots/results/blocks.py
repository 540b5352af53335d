"""The blocks of a run, coloured by material, with supports and loads where a scene is given."""

from typing import TYPE_CHECKING

from nmm.plots.canvas import PathLike, axes_grid, extent_of, finished, frame_plane, legend_below
from nmm.plots.results.conditions import draw_conditions
from nmm.plots.shapes import draw_blocks, material_colour
from nmm.results.frame import Topology
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch

    from nmm.scene import Scene


def blocks(
    run: RunData,
    *,
    scene: "Scene | None" = None,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
    title: str = "initial geometry",
) -> "Axes":
    """Draw the blocks as they are before the run.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    scene
        When given, its supports and loads are drawn too.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.
    title
        Title; the number of blocks is added.
    """
    topology = run.topologies[0]
    extent = extent_of(topology.elements.points)
    axes = ax or axes_grid(1, 1, 4.0)[0]
    # Cracks are told by how far their faces have moved, in the last frame that has no others.
    known = [frame for frame in run.frames if frame.topology == 0]
    draw_blocks(axes, topology, topology.elements, known[-1] if known else None)
    if scene is not None:
        extent = draw_conditions(axes, scene, extent)
    frame_plane(axes, extent, f"{title}, {block_count(topology)}")
    legend_below(axes, material_handles(topology))
    return finished(axes, path, fit=ax is None)


def block_count(topology: Topology) -> str:
    """Return the number of blocks in words."""
    count = len(topology.region_material)
    return "1 block" if count == 1 else f"{count:,} blocks"


def material_handles(topology: Topology) -> "list[Patch]":
    """Return legend entries of the materials' colours when there is more than one."""
    from matplotlib.patches import Patch

    used = sorted(set(topology.region_material.tolist()))
    if len(used) < 2:
        return []
    return [
        Patch(facecolor=material_colour(n), edgecolor="#777777", label=topology.material_names[n])
        for n in used
    ]
