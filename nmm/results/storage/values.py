"""Values of a program as arrays and one text, and back: what checkpoints are made of.

A value is None, a truth, a number, a text, an array of them, a tuple or list, a mapping by names,
or a dataclass of such values. The text is a tree in JSON in which arrays stand by number. Nothing
that a file names is imported: its dataclasses are those of a table that the reader brings.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from importlib import import_module
from typing import Any

import numpy as np
import numpy.typing as npt

Arrays = dict[str, npt.NDArray[Any]]
Kinds = Mapping[str, str]
"""Dataclasses by their names: where they stand, ``module:Class``."""

TREE = "tree"


def encoded(value: Any, kinds: Kinds) -> Arrays:
    """Return a value as arrays by name.

    Raises
    ------
    TypeError
        When it holds something else than is said above.
    """
    arrays: Arrays = {}
    tree = _tree(value, kinds, arrays)
    return {**arrays, TREE: np.array(json.dumps(tree))}


def decoded(arrays: Mapping[str, npt.NDArray[Any]], kinds: Kinds) -> Any:
    """Return the value that `encoded` made these of.

    Raises
    ------
    ValueError
        When they were not made by it, with the same table.
    """
    try:
        return _value(json.loads(arrays[TREE].item()), kinds, arrays.__getitem__)
    except (KeyError, IndexError, TypeError, AttributeError, RecursionError) as fault:
        raise ValueError(f"its values do not fit together ({fault})") from fault


def _tree(value: Any, kinds: Kinds, arrays: Arrays) -> Any:
    match value:
        case None | bool() | str():
            return value
        case np.generic():
            return _tree(value.item(), kinds, arrays)
        case int() | float():
            return value
        case np.ndarray():
            name = str(len(arrays))
            # In the order of rows, which it has when it is read: sums of it keep their digits.
            arrays[name] = np.array(value, order="C")
            return {"array": name}
        case tuple() | list():
            kind = "list" if isinstance(value, list) else "tuple"
            return {kind: [_tree(item, kinds, arrays) for item in value]}
        case Mapping():
            return {"mapping": {name: _tree(item, kinds, arrays) for name, item in value.items()}}
    name = type(value).__name__
    if not is_dataclass(value) or kinds.get(name) != f"{type(value).__module__}:{name}":
        raise TypeError(
            f"{type(value).__name__}: expected arrays, numbers, texts, None, and tuples and "
            "mappings of these"
        )
    parts = {part.name: _tree(getattr(value, part.name), kinds, arrays) for part in fields(value)}
    return {"kind": name, "parts": parts}


def _value(tree: Any, kinds: Kinds, array: Callable[[str], npt.NDArray[Any]]) -> Any:
    match tree:
        case {"array": name}:
            return array(name)
        case {"list": items}:
            return [_value(item, kinds, array) for item in items]
        case {"tuple": items}:
            return tuple(_value(item, kinds, array) for item in items)
        case {"mapping": items}:
            return {name: _value(item, kinds, array) for name, item in items.items()}
        case {"kind": name, "parts": parts}:
            module, _, attribute = kinds[name].partition(":")
            made = getattr(import_module(module), attribute)
            return made(**{part: _value(item, kinds, array) for part, item in parts.items()})
        case None | bool() | int() | float() | str():
            return tree
    raise TypeError(f"{type(tree).__name__} stands where a value was expected")
