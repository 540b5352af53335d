"""The verbs of benchmarks: verify and publish. What they need they import."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.terminal import console, faults_told, progress_bar, tell_files

if TYPE_CHECKING:
    from collections.abc import Iterator

    from nmm.verification import Case, Outcome


def verify(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help="Benchmarks (B2), what their names begin with (A, B1), a class of your own "
            "(module:Class), or published case folders; all when none is named.",
            metavar="[NAME]...",
        ),
    ] = None,
    slow: Annotated[bool, typer.Option(help="Also runs of more than a few seconds.")] = False,
    listed: Annotated[bool, typer.Option("--list", help="Say which there are, and stop.")] = False,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder to write the manual's pages to.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print what misses only.")] = False,
) -> None:
    """Run problems whose answers are known from elsewhere; exit code 1 when one is missed.

    Prints, for every quantity, what was computed, the reference, the error and what is allowed. A
    benchmark is one small class: derive your own from nmm.verification.Case and name it
    module:Class. Runs of more than a few seconds are left out unless --slow is given or their
    benchmark is named in full.
    """
    with faults_told():
        sys.path.append(str(Path.cwd()))
        if listed:
            _list(names or [])
            return
        chosen = list(_chosen(names or [], slow))
        outcomes = []
        with progress_bar(quiet) as progress:
            for number, (case, formulation) in enumerate(chosen):
                label = ", ".join(filter(None, (case.name, case.variant, formulation)))
                progress(number / len(chosen), f"{number + 1}/{len(chosen)} {label}")
                outcomes.append(_judged(case, formulation, quiet))
        missed = [one for one in outcomes if not one.passed]
        _sum_up(outcomes, missed)
        if out is not None:
            from nmm.verification.manual import write_manual

            tell_files(write_manual(outcomes, out))
    if missed:
        raise typer.Exit(1)


def publish(
    scene: Annotated[Path, typer.Argument(help="Scene file, TOML.", metavar="SCENE")],
    out: Annotated[Path, typer.Option("--out", "-o", help="Folder to write, new.")],
    formulation: Annotated[
        Path | None, typer.Option("--formulation", "-f", help="Formulation file, TOML.")
    ] = None,
    quantity: Annotated[
        list[str] | None, typer.Option(help="Quantity to publish; the scene's [[reference]]s.")
    ] = None,
    tolerance: Annotated[float, typer.Option(min=0, help="Relative tolerance.")] = 1e-6,
    source: Annotated[str, typer.Option(help="Who publishes it, and where.")] = "",
) -> None:
    """Write a case folder that others reproduce by `nmm verify FOLDER`."""
    with faults_told():
        import nmm
        from nmm.verification.published import publish as write

        sys.path.append(str(scene.resolve().parent))
        names = quantity or [item.quantity for item in nmm.read_scene(scene).references]
        typer.echo(write(scene, formulation, names or ["energy"], tolerance, out, source))


VERBS = (verify, publish)


def _chosen(names: list[str], slow: bool) -> "Iterator[tuple[Case, str]]":
    """Yield benchmarks with their formulations; a name that is a case folder is that case."""
    from nmm.verification import runs
    from nmm.verification.published import PublishedCase, is_published

    if not names:
        yield from runs(None, slow)
    for name in names:
        if is_published(Path(name)):
            case = PublishedCase(Path(name))
            for remark in case.remarks:
                typer.echo(f"{case.name}: {remark}", err=True)
            yield case, case.formulations[0]
        else:
            yield from runs([name], slow)


def _list(names: list[str]) -> None:
    """Print names, titles and how many runs there are."""
    from rich.table import Table

    from nmm.verification import CASES
    from nmm.verification.manual import in_order
    from nmm.verification.outcomes import named

    table = Table(box=None, pad_edge=False, header_style="dim")
    for head in ("name", "what", "runs", "slow", "formulations"):
        table.add_column(head, overflow="fold")
    wanted = {found for name in names for found in named(name)} if names else set(CASES.table)
    for name in in_order(wanted):
        kind = CASES.load(name)
        cases = kind.variants()
        lasting = sum(len(case.formulations) for case in cases if case.slow)
        table.add_row(
            name,
            kind.title,
            str(sum(len(case.formulations) for case in cases)),
            str(lasting or ""),
            ", ".join(dict.fromkeys(one for case in cases for one in case.formulations)),
        )
    console().print(table)


def _judged(case: "Case", formulation: str, quiet: bool) -> "Outcome":
    """Run one benchmark and print its quantities as soon as they are there."""
    from nmm.verification import judge

    outcome = judge(case, formulation)
    if not (quiet and outcome.passed):
        _tell(outcome, quiet)
    return outcome


def _tell(outcome: "Outcome", misses_only: bool = False) -> None:
    """Print a run: a line of its own, then one line a quantity."""
    from rich.table import Table
    from rich.text import Text

    verdict = "passed" if outcome.passed else "MISSED"
    console().print(
        Text(
            f"{outcome.label}: {verdict} ({outcome.seconds:.2g} s)",
            style="green" if outcome.passed else "bold red",
        )
    )
    if outcome.fault:
        console().print(Text(f"  {outcome.fault}", style="red"))
    table = Table(box=None, show_header=False, pad_edge=False)
    for _ in range(6):
        table.add_column(overflow="fold")
    for name, check in outcome.checks.items():
        if misses_only and check.passed:
            continue
        table.add_row(
            f"  {name}",
            Text(check.shown),
            Text(f"reference {check.wanted}"),
            f"error {check.error:.1e}",
            f"allowed {check.tolerance:.1e}",
            "passed" if check.passed else f"MISSED: {check.reason}",
            style=None if check.passed else "red",
        )
    if table.row_count:
        console().print(table)


def _sum_up(outcomes: "list[Outcome]", missed: "list[Outcome]") -> None:
    """Print how many missed; of many runs, say again which, and where each is written."""
    out = console()
    if missed and len(outcomes) > 1:
        out.print("missed:", style="red")
        for one in missed:
            kind = type(one.case)
            what = one.fault or "; ".join(
                f"{name} {check.shown}, reference {check.wanted}"
                for name, check in one.checks.items()
                if not check.passed
            )
            out.print(f"  {one.label}: {what}", style="red", highlight=False, markup=False)
            out.print(f"    in {kind.__module__}:{kind.__qualname__}", highlight=False)
    seconds = sum(one.seconds for one in outcomes)
    out.print(
        f"{len(outcomes)} runs, {len(missed)} missed, {seconds:.3g} s"
        if missed
        else f"{len(outcomes)} runs, all within tolerance, {seconds:.3g} s",
        style="red" if missed else "green",
        highlight=False,
    )


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in VERBS:
        app.command()(verb)
