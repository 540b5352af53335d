"""`nmm verify --hard`: the hard matrix on the terminal. What it needs is imported when it runs."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from nmm.cli.terminal import console
from nmm.errors import NmmError

if TYPE_CHECKING:
    from nmm.verification.hard.running.running import Finding

REDUCED_BELOW = 5.0
"""Seconds of a case above which it is not made smaller."""


def verify_hard(
    names: list[str],
    seeds: Sequence[int],
    parts: list[str],
    slow: bool,
    listed: bool,
    out: Path | None,
    quiet: bool,
) -> None:
    """Run classes of hard cases, or list them; write the scenes that miss to a folder.

    If ``quiet`` cases that pass are not printed.
    Where ``out`` is a file NAME.jsonl a record of each case is added to it in place of that; where
    it is a file NAME.md it becomes a page of the manual, of files of records if they are named.

    Raises
    ------
    typer.Exit
        With code 1 when a case misses.
    """
    from nmm.verification.hard.running.page import write_page
    from nmm.verification.hard.running.records import SUFFIX, append_record
    from nmm.verification.hard.running.running import chosen_cases, judged

    if listed:
        _list()
        return
    if names and all(name.endswith(SUFFIX) for name in names):
        _tell_records([Path(name) for name in names], out)
        return
    how = " ".join([*names, f"--first {seeds[0]} --seeds {len(seeds)}", *["--slow"] * slow])
    found = []
    for group, case in chosen_cases(names, seeds, slow, parts):
        finding = judged(group, case)
        found.append(finding)
        if not (quiet and finding.passed):
            _tell(finding)
        if out is not None and out.suffix == ".md":
            write_page(found, out, how)  # anew with each, so that a run that is stopped leaves it
        elif out is not None and out.suffix == SUFFIX:
            append_record(finding, out)
        elif out is not None and not finding.passed:
            _keep(finding, out)
    _sum_up(found)


def _sum_up(found: "list[Finding]") -> None:
    if not found:
        raise NmmError(
            "--hard: nothing was run: expected cases that have all of --part and are not slow: "
            "leave a part out, or add --slow"
        )
    missed = [finding for finding in found if not finding.passed]
    seconds = sum(finding.seconds for finding in found)
    console().print(
        f"{len(found)} cases, {len(missed)} missed, {seconds:.3g} s",
        style="red" if missed else "green",
        highlight=False,
    )
    if missed:
        raise typer.Exit(1)


def _tell_records(paths: list[Path], out: Path | None) -> None:
    """Sum up records, or make the page of them: nothing is run."""
    from nmm.verification.hard.running.page import write_page
    from nmm.verification.hard.running.records import read_records

    found = read_records(paths)
    if out is None:
        _sum_up(found)
    else:
        typer.echo(write_page(found, out, "CLASS --out NAME.jsonl"))


def _list() -> None:
    from nmm.verification.hard.running.registry import HARD

    for name in HARD.table:
        kind = HARD.load(name)
        typer.echo(f"{name:12} {kind.title}")
        typer.echo(f"{'':12} {kind.oracle}")


def _tell(finding: "Finding") -> None:
    verdict = "passed" if finding.passed else "MISSED"
    console().print(
        f"{verdict} {finding.seconds:6.2f} s  {finding.group}: {finding.case.label}: "
        f"{finding.words}",
        style=None if finding.passed else "red",
        highlight=False,
        markup=False,
        soft_wrap=True,
    )


def _keep(finding: "Finding", out: Path) -> None:
    """Write the scene of a case that misses, and the smallest one found that does so too."""
    from nmm.verification.hard.cases.files import write_scene
    from nmm.verification.hard.running.running import smallest

    label = f"{finding.group} {finding.case.label}"
    path = write_scene(out, label, finding.case.scene, finding.words)
    if finding.seconds < REDUCED_BELOW:
        small, words = smallest(finding)
        path = write_scene(out, f"{label} reduced", small, words)
    console().print(f"  {path}", highlight=False, markup=False, soft_wrap=True)
