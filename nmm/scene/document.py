"""TOML text -> model, with every fault in one error."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from nmm.errors import Fault, NmmError
from nmm.scene.faults import Source, report

# Model, what its file is called, and keys that it has and files of the other kinds have not.
OWN_KEYS = {
    "Scene": ("a scene", {"materials", "blocks", "tessellations", "plane"}),
    "Formulation": ("a formulation", {"cover", "integrator", "rotation", "solver", "glue"}),
    "Plan": ("a study", {"scene", "scenes", "vary"}),
}

Model = TypeVar("Model", bound=BaseModel)


def read_text(path: str | Path, error: type[NmmError]) -> str:
    """Text of a file.

    Raises
    ------
    error
        The file does not exist or is no UTF-8 text.
    """
    try:
        return Path(path).read_text(encoding="utf-8")
    except OSError as cause:
        reason = cause.strerror or str(cause)
        raise error(Fault(str(path), reason, "a TOML file", "check the path")) from None
    except UnicodeDecodeError:
        raise error(Fault(str(path), "bytes", "UTF-8 text", "save the file as UTF-8")) from None


def parse(text: str, model: type[Model], place: str, error: type[NmmError]) -> tuple[Model, Source]:
    """Model of a TOML text, and where its keys stand.

    Raises
    ------
    error
        The text is no TOML or a file of another kind, or the model refuses it; one fault a line.
    """
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as cause:
        raise error(_syntax(str(cause), place)) from None
    _refuse_other_kind(data, model, place, error)
    source = Source(place, text)
    return build(data, model, source, error), source


def build(data: dict[str, Any], model: type[Model], source: Source, error: type[NmmError]) -> Model:
    """Model of tables."""
    try:
        return model.model_validate(data)
    except ValidationError as cause:
        raise error(*report(cause, model, source)) from None


def _refuse_other_kind(
    data: dict[str, Any], model: type[Model], place: str, error: type[NmmError]
) -> None:
    """Say in one line that a file of another kind was given, in place of one line a key."""
    wanted, own = OWN_KEYS.get(model.__name__, ("", data.keys()))
    if data.keys() & own:
        return
    for kind, keys in OWN_KEYS.values():
        if data.keys() & keys:
            raise error(Fault(place, kind, wanted, f"give the file of {wanted} here"))


def _syntax(message: str, place: str) -> Fault:
    match = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|(.*))\)", message)
    if match is None:
        return Fault(place, message, "TOML", "correct the text")
    reason, line, column, end = match.groups()
    where = f"{place}:{line}" if line else place
    position = f"at column {column}" if column else f"at {end}"
    return Fault(where, f"{reason} {position}", "TOML", "correct the text there or just before")
