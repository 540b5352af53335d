"""Reading a run folder, whether its run has ended, is going on or was killed.

What is damaged or missing is told, and the rest is read.
"""

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from warnings import warn

from integration.arrays import Floats
from nmm.errors import DamageError, NmmError, NmmWarning, StorageError
from nmm.plain_file import plain
from nmm.results.frame import Topology
from nmm.results.sink import columns_of
from nmm.results.storage import files
from nmm.results.storage.history import read_history
from nmm.results.storage.lock import owner
from nmm.results.storage.mark import FORMAT, RunMark
from nmm.results.storage.on_demand import StoredFrames, StoredTopologies
from nmm.results.summary import REPLACING, RUNNING, STOPPED, UNKNOWN, Summary


@dataclass(frozen=True)
class StoredRun:
    """A run as its folder holds it.

    Attributes
    ----------
    folder
        The folder.
    scene, formulation
        Their texts as run; empty when missing.
    topologies
        Element topologies; `Frame.topology` counts in them.
    frames
        Frames in the order of output, read on demand.
    history
        Columns by name, one value a step.
    summary
        The summary. Its status is "running" while the run goes on, "stopped" when it ended before
        its end, "unknown" when the summary is lost.
    mark
        What its texts add up to; None where that is missing or damaged.
    faults
        What of the folder is damaged or missing, one sentence each.
    """

    folder: Path
    scene: str
    formulation: str
    topologies: Sequence[Topology]
    frames: StoredFrames
    history: dict[str, Floats]
    summary: Summary
    mark: RunMark | None = None
    faults: tuple[str, ...] = ()


def read_run(path: str | os.PathLike[str]) -> StoredRun:
    """Read a run folder.

    Raises
    ------
    StorageError
        When the path is not a run folder, or its layout is of a later version. A frame or topology
        that is damaged raises `DamageError` when it is asked for.

    Warns
    -----
    NmmWarning
        Of everything in the folder that is damaged or missing; also in `StoredRun.faults`.
    """
    folder = Path(path)
    reader = _Reader(folder)
    mark = reader.mark()
    history = reader.history()
    summary = reader.summary(history)
    reader.compare(history, summary)
    frames = reader.frames(summary)
    topologies = reader.topologies(frames)
    stored = StoredRun(
        folder=folder,
        scene=reader.own_text(files.SCENE, mark, frames),
        formulation=reader.own_text(files.FORMULATION, mark, frames),
        topologies=topologies,
        frames=StoredFrames(frames, topologies),
        history=history,
        summary=summary,
        mark=mark,
        faults=tuple(reader.faults),
    )
    for fault in stored.faults:
        warn(fault, NmmWarning, stacklevel=2)
    return stored


class _Reader:
    """Reads the parts of a folder and gathers what is wrong with them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.faults: list[str] = []
        names = (files.MARK, files.SUMMARY, files.HISTORY, files.FRAMES)
        if not any((folder / name).exists() for name in names):
            raise StorageError(
                f"{folder}: no {files.MARK} or {files.SUMMARY} in it: expected a run folder: give "
                "the folder that `nmm run` named at its end"
            )

    def mark(self) -> RunMark | None:
        """Return the mark; folders of before it was introduced have none."""
        path = self.folder / files.MARK
        if not path.exists():
            return None
        try:
            mark = RunMark.from_json(self.text(files.MARK))
        except NmmError:
            self._fault(path, "damaged", "what is read may be of another version")
            return None
        if mark.format > FORMAT:
            raise StorageError(
                f"{path}: format {mark.format}: expected {FORMAT} at most: read it with the "
                "version of nmm that wrote it, or a later one"
            )
        return mark

    def text(self, name: str) -> str:
        """Return the text of a file; none, and a fault, where it cannot be read."""
        path = self.folder / name
        try:
            return plain(path).read_text(encoding="utf-8")
        except OSError as fault:
            self.faults.append(files.unreadable(path, fault))
        except UnicodeDecodeError:
            self._fault(path, "damaged, no UTF-8 text", "the other files can be read")
        return ""

    def own_text(self, name: str, mark: RunMark | None, frames: Sequence[Path]) -> str:
        """Return scene or formulation as run; a run killed at its start has none yet."""
        if not frames and not (self.folder / name).exists():
            return ""
        known = len(self.faults)
        text = self.text(name)
        if len(self.faults) == known and mark is not None and mark.differs(name, text):
            self._fault(self.folder / name, "altered or cut off", "it is not what was run")
        return text

    def history(self) -> dict[str, Floats]:
        """Return the columns of the history, empty ones of a run without a step."""
        path = self.folder / files.HISTORY
        if not path.exists():
            return columns_of([])
        text = self.text(files.HISTORY)
        columns, faults = read_history(path, text)
        self.faults += faults
        if not columns and not faults:
            self._fault(path, "damaged, its first line is cut off", "the history is lost")
        return columns or columns_of([])

    def summary(self, history: dict[str, Floats]) -> Summary:
        """Return the summary; "stopped" for one that says "running" though no process does."""
        path = self.folder / files.SUMMARY
        known = len(self.faults)
        text = self.text(files.SUMMARY)
        try:
            found = Summary.from_json(text)
        except NmmError as fault:
            if len(self.faults) == known:
                self._fault(path, f"damaged ({fault})", "frames and history can be read")
            return Summary(status=UNKNOWN, sentence="the summary of the run is lost", versions={})
        if found.status == REPLACING:
            self.faults.append(
                f"{self.folder}: its process ended while it was replacing an earlier run: expected "
                "the run that was asked for: run the scene again"
            )
        if found.status != RUNNING or (writer := owner(self.folder / files.LOCK)) is None:
            return _stopped(found, history) if found.status == RUNNING else found
        return replace(found, sentence=f"the run has not ended: {writer} writes to it")

    def compare(self, history: dict[str, Floats], summary: Summary) -> None:
        """Tell of a history that holds other steps than the run had when it ended."""
        rows = len(history.get("step", ()))
        known = summary.status not in (RUNNING, REPLACING, UNKNOWN)
        if known and rows != summary.steps and not self._tells(files.HISTORY):
            what = f"{rows} steps in it, {summary.steps} in the summary"
            self._fault(self.folder / files.HISTORY, what, "steps are missing or altered")

    def _tells(self, name: str) -> bool:
        return any(fault.startswith(str(self.folder / name)) for fault in self.faults)

    def frames(self, summary: Summary) -> list[Path]:
        """Return the frames that may be whole, and tell of the others."""
        found = files.numbered(self.folder / files.FRAMES, files.FRAME_NAME)
        wrong = {number: files.archive_fault(path) for number, path in found.items()}
        self.faults += [fault for fault in wrong.values() if fault is not None]
        count = max(max(found, default=-1) + 1, summary.frames or 0)
        if lost := sorted(set(range(count)) - set(found)):
            more = f" and {len(lost) - 1} more" if len(lost) > 1 else ""
            path = self.folder / files.FRAMES / files.frame_name(lost[0])
            self._fault(path, f"missing{more}", "the others can be read")
        return [path for number, path in found.items() if wrong[number] is None]

    def topologies(self, frames: Sequence[Path]) -> Sequence[Topology]:
        """Return all topologies; frames without any have lost theirs."""
        found = files.numbered(self.folder, files.TOPOLOGY_NAME)
        count = max(max(found, default=-1) + 1, 1 if frames else 0)
        read = [_topology(self.folder / files.topology_name(number)) for number in range(count)]
        self.faults += [str(one) for one in read if isinstance(one, DamageError)]
        whole = tuple(one for one in read if isinstance(one, Topology))
        return whole if len(whole) == len(read) else StoredTopologies(read)

    def _fault(self, path: Path, what: str, then: str) -> None:
        self.faults.append(
            f"{path}: {what}: expected it as the run wrote it: {then}; restore it or run the scene "
            "again to have all"
        )


def _topology(path: Path) -> Topology | DamageError:
    try:
        return files.read_topology(path)
    except DamageError as fault:
        return fault


def _stopped(summary: Summary, history: dict[str, Floats]) -> Summary:
    """Return the summary of a run whose process is gone, up to its last step."""
    steps = max((len(column) for column in history.values()), default=0)
    sentence = f"the run was stopped before its end; {steps} steps of it can be read"
    if steps and "time" in history:
        sentence += f", the last at {history['time'][-1]:.6g}"
    return replace(summary, status=STOPPED, sentence=sentence, steps=steps)
