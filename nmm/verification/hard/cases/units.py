"""The same scene in other units: every number of a scene by the unit that its type names."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar, get_args

from pydantic import BaseModel

from nmm.scene import parse_scene
from nmm.scene.fields import InUnit
from nmm.scene.tables.shaking.records import RecordTable
from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.files import toml

ModelT = TypeVar("ModelT", bound=BaseModel)

Units = Mapping[str, float]
"""By how much the number of a base or named unit is multiplied."""


def units_of(length: float, force: float) -> Units:
    """Return the factors of all units where lengths and forces are multiplied; time stays."""
    mass, energy, none = force / length, force * length, dict.fromkeys(("1", "s", "rad", "K"), 1.0)
    stress = force / length**2
    return {**none, "m": length, "kg": mass, "N": force, "Pa": stress, "J": energy, "W": energy}


def factor(unit: str, units: Units) -> float:
    """Return what a number in a unit such as "J/kg/K" is multiplied by."""
    value = 1.0
    for sign, symbol, power in re.findall(r"(^| |/)([A-Za-z]+|1)(?:\^([\d.]+))?", unit):
        value *= units[symbol] ** ((-1 if sign == "/" else 1) * float(power or 1))
    return value


def in_units(scene: Document, length: float, force: float) -> Document:
    """Return a scene in other units: all numbers of lengths and forces are multiplied.

    Expressions, tables of fields and options of parts are left as they are.
    """
    made = rescaled(parse_scene(toml(scene), "hard case"), units_of(length, force))
    return made.model_dump(mode="json", by_alias=True, exclude_defaults=True, exclude_none=True)


def rescaled(part: ModelT, units: Units) -> ModelT:
    """Return a table, and what is in it, with every number in other units."""
    changes: dict[str, Any] = {}
    for name, item in type(part).model_fields.items():
        named = set(_named(item.annotation)) | {u for mark in item.metadata for u in _named(mark)}
        times = factor(named.pop(), units) if named else 1.0
        changes[name] = _times(getattr(part, name), times, units)
    if isinstance(part, RecordTable):  # samples have no unit of their own
        changes["scale"] = part.scale * units["m"]
    return part.model_copy(update=changes)


def _named(hint: Any) -> Iterator[str]:
    """Yield the units that a type or a mark names, in whatever it is made of."""
    if isinstance(hint, InUnit) and hint.unit != "any":
        yield hint.unit
    for inner in (*get_args(hint), *getattr(hint, "__metadata__", ())):
        yield from _named(inner)


def _times(value: Any, times: float, units: Units) -> Any:
    if isinstance(value, BaseModel):
        return rescaled(value, units)
    if isinstance(value, dict):
        return {key: _times(item, times, units) for key, item in value.items()}
    if isinstance(value, tuple):
        return tuple(_times(item, times, units) for item in value)
    return times * value if isinstance(value, float) else value
