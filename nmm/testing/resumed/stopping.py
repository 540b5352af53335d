"""Runs that are stopped in mid-run and gone on with, as after Ctrl-C."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import nmm
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.results.frame import Frame
from nmm.scene.model import Scene
from nmm.stepping.run import Run
from nmm.testing.claims import claim

MEASURED = ("seconds", "effect_seconds", "peak_memory")
"""Entries of a summary that no two runs share."""


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
    one, other = (json.loads(run.summary.to_json()) for run in (whole, resumed))
    claim(one.keys() == other.keys(), "resumed: other entries of the summary")
    for name in sorted(set(one) - set(MEASURED)):
        claim(one[name] == other[name], f"resumed: another {name}: {other[name]}, not {one[name]}")
    claim(np.array_equal(whole.displacement, resumed.displacement), "resumed: other displacements")
    claim(list(whole.history) == list(resumed.history), "resumed: other columns of the history")
    columns = {
        f"column {name}": (column, resumed.history[name]) for name, column in whole.history.items()
    }
    claim(len(whole.frames) == len(resumed.frames), "resumed: another number of frames")
    for frame, again in zip(whole.frames, resumed.frames, strict=True):
        kept, found = _arrays(frame), _arrays(again)
        claim(list(kept) == list(found), f"resumed: other fields of frame {frame.index}")
        columns |= {f"{name} of frame {frame.index}": (kept[name], found[name]) for name in kept}
    for name, (before, after) in columns.items():
        claim(np.array_equal(before, after, equal_nan=True), f"resumed: another {name}")


def _arrays(frame: Frame) -> dict[str, Any]:
    """Return all that a frame holds by name, but for what is text."""
    own = {name: value for name, value in vars(frame).items() if name not in ("fields", "stage")}
    return own | {f"field {name}": field.values for name, field in frame.fields.items()}
