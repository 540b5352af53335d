"""The verbs of the command line. What they need is imported inside them, so that help is fast."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

from nmm import verification_verbs
from nmm.study_verbs import register, tell_cost
from nmm.terminal import (
    FAILED,
    console,
    faults_told,
    progress_bar,
    tell_faults,
    tell_files,
    tell_next,
    tell_run,
)

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.results.sink import RunData
    from nmm.scene import Scene

app = typer.Typer(
    help="Numerical manifold method in 2D: blocks, joints, contact and fracture.",
    no_args_is_help=True,
    add_completion=False,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)

SceneFile = Annotated[Path, typer.Argument(help="Scene file, TOML.", metavar="SCENE")]
FormulationFile = Annotated[
    Path | None, typer.Option("--formulation", "-f", help="Formulation file, TOML.")
]
Out = Annotated[Path | None, typer.Option("--out", "-o", help="Folder of the run.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print the verdict only.")]

Read = TypeVar("Read")

DEMO = "kitoh_beam/kitoh_130.toml"
RUNS = Path("runs")

CALLED_BY = {
    "loads": "[[loads]]",
    "body loads": '[[loads]] of kind "body"',
    "supports": "[[supports]]",
    "seams": "bonded interface without contact",
    "initial velocity": "[[initial_velocities]]",
    "initial stress": "[[initial_stresses]]",
}
"""How a scene names an effect, where that is not `[effect]`."""


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
    """Run a scene; write its folder with pictures and ParaView files."""
    with faults_told():
        _run(scene, formulation, out or _free(RUNS / scene.stem), quiet, steps)


@app.command()
def demo(out: Out = None, quiet: Quiet = False) -> None:
    """Break a concrete beam in four-point bending and draw it."""
    from nmm.shipped import example

    with faults_told():
        _run(example(DEMO), None, out or RUNS / "demo", quiet)


@app.command()
def check(scene: SceneFile, formulation: FormulationFile = None) -> None:
    """Name every fault of the files; exit code 1 if there is one."""
    faults = _faults(scene, formulation)
    tell_faults(faults)
    if faults:
        typer.echo(f"{len(faults)} fault{'s' * (len(faults) > 1)}", err=True)
        raise typer.Exit(1)
    typer.secho("no faults", fg="green")
    tell_next(f"nmm explain {scene}", f"nmm run {scene}")


@app.command()
def explain(
    scene: SceneFile,
    formulation: FormulationFile = None,
    cost: Annotated[bool, typer.Option("--cost", help="Also seconds and memory.")] = False,
) -> None:
    """Say what a scene simulates and what it does not, and how large it is."""
    with faults_told():
        _explain(scene, formulation, cost)


@app.command()
def new(
    name: Annotated[str, typer.Argument(help="Name of the scene; NAME.toml is written.")],
) -> None:
    """Write a commented scene to start from."""
    from nmm.errors import NmmError
    from nmm.shipped import starter

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    with faults_told():
        if path.stem in ("", ".", "..", ".toml"):
            raise NmmError(f"name: {name!r}: expected the name of a file: nmm new slope")
        if path.exists():
            raise NmmError(f"{path}: exists: expected a new name: choose another one")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(starter(), encoding="utf-8")
    typer.echo(path)
    tell_next(f"nmm check {path}", f"nmm run {path}")


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


register(app)
verification_verbs.register(app)


def _run(
    place: Path, formulation: Path | None, out: Path, quiet: bool, steps: bool = False
) -> None:
    import nmm
    from nmm.results.summary import render

    _import_beside(place)
    scene = nmm.read_scene(place)
    chosen = _read_formulation(formulation)
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


def _explain(place: Path, formulation: Path | None, cost: bool) -> None:
    from rich.markup import escape
    from rich.table import Table

    import nmm
    from nmm.formulation import Formulation
    from nmm.stepping.plan import called_for
    from nmm.stepping.simulation import prepare

    _import_beside(place)
    scene = nmm.read_scene(place)
    chosen = _read_formulation(formulation) or scene.formulation or Formulation()
    prepared = prepare(scene, chosen)
    manifold = prepared.stepper.model.manifold
    effects = Table(title=scene.title, title_justify="left", show_header=False)
    for name, named in called_for(scene).items():
        key = CALLED_BY.get(name, f"[{name}]")
        effects.add_row(
            name,
            "simulated" if named else f"not simulated: the scene has no {escape(key)}",
            style=None if named else "dim",
        )
    out = console()
    out.print(effects)
    for line in _sizes(scene, chosen, len(prepared.regions), len(manifold.elements)):
        out.print(line, highlight=False)
    for effect in prepared.stepper.plan.effects.values():
        if effect.about:
            out.print(f"{effect.name}: {effect.about}", highlight=False)
    out.print(f"unknowns: {manifold.n_unknowns:,}", highlight=False)
    if cost:
        tell_cost(prepared)
    tell_next(f"nmm run {place}")


def _sizes(scene: "Scene", chosen: "Formulation", blocks: int, elements: int) -> Iterator[str]:
    """Yield the lines that say what kind of run it is."""
    dynamic = scene.inertia is not None
    yield f"run: {'dynamic' if dynamic else 'static'}, plane {scene.plane}"
    if dynamic:
        yield f"integrator: {chosen.integrator.type}, step {chosen.integrator.step:g} s"
        yield f"duration: {scene.duration:g} s"
    elif scene.loading is not None:
        yield f"loading: until {scene.loading.until}, increment {chosen.loading.increment:g}"
    if scene.contact is not None:
        yield f"contact: {chosen.contact.enforcement}"
    yield f"cover: {chosen.cover.type}, {chosen.cover.functions}"
    yield f"blocks: {blocks:,}"
    yield f"elements: {elements:,}"


def _faults(place: Path, formulation: Path | None) -> list[str]:
    """Lines about keys and values of both files, then about blocks and parts that they name."""
    import nmm
    from nmm.errors import NmmError
    from nmm.formulation import Formulation
    from nmm.geometry import regions
    from nmm.stepping.parts import check_parts

    faults: list[str] = []

    def tried(read: Callable[..., Read], *given: object) -> Read | None:
        try:
            return read(*given)
        except NmmError as error:
            faults.extend(str(fault) for fault in error.faults)
            return None

    _import_beside(place)
    scene = tried(nmm.read_scene, place)
    chosen = tried(_read_formulation, formulation)
    if scene is not None:
        tried(regions, scene)
    if scene is not None and not (formulation and chosen is None):
        tried(check_parts, scene, chosen or scene.formulation or Formulation())
    return faults


def _read_formulation(place: Path | None) -> "Formulation | None":
    if place is None:
        return None
    import nmm

    return nmm.read_formulation(place)


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


def _import_beside(scene: Path) -> None:
    """Let a scene name parts of modules in its own folder, behind all that is installed."""
    sys.path.append(str(scene.resolve().parent))


def _free(path: Path) -> Path:
    """Return the path, with a number behind it when there is something of that name."""
    number, free = 1, path
    while free.exists():
        number += 1
        free = path.with_name(f"{path.name}-{number}")
    return free
