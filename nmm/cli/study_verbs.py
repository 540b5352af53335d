"""The verbs of studies: cost, compare, ablate, study, calibrate. What they need they import."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.cli.scene_verbs import AllowCode, allowed
from nmm.cli.terminal import console, faults_told, progress_bar, tell_files

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.study.cases.variants import StudyCase

SceneFile = Annotated[Path, typer.Argument(help="Scene file, TOML.", metavar="SCENE")]
Formulations = Annotated[
    list[Path] | None, typer.Argument(help="Formulation files, TOML.", metavar="FORMULATION")
]
FirstFormulations = Annotated[
    list[Path] | None,
    typer.Option("--formulations", "-f", help="Formulation files; more may follow without it."),
]
Out = Annotated[Path | None, typer.Option("--out", "-o", help="Folder to write to.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print the outcome only.")]


def cost(
    scene: SceneFile,
    more: Formulations = None,
    formulations: FirstFormulations = None,
    sizes: Annotated[
        str | None, typer.Option(help="Sizes of covers in m, with commas: 0.2,0.1,0.05.")
    ] = None,
    vary: Annotated[
        list[str] | None,
        typer.Option(help="key=v1,v2,...: formulation.integrator.step=2e-3,1e-3; repeatable."),
    ] = None,
    yardstick: Annotated[
        str | None,
        typer.Option(help="Also finite elements of scikit-fem, with commas: P1,P2,P3."),
    ] = None,
    quantity: Annotated[
        str | None, typer.Option(help="What error is taken of; else the scene's first reference.")
    ] = None,
    exponent: Annotated[
        float | None,
        typer.Option(
            min=0, help="Of the strongest singularity, 0.5 at crack tips: for theory's orders."
        ),
    ] = None,
    repeats: Annotated[int, typer.Option(min=1, help="Counted repeats of each run.")] = 3,
    memory: Annotated[bool, typer.Option(help="Measure memory, in processes of their own.")] = True,
    out: Out = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Show what accuracy costs: error against seconds over formulations and sizes."""
    with faults_told(), allowed(scene, allow_code):
        _one_thread()
        import nmm
        from nmm.study.cases.variants import SIZE
        from nmm.study.cost.cost_study import cost_study, yardsticks
        from nmm.study.cost.levels import levels
        from nmm.study.cost.report import write_cost_report

        said = ([f"{SIZE}={sizes}"] if sizes else []) + (vary or [])
        with progress_bar(quiet) as progress:
            study = cost_study(
                nmm.read_scene(scene),
                _formulations(scene, [*(formulations or []), *(more or [])])
                | yardsticks(_listed(yardstick)),
                dict(_varied(text) for text in said),
                quantity,
                repeats,
                progress,
                memory,
                exponent,
            )
        files = write_cost_report(study, out or Path("runs") / f"{scene.stem}-cost")
        lost = sum(not one.valid for one in study.records)
        console().print(
            f"{len(study.records)} cases, {lost} failed; reference of {study.reference.quantity} "
            f"{study.reference.value:.6g}: {study.reference.source}",
            highlight=False,
        )
        for line in levels(study):
            console().print(line, highlight=False)
        tell_files(files)


def compare(
    scene: SceneFile,
    formulations: Formulations = None,
    beside: Annotated[
        list[Path] | None,
        typer.Option(
            "--beside", "-b", help="Another scene of the same case, with its own formulation."
        ),
    ] = None,
    memory: Annotated[bool, typer.Option(help="Measure memory, in processes of their own.")] = True,
    out: Out = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Draw a scene under several formulations, or scenes of one case, side by side with a table."""
    with faults_told(), allowed(scene, allow_code):
        _one_thread()
        from nmm.study.comparison.page import comparison_page, write_comparison
        from nmm.study.comparison.runs import compare_cases

        with progress_bar(quiet) as progress:
            cases = _compared_cases(scene, formulations or [], beside or [])
            study = compare_cases(cases, memory, progress)
        files = write_comparison(study, out or Path("runs") / f"{scene.stem}-compare")
        if not quiet:
            for line in comparison_page(study, "").splitlines():
                if line.startswith(("|", "- ")):
                    typer.echo(line)
        tell_files(files)


def ablate(
    scene: SceneFile,
    formulation: Annotated[
        Path | None, typer.Argument(help="Formulation file, TOML.", metavar="FORMULATION")
    ] = None,
    quantity: Annotated[
        list[str] | None,
        typer.Option(help="What is compared, repeatable; else the scene's references or monitors."),
    ] = None,
    repeats: Annotated[int, typer.Option(min=1, help="Counted repeats of each run.")] = 1,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="File of the table, .md.")] = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Show which effects matter: the scene without each of them in turn.

    Each effect that the scene calls for is left out in a run of its own, and so are damping, finite
    rotation, inertia and friction. The table says by which share of their size the quantities
    change, and which share of the seconds is saved; a line below it what matters, most first.

    It takes as many runs as lines; short ones are made once more, for what the first compiles.
    """
    with faults_told(), allowed(scene, allow_code):
        _one_thread()
        import nmm
        from nmm.results.storage.writing import told, write_text
        from nmm.study.ablation.ablate import ablate as run_without
        from nmm.study.ablation.page import ablation_table, ablation_verdict

        ((_, method),) = _formulations(scene, [formulation] if formulation else []).items()
        with progress_bar(quiet) as progress:
            found = run_without(nmm.read_scene(scene), method, quantity or (), repeats, progress)
        lines = [*ablation_table(found), "", ablation_verdict(found)]
        for line in lines:
            typer.echo(line)
        if out is not None:
            with told(out):
                out.parent.mkdir(parents=True, exist_ok=True)
                write_text(out, "\n".join([*lines, ""]))
            tell_files([out])


def study(
    plan: Annotated[Path, typer.Argument(help="Study file, TOML.", metavar="STUDY")],
    scheduler: Annotated[
        str | None, typer.Option(help="Address of a dask.distributed scheduler.")
    ] = None,
    processes: Annotated[
        int | None, typer.Option("--processes", "-n", min=1, help="Processes; one a core.")
    ] = None,
    again: Annotated[bool, typer.Option(help="Run cases again that failed before.")] = False,
    out: Out = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Run a sweep or an ensemble; what is done already is skipped.

    Exit code 2 when all cases failed.
    """
    with faults_told(), allowed(plan, allow_code):
        _one_thread()
        from nmm.study.sweep.report import sweep_page, write_sweep
        from nmm.study.sweep.runs import run_study
        from nmm.study.sweep.study_file import read_plan

        read, cases = read_plan(plan)
        folder = out or Path("runs") / plan.stem
        try:
            with progress_bar(quiet) as progress:
                done = run_study(
                    read,
                    cases,
                    folder,
                    scheduler=scheduler,
                    processes=processes,
                    again=again,
                    tell=lambda number, total, one: progress(
                        number / total, f"{number}/{total} {one.label}: {one.status}"
                    ),
                )
        except KeyboardInterrupt:
            typer.secho(f"stopped; the same command continues it: nmm study {plan}", err=True)
            raise typer.Exit(130) from None
        files = write_sweep(done, folder)
        failed = sum(not one.valid for one in done.records)
        count = len(done.records)
        plural = "s" * (count != 1)
        typer.echo(f"{count} case{plural}, {done.skipped} done before, {failed} failed")
        if not quiet:
            for line in sweep_page(done).splitlines():
                if line.startswith(("|", "- ")):
                    typer.echo(line)
        tell_files(files)
    if failed == count:
        raise typer.Exit(2)


def calibrate(
    check: Annotated[
        bool, typer.Option(help="Then predict scenes five times larger and run them.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Fit the model of what runs cost on this machine, for `nmm explain --cost`."""
    with faults_told():
        _one_thread()
        from nmm.study.cost import calibrate as work
        from nmm.study.cost.cost_model import factor, save_model

        with progress_bar(quiet) as progress:
            model = work.calibrate(progress)
        typer.echo(save_model(model))
        typer.echo(
            f"fitted up to {max(model.largest.values()):,} unknowns; farthest off by a factor of "
            f"{model.spread_seconds:.2f} in seconds, {model.spread_memory:.2f} in memory"
        )
        for one in work.measured(work.CHECKED) if check else ():
            spent, said = one.preparing + one.running, model.seconds(one.size)
            held, told = float(one.memory or 0), model.bytes(one.size)
            typer.echo(
                f"{one.name}, {one.size.unknowns:,} unknowns: predicted {said:.3g} s, measured "
                f"{spent:.3g} s, factor {factor(said, spent):.2f}; predicted {told / 2**20:.0f} "
                f"MiB, measured {held / 2**20:.0f} MiB, factor {factor(told, held):.2f}"
            )


VERBS = (cost, compare, ablate, study, calibrate)


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in VERBS:
        app.command()(verb)


def _one_thread() -> None:
    from nmm.study.cases.threads import one_thread

    one_thread()


def _formulations(scene: Path, paths: list[Path]) -> "dict[str, Formulation]":
    import nmm
    from nmm.formulation import Formulation
    from nmm.study.cases.variants import read_formulations

    if paths:
        return read_formulations(paths)
    own = nmm.read_scene(scene).formulation or Formulation()
    return {own.title or "the scene's own": own}


def _compared_cases(scene: Path, formulations: list[Path], beside: list[Path]) -> "list[StudyCase]":
    """Return a scene under formulations, and others of its case under their own."""
    import nmm
    from nmm.formulation import Formulation
    from nmm.study.cases.variants import StudyCase

    first = nmm.read_scene(scene)
    if beside and not formulations:
        named = {_scene_name(first, scene): first.formulation or Formulation()}
    else:
        named = _formulations(scene, formulations)
    cases = [StudyCase(name, first, one) for name, one in named.items()]
    for path in beside:  # a handful of scenes
        other = nmm.read_scene(path)
        name = _scene_name(other, path)
        cases.append(StudyCase(name, other, other.formulation or Formulation()))
    return cases


def _scene_name(scene: "Scene", path: Path) -> str:
    own = scene.formulation
    return own.title if own is not None and own.title else scene.title or path.stem


def _listed(text: str | None) -> list[str]:
    return [name.strip() for name in (text or "").split(",") if name.strip()]


def _varied(text: str) -> tuple[str, list[object]]:
    from nmm.errors import NmmError
    from nmm.study.cases.variants import value_of

    key, equals, values = text.partition("=")
    if not equals or not values:
        raise NmmError(f"--vary {text}: expected key=value,value: write it so")
    return key.strip(), [value_of(item.strip()) for item in values.split(",")]
