"""The folder of a run, written while the run goes.

Layout: `scene.toml` and `formulation.toml` as run, `topology.npz`, `frames/000000.npz`, ...,
`history.csv`, `summary.json`. Every file but the history is put in place whole, the history is
flushed line by line, so a run that was killed can be read up to its last step.
"""

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from nmm.errors import NmmError
from nmm.results import files
from nmm.results.frame import Frame, Topology
from nmm.results.history import HistoryFile
from nmm.results.summary import Summary


class RunFolder:
    """Sink that writes a run folder.

    Parameters
    ----------
    path
        The folder. It is made when missing; an earlier run in it is replaced.
    scene, formulation
        Their texts as run.
    summary
        What is known before the run (title, hashes, seed); written with status "running".

    Raises
    ------
    NmmError
        When the folder holds files but no run, so that nothing of the user's is deleted.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        scene: str = "",
        formulation: str = "",
        summary: Summary | None = None,
    ) -> None:
        self.path = Path(path)
        _clear(self.path)
        (self.path / files.FRAMES).mkdir(parents=True, exist_ok=True)
        files.write_text(self.path / files.SUMMARY, (summary or Summary()).to_json())
        files.write_text(self.path / files.SCENE, scene)
        files.write_text(self.path / files.FORMULATION, formulation)
        self._history = HistoryFile(self.path / files.HISTORY)
        self._topologies = 0

    def begin(self, topology: Topology) -> None:
        """Write the elements as the topology of the frames to come."""
        files.write_topology(self.path / files.topology_name(self._topologies), topology)
        self._topologies += 1

    def frame(self, frame: Frame) -> None:
        """Write one frame."""
        numbered = replace(frame, topology=self._topologies - 1)
        files.write_frame(self.path / files.FRAMES / files.frame_name(frame.index), numbered)

    def row(self, values: Mapping[str, float]) -> None:
        """Append one row to the history."""
        self._history.append(values)

    def finish(self, summary: Summary) -> None:
        """Put the summary in the place of the one that says "running"."""
        self._history.close()
        files.write_text(self.path / files.SUMMARY, summary.to_json())


def _clear(path: Path) -> None:
    """Delete the files of an earlier run, and refuse a folder that holds something else."""
    if not path.exists():
        return
    if not path.is_dir() or (any(path.iterdir()) and not (path / files.SUMMARY).exists()):
        raise NmmError(
            f"{path}: exists and is not a run folder: expected a new or empty folder, or one with "
            f"{files.SUMMARY}: choose another name"
        )
    for pattern in files.OF_A_RUN:
        for old in path.glob(pattern):
            old.unlink()
