"""Reading a run folder, whether its run has ended, is going on or was killed."""

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import overload

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.results import files
from nmm.results.frame import Frame, Topology
from nmm.results.history import read_history
from nmm.results.summary import Summary


class StoredFrames(Sequence[Frame]):
    """Frames of a run folder, each read when it is asked for."""

    def __init__(self, paths: Sequence[Path]) -> None:
        self._paths = tuple(paths)

    def __len__(self) -> int:
        return len(self._paths)

    @overload
    def __getitem__(self, item: int) -> Frame: ...
    @overload
    def __getitem__(self, item: slice) -> "StoredFrames": ...
    def __getitem__(self, item: int | slice) -> "Frame | StoredFrames":
        if isinstance(item, slice):
            return StoredFrames(self._paths[item])
        return files.read_frame(self._paths[item])


@dataclass(frozen=True)
class StoredRun:
    """A run as its folder holds it.

    Attributes
    ----------
    folder
        The folder.
    scene, formulation
        Their texts as run.
    topologies
        Element topologies; `Frame.topology` counts in them.
    frames
        Frames in the order of output, read on demand.
    history
        Columns by name, one value a step.
    summary
        The summary; its status is "running" when the run has not ended.
    """

    folder: Path
    scene: str
    formulation: str
    topologies: tuple[Topology, ...]
    frames: StoredFrames
    history: dict[str, Floats]
    summary: Summary


def read_run(path: str | os.PathLike[str]) -> StoredRun:
    """Read a run folder.

    Raises
    ------
    NmmError
        When the path is not a run folder or one of its files was altered.
    """
    folder = Path(path)
    if not (folder / files.SUMMARY).is_file():
        raise NmmError(
            f"{folder}: no {files.SUMMARY} in it: expected a run folder: give the folder that "
            "`nmm run` named at its end"
        )
    return StoredRun(
        folder=folder,
        scene=_text(folder / files.SCENE),
        formulation=_text(folder / files.FORMULATION),
        topologies=_topologies(folder),
        frames=StoredFrames(sorted((folder / files.FRAMES).glob(files.FRAME_PATTERN))),
        history=read_history(folder / files.HISTORY),
        summary=Summary.from_json((folder / files.SUMMARY).read_text()),
    )


def _topologies(folder: Path) -> tuple[Topology, ...]:
    count = len(list(folder.glob(files.TOPOLOGY_PATTERN)))
    return tuple(
        files.read_topology(folder / files.topology_name(number)) for number in range(count)
    )


def _text(path: Path) -> str:
    """Return the text of a file, none when the run was killed before it was written."""
    return path.read_text() if path.exists() else ""
