"""Receivers that stand before others: one run to several, its frames alone, or later."""

from collections.abc import Callable, Mapping, Sequence

from nmm.results.frame import Frame, Topology
from nmm.results.sink import Sink
from nmm.results.summary import Summary


class Tee:
    """Sink that hands everything on to all of ``sinks``."""

    def __init__(self, sinks: Sequence[Sink]) -> None:
        self._sinks = sinks

    def begin(self, topology: Topology) -> None:
        """See `Sink.begin`."""
        for sink in self._sinks:
            sink.begin(topology)

    def frame(self, frame: Frame) -> None:
        """See `Sink.frame`."""
        for sink in self._sinks:
            sink.frame(frame)

    def row(self, values: Mapping[str, float]) -> None:
        """See `Sink.row`."""
        for sink in self._sinks:
            sink.row(values)

    def finish(self, summary: Summary) -> None:
        """See `Sink.finish`."""
        for sink in self._sinks:
            sink.finish(summary)


class Deferred:
    """Sink that keeps frames and rows until they are to be handed on.

    Attributes
    ----------
    behind
        The sink that they are for.
    """

    def __init__(self, behind: Sink) -> None:
        self.behind = behind
        self._kept: list[Callable[[Sink], None]] = []

    def begin(self, topology: Topology) -> None:
        """See `Sink.begin`."""
        self._kept.append(lambda sink: sink.begin(topology))

    def frame(self, frame: Frame) -> None:
        """See `Sink.frame`."""
        self._kept.append(lambda sink: sink.frame(frame))

    def row(self, values: Mapping[str, float]) -> None:
        """See `Sink.row`."""
        self._kept.append(lambda sink: sink.row(values))

    def finish(self, summary: Summary) -> None:
        """See `Sink.finish`."""
        self._kept.append(lambda sink: sink.finish(summary))

    def release(self) -> Sink:
        """Hand on all that was kept; return the sink that it went to."""
        for hand_on in self._kept:
            hand_on(self.behind)
        self._kept.clear()
        return self.behind


class FramesOnly:
    """Sink that hands on frames alone: for motion that is shown but is no result."""

    def __init__(self, sink: Sink) -> None:
        self._sink = sink

    def begin(self, topology: Topology) -> None:
        """Ignore: the topology stands."""

    def frame(self, frame: Frame) -> None:
        """See `Sink.frame`."""
        self._sink.frame(frame)

    def row(self, values: Mapping[str, float]) -> None:
        """Ignore."""

    def finish(self, summary: Summary) -> None:
        """Ignore."""
