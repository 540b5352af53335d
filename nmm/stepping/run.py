"""One scene under one formulation, from files to a finished run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.results.frame import Frame, Topology
from nmm.results.sink import MemorySink, Sink
from nmm.results.storage.run_folder import RunFolder
from nmm.results.storage.values import Arrays
from nmm.results.summary import Summary
from nmm.solvers.threads import OneThread
from nmm.stepping.prepare import prepare
from nmm.stepping.run_state import RunState
from nmm.stepping.simulation import Simulation
from nmm.stepping.step.stepper import Stepper
from nmm.trust import allowing, beside, given

if TYPE_CHECKING:
    from covers.approximation.manifold import Manifold
    from nmm.scene.model import Scene


@dataclass(frozen=True)
class Run:
    """A finished run.

    Attributes
    ----------
    summary
        Verdict, sizes, costs.
    history
        One array a column, one value a step.
    frames
        Stored states.
    folder
        Where it was written; None when it was kept in memory.
    manifold
        The approximation.
    state
        The last accepted state.
    stepper
        What solved it, for further steps by hand.
    topologies
        Elements that the frames belong to, as plots and exports need them.
    origin
        (2,) where the axes of manifold and state lie (m); zero unless the scene lies far away.
        Frames and topologies have the axes of the scene.
    """

    summary: Summary
    history: dict[str, Floats]
    frames: list[Frame]
    folder: Path | None
    manifold: "Manifold"
    state: State
    stepper: Stepper
    topologies: list[Topology]
    origin: Floats

    @property
    def displacement(self) -> Floats:
        """Displacement (P, 2) of ``manifold.elements.points`` at the end (m)."""
        return self.stepper.place(self.state) - self.manifold.elements.points

    @property
    def stress(self) -> Floats:
        """Mean stress (E, 3) of the elements at the end (Pa)."""
        return self.frames[-1].stress

    @property
    def contact_forces(self) -> Floats:
        """Normal and shear force (C, 2) of the contacts at the end (N), tension positive."""
        return self.frames[-1].contact_force


def run(
    scene: "Scene",
    formulation: Formulation | None = None,
    *,
    out: str | Path | None = None,
    progress: Progress | None = None,
    allow_code: Sequence[str] = (),
    budget: float | None = None,
) -> Run:
    """Run a scene.

    Parameters
    ----------
    scene
        What happens.
    formulation
        How it is approximated; the scene's own, or classical DDA, when not given.
    out
        Folder to write to; nothing is written without it.
    progress
        Called with the share done (0 to 1) and a line of text.
    allow_code
        Modules, beside the scene's file or on the Python path, that parts named ``module:Class``
        may be imported from. Their code runs: name those that you trust.
    budget
        Seconds on the wall clock after which the run ends with what it has; the formulation's
        ``[loading] budget`` when not given.

    Raises
    ------
    TypeError
        When something else than a scene or a formulation is given, such as the name of a file, or
        a budget that is no number of seconds.
    NmmError
        When scene or formulation cannot be run at all. A run that starts ends with a summary whose
        status is a key of `nmm.stepping.drive.verdict.MEANT` and whose sentence says why.
    StorageError
        When the folder cannot be written, for one as the disk is full; what was written before
        stays, and the summary there says what stopped the run.
    """
    _refuse_other(scene, "Scene", "nmm.read_scene")
    if formulation is not None:
        _refuse_other(formulation, "Formulation", "nmm.read_formulation")
    if isinstance(allow_code, str):
        raise TypeError(f"nmm.run: allow_code {allow_code!r}: expected a list of names of modules")
    refuse_no_seconds(budget)
    modules = given().modules.union(allow_code)
    # With several threads sums differ in their last digits from one number of threads to another.
    with allowing(*modules, folder=beside(scene.source.name, modules)), OneThread():
        return _run(scene, formulation, out, progress or (lambda share, text: None), budget)


def _run(
    scene: "Scene",
    formulation: Formulation | None,
    out: str | Path | None,
    progress: Progress,
    budget: float | None,
) -> Run:
    formulation = formulation or scene.formulation or Formulation()
    store = None
    if scene.strength_reduction is None:
        simulation = prepare(scene, formulation)
        folder = None if out is None else simulation.folder(Path(out))
    else:
        from nmm.stepping.safety.search import sought

        found = sought(scene, formulation, out, progress)
        simulation, folder, store = found.simulation, found.folder, found.store
    if budget is not None:
        simulation.stepper.budget.seconds = budget
    return finished(simulation, MemorySink(), folder, progress, store=store)


def finished(
    simulation: Simulation,
    memory: MemorySink,
    folder: RunFolder | None,
    progress: Progress,
    stood: RunState | None = None,
    store: Callable[[Arrays], None] | None = None,
) -> Run:
    """Run a simulation to its end, from its start or from where it ``stood``.

    ``store`` takes checkpoints, in place of the ``folder``.
    """
    sinks: list[Sink] = [memory] if folder is None else [memory, folder]
    if store is None and folder is not None:
        store = folder.checkpoint
    try:
        state = simulation.run(sinks, progress, store or (lambda arrays: None), stood)
    except BaseException as fault:
        if folder is not None:
            folder.stop(fault)
        raise
    return Run(
        summary=memory.summary,
        history=memory.history,
        frames=memory.frames,
        folder=None if folder is None else folder.path,
        manifold=simulation.stepper.model.manifold,
        state=state,
        stepper=simulation.stepper,
        topologies=memory.topologies,
        origin=simulation.origin,
    )


def _refuse_other(given: object, kind: str, reader: str) -> None:
    if type(given).__name__ != kind:
        raise TypeError(f"nmm.run: {given!r}: expected a {kind}: read a file by {reader}(path)")


def refuse_no_seconds(budget: float | None) -> None:
    """Refuse a budget that is no number of seconds: one that is nan was spent at once."""
    if budget is not None and not (isinstance(budget, int | float) and budget >= 0):
        raise TypeError(
            f"budget {budget!r}: expected a number of seconds, 0 or more: write for example "
            "budget=60"
        )
