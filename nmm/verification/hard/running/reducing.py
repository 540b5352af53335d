"""Smaller scenes that still fail: tables, blocks and keys are dropped while the fault stays."""

from collections.abc import Callable, Iterator
from copy import deepcopy
from time import process_time
from typing import Any

from nmm.verification.hard.cases.base import Document

Path = tuple[str | int, ...]

KEPT = ("plane", "materials", "young_modulus", "poisson_ratio", "vertices", "name", "material")
"""Keys without which a scene is none."""


def reduced(
    scene: Document, still_fails: Callable[[Document], bool], seconds: float = 60.0
) -> Document:
    """Return the smallest scene found that still fails.

    Parameters
    ----------
    scene
        Tables that fail; they are not changed.
    still_fails
        Says whether tables fail in the same way; what raises does not.
    seconds
        Processor time after which no more is tried.
    """
    until, smallest = process_time() + seconds, scene
    changed = True
    while changed:  # each round starts from what the last one left
        changed = False
        for path in list(_droppable(smallest)):
            if process_time() > until:
                return smallest
            tried = _without(smallest, path)
            if tried is not None and _fails(tried, still_fails):
                smallest, changed = tried, True
    return smallest


def _fails(scene: Document, still_fails: Callable[[Document], bool]) -> bool:
    try:
        return still_fails(scene)
    except Exception:  # another fault than the one that is looked for
        return False


def _droppable(table: Any, path: Path = ()) -> Iterator[Path]:
    """Yield the paths of what may be dropped, the largest first, last entries before first."""
    entries = table.items() if isinstance(table, dict) else enumerate(table)
    inner = [(key, value) for key, value in entries if key not in KEPT or isinstance(value, dict)]
    for key, value in reversed(inner):
        tables = isinstance(table, list) and not isinstance(value, dict)
        if key not in KEPT and not tables:
            yield (*path, key)
    for key, value in reversed(inner):
        if isinstance(value, dict) or (isinstance(value, list) and value and _of_tables(value)):
            yield from _droppable(value, (*path, key))


def _of_tables(values: list[Any]) -> bool:
    return all(isinstance(value, dict) for value in values)


def _without(scene: Document, path: Path) -> Document | None:
    """Return a scene without what stands at a path; None where it is gone already."""
    made = deepcopy(scene)
    table: Any = made
    try:
        for key in path[:-1]:
            table = table[key]
        del table[path[-1]]
    except (KeyError, IndexError, TypeError):
        return None
    return made
