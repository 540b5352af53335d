"""Runs that are stopped in mid-run and gone on with, as after Ctrl-C."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import nmm
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.scene.model import Scene
from nmm.stepping.run import Run
from nmm.testing.claims import claim


class StoppedError(Exception):
    """Stands for a user's Ctrl-C."""


def interrupting(steps: int) -> Progress:
    """Return what is told how far a run is, and ends it by an exception after so many steps."""
    left = [steps]

    def progress(share: float, said: str) -> None:
        left[0] -= 1
        if left[0] < 0:
            raise StoppedError

    return progress


def stopped_after(
    scene: Scene,
    folder: Path,
    steps: int,
    formulation: Formulation | None = None,
    *,
    allow_code: Sequence[str] = (),
) -> Path:
    """Run a scene into a folder until an exception ends it after so many steps.

    ``allow_code`` names modules of one's own that may run.

    Raises
    ------
    AssertionError
        When the run has come to its end before.
    """
    progress = interrupting(steps)
    try:
        nmm.run(scene, formulation, out=folder, progress=progress, allow_code=allow_code)
    except StoppedError:
        return folder
    raise AssertionError(f"{folder}: the run ended before step {steps}")


def check_goes_on(
    scene: Scene, folder: Path, steps: int | None = None, formulation: Formulation | None = None
) -> Run:
    """Check that a run stopped after so many steps ends bit by bit as one that was not.

    Parameters
    ----------
    scene, formulation
        One that stores checkpoints, and how it is solved; None is the scene's own.
    folder
        Takes both runs.
    steps
        After which it is stopped; 0.6 of those of the whole run when not given.

    Returns
    -------
    The whole run.

    Raises
    ------
    AssertionError
        Naming what differs.
    """
    whole = nmm.run(scene, formulation, out=folder / "whole")
    steps = max(int(0.6 * whole.summary.steps), 1) if steps is None else steps
    check_resumed(whole, nmm.resume(stopped_after(scene, folder / "half", steps, formulation)))
    return whole


def check_resumed(whole: Run, resumed: Run) -> None:
    """Check that a run that was stopped and gone on with is the whole one, bit by bit.

    Raises
    ------
    AssertionError
        Naming what differs.
    """
    for name in ("status", "sentence", "changes"):
        same = getattr(resumed.summary, name) == getattr(whole.summary, name)
        claim(same, f"resumed: another {name}")
    claim(np.array_equal(whole.displacement, resumed.displacement), "resumed: other displacements")
    claim(list(whole.history) == list(resumed.history), "resumed: other columns of the history")
    columns = {
        f"column {name}": (column, resumed.history[name]) for name, column in whole.history.items()
    }
    last, end = whole.frames[-1].fields, resumed.frames[-1].fields
    claim(list(last) == list(end), "resumed: other fields of the last frame")
    columns |= {f"field {name}": (field.values, end[name].values) for name, field in last.items()}
    for name, (one, other) in columns.items():
        claim(np.array_equal(one, other, equal_nan=True), f"resumed: another {name}")
