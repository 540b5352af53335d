"""The verbs of the command line. What they need is imported inside them, so that help is fast."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm import scene_verbs, study_verbs, verification_verbs
from nmm.scene_verbs import FormulationFile, SceneFile, read_beside, read_formulation
from nmm.terminal import (
    FAILED,
    console,
    faults_told,
    progress_bar,
    tell_files,
    tell_next,
    tell_run,
)

if TYPE_CHECKING:
    from nmm.results.sink import RunData
    from nmm.scene import Scene

app = typer.Typer(
    help="Numerical manifold method in 2D: blocks, joints, contact and fracture.",
    no_args_is_help=True,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)

Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", help="Folder of the run; else one of its name in runs/."),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print the verdict only.")]

DEMO = "kitoh_beam/kitoh_130.toml"
RUNS = Path("runs")


@app.callback(invoke_without_command=True)
def main(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and exit.", is_eager=True)
    ] = False,
) -> None:
    """Numerical manifold method in 2D: blocks, joints, contact and fracture."""
    if version:
        import nmm

        typer.echo(f"nmm {nmm.__version__}")
        raise typer.Exit


scene_verbs.register(app)


@app.command()
def run(
    scene: SceneFile,
    formulation: FormulationFile = None,
    out: Out = None,
    quiet: Quiet = False,
    steps: Annotated[
        bool, typer.Option("--steps", help="A line after each step: passes, states of contacts.")
    ] = False,
) -> None:
    """Run a scene; write its folder with pictures and ParaView files.

    Exit code 2 when a step could not be solved; what was written before it stays.
    """
    with faults_told():
        _run(scene, formulation, out or _free(RUNS / scene.stem), quiet, steps)


@app.command()
def demo(out: Out = None, quiet: Quiet = False) -> None:
    """Break a concrete beam in four-point bending and draw it."""
    from nmm.shipped import example

    with faults_told():
        _run(example(DEMO), None, out or RUNS / "demo", quiet)


@app.command()
def plot(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", metavar="RUN")],
    frame: Annotated[
        int | None, typer.Option(help="Number of the frame, from the end when negative.")
    ] = None,
    magnification: Annotated[
        float | None, typer.Option(min=0, help="Factor on displacements.")
    ] = None,
    component: Annotated[
        str, typer.Option(help="Stress drawn: mises, xx, yy, xy, major, minor.")
    ] = "mises",
) -> None:
    """Draw a run again, whole or one frame of it; a run that was stopped can be drawn too."""
    from nmm.results import read_run
    from nmm.scene import parse_scene

    with faults_told():
        stored = read_run(run)
        scene = parse_scene(stored.scene, str(run / "scene.toml")) if stored.scene else None
        _frame_exists(frame, len(stored.frames))
        tell_files(_draw(stored, run, scene, frame, magnification, component))


study_verbs.register(app)
verification_verbs.register(app)


def _run(
    place: Path, formulation: Path | None, out: Path, quiet: bool, steps: bool = False
) -> None:
    import nmm
    from nmm.results.summary import render

    scene = read_beside(place)
    chosen = read_formulation(formulation)
    try:
        with progress_bar(quiet, steps) as progress:
            done = nmm.run(scene, chosen, out=out, progress=progress)
    except KeyboardInterrupt:
        typer.secho(f"stopped; what was written can be drawn: nmm plot {out}", err=True)
        raise typer.Exit(130) from None
    # Drawn from the folder, as `nmm plot` does, which knows the covers too.
    files = [*_draw(nmm.read_run(out), out, scene), *_paraview(done, out)]
    tell_run(scene, done)
    if not quiet:
        console().print(render(done.summary))
        tell_files([out, *files])
        tell_next(f"nmm plot {out} --frame 0", f"paraview {out / 'paraview' / 'blocks.pvd'}")
    if done.summary.status == FAILED:
        raise typer.Exit(2)


def _draw(
    run: "RunData",
    folder: Path,
    scene: "Scene | None",
    frame: int | None = None,
    magnification: float | None = None,
    component: str = "mises",
) -> list[Path]:
    from nmm.plots import draw_all
    from nmm.results.files import PICTURES

    return draw_all(
        run,
        folder / PICTURES,
        scene=scene,
        frame=frame,
        magnification=magnification,
        component=component,
    )


def _paraview(run: "RunData", folder: Path) -> list[Path]:
    from nmm.results.files import PARAVIEW
    from nmm.results.paraview import write_paraview

    return write_paraview(run, folder / PARAVIEW)


def _frame_exists(frame: int | None, count: int) -> None:
    from nmm.errors import NmmError

    if frame is not None and not -count <= frame < count:
        raise NmmError(f"--frame {frame}: expected {-count} to {count - 1}: the run has {count}")


def _free(path: Path) -> Path:
    """Return the path, with a number behind it when there is something of that name."""
    number, free = 1, path
    while free.exists():
        number += 1
        free = path.with_name(f"{path.name}-{number}")
    return free
