"""A run at the factor of safety of a scene, which is sought first; stopped anywhere it goes on."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from nmm.progress import Progress
from nmm.results.storage.run_folder import RunFolder
from nmm.results.storage.values import Arrays
from nmm.stepping.prepare import prepare
from nmm.stepping.run_state import RunState
from nmm.stepping.safety.strength_reduction import reduced
from nmm.stepping.safety.tried_factors import TriedFactors
from nmm.stepping.simulation import Simulation

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class SafetyRun:
    """What is run once the factor is found.

    Attributes
    ----------
    simulation
        At the factor.
    folder
        Where it is written; None in memory.
    store
        Takes checkpoints, beside which it puts what is known of factors.
    stood
        Where it goes on; None from its start.
    """

    simulation: Simulation
    folder: RunFolder | None
    store: Callable[[Arrays], None]
    stood: RunState | None = None


def sought(
    scene: "Scene", formulation: "Formulation", out: str | Path | None, progress: Progress
) -> SafetyRun:
    """Seek the factor of safety of a scene, into a folder if one is given."""
    folder, tried = None, TriedFactors()
    if out is not None:
        folder = prepare(scene, formulation).folder(Path(out))
        if scene.output is not None and scene.output.checkpoint is not None:
            tried.keep = folder.checkpoint
            tried.store({})
    return SafetyRun(_found(scene, formulation, progress, tried, folder), folder, tried.store)


def sought_on(
    scene: "Scene", formulation: "Formulation", path: Path, progress: Progress
) -> SafetyRun:
    """Go on with a search, or with the run after it, from the last checkpoint in its folder."""
    tried = TriedFactors()
    folder, stood = prepare(scene, formulation).reopened(path, tried.taken_up)
    tried.keep = folder.checkpoint
    found = _found(scene, formulation, progress, tried, folder)
    return SafetyRun(found, folder, tried.store, stood)


def _found(
    scene: "Scene",
    formulation: "Formulation",
    progress: Progress,
    tried: TriedFactors,
    folder: RunFolder | None,
) -> Simulation:
    try:
        return reduced(scene, formulation, progress, tried)
    except BaseException as fault:
        if folder is not None:
            folder.stop(fault)
        raise
