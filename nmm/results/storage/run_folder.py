"""The folder of a run, written while the run goes.

Layout: `run.json` with the version of this layout, `scene.toml` and `formulation.toml` as run,
`topology.npz`, `frames/000000.npz`, ..., `history.csv`, `summary.json`; `checkpoint.npz`
where the scene asks for it; `.lock` while a run writes.
Every file but the history is put in place whole, the history grows by whole lines, so a run that
was killed can be read up to its last step.
"""

import os
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from warnings import warn

from nmm.errors import NmmError, NmmWarning
from nmm.results.frame import Frame, Topology
from nmm.results.storage import files, former
from nmm.results.storage.checkpoint import (
    CHECKPOINT_FORMAT,
    Checkpoint,
    CheckpointHeader,
    read_checkpoint,
    write_checkpoint,
)
from nmm.results.storage.history import HistoryFile
from nmm.results.storage.lock import FolderLock
from nmm.results.storage.mark import RunMark
from nmm.results.storage.values import Arrays
from nmm.results.storage.writing import ToDisk, told, write_text
from nmm.results.summary import REPLACING, STOPPED, Summary


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
    StorageError
        When the folder cannot be written, holds files but no run, so that nothing of the user's is
        deleted, or another run is writing to it.

    Warns
    -----
    NmmWarning
        When the earlier run there was killed.
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
        self._summary = summary or Summary()
        self._topologies = self._frames = self._rows = 0
        replaced = former.is_there(self.path)
        with told(self.path):
            self.path.mkdir(parents=True, exist_ok=True)
        self._lock = FolderLock(self.path / files.LOCK)
        try:
            self._disk = ToDisk()
            self._replace(replaced)
            self._start(scene, formulation)
            self._write(files.SUMMARY, self._summary.to_json())
        except BaseException:
            self._lock.release()
            raise
        self._history = HistoryFile(self.path / files.HISTORY)

    @classmethod
    def reopened(
        cls, path: Path, summary: Summary, expected: CheckpointHeader
    ) -> tuple["RunFolder", Arrays]:
        """Return a folder as it was at its checkpoint, to go on writing, and what that holds.

        What was written after the checkpoint is deleted.

        Raises
        ------
        StorageError
            When another run is writing to it, there is no checkpoint, or it is of another version,
            scene or formulation.
        DamageError
            When the checkpoint, or something written before it, was cut off or altered.
        """
        lock = FolderLock(path / files.LOCK)
        try:
            checkpoint = read_checkpoint(path, expected)
            header = checkpoint.header
            former.delete_after(path, header.topologies, header.frames)
            history = HistoryFile.cut(path / files.HISTORY, header.columns, header.rows)
            folder = cls.__new__(cls)
            folder.path, folder._summary, folder._lock = path, summary, lock
            folder._topologies, folder._frames = header.topologies, header.frames
            folder._rows, folder._history, folder._disk = header.rows, history, ToDisk()
            folder._write(files.SUMMARY, summary.to_json())
        except BaseException:
            lock.release()
            raise
        return folder, checkpoint.arrays

    def checkpoint(self, arrays: Arrays) -> None:
        """Store what the run goes on from when it is stopped after this."""
        self._disk.sync()
        header = replace(
            checkpoint_header(self._summary),
            topologies=self._topologies,
            frames=self._frames,
            rows=self._rows,
            columns=self._history.columns,
        )
        write_checkpoint(self.path / files.CHECKPOINT, Checkpoint(header, arrays))

    def begin(self, topology: Topology) -> None:
        """Write the elements as the topology of the frames to come."""
        path = self.path / files.topology_name(self._topologies)
        files.write_topology(path, topology)
        self._disk.wrote(path)
        self._topologies += 1

    def frame(self, frame: Frame) -> None:
        """Write one frame."""
        numbered = replace(frame, topology=self._topologies - 1)
        path = self.path / files.FRAMES / files.frame_name(frame.index)
        files.write_frame(path, numbered)
        self._disk.wrote(path)
        self._frames += 1

    def row(self, values: Mapping[str, float]) -> None:
        """Append one row to the history."""
        self._history.append(values)
        self._rows += 1
        self._disk.wrote(self._history.path)

    def finish(self, summary: Summary) -> None:
        """Put the summary in the place of the one that says "running", and free the folder."""
        self._write(files.SUMMARY, summary.to_json())
        self._disk.sync()
        self.close()

    def stop(self, fault: BaseException) -> None:
        """Say in the summary that the run was stopped and by what, as far as that can be written.

        Nothing happens after `finish`.
        """
        if self._lock.released:
            return
        with suppress(NmmError):
            said = f"{type(fault).__name__}: {fault}".rstrip(": ")
            sentence = f"the run was stopped before its end after {self._rows} steps by {said}"
            stopped = replace(self._summary, status=STOPPED, sentence=" ".join(sentence.split()))
            self._write(files.SUMMARY, replace(stopped, steps=self._rows).to_json())
            self._disk.sync()
        self.close()

    def close(self) -> None:
        """Close the history and free the folder; a second call does nothing."""
        self._history.close()
        self._lock.release()

    def _replace(self, replaced: bool) -> None:
        """Delete the earlier run; whoever is killed over it leaves a folder that says so."""
        if self._lock.stale is not None:
            warn(
                f"{self.path}: {self._lock.stale} was stopped here before its run had ended: "
                "what it left is replaced",
                NmmWarning,
                stacklevel=4,
            )
        status = REPLACING if replaced else self._summary.status
        self._write(files.SUMMARY, replace(self._summary, status=status).to_json())
        if replaced:
            former.delete(self.path)

    def _start(self, scene: str, formulation: str) -> None:
        with told(self.path / files.FRAMES):
            (self.path / files.FRAMES).mkdir(exist_ok=True)
        self._write(files.SCENE, scene)
        self._write(files.FORMULATION, formulation)
        mark = RunMark.of({files.SCENE: scene, files.FORMULATION: formulation})
        self._write(files.MARK, mark.to_json())

    def _write(self, name: str, content: str) -> None:
        write_text(self.path / name, content)
        self._disk.wrote(self.path / name)


def checkpoint_header(summary: Summary) -> CheckpointHeader:
    """Return the header of checkpoints of a run, of which ``summary`` is known beforehand."""
    version = summary.versions["nmm-framework"]
    return CheckpointHeader(
        CHECKPOINT_FORMAT, version, summary.scene_hash, summary.formulation_hash
    )
