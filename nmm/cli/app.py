"""The verbs of the command line. What they need is imported inside them, so that help is fast."""

import atexit
import gc
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.cli import motion_verbs, result_verbs, scene_verbs, study_verbs, verification_verbs
from nmm.cli.result_verbs import draw, paraview_files
from nmm.cli.scene_verbs import AllowCode, FormulationFile, allowed, read_formulation
from nmm.cli.terminal import (
    console,
    faults_told,
    in_shell,
    progress_bar,
    tell_files,
    tell_next,
    tell_run,
)
from nmm.errors import NmmError

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.stepping.run import Run

app = typer.Typer(
    help="Numerical manifold method in 2D: blocks, joints, contact and fracture.",
    no_args_is_help=True,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
    rich_markup_mode="markdown",  # paragraphs flow, and [tables] are no markup
)

Out = Annotated[
    Path | None,
    typer.Option("--out", "-o", help="Folder of the run; else one of its name in runs/."),
]

Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print the verdict only.")]

DEMO = "kitoh_beam/kitoh_130.toml"

# Objects made between two searches for circles of them. Libraries make 160 000 that stay when they
# are imported; to look through these again and again is a tenth of a small run, 50 ms even once
# for each 100 000.
MADE_BETWEEN_SEARCHES = 300_000

RUNS = Path("runs")


@app.callback(invoke_without_command=True)
def main(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version and exit.", is_eager=True)
    ] = False,
) -> None:
    """Numerical manifold method in 2D: blocks, joints, contact and fracture."""
    gc.set_threshold(MADE_BETWEEN_SEARCHES)
    # Python ends with three searches through all that imports have made: a fifth of a check.
    atexit.register(gc.freeze)
    if version:
        import nmm

        typer.echo(f"nmm {nmm.__version__}")
        raise typer.Exit


scene_verbs.register(app)


@app.command()
def run(
    scene: Annotated[Path | None, typer.Argument(help="Scene file, TOML.", metavar="SCENE")] = None,
    formulation: FormulationFile = None,
    out: Out = None,
    quiet: Quiet = False,
    steps: Annotated[
        bool, typer.Option("--steps", help="A line after each step: passes, states of contacts.")
    ] = False,
    budget: Annotated[
        float | None,
        typer.Option(min=0, help="Seconds after which the run ends with what it has."),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            metavar="RUN",
            help="Go on with a run that was stopped from the last checkpoint in its folder; "
            "its scene has [output] checkpoint.",
        ),
    ] = None,
    allow_code: AllowCode = None,
) -> None:
    """Run a scene, or go on with a run; write its folder.

    Pictures and ParaView files are among it where the scene's [output] asks for them.

    Exit code 2 when a step could not be solved, 3 when the budget was spent, 4 when the structure
    collapsed, 5 when an audit of energy, momentum or balance failed; what was written stays.
    """
    with faults_told():
        if resume is not None:
            _refuse_beside_resume(scene, formulation, out)
            with allowed(resume / "scene.toml", allow_code):
                _resume(resume, quiet, steps, budget)
            return
        if scene is None:
            raise NmmError("SCENE: missing: expected a scene file, or --resume with a run folder")
        with allowed(scene, allow_code):
            _run(scene, formulation, out or _free(RUNS / scene.stem), quiet, steps, budget)


@app.command()
def demo(out: Out = None, quiet: Quiet = False) -> None:
    """Break a concrete beam in four-point bending and draw it."""
    from nmm.shipped import example

    with faults_told():
        _run(example(DEMO), None, out or RUNS / "demo", quiet, pictures=True)


@app.command("compile")
def compile_ahead() -> None:
    """Compile what runs of blocks need, once, so that the first of them does not wait for it."""
    from nmm.cli.compiling import compile_kernels

    with faults_told():
        compile_kernels()


result_verbs.register(app)
study_verbs.register(app)


motion_verbs.register(app)


verification_verbs.register(app)


def _run(
    place: Path,
    formulation: Path | None,
    out: Path,
    quiet: bool,
    steps: bool = False,
    budget: float | None = None,
    pictures: bool = False,
) -> None:
    import nmm

    scene = nmm.read_scene(place)
    chosen = read_formulation(formulation)
    with _stopped_told(out), progress_bar(quiet, steps) as progress:
        done = nmm.run(scene, chosen, out=out, progress=progress, budget=budget)
    _tell_done(scene, done, out, quiet, pictures)


def _resume(folder: Path, quiet: bool, steps: bool, budget: float | None) -> None:
    import nmm

    with _stopped_told(folder), progress_bar(quiet, steps) as progress:
        done = nmm.resume(folder, progress=progress, budget=budget)
    _tell_done(nmm.read_scene(folder / "scene.toml"), done, folder, quiet)


def _refuse_beside_resume(scene: Path | None, formulation: Path | None, out: Path | None) -> None:
    given = {"SCENE": scene, "--formulation": formulation, "--out": out}
    for name, value in given.items():
        if value is not None:
            raise NmmError(
                f"{name}: {value}: expected none beside --resume, which takes what the folder "
                "holds: leave it out, or run the scene anew without --resume"
            )


@contextmanager
def _stopped_told(out: Path) -> Iterator[None]:
    """Tell what can be done with a run that the user stops."""
    try:
        yield
    except KeyboardInterrupt:
        typer.secho(f"stopped; what was written can be drawn: nmm plot {in_shell(out)}", err=True)
        if (out / "checkpoint.npz").exists():
            again = f"nmm run --resume {in_shell(out)}"
            typer.secho(f"it goes on from its last checkpoint: {again}", err=True)
        raise typer.Exit(130) from None


def _tell_done(scene: "Scene", done: "Run", out: Path, quiet: bool, pictures: bool = False) -> None:
    """Tell of a run that has ended, with the files that were asked for; leave with its code."""
    from nmm.results.summary_lines import render
    from nmm.stepping.drive.verdict import status_code

    files = _shown(scene, done, out, pictures)
    tell_run(scene, done)
    if not quiet:
        console().print(render(done.summary))
        tell_files([out, *files])
        tell_next(f"nmm plot {in_shell(out)}", f"nmm export {in_shell(out)} for ParaView")
    if code := status_code(done.summary.status):
        raise typer.Exit(code)


def _shown(scene: "Scene", done: "Run", out: Path, pictures: bool) -> list[Path]:
    """Draw and export what was asked for: both cost more than a small run itself."""
    import nmm

    asked, files = scene.output, []
    if pictures or (asked is not None and asked.pictures):
        # Drawn from the folder, as `nmm plot` does, which knows the covers too.
        files += draw(nmm.read_run(out), out, scene)
    if asked is not None and asked.paraview:
        files += paraview_files(done, out)
    return files


def _free(path: Path) -> Path:
    """Return the path, with a number behind it when there is something of that name."""
    number, free = 1, path
    while free.exists():
        number += 1
        free = path.with_name(f"{path.name}-{number}")
    return free
