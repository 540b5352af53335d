"""The verbs of what accuracy costs: cost, calibrate. What they need they import."""

from pathlib import Path
from typing import Annotated

import typer

from nmm.cli.scene_verbs import AllowCode, allowed
from nmm.cli.study_arguments import (
    FirstFormulations,
    Formulations,
    Memory,
    Out,
    Quiet,
    SceneFile,
    formulations_of,
    one_thread_only,
)
from nmm.cli.terminal import console, faults_told, progress_bar, tell_files


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
    memory: Memory = True,
    out: Out = None,
    quiet: Quiet = False,
    allow_code: AllowCode = None,
) -> None:
    """Show what accuracy costs: error against seconds over formulations and sizes."""
    with faults_told(), allowed(scene, allow_code):
        one_thread_only()
        import nmm
        from nmm.study.cases.variants import SIZE
        from nmm.study.cost.cost_study import cost_study, yardsticks
        from nmm.study.cost.levels import levels
        from nmm.study.cost.report import write_cost_report

        varied: dict[str, list[object]] = {SIZE: [*_sizes(sizes)]} if sizes else {}
        varied |= dict(_varied(text) for text in vary or [])
        with progress_bar(quiet) as progress:
            study = cost_study(
                nmm.read_scene(scene),
                formulations_of(scene, [*(formulations or []), *(more or [])])
                | yardsticks(_listed(yardstick)),
                varied,
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


def calibrate(
    check: Annotated[
        bool, typer.Option(help="Then predict scenes five times larger and run them.")
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Fit the model of what runs cost on this machine, for `nmm explain --cost`."""
    with faults_told():
        one_thread_only()
        from nmm.study.cost import calibrate as work
        from nmm.study.cost.cost_model import factor
        from nmm.study.cost.stored_model import save_model

        with progress_bar(quiet) as progress:
            model = work.calibrate(progress)
        typer.echo(save_model(model))
        typer.echo(
            f"fitted up to {max(model.largest.values()):,} unknowns; farthest off by a factor of "
            f"{model.spread_seconds:.2f} in seconds, {model.spread_memory:.2f} in memory"
        )
        for one in work.measured(work.CHECKED) if check else ():
            spent, said = one.preparing + one.running, model.seconds(one.size)
            measured, told = float(one.memory or 0), model.bytes(one.size)
            typer.echo(
                f"{one.name}, {one.size.unknowns:,} unknowns: predicted {said:.3g} s, measured "
                f"{spent:.3g} s, factor {factor(said, spent):.2f}; predicted {told / 2**20:.0f} "
                f"MiB, measured {measured / 2**20:.0f} MiB, factor {factor(told, measured):.2f}"
            )


def _listed(text: str | None) -> list[str]:
    return [name.strip() for name in (text or "").split(",") if name.strip()]


def _sizes(text: str) -> list[float]:
    from nmm.errors import NmmError

    try:
        sizes = [float(item) for item in text.split(",")]
    except ValueError:
        sizes = []
    if not sizes or not all(size > 0 for size in sizes):
        raise NmmError(f"--sizes {text}: expected lengths in m, with commas: --sizes 0.2,0.1")
    return sizes


def _varied(text: str) -> tuple[str, list[object]]:
    from nmm.errors import NmmError
    from nmm.study.cases.variants import value_of

    key, equals, values = text.partition("=")
    if not equals or not values:
        raise NmmError(f"--vary {text}: expected key=value,value: write it so")
    return key.strip(), [value_of(item.strip()) for item in values.split(",")]
