"""A run that was stopped goes on from its last checkpoint."""

import os
import warnings
from collections.abc import Sequence
from pathlib import Path

from nmm.errors import NmmWarning, StorageError
from nmm.formulation import read_formulation
from nmm.progress import Progress
from nmm.results.sink import MemorySink
from nmm.results.storage import files
from nmm.results.storage.history import read_history
from nmm.results.storage.run_folder import RunFolder
from nmm.results.storage.stored_run import StoredRun, read_run
from nmm.results.summary import RUNNING, STOPPED, UNKNOWN
from nmm.scene import read_scene
from nmm.solvers.threads import OneThread
from nmm.stepping.drive.verdict import SPENT
from nmm.stepping.prepare import prepare
from nmm.stepping.run import Run, finished, refuse_no_seconds
from nmm.trust import allowing, given

GOES_ON = (RUNNING, STOPPED, SPENT, UNKNOWN)
"""Status of a run that has not come to its end."""


def resume(
    folder: str | os.PathLike[str],
    *,
    progress: Progress | None = None,
    allow_code: Sequence[str] = (),
    budget: float | None = None,
) -> Run:
    """Go on with a run that was stopped, from the last checkpoint in its folder.

    Frames, history and summary are in the end those of a run that was never stopped, byte by byte
    but for seconds and memory. What the stopped run wrote after its checkpoint is written anew.

    Parameters
    ----------
    folder
        Of the run, whose scene has ``[output] checkpoint``.
    progress, allow_code, budget
        As for `nmm.run`; seconds count anew.

    Raises
    ------
    StorageError
        When it is no run folder, the run has come to its end or still goes on, or there is no
        checkpoint of this version, scene and formulation.
    DamageError
        When the checkpoint, or something written before it, is missing, cut off or altered.
    """
    path = Path(folder)
    if isinstance(allow_code, str):
        raise TypeError(f"nmm.resume: allow_code {allow_code!r}: expected a list of names")
    refuse_no_seconds(budget)
    with warnings.catch_warnings():
        # What a kill has left unfinished is written anew.
        warnings.simplefilter("ignore", NmmWarning)
        _refuse_altered(read_run(path))
    modules = given().modules.union(allow_code)
    beside = path if modules else None
    with allowing(*modules, folder=beside), OneThread():
        return _resumed(path, progress or (lambda share, text: None), budget)


def _resumed(path: Path, progress: Progress, budget: float | None) -> Run:
    scene = read_scene(path / files.SCENE)
    formulation = read_formulation(path / files.FORMULATION)
    folder: RunFolder | None
    store = None
    if scene.strength_reduction is None:
        simulation = prepare(scene, formulation)
        folder, stood = simulation.reopened(path)
    else:
        from nmm.stepping.safety.search import sought_on

        found = sought_on(scene, formulation, path, progress)
        simulation, folder, stood, store = found.simulation, found.folder, found.stood, found.store
    if budget is not None:
        simulation.stepper.budget.seconds = budget
    return finished(simulation, _read_before(path), folder, progress, stood, store)


def _read_before(path: Path) -> MemorySink:
    """Return what a folder, reopened at its checkpoint, holds."""
    memory, found = MemorySink(), files.numbered(path / files.FRAMES, files.FRAME_NAME)
    memory.frames = [files.read_frame(frame) for frame in found.values()]
    topologies = files.numbered(path, files.TOPOLOGY_NAME)
    memory.topologies = [files.read_topology(one) for one in topologies.values()]
    if (path / files.HISTORY).exists():
        text = (path / files.HISTORY).read_text(encoding="utf-8")
        columns, _ = read_history(path / files.HISTORY, text)
        rows = zip(*(column.tolist() for column in columns.values()), strict=True)
        memory.rows = [dict(zip(columns, row, strict=True)) for row in rows]
    return memory


def _refuse_altered(stored: StoredRun) -> None:
    """Refuse a run that has ended, or whose texts are not what was run."""
    path, status = stored.folder, stored.summary.status
    if status not in GOES_ON:
        raise StorageError(
            f"{path}: its run has ended ({status}): expected one that was stopped: nothing is left "
            "to go on with; run the scene again"
        )
    if stored.mark is None:
        raise _altered(path / files.MARK)
    texts = {files.SCENE: stored.scene, files.FORMULATION: stored.formulation}
    for name, text in texts.items():
        if not text or stored.mark.differs(name, text):
            raise _altered(path / name)


def _altered(path: Path) -> StorageError:
    return StorageError(
        f"{path}: missing or altered: expected it as it was run: restore it, or run the scene again"
    )
