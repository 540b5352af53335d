"""The verbs of benchmarks: verify and publish. What they need they import."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from nmm.cli.scene_verbs import AllowCode, allowed
from nmm.cli.terminal import console, faults_told, progress_bar, tell_files
from nmm.errors import NmmError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from nmm.verification import Case, Outcome
    from nmm.verification.base import Checks


def verify(
    names: Annotated[
        list[str] | None,
        typer.Argument(
            help="Benchmarks (B2), what their names begin with (A, B1), a class of your own "
            "(module:Class), or published case folders; all when none is named.",
            metavar="NAME",
        ),
    ] = None,
    slow: Annotated[bool, typer.Option(help="Also runs of more than a few seconds.")] = False,
    listed: Annotated[bool, typer.Option("--list", help="Say which there are, and stop.")] = False,
    out: Annotated[
        Path | None, typer.Option("--out", "-o", help="Folder to write the manual's pages to.")
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print what misses only.")] = False,
    hard: Annotated[
        bool, typer.Option("--hard", help="Run the hard matrix: NAME is a class of hard cases.")
    ] = False,
    seeds: Annotated[
        int, typer.Option(min=1, help="With --hard: how many seeds a class, cheap ones more.")
    ] = 1,
    first: Annotated[
        int, typer.Option(min=0, help="With --hard: the first seed, as cases are named by it.")
    ] = 0,
    part: Annotated[
        list[str] | None,
        typer.Option(help="With --hard: a part that cases must have, such as cone; repeatable."),
    ] = None,
    allow_code: AllowCode = None,
) -> None:
    """Run problems whose answers are known from elsewhere; exit code 1 when one is missed.

    Every quantity is printed with its reference, its error and what is allowed.

    Runs of more than a few seconds need --slow, or the benchmark's full name.

    With --hard, generated scenes with oracles that need no answer; --out takes those that miss, a
    file NAME.jsonl records of all, a file NAME.md the page of the manual: also of records, where
    they are the NAMEs.

    Your own: derive a class from nmm.verification.Case, and name it module:Class. Naming it here
    lets its module run; case folders are data, and parts of one's own in them need --allow-code.
    """
    with faults_told(), allowed(Path("here"), allow_code):
        if hard:
            from nmm.cli.hard_verbs import verify_hard

            numbers = range(first, first + seeds)
            verify_hard(names or [], numbers, part or [], slow, listed, out, quiet)
            return
        if listed:
            _list(names or [])
            return
        chosen = list(_chosen(names or [], slow))
        left_out = _left_out(names or [], slow)
        if not chosen:
            raise NmmError(
                f"{' '.join(names or [])}: nothing was run: all {left_out} runs take more than a "
                "few seconds: expected --slow, or a benchmark named in full (nmm verify --list)"
            )
        outcomes = []
        with progress_bar(quiet) as progress:
            for number, (case, formulation) in enumerate(chosen):
                label = ", ".join(filter(None, (case.name, case.variant, formulation)))
                progress(number / len(chosen), f"{number + 1}/{len(chosen)} {label}")
                outcomes.append(_judged(case, formulation, quiet))
        missed = [one for one in outcomes if not one.passed]
        _sum_up(outcomes, missed, left_out)
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
        list[str] | None,
        typer.Option(help="Quantity to publish, repeatable; else those of the scene's references."),
    ] = None,
    tolerance: Annotated[float, typer.Option(min=0, help="Relative tolerance.")] = 1e-6,
    source: Annotated[str, typer.Option(help="Who publishes it, and where.")] = "",
    allow_code: AllowCode = None,
) -> None:
    """Write a case folder that others reproduce by `nmm verify FOLDER`."""
    with faults_told(), allowed(scene, allow_code):
        import nmm
        from nmm.verification.published import publish as write

        read = nmm.read_scene(scene)
        names = quantity or [item.quantity for item in read.references]
        typer.echo(write(scene, formulation, names or ["energy"], tolerance, out, source))


VERBS = (verify, publish)


def _chosen(names: list[str], slow: bool) -> "Iterator[tuple[Case, str]]":
    """Yield benchmarks with their formulations, each once, after names that are case folders."""
    from nmm.verification import runs
    from nmm.verification.published import PublishedCase, is_published

    folders = [name for name in names if is_published(Path(name))]
    for folder in folders:
        case = PublishedCase(Path(folder))
        for remark in case.remarks:
            typer.echo(f"{case.name}: {remark}", err=True)
        yield case, case.formulations[0]
    yield from runs([name for name in names if name not in folders] if names else None, slow)


def _left_out(names: list[str], slow: bool) -> int:
    """Return how many runs are left out for want of --slow."""
    from nmm.verification import runs
    from nmm.verification.published import is_published

    wanted = [name for name in names if not is_published(Path(name))] if names else None
    return len(list(runs(wanted, slow=True))) - len(list(runs(wanted, slow)))


def _list(names: list[str]) -> None:
    """Print names, titles and how many runs there are; with names given, the formulations too."""
    from nmm.verification import CASES
    from nmm.verification.manual import in_order
    from nmm.verification.outcomes import named

    wanted = in_order({found for name in names for found in named(name)} or CASES.table)
    wide = max(map(len, wanted))
    for name in wanted:
        kind = CASES.load_said(name)
        cases = kind.variants()
        runs = sum(len(case.formulations) for case in cases)
        lasting = sum(len(case.formulations) for case in cases if case.slow)
        slow = f", {lasting} of them slow" if lasting else ""
        typer.echo(f"{name:{wide}}  {kind.title} ({runs} run{'s' if runs > 1 else ''}{slow})")
        if names:
            all_of_them = (one for case in cases for one in case.formulations)
            typer.echo(f"{'':{wide}}  {', '.join(dict.fromkeys(all_of_them))}")


def _judged(case: "Case", formulation: str, quiet: bool) -> "Outcome":
    """Run one benchmark and print its quantities as soon as they are there."""
    from nmm.verification import judge

    outcome = judge(case, formulation)
    if not (quiet and outcome.passed):
        _tell(outcome, quiet)
    return outcome


def _tell(outcome: "Outcome", misses_only: bool = False) -> None:
    """Print a run: a line of its own, then one line a quantity."""
    out, verdict = console(), "passed" if outcome.passed else "MISSED"
    out.print(
        f"{outcome.label}: {verdict} ({outcome.seconds:.2g} s)",
        style="green" if outcome.passed else "bold red",
        highlight=False,
        markup=False,
    )
    if outcome.fault:
        out.print(f"  {outcome.fault}", style="red", highlight=False, markup=False)
    checks = {n: one for n, one in outcome.checks.items() if not (misses_only and one.passed)}
    wide = [max(map(len, column), default=0) for column in zip(*_columns(checks), strict=True)]
    for (name, computed, reference), check in zip(_columns(checks), checks.values(), strict=True):
        error = f"error {check.error:.1e} of {check.tolerance:.1e}" if check.tolerance else ""
        out.print(
            f"  {name:{wide[0]}}  {computed:{wide[1]}}  {reference:{wide[2]}}  {error:24}  "
            + ("passed" if check.passed else f"MISSED: {check.reason}"),
            style=None if check.passed else "red",
            highlight=False,
            markup=False,
        )


def _columns(checks: "Checks") -> list[tuple[str, str, str]]:
    """Name, computed value and reference of each quantity in words."""
    return [(name, one.shown, f"reference {one.wanted}") for name, one in checks.items()]


def _sum_up(outcomes: "list[Outcome]", missed: "list[Outcome]", left_out: int) -> None:
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
    told = f"{len(missed)} missed" if missed else "all within tolerance"
    slow = f"; {left_out} more with --slow" if left_out else ""
    out.print(
        f"{len(outcomes)} run{'s' * (len(outcomes) != 1)}, {told}, {seconds:.3g} s{slow}",
        style="red" if missed else "green",
        highlight=False,
    )


def register(app: typer.Typer) -> None:
    """Add the verbs to the command line."""
    for verb in VERBS:
        app.command()(verb)
