"""What is expected of a key, or of an item of its list, in words: by its description and type."""

from __future__ import annotations

import json
from collections.abc import Sequence
from itertools import takewhile
from types import UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from nmm.scene.fields import InUnit
from nmm.scene.lines import Path


def expected(info: FieldInfo, path: Path) -> str:
    """Return what completes "expected ..." at a path that ends in a key, or in its list.

    After a colon a description says what the key does.
    """
    index = [*takewhile(lambda part: isinstance(part, int), reversed(path))][::-1]
    of_key = (info.description or "").partition(": ")[0]
    return _of_item(info.annotation, index) or of_key if index else of_key


def _of_item(annotation: Any, index: Sequence[Any]) -> str:
    """Return what is expected at a place in lists of a type; "" where the type does not say."""
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        said = "" if index else next(filter(None, map(_of_mark, inner[1:])), "")
        return said or _of_item(inner[0], index)
    if origin in (Union, UnionType):
        return next(filter(None, (_of_item(one, index) for one in inner)), "")
    if origin is tuple and index:
        same = inner[-1] is ...
        return _of_item(inner[0], index[1:]) if same or inner[1:] == inner[:-1] else ""
    if origin is Literal and not index:
        *words, last = (json.dumps(word) for word in inner)
        return f"{', '.join(words)} or {last}" if words else last
    return ""


def _of_mark(mark: Any) -> str:
    """Return what a mark of a type says of its values."""
    if isinstance(mark, InUnit):
        return "a number" if mark.unit in ("1", "any") else f"a number in {mark.unit}"
    return mark.description or "" if isinstance(mark, FieldInfo) else ""
