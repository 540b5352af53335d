"""The verbs of studies: compare, ablate, study. What they need they import."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.cli.cost_verbs import calibrate, cost
from nmm.cli.scene_verbs import AllowCode, allowed
from nmm.cli.study_arguments import (
    Formulations,
    Memory,
    Out,
    Quiet,
    SceneFile,
    formulations_of,
    one_thread_only,
)
from nmm.cli.terminal import faults_told, in_shell, progress_bar, tell_files

if TYPE_CHECKING:
    from nmm.scene import Scene
    from nmm.study.cases.variants import StudyCase


def compare(
    scene: SceneFile,
    formulations: Formulations = None,
    beside: Annotated[
        list[Path] | None,
        typer.Option(
            "--beside", "-b", help="Another scene of the same case, with its own formulation."
        ),
    ] = None,
    memory: Memory = True,
    out: Out = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Draw a scene under several formulations, or scenes of one case, side by side with a table.

    Exit code 1 when one of them could not be run, else that of the first run that did not end well.
    """
    with faults_told(), allowed(scene, allow_code):
        one_thread_only()
        from nmm.study.comparison.page import comparison_page, write_comparison
        from nmm.study.comparison.runs import compare_cases, exit_code

        with progress_bar(quiet) as progress:
            cases = _compared_cases(scene, formulations or [], beside or [])
            study = compare_cases(cases, memory, progress)
        files = write_comparison(study, out or Path("runs") / f"{scene.stem}-compare")
        if not quiet:
            for line in comparison_page(study, "").splitlines():
                if line.startswith(("|", "- ")):
                    typer.echo(line)
        tell_files(files)
    if code := exit_code(study):
        raise typer.Exit(code)


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
    change, and which share of the seconds is saved; lines below it what matters and what takes
    long, most first.

    It takes as many runs as lines; short ones are made once more, for what the first compiles.
    """
    with faults_told(), allowed(scene, allow_code):
        one_thread_only()
        import nmm
        from nmm.results.storage.writing import told, write_text
        from nmm.study.ablation.ablate import ablate as run_without
        from nmm.study.ablation.page import (
            ablation_costs,
            ablation_rounding,
            ablation_table,
            ablation_verdict,
        )

        ((_, method),) = formulations_of(scene, [formulation] if formulation else []).items()
        with progress_bar(quiet) as progress:
            found = run_without(nmm.read_scene(scene), method, quantity or (), repeats, progress)
        said = filter(
            None, (ablation_verdict(found), ablation_costs(found), ablation_rounding(found))
        )
        lines = [*ablation_table(found), "", *said]
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
        one_thread_only()
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
            typer.secho(
                f"stopped; the same command continues it: nmm study {in_shell(plan)}", err=True
            )
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


VERBS = (cost, compare, ablate, study, calibrate)


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in VERBS:
        app.command()(verb)


def _compared_cases(scene: Path, formulations: list[Path], beside: list[Path]) -> "list[StudyCase]":
    """Return a scene under formulations, and others of its case under their own."""
    import nmm
    from nmm.formulation import Formulation
    from nmm.study.cases.variants import StudyCase

    first = nmm.read_scene(scene)
    if beside and not formulations:
        named = {_scene_name(first, scene): first.formulation or Formulation()}
    else:
        named = formulations_of(scene, formulations)
    cases = [StudyCase(name, first, one) for name, one in named.items()]
    for path in beside:  # a handful of scenes
        other = nmm.read_scene(path)
        name = _scene_name(other, path)
        cases.append(StudyCase(name, other, other.formulation or Formulation()))
    return cases


def _scene_name(scene: "Scene", path: Path) -> str:
    own = scene.formulation
    return own.title if own is not None and own.title else scene.title or path.stem
