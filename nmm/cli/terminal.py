"""What the command line prints: verdicts, faults, files, progress."""

import shlex
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from nmm.errors import NmmError, NmmWarning

if TYPE_CHECKING:
    from rich.console import Console

    from nmm.progress import Progress
    from nmm.scene import Scene
    from nmm.stepping.run import Run


# Colours of the ends of runs; others are red.
STYLES = {"converged": "green", "failure_load": "green", "budget_spent": "yellow"}


@contextmanager
def faults_told() -> Iterator[None]:
    """Print the faults of an error one a line and leave with exit code 1.

    So is a file or folder that cannot be read or written. Warnings of nmm are printed one a line.
    A reader of the output that has had enough (`nmm parts | head`) is no fault: typer ends quietly.
    """
    try:
        with _warnings_told():
            yield
    except NmmError as error:
        tell_faults([str(fault) for fault in error.faults])
        raise typer.Exit(1) from None
    except BrokenPipeError:
        raise
    except OSError as error:
        if error.errno is None:
            raise
        place = "a file" if error.filename is None else error.filename
        expected = "a place that can be read and written: choose another one, or free it"
        tell_faults([f"{place}: {error.strerror}: expected {expected}"])
        raise typer.Exit(1) from None


@contextmanager
def _warnings_told() -> Iterator[None]:
    """Print warnings of nmm as sentences; those of others stay as they are."""
    with warnings.catch_warnings():
        others = warnings.showwarning

        def show(message: Warning | str, category: type[Warning], *rest: Any, **more: Any) -> None:
            if issubclass(category, NmmWarning):
                typer.secho(f"warning: {message}", fg="yellow", err=True)
            else:
                others(message, category, *rest, **more)

        warnings.showwarning = show
        warnings.simplefilter("always", NmmWarning)
        yield


def tell_faults(faults: Sequence[str]) -> None:
    """Print faults to the error stream, one a line."""
    for fault in faults:
        typer.secho(fault, fg="red", err=True)


def tell_run(scene: "Scene", done: "Run") -> None:
    """Print verdict, failure load and comparison with the references of the scene."""
    from nmm.results.references import compare
    from nmm.results.summary_lines import failure_line

    out = console()
    style = STYLES.get(done.summary.status, "red")
    # Sentences name tables such as [contact], which are no markup.
    out.print(done.summary.sentence, style=style, highlight=False, markup=False)
    if (line := failure_line(done.summary)) is not None:
        out.print(line, style="bold", highlight=False, markup=False)
    for change in done.summary.changes:
        out.print(change, highlight=False, markup=False)
    for warning in done.summary.warnings:
        out.print(f"warning: {warning}", style="yellow", highlight=False, markup=False)
    for one in compare(done.summary, done.history, scene.references):
        found = "not found" if one.found is None else f"{one.found:.6g}"
        verdict = "within" if one.holds else "outside"
        out.print(
            f"{one.quantity} {found}, reference {one.expected:.6g} ({100 * one.deviation:+.2f} %, "
            f"{verdict} the tolerance of {100 * one.tolerance:g} %): {one.source}",
            style=None if one.holds else "yellow",
            highlight=False,
            markup=False,
        )


def tell_files(files: Sequence[Path]) -> None:
    """Print every path written, one a line."""
    for file in files:
        typer.echo(file)


def in_shell(place: Path) -> str:
    """Return a path as a shell reads it: names with blanks are quoted."""
    return shlex.quote(str(place))


def tell_next(*commands: str) -> None:
    """Print what to try next."""
    typer.secho("next: " + "   or: ".join(commands), dim=True)


@contextmanager
def progress_bar(quiet: bool, steps: bool = False) -> "Iterator[Progress]":
    """Show a progress bar while the run goes, unless quiet or not in a terminal.

    With ``steps`` print a line after each step instead.
    """
    out = console()
    if steps:
        yield lambda fraction, text: typer.echo(f"{100 * fraction:5.1f} %  {text}")
        return
    if quiet or not out.is_terminal:
        yield lambda fraction, text: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    share, words = TextColumn("{task.percentage:3.0f} %"), TextColumn("{task.description}")
    columns = (BarColumn(), share, TimeElapsedColumn(), words)
    with Progress(*columns, console=out, transient=True) as bar:
        task = bar.add_task("preparing", total=1.0)
        yield lambda fraction, text: bar.update(task, completed=fraction, description=text)


def console() -> "Console":
    """Return the console; long lines are left to the terminal, so that paths can be copied."""
    from rich.console import Console

    return Console(soft_wrap=True, emoji=False)  # names have colons: monitor:top:ux
