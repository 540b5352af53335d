"""The verbs of files before a run: check, explain, new. What they need they import."""

from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

from nmm.cli.terminal import console, faults_told, in_shell, tell_faults, tell_next

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene

SceneFile = Annotated[Path, typer.Argument(help="Scene file, TOML.", metavar="SCENE")]
FormulationFile = Annotated[
    Path | None,
    typer.Option("--formulation", "-f", help="Formulation file, TOML; else the scene's own."),
]
AllowCode = Annotated[
    list[str] | None,
    typer.Option(
        "--allow-code",
        metavar="MODULE",
        help="Let parts named MODULE:Class run, code beside the scene or installed; repeatable.",
    ),
]
Read = TypeVar("Read")


def check(
    scene: SceneFile, formulation: FormulationFile = None, allow_code: AllowCode = None
) -> None:
    """Name every fault of the files, and what a run would refuse; exit code 1 if there is one."""
    with faults_told(), allowed(scene, allow_code):
        faults = _faults(scene, formulation)
    tell_faults(faults)
    if faults:
        typer.echo(f"{len(faults)} fault{'s' * (len(faults) > 1)}", err=True)
        raise typer.Exit(1)
    typer.secho("no faults", fg="green")
    tell_next(f"nmm explain {in_shell(scene)}", f"nmm run {in_shell(scene)}")


def explain(
    scene: SceneFile,
    formulation: FormulationFile = None,
    cost: Annotated[bool, typer.Option("--cost", help="Also seconds and memory.")] = False,
    allow_code: AllowCode = None,
) -> None:
    """Say what a scene simulates and what it does not, and how large it is."""
    from nmm.cli.explaining import told

    with faults_told(), allowed(scene, allow_code):
        told(scene, read_formulation(formulation), cost)


def new(
    name: Annotated[
        str, typer.Argument(help="Name of the scene; NAME.toml is written.", metavar="NAME")
    ],
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
    tell_next(f"nmm check {in_shell(path)}", f"nmm run {in_shell(path)}")


def bound(
    scene: SceneFile, formulation: FormulationFile = None, allow_code: AllowCode = None
) -> None:
    """Print the load factor that nothing as drawn can pass: the static theorem."""
    with faults_told(), allowed(scene, allow_code):
        _bound(scene, formulation)


def parts(
    words: Annotated[
        list[str] | None, typer.Argument(help="Words that a line must have.", metavar="WORD")
    ] = None,
    allow_code: AllowCode = None,
) -> None:
    """List the parts that can be exchanged: covers, laws, solvers, effects, outputs and others."""
    with faults_told(), allowed(Path("scene"), allow_code):
        _parts(words or [], allow_code or [])


def _parts(words: list[str], modules: list[str]) -> None:
    from nmm.catalogue import parts as listed
    from nmm.errors import NmmError, printable

    try:
        found = listed(modules)
    except Exception as fault:  # the code of a module may raise anything
        why = f"{type(fault).__name__}: {fault}"
        raise NmmError(f"--allow-code: {why}: expected a module beside you or installed") from fault
    kept = [one for one in found if all(word.lower() in str(one).lower() for word in words)]
    if not kept:
        said = " ".join(words)
        raise NmmError(f"{said}: no part has these words: expected words of a part: leave some out")
    columns = [(one.kind, one.name, one.origin, one.module) for one in kept]
    widths = [max(map(len, column)) for column in zip(*columns, strict=True)]
    for cells, one in zip(columns, kept, strict=True):
        aligned = "  ".join(map(str.ljust, cells, widths))
        typer.echo(printable(f"{aligned}  {one.says}".rstrip()))


VERBS = (new, check, explain, bound, parts)


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in VERBS:
        app.command()(verb)


def read_formulation(place: Path | None) -> "Formulation | None":
    """Read the formulation of a file, where one is named."""
    if place is None:
        return None
    import nmm

    return nmm.read_formulation(place)


def allowed(scene: Path, modules: list[str] | None) -> AbstractContextManager[None]:
    """Let parts of the modules that the user names be imported, from the scene's folder too."""
    from nmm.trust import allowing

    return allowing(*(modules or ()), folder=scene.resolve().parent if modules else None)


def _bound(place: Path, formulation: Path | None) -> None:
    import nmm
    from nmm.errors import SceneError
    from nmm.formulation import Formulation
    from nmm.stepping.bounds.static_theorem import load_bound
    from nmm.stepping.prepare import prepare
    from nmm.stepping.step.anchors import block_name, largest_mover

    scene = nmm.read_scene(place)
    if scene.contact is None or scene.loading is None:
        missing = "[contact]" if scene.contact is None else "[loading]"
        raise SceneError(
            f"{place}: {missing} is missing: expected blocks in contact under a load that grows: "
            f"add {missing}, with the loads that it scales"
        )
    made = prepare(scene, read_formulation(formulation) or scene.formulation or Formulation())
    found = load_bound(made.stepper, made.start)
    out = console()
    if found is None:
        text = (
            "no bound: no body moves by contacts alone, nothing loads one, or members hold some "
            "with limits of their own"
        )
    elif found.factor is None:
        text = (
            "no equilibrium: contacts, bonds and members do not carry the loads that are not scaled"
        )
    elif not found.motion.any():
        text = "no bound: contacts, bonds and members carry any load factor"
    else:
        load = made.stepper.plan.scaled_load(found.factor)
        newton = "" if load is None else f", {load:.6g} N"
        body, how = largest_mover(made.stepper.model, made.start, found.motion)
        name = block_name(made.stepper.model, body, made.regions.name)
        text = (
            f"no equilibrium above load factor {found.factor:.6g}{newton}, as drawn\n"
            f"mechanism: block {name} moves most: {how} (friction that dilates)"
        )
    out.print(text, highlight=False, markup=False)
    tell_next(f"nmm run {in_shell(place)}")


def _faults(place: Path, formulation: Path | None) -> list[str]:
    """Lines about keys and values of both files, then about blocks and parts that they name."""
    import nmm
    from nmm.errors import NmmError
    from nmm.formulation import Formulation
    from nmm.geometry import regions
    from nmm.model.consistency import check_together
    from nmm.model.parts import check_parts

    faults: list[str] = []

    def tried(read: Callable[..., Read], *given: object) -> Read | None:
        try:
            return read(*given)
        except NmmError as error:
            faults.extend(str(fault) for fault in error.faults)
            return None

    scene = tried(nmm.read_scene, place)
    chosen = tried(read_formulation, formulation)
    if scene is not None:
        tried(regions, scene)
    if scene is not None and not (formulation and chosen is None):
        whole = chosen or scene.formulation or Formulation()
        tried(check_together, scene, whole)
        tried(check_parts, scene, whole)
        if not faults:
            tried(_posed, scene, whole)
    return faults


def _posed(scene: "Scene", formulation: "Formulation") -> None:
    """Build all that a run begins with: what it would refuse is refused here."""
    if scene.loading is not None and scene.loading.control is not None:
        from nmm.stepping.prepare import prepare  # a path is followed by what takes the steps

        prepare(scene, formulation)
    else:
        from nmm.stepping.posed import pose

        pose(scene, formulation)
