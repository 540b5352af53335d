"""Runs that are stopped in mid-run and gone on with, as after Ctrl-C."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

import nmm
from nmm.scene.model import Scene
from nmm.stepping.run import Run
from nmm.testing.claims import claim


class StoppedError(Exception):
    """Stands for a user's Ctrl-C."""


def stopped_after(scene: Scene, folder: Path, steps: int, allow_code: Sequence[str] = ()) -> Path:
    """Run a scene into a folder until an exception ends it after so many steps.

    ``allow_code`` names modules of one's own that may run.

    Raises
    ------
    AssertionError
        When the run has come to its end before.
    """
    left = [steps]

    def progress(share: float, said: str | None) -> None:
        left[0] -= 1
        if left[0] < 0:
            raise StoppedError

    try:
        nmm.run(scene, out=folder, progress=progress, allow_code=allow_code)
    except StoppedError:
        return folder
    raise AssertionError(f"{folder}: the run ended before step {steps}")


def check_goes_on(scene: Scene, folder: Path, steps: int | None = None) -> Run:
    """Check that a run stopped after so many steps ends bit by bit as one that was not.

    Parameters
    ----------
    scene
        One that stores checkpoints.
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
    whole = nmm.run(scene, out=folder / "whole")
    steps = max(int(0.6 * whole.summary.steps), 1) if steps is None else steps
    resumed = nmm.resume(stopped_after(scene, folder / "half", steps))
    claim(resumed.summary.status == whole.summary.status, "resumed: another status")
    claim(np.array_equal(whole.displacement, resumed.displacement), "resumed: other displacements")
    claim(list(whole.history) == list(resumed.history), "resumed: other columns of the history")
    for name, column in whole.history.items():
        same = np.array_equal(column, resumed.history[name], equal_nan=True)
        claim(same, f"resumed: another column {name}")
    return whole
