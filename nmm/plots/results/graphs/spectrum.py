"""A response spectrum: accelerations of oscillators over their period."""

from typing import TYPE_CHECKING

from nmm.plots.canvas import PathLike, axes_grid, finished, frame
from nmm.plots.results.graphs.columns import CYCLE
from nmm.results.response_spectrum import ResponseSpectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def spectrum(
    found: ResponseSpectrum,
    title: str = "",
    *,
    ax: "Axes | None" = None,
    path: PathLike | None = None,
) -> "Axes":
    """Draw pseudo and absolute acceleration over the period; return the axes.

    Parameters
    ----------
    found
        The spectrum.
    title
        What it is of.
    ax, path
        Axes to draw into, a new figure when None, and a file to save it in.
    """
    axes = ax or axes_grid(1, 1, 4.2)[0]
    lines = {
        "pseudo-acceleration": (found.pseudo_acceleration, "-"),
        "absolute acceleration": (found.absolute_acceleration, "--"),
    }
    for colour, (words, (values, style)) in zip(CYCLE, lines.items(), strict=False):
        axes.plot(found.period, values, style, color=colour, linewidth=1.2, label=words)
    axes.set_xscale("log")
    axes.grid(visible=True, which="both", alpha=0.25)
    axes.legend(frameon=False, fontsize=9)
    ratio = f"{100 * found.ratio:g} % of critical damping"
    words = ", ".join(part for part in (title, ratio) if part)
    frame(axes, "period  (s)", "acceleration  (m/s²)", words)
    return finished(axes, path)
