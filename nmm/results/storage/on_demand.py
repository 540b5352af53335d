"""Frames and topologies of a run folder: sequences that read, or refuse, what is asked for."""

from collections.abc import Sequence
from pathlib import Path
from typing import overload

from nmm.errors import DamageError
from nmm.results.frame import Frame, Topology
from nmm.results.storage import files


class StoredFrames(Sequence[Frame]):
    """Frames of a run folder, each read when it is asked for."""

    def __init__(self, paths: Sequence[Path], topologies: Sequence[Topology]) -> None:
        self._paths = tuple(paths)
        self._topologies = topologies

    def __len__(self) -> int:
        return len(self._paths)

    @overload
    def __getitem__(self, item: int) -> Frame: ...
    @overload
    def __getitem__(self, item: slice) -> "StoredFrames": ...
    def __getitem__(self, item: int | slice) -> "Frame | StoredFrames":
        if isinstance(item, slice):
            return StoredFrames(self._paths[item], self._topologies)
        path = self._paths[item]
        frame = files.read_frame(path)
        if (wrong := _misfit(frame, self._topologies)) is not None:
            raise DamageError(
                f"{path}: {wrong}: expected the topology it was written with: restore that file "
                "or run the scene again"
            )
        return frame


class StoredTopologies(Sequence[Topology]):
    """Topologies of a run folder; one that is damaged says so when it is asked for."""

    def __init__(self, found: Sequence[Topology | DamageError]) -> None:
        self._found = tuple(found)

    def __len__(self) -> int:
        return len(self._found)

    @overload
    def __getitem__(self, item: int) -> Topology: ...
    @overload
    def __getitem__(self, item: slice) -> "StoredTopologies": ...
    def __getitem__(self, item: int | slice) -> "Topology | StoredTopologies":
        if isinstance(item, slice):
            return StoredTopologies(self._found[item])
        one = self._found[item]
        if isinstance(one, DamageError):
            raise one
        return one


def _misfit(frame: Frame, topologies: Sequence[Topology]) -> str | None:
    """Return why a frame does not fit its topology; one that is damaged says so by itself."""
    if not 0 <= frame.topology < len(topologies):
        return f"its topology, number {frame.topology}, is missing"
    try:
        elements = topologies[frame.topology].elements
    except DamageError:
        return None
    found = (len(frame.points), len(frame.stress))
    if found != (len(elements.points), len(elements)):
        return f"it has {found[0]} points and {found[1]} elements, its topology another number"
    return None
