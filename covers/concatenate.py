"""Records of arrays: concatenated, with numbers of things offset, and some rows of them."""

from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import numpy as np

from integration.arrays import Bools, Ints
from integration.polygons import Polygons

Record = TypeVar("Record")


SHARED = {"of": "shared"}
"""Metadata of the field of an array that is the same in all parts."""


def numbers(of: str) -> dict[str, str]:
    """Return metadata of a field that holds numbers of elements, edges and so on; -1 for none.

    Parameters
    ----------
    of
        What is numbered, a key of the ``offsets`` of `concatenate`.
    """
    return {"of": of}


def concatenate(parts: Sequence[Record], offsets: Mapping[str, Ints], **given: Any) -> Record:
    """Return the records as one.

    Arrays and polygons are concatenated, numbers (`numbers`) are increased by the offsets of what
    they count, and nested records are concatenated likewise.

    Parameters
    ----------
    offsets
        First number (p,) of each part, for each kind of thing that fields number.
    given
        Values of fields that are not concatenated.
    """
    made = dict(given)
    for item in fields(parts[0]):  # type: ignore[arg-type]
        if item.name not in given:
            values = [getattr(part, item.name) for part in parts]
            made[item.name] = _joined(values, item.metadata.get("of"), offsets)
    return replace(parts[0], **made)  # type: ignore[type-var]


def some_of(record: Record, index: Ints | Bools) -> Record:
    """Return rows of a record: those of its arrays and nested records; all else is as it was."""
    made: dict[str, Any] = {}
    for item in fields(record):  # type: ignore[arg-type]
        value = getattr(record, item.name)
        if is_dataclass(value):
            made[item.name] = some_of(value, index)
        elif isinstance(value, np.ndarray):
            made[item.name] = value[index]
    return replace(record, **made)  # type: ignore[type-var]


def starts(counts: Sequence[int]) -> Ints:
    """Return the first number of each part from the counts of the parts."""
    return np.cumsum([0, *counts])[:-1]


def _joined(values: list[Any], of: str | None, offsets: Mapping[str, Ints]) -> Any:
    if isinstance(values[0], Polygons):
        return Polygons.concatenate(values)
    if is_dataclass(values[0]):
        return concatenate(values, offsets)
    if of == SHARED["of"] or not isinstance(values[0], np.ndarray):
        return values[0]
    if of is not None:
        pairs = zip(values, offsets[of], strict=True)
        values = [np.where(part >= 0, part + first, -1) for part, first in pairs]
    return np.concatenate(values)
