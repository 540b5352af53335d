"""What verbs of studies are given alike: scenes, formulations, where to write."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nmm.formulation import Formulation

SceneFile = Annotated[Path, typer.Argument(help="Scene file, TOML.", metavar="SCENE")]

Formulations = Annotated[
    list[Path] | None, typer.Argument(help="Formulation files, TOML.", metavar="FORMULATION")
]

FirstFormulations = Annotated[
    list[Path] | None,
    typer.Option("--formulations", "-f", help="Formulation files; more may follow without it."),
]

Out = Annotated[Path | None, typer.Option("--out", "-o", help="Folder to write to.")]

Memory = Annotated[bool, typer.Option(help="Measure memory, in processes of their own.")]

Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print the outcome only.")]


def one_thread_only() -> None:
    """Measure on one thread, as all costs are told."""
    from nmm.study.cases.threads import one_thread

    one_thread()


def formulations_of(scene: Path, paths: list[Path]) -> "dict[str, Formulation]":
    """Return the formulations of files by name; without any the scene's own."""
    import nmm
    from nmm.formulation import Formulation
    from nmm.study.cases.variants import read_formulations

    if paths:
        return read_formulations(paths)
    own = nmm.read_scene(scene).formulation or Formulation()
    return {own.title or "the scene's own": own}
