"""Where a run writes to: the protocol of the step loop's output, and the sink that keeps it all."""

from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from integration.arrays import Floats
from nmm.frozen import with_parts
from nmm.results.frame import Frame, Topology
from nmm.results.summary import Summary

RESETS = "displacement_resets"
"""Column of the history: how often displacements were set to zero; only where they were."""

EVERY_STEP = ("time", "load_factor", "step", "passes", "residual")
"""Columns that every step gives; a run that ends before its first step has these, empty."""


def columns_of(rows: Sequence[Mapping[str, float]]) -> dict[str, Floats]:
    """Return the columns of a history, one value a row; one that a row does not give is nan."""
    names = dict.fromkeys(name for row in rows for name in row) or dict.fromkeys(EVERY_STEP)
    return {name: np.array([row.get(name, np.nan) for row in rows]) for name in names}


class Sink(Protocol):
    """Receiver of a run: `begin`, then frames and rows as they come, then `finish`."""

    def begin(self, topology: Topology) -> None:
        """Take the elements; called again whenever cutting has changed them."""

    def frame(self, frame: Frame) -> None:
        """Take one frame; its points are those of the last topology begun."""

    def row(self, values: Mapping[str, float]) -> None:
        """Take the history values of one step."""

    def finish(self, summary: Summary) -> None:
        """Take the summary; nothing follows."""


class RunData(Protocol):
    """What plots, exports and studies read: a run in memory or a stored one."""

    @property
    def topologies(self) -> Sequence[Topology]:
        """Element topologies; `Frame.topology` counts in them."""

    @property
    def frames(self) -> Sequence[Frame]:
        """Frames in the order of output."""

    @property
    def history(self) -> Mapping[str, Floats]:
        """History columns by name, one value a step."""


class MemorySink:
    """Keeps topologies, frames, history and summary in memory.

    The default of the Python interface; it satisfies `RunData`, so plots accept it.
    """

    def __init__(self) -> None:
        self.topologies: list[Topology] = []
        self.frames: list[Frame] = []
        self.rows: list[dict[str, float]] = []
        self.summary = Summary()

    def begin(self, topology: Topology) -> None:
        """Keep the elements as the topology of the frames to come."""
        self.topologies.append(topology)

    def frame(self, frame: Frame) -> None:
        """Keep one frame."""
        self.frames.append(with_parts(frame, topology=len(self.topologies) - 1))

    def row(self, values: Mapping[str, float]) -> None:
        """Keep one row of the history."""
        self.rows.append(dict(values))

    def finish(self, summary: Summary) -> None:
        """Keep the summary."""
        self.summary = summary

    @property
    def history(self) -> dict[str, Floats]:
        """Columns of the history; a value that a step did not give is nan."""
        return columns_of(self.rows)
