"""The verbs that show what a run has left: plot, export. What they need they import."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.cli.scene_verbs import AllowCode, allowed
from nmm.cli.terminal import faults_told, tell_faults, tell_files
from nmm.errors import NmmError

if TYPE_CHECKING:
    from collections.abc import Callable

    from nmm.results import StoredRun
    from nmm.results.sink import RunData
    from nmm.scene import Scene


def plot(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", metavar="RUN")],
    frame: Annotated[
        int | None, typer.Option(help="Number of the frame, from the end when negative.")
    ] = None,
    magnification: Annotated[
        float | None, typer.Option(min=0, help="Factor on displacements.")
    ] = None,
    component: Annotated[
        str,
        typer.Option(
            help="What is drawn: mises, xx, yy, xy, major or minor stress; or a quantity of the "
            "frames, such as heat:temperature."
        ),
    ] = "mises",
    allow_code: AllowCode = None,
) -> None:
    """Draw a run, whole or one frame of it; a run that was stopped can be drawn too.

    Exit code 1 when the folder is damaged so that a picture or file could not be made.
    """
    from nmm.results import read_run

    missed: list[str] = []
    with faults_told(), allowed(run / "scene.toml", allow_code):
        stored = read_run(run)
        _frame_exists(frame, len(stored.frames))
        scene = _scene_of(stored, missed.append)
        drawn = draw(stored, run, scene, frame, magnification, component, missed.append)
        tell_files(drawn)
        if not drawn:
            missed.append(f"{run}: nothing to draw: expected frames or a history: run it again")
        elif not len(stored.frames):
            missed.append(f"{run}: no frame: expected one for pictures of blocks: run it again")
    _tell_missed(missed)


def export(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", metavar="RUN")],
    allow_code: AllowCode = None,
) -> None:
    """Write the ParaView files of a run; one that was stopped is written up to its last frame.

    Exit code 1 when the folder is damaged so that a frame could not be written.
    """
    from nmm.results import read_run

    missed: list[str] = []
    with faults_told(), allowed(run / "scene.toml", allow_code):
        stored = read_run(run)
        if not len(stored.frames):
            raise NmmError(f"{run}: nothing to export: expected frames: run it again")
        tell_files(paraview_files(stored, run, missed.append))
    _tell_missed(missed)


def _tell_missed(missed: list[str]) -> None:
    """Tell what could not be made of a damaged folder, and leave with exit code 1."""
    tell_faults(missed)
    if missed:
        raise typer.Exit(1)


def draw(
    run: "RunData",
    folder: Path,
    scene: "Scene | None",
    frame: int | None = None,
    magnification: float | None = None,
    component: str = "mises",
    tell: "Callable[[str], None] | None" = None,
) -> list[Path]:
    """Draw a run, or one frame of it; return the pictures."""
    from nmm.plots import draw_all
    from nmm.results.storage.files import PICTURES

    return draw_all(
        run,
        folder / PICTURES,
        scene=scene,
        frame=frame,
        magnification=magnification,
        component=component,
        tell=tell,
    )


def _scene_of(stored: "StoredRun", tell: "Callable[[str], None]") -> "Scene | None":
    """Read the scene of a run again; a run is drawn without one that cannot be read."""
    from nmm.results.storage.files import SCENE
    from nmm.scene import parse_scene

    try:
        return parse_scene(stored.scene, str(stored.folder / SCENE)) if stored.scene else None
    except NmmError as error:
        tell(f"{error.faults[0]}; supports, loads and covers are not drawn")
        return None


def paraview_files(
    run: "RunData", folder: Path, tell: "Callable[[str], None] | None" = None
) -> list[Path]:
    """Write the ParaView files of a run; return them."""
    from nmm.results.storage.files import PARAVIEW
    from nmm.results.viewing.paraview import write_paraview

    return write_paraview(run, folder / PARAVIEW, tell)


def _frame_exists(frame: int | None, count: int) -> None:
    if frame is None or -count <= frame < count:
        return
    expected = f"{-count} to {count - 1}" if count else "none"
    raise NmmError(f"--frame {frame}: expected {expected}: the run has {count}")


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in (plot, export):
        app.command()(verb)
