"""All pictures of a run that have something to show, in one folder."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.errors import DamageError, FormulationError, SceneError
from nmm.plots.results.contact_forces import contact_forces
from nmm.plots.results.covers import covers
from nmm.plots.results.crack_paths import crack_paths, grown_paths
from nmm.plots.results.deformed import deformed, failure_mode
from nmm.plots.results.graphs.curves import load_displacement
from nmm.plots.results.graphs.history import overview
from nmm.plots.results.members import members
from nmm.plots.results.stress import NAMES, stress
from nmm.quantity import APART
from nmm.results.frame import Frame, Topology
from nmm.results.sink import RunData

if TYPE_CHECKING:
    from nmm.scene import Scene


def draw_all(
    run: RunData,
    folder: str | os.PathLike[str],
    *,
    scene: "Scene | None" = None,
    frame: int | None = None,
    magnification: float | None = None,
    component: str = "mises",
    tell: Callable[[str], None] | None = None,
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
        Measure of stress, or a quantity of the frame, see `stress`.
    tell
        Called with a sentence for each picture that a damaged run folder does not let us draw; the
        others are drawn. Without it the first such fault is raised.
    """
    album, shown = _Album(Path(folder), tell), _readable(run, tell)
    if shown.frames:
        calm = _last_before_failure(shown) if frame is None else frame
        if frame is not None:
            place = {"frame": frame, "magnification": magnification}
            album.draw("deformed.png", deformed, shown, **place)
        else:
            name = "failure_mode.png" if shown.frames[-1].stage == "failure" else "deformed.png"
            album.draw(name, failure_mode, shown, scene=scene, magnification=magnification)
        own = f"stress_{component}.png" if component in NAMES else _file(component)
        album.draw(own, stress, shown, component, frame=calm)
        _of_frame(album, shown, calm, component)
        if _has_covers(run, scene):
            album.draw("covers.png", _covers, run, scene)
    if _steps(run) > 1:  # one step is no curve
        if _moved(run) and not (shown.frames and shown.frames[-1].stage == "dynamic"):
            album.draw("load_displacement.png", load_displacement, run)
        album.draw("history.png", overview, run)
    return album.drawn


@dataclass
class _Album:
    """Pictures of a folder, ``drawn`` so far; ``tell`` as for `draw_all`."""

    folder: Path
    tell: Callable[[str], None] | None
    drawn: list[Path] = field(default_factory=list)

    def draw(self, name: str, picture: Callable[..., object], *what: object, **how: object) -> None:
        """Draw one, unless it says by False that there is nothing to draw."""
        try:
            made = picture(*what, **how, path=self.folder / name)
        except (DamageError, SceneError, FormulationError) as fault:
            if self.tell is None:
                raise
            self.tell(f"{name} is not drawn: {fault}")
        else:
            self.drawn.extend([self.folder / name] if made is not False else [])


def _file(quantity: str) -> str:
    """Name of the picture of a quantity."""
    return f"{quantity.replace(':', '_').replace(' ', '_')}.png"


def _of_frame(album: _Album, shown: RunData, number: int, drawn: str) -> None:
    """Draw what a frame has besides ``drawn``: quantities of effects, cracks, forces."""
    frame = shown.frames[number]
    for name, quantity in frame.fields.items():  # a handful, of effects
        apart = quantity.on in ("contacts", *APART)
        if ":" in name and not apart and quantity.values.ndim == 1 and name != drawn:
            album.draw(_file(name), stress, shown, name, frame=number)
    if grown_paths(shown):
        album.draw("crack_paths.png", crack_paths, shown)
    if len(frame.contact_gap):
        album.draw("contact_forces.png", contact_forces, shown, frame=number)
    if frame.on("members"):
        album.draw("members.png", members, shown, frame=number)


@dataclass(frozen=True)
class _Shown:
    """A run up to its last frame that can be read."""

    topologies: Sequence[Topology]
    frames: Sequence[Frame]
    history: Mapping[str, Floats]


def _readable(run: RunData, tell: Callable[[str], None] | None) -> RunData:
    """Return the run without damaged frames at its end, which are told."""
    count = len(run.frames)
    while count and tell is not None:
        try:
            run.frames[count - 1]
        except DamageError as fault:
            tell(str(fault))
            count -= 1
        else:
            break
    if count == len(run.frames):
        return run
    return _Shown(run.topologies, run.frames[:count], run.history)


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


def _has_covers(run: RunData, scene: "Scene | None") -> bool:
    return scene is not None and bool(getattr(run, "formulation", ""))


def _covers(run: RunData, scene: "Scene", path: Path) -> bool:
    """Lay the covers of a stored run again and draw them; blocks have none to draw."""
    from nmm.formulation import parse_formulation
    from nmm.geometry import regions
    from nmm.model.manifolds.covering import cover_regions

    text: str = getattr(run, "formulation", "")
    cover = parse_formulation(text).cover.model_copy(update={"enrichment": None})
    laid = cover_regions(regions(scene), cover, [np.array(item.points) for item in scene.cracks])
    if laid.laid is None:
        return False
    covers(laid.laid, laid.cut, path=path)
    return True
