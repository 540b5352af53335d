"""Columns of a history as curves show them: values in a readable unit, words, families, a grid."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.plots.canvas import frame
from nmm.plots.units import label, prefixed, unit_of, words_of
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CYCLE = ("#1d4e89", "#c1121f", "#2a7f62", "#e08e0b", "#6a4c93", "#555555", "#4d9de0")


def column(run: RunData, name: str) -> Floats:
    """Return the values of a column; refuse a name that the history does not have."""
    if name not in run.history:
        raise NmmError(
            f"history: column {name!r}: expected one of {', '.join(run.history) or 'none'}: "
            "name a column of history.csv"
        )
    return run.history[name]


def readable(
    run: RunData, name: str, factor: float = 1.0, text: str | None = None
) -> tuple[Floats, str]:
    """Return a column in a readable unit and its label; a label of the caller's keeps SI."""
    values = factor * column(run, name)
    if text is not None:
        return values, text
    scale, unit = prefixed(values, unit_of(name))
    return scale * values, label(signed(words_of(name), factor), unit)


def signed(words: str, factor: float) -> str:
    """Say that a column is drawn with its sign changed."""
    return f"-{words}" if factor < 0 else words


def family(known: Mapping[str, Floats], start: str) -> list[str]:
    """Return the columns of a family, "monitor" or "monitor:top", that are not zero throughout."""
    return [name for name in known if name.startswith(f"{start}:") and varies(known, name)]


def varies(known: Mapping[str, Floats], name: str) -> bool:
    """Whether a column is there and not zero throughout."""
    return name in known and bool(np.any(np.nan_to_num(known[name])))


def on_grid(axes: "Axes", x_text: str, y_text: str, title: str) -> None:
    """Put a grid behind curves, and labels and a title about them."""
    axes.grid(True, color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)
    frame(axes, x_text, y_text, title)
