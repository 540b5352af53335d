"""Pictures of few kilobytes, for pages that are kept with the source."""

from io import BytesIO
from typing import TYPE_CHECKING

from nmm.plots.canvas import PathLike

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DOTS = 100  # an inch
COLOURS = 64


def save_small(figure: "Figure", path: PathLike) -> None:
    """Write a PNG of few colours: a third of the size, and lines look the same."""
    from PIL import Image

    whole = BytesIO()
    figure.savefig(whole, format="png", dpi=DOTS)
    few = Image.open(whole).convert("RGB").quantize(COLOURS)
    few.save(path, format="PNG", optimize=True)
