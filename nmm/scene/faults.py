"""From errors of pydantic to a report: a line for each fault, with place, value and remedy."""

from __future__ import annotations

import difflib
import json
import math
import re
import tomllib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from nmm.errors import Fault, shown
from nmm.scene.expected import expected
from nmm.scene.lines import Path, line_numbers


@dataclass(frozen=True, eq=False)
class Source:
    """Source of a model: file name and TOML text, scanned for line numbers when first needed.

    A model that is part of another file has its key path there as ``root``.
    Two sources are always equal, so that equal scenes from different files compare equal.
    """

    name: str = "scene"
    text: str = ""
    root: Path = ()

    @cached_property
    def lines(self) -> dict[Path, int]:
        """Line of each key path."""
        return line_numbers(self.text)

    def place(self, *path: str | int) -> str:
        """`file:line: dotted.path`; the line is that of the nearest key that is in the file."""
        path = (*self.root, *path)
        dotted = ".".join(str(part) for part in path)
        line = self._line(path)
        where = f"{self.name}:{line}" if line else self.name
        return f"{where}: {dotted}" if dotted else where

    def written(self, *path: str | int) -> object:
        """Value at a key path as the file has it; None where it has none."""
        value: Any = None
        with suppress(tomllib.TOMLDecodeError, KeyError, IndexError, TypeError):
            value = tomllib.loads(self.text)
            for part in (*self.root, *path):
                value = value[part]
        return value

    def of_name(self, key: str, name: str, *below: str) -> str:
        """`place` in the table ``[[key]]`` of a given name."""
        rows: Any = []
        with suppress(tomllib.TOMLDecodeError):
            rows = tomllib.loads(self.text).get(key, [])
        number = [n for n, row in enumerate(rows) if row.get("name") == name]
        return self.place(key, *number[:1], *(below if number else ()))

    def line(self, *path: str | int) -> int:
        """Line of the nearest key that is in the file, 0 if there is none."""
        return self._line((*self.root, *path))

    def _line(self, path: Path) -> int:
        lengths = range(len(path), 0, -1)
        return next((self.lines[path[:n]] for n in lengths if path[:n] in self.lines), 0)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Source)

    def __hash__(self) -> int:
        return hash(Source)


def report(error: ValidationError, model: type[BaseModel], source: Source) -> list[Fault]:
    """Return all faults of a failed validation of `model`."""
    details = sorted(error.errors(include_url=False), key=lambda item: source.line(*item["loc"]))
    inner = {tuple(item["loc"][:-1]) for item in details}
    # A list that is too short because its items are faulty is not reported twice.
    return [
        _fault(item, model, source)
        for item in details
        if item["type"] != "too_short" or tuple(item["loc"]) not in inner
    ]


def suggestion(word: str, known: list[str]) -> str:
    """Return `did you mean "..."?`, or the list of known words."""
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.6)
    if close:
        return f'did you mean "{close[0]}"?'
    return f"known: {', '.join(known)}" if known else "none is defined"


def _fault(detail: Any, model: type[BaseModel], source: Source) -> Fault:
    path: Path = tuple(detail["loc"])
    place = source.place(*path)
    kind, context = detail["type"], detail.get("ctx", {})
    if kind == "fault":
        value = _as_written(context["value"], source.written(*path))
        return Fault(place, value, context["expected"], context["remedy"])
    parent, info = _at(model, path)
    if kind == "extra_forbidden":
        known = [name for name, _ in _keys(parent)]
        remedy = suggestion(str(path[-1]), known)
        return Fault(place, f'unknown key "{path[-1]}"', "a known key", remedy)
    wanted = (expected(info, path) if info else "") or detail["msg"]
    key = next((part for part in reversed(path) if isinstance(part, str)), "value")
    table = re.search(r"\[+[\w.]+\]+", wanted)
    sample = table[0] if table else f"{key} = {_sample(info)}"
    if kind == "missing" and isinstance(path[-1], str):
        return Fault(place, "missing", wanted, f"add {sample}")
    given = _as_written(shown(detail["input"]), source.written(*path))
    value = "missing" if kind == "missing" else given
    return Fault(place, value, wanted, f"write for example {sample}")


def _as_written(value: str, written: object) -> str:
    """Return a number as the text with a unit that it was read from."""
    with suppress(ValueError):
        if isinstance(written, str) and math.isfinite(float(value)):
            return shown(written)
    return value


def _at(model: type[BaseModel], path: Path) -> tuple[type[BaseModel], FieldInfo | None]:
    """Return the model that the last part of a path is in, and the nearest field."""
    info: FieldInfo | None = None
    parent = model
    is_name = False  # the part after a field of named entries is an entry's name, not a key
    for part in path:
        parent = model
        found = None if is_name else dict(_keys(model)).get(str(part))
        is_name = found is not None and get_origin(found.annotation) in (dict, Mapping)
        info = found or info
        if found is not None:
            model = _inner(found.annotation) or model
    return parent, info


def _keys(model: type[BaseModel]) -> list[tuple[str, FieldInfo]]:
    return [(info.alias or name, info) for name, info in model.model_fields.items()]


def _inner(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for item in get_args(annotation) if (found := _inner(item))), None)


def _sample(info: FieldInfo | None) -> str:
    if info is None or not info.examples:
        return "..."
    return json.dumps(info.examples[0])  # which is TOML for text, numbers and lists
