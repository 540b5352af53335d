"""All pictures of a run that have something to show, in one folder."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nmm.plots.contact_forces import contact_forces
from nmm.plots.covers import covers
from nmm.plots.curves import load_displacement, overview
from nmm.plots.deformed import deformed, failure_mode
from nmm.plots.stress import stress
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.stepping.covering import Covering


def draw_all(
    run: RunData,
    folder: str | os.PathLike[str],
    *,
    scene: "Scene | None" = None,
    frame: int | None = None,
    magnification: float | None = None,
    component: str = "mises",
) -> list[Path]:
    """Draw a run and return the files, the most telling one first.

    Parameters
    ----------
    run
        A run in memory or a stored one.
    folder
        Where the pictures go; made when missing.
    scene
        When given, its supports and loads are drawn too.
    frame
        Number of the frame of the deformed shape, stress and contact forces. None takes the last
        one, for stress and forces the last before failure.
    magnification
        Factor on displacements; None takes a round one that makes them visible.
    component
        Measure of stress, see `stress`.
    """
    target = Path(folder)
    drawn: list[Path] = []

    def file(name: str) -> Path:
        drawn.append(target / name)
        return drawn[-1]

    if not run.frames:
        return drawn
    calm = _last_before_failure(run) if frame is None else frame
    if frame is not None:
        deformed(run, frame=frame, magnification=magnification, path=file("deformed.png"))
    else:
        name = "failure_mode.png" if run.frames[-1].stage == "failure" else "deformed.png"
        failure_mode(run, scene=scene, magnification=magnification, path=file(name))
    stress(run, component, frame=calm, path=file(f"stress_{component}.png"))
    if len(run.frames[calm].contact_gap):
        contact_forces(run, frame=calm, path=file("contact_forces.png"))
    covering = _covering(run, scene)
    if covering is not None and covering.laid is not None and covering.cut is not None:
        covers(covering.laid, covering.cut, path=file("covers.png"))
    if _steps(run) > 1:  # one step is no curve
        if run.frames[-1].stage != "dynamic" and _moved(run):
            load_displacement(run, path=file("load_displacement.png"))
        overview(run, path=file("history.png"))
    return drawn


def _last_before_failure(run: RunData) -> int:
    for number in range(len(run.frames) - 1, -1, -1):
        if run.frames[number].stage != "failure":
            return number
    return -1


def _steps(run: RunData) -> int:
    return max((len(values) for values in run.history.values()), default=0)


def _moved(run: RunData) -> bool:
    return any(
        name.startswith("monitor:") and bool(values.any()) for name, values in run.history.items()
    )


def _covering(run: RunData, scene: "Scene | None") -> "Covering | None":
    """Lay the covers of a stored run again; None for blocks and where scene or text is missing."""
    text = getattr(run, "formulation", "")
    if scene is None or not text:
        return None
    from nmm.formulation import parse_formulation
    from nmm.geometry import regions
    from nmm.stepping.covering import cover_regions

    cover = parse_formulation(text).cover.model_copy(update={"enrichment": None})
    if cover.of_blocks:
        return None
    return cover_regions(regions(scene), cover, [np.array(item.points) for item in scene.cracks])
