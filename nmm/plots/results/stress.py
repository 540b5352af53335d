"""Mean stress, or another quantity, of each element as colours."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.outputs.stresses import principal, von_mises
from nmm.plots.canvas import (
    BESIDE,
    PathLike,
    axes_grid,
    colour_bar,
    extent_of,
    finished,
    frame_plane,
)
from nmm.plots.results.deformed import magnified, moment
from nmm.plots.results.frame_of import frame_of
from nmm.plots.shapes import draw_lines, fill, line_width
from nmm.plots.units import label, prefixed, words_of
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

NAMES = {
    "mises": "von Mises stress",
    "xx": "stress xx",
    "yy": "stress yy",
    "xy": "shear stress xy",
    "major": "major principal stress",
    "minor": "minor principal stress",
}

SHARE, PEAK = 0.995, 1.5
"""Share of the area that the colours hold, and how far beyond stress may go without being cut."""

FAR = 0.5
"""Share of the end of the scale from which it does not begin at zero where no value is below."""

SHORT = {"mises": "von Mises", "major": "major principal", "minor": "minor principal"}
"""Names that fit beside a colour bar."""


def stress(
    run: RunData,
    component: str = "mises",
    *,
    frame: int = -1,
    magnification: float = 1.0,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw one measure of the stress of every element, tension positive, or another quantity.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    component
        "mises", "xx", "yy", "xy", "major" or "minor", or a quantity of the frame on elements or
        points: "von_mises", "heat:temperature", "ground:pressure", "principal_stress:major".
    frame
        Number of the frame, counted from the end when negative.
    magnification
        Factor on displacements.
    ax
        Axes to draw into; a new figure when None.
    path
        File to save the figure in.

    Raises
    ------
    NmmError
        When the component is none of these.
    """
    shown = frame_of(run, frame)
    topology = run.topologies[shown.topology]
    values, unit = _chosen(shown, topology, component)
    factor, unit = prefixed(values, unit)
    polygons = magnified(shown, topology, magnification)
    extent = extent_of(polygons.points)
    axes = ax or axes_grid(1, 1, 4.0)[0]
    values = factor * values
    signed = bool((values < 0).any()) or component in set(NAMES) - {"mises"}
    words = NAMES.get(component) or words_of(component)
    areas = topology.elements.areas
    limit, beyond = scale_end(values, areas)
    drawn = fill(
        axes, polygons, edgecolors="face", linewidths=0.1, cmap="RdBu_r" if signed else "viridis"
    )
    drawn.set_array(values)
    least = float(values.min(initial=np.inf))
    bottom = least if least > FAR * limit else 0.0
    drawn.set_clim(-limit if signed else bottom, limit)
    draw_lines(
        axes, topology, polygons, shown, colors="#00000066", linewidths=0.7 * line_width(topology)
    )
    text = f", displacements ×{magnification:g}" if magnification != 1.0 else ""
    frame_plane(axes, extent, f"{words}, {moment(shown)}{text}")
    above = bool(beyond and (values > limit).any())
    below = bool(beyond and signed and (values < -limit).any())
    arrows = ("neither", "max", "min", "both")[above + 2 * below]
    beside = label(SHORT.get(component, words), unit)
    if beyond:
        beside += f"\n{100 * beyond:.2g} % of the area beyond, up to {np.abs(values).max():.3g}"
    colour_bar(axes, drawn, beside, arrows)
    return finished(axes, path, fit=ax is None, beside=BESIDE + 0.9)


def _chosen(frame: Frame, topology: Topology, component: str) -> tuple[Floats, str]:
    """Return the values (E,) that are drawn, and their unit; of points their means."""
    at_points = frame.on("points").get(component)
    if at_points is not None and at_points.values.ndim == 1:
        owner = topology.elements.polygon_of_point
        return np.bincount(owner, at_points.values) / np.bincount(owner), at_points.unit
    scalars = {name: (q.values, q.unit) for name, q in frame.on("elements").items()}
    for name, one in frame.on("elements").items():
        if one.values.ndim == 2:
            del scalars[name]
            parts = one.components or [str(i) for i in range(one.values.shape[1])]
            scalars |= {f"{name}:{p}": (one.values[:, i], one.unit) for i, p in enumerate(parts)}
    if component in scalars:
        return scalars[component]
    across = scalars.get("stress_zz", (None, ""))[0]
    return measure(frame.stress, component, [*scalars], across), "Pa"


def scale_end(values: Floats, areas: Floats) -> tuple[float, float]:
    """Return where a colour scale of sizes ends, and the share of the area that lies beyond.

    It holds `SHARE` of the area, and all of it unless what is beyond is `PEAK` times as large: a
    sliver would else take the colours from all else.
    """
    sizes = np.abs(values)
    largest = float(sizes.max(initial=0.0))
    if not largest:
        return 1.0, 0.0
    order = np.argsort(sizes)
    within = np.cumsum(areas[order]) / areas.sum()
    end = float(sizes[order][min(int(np.searchsorted(within, SHARE)), len(sizes) - 1)])
    if not end or largest <= PEAK * end:
        return largest, 0.0
    return end, float(areas[sizes > end].sum() / areas.sum())


def measure(
    stresses: Floats, component: str, besides: Sequence[str] = (), across: Floats | None = None
) -> Floats:
    """(E,) one number of stresses (E, 3): xx, yy, xy, and of what acts ``across`` the plane (E,).

    ``besides`` are names that would do too.

    Raises
    ------
    NmmError
        When the component is not known.
    """
    xx, yy, xy = stresses.T
    major, minor = principal(stresses).T
    known: dict[str, Floats] = {
        "mises": von_mises(stresses, across),
        "xx": xx,
        "yy": yy,
        "xy": xy,
        "major": major,
        "minor": minor,
    }
    if component not in known:
        names = ", ".join([*known, *besides])
        raise NmmError(f"stress plot: component {component!r}: expected one of {names}")
    return known[component]
