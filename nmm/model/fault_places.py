"""Faults found while a run is prepared, told with the line of the table that they are about."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING

from nmm.errors import Fault, NmmError

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene

TABLE = re.compile(r"\[+([\w.]+)\]+")


@contextmanager
def placed(scene: "Scene", formulation: "Formulation") -> Iterator[None]:
    """Put file and line before faults that name a table, such as ``[cover] size: ...``, at most."""
    try:
        yield
    except NmmError as error:
        told = [_placed(fault, scene, formulation) for fault in error.faults]
        if told == list(error.faults):
            raise
        error.faults = tuple(told)
        error.args = ("\n".join(str(fault) for fault in told),)
        raise


@contextmanager
def of_stage(name: str) -> Iterator[None]:
    """Say of faults in which stage they are: what they are about is there in others."""
    try:
        yield
    except NmmError as error:
        error.faults = tuple(
            replace(fault, value=f'{fault.value} in stage "{name}"')
            if isinstance(fault, Fault)
            else f'{fault} (stage "{name}")'
            for fault in error.faults
        )
        error.args = ("\n".join(str(fault) for fault in error.faults),)
        raise


def _placed(fault: Fault | str, scene: "Scene", formulation: "Formulation") -> Fault | str:
    text = str(fault)
    usual = not formulation.model_fields_set  # what does not go with it stands in the scene
    if usual:
        text = text.removeprefix(f"{formulation.source.name}: ")
    elif text.startswith(formulation.source.name):
        return fault
    if text.startswith(scene.source.name):
        return fault
    match = TABLE.match(text)
    path = match[1].split(".") if match is not None else []
    method = bool(path) and path[0] in type(formulation).model_fields and not _of_scene(path[0])
    source = formulation.source if method and not usual else scene.source
    if not source.text:  # made by a program
        return fault
    where = source.place(*path) if path and source.line(*path) else source.name
    return f"{where}: {text}"


def _of_scene(table: str) -> bool:
    """Tables that both files have are named for the scene, but for the supports' method."""
    return table in ("contact", "loading")
