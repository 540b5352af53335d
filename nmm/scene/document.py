"""From TOML text to a model, with all faults in one error."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError

from nmm.errors import Fault, NmmError
from nmm.scene.faults import Source, report
from nmm.scene.fields import DEEPEST

# Of each kind of file: its name, and keys that only this kind has.
OWN_KEYS = {
    "Scene": ("a scene", {"materials", "blocks", "tessellations", "plane"}),
    "Formulation": ("a formulation", {"cover", "integrator", "rotation", "solver", "glue"}),
    "StudyPlan": ("a study", {"scene", "scenes", "vary"}),
}

# Largest size of a file in bytes.
LARGEST_FILE = 256_000_000

QUOTED = "'([^']*)'"

Model = TypeVar("Model", bound=BaseModel)


def read_text(path: str | Path, error: type[NmmError]) -> str:
    """Return the text of a file.

    Raises
    ------
    error
        The file does not exist or is no UTF-8 text.
    """
    try:
        size = Path(path).stat().st_size
        if not Path(path).is_file():
            raise error(Fault(str(path), "no file", "a TOML file", "check the path"))
        if size > LARGEST_FILE:
            found, most = f"{size / 1e6:.0f} MB", f"at most {LARGEST_FILE / 1e6:.0f} MB"
            raise error(Fault(str(path), found, most, "let a program build the scene"))
        # Windows marks UTF-8 by three bytes in front.
        return Path(path).read_text(encoding="utf-8-sig")
    except OSError as cause:
        reason = cause.strerror or str(cause)
        raise error(Fault(str(path), reason, "a TOML file", "check the path")) from None
    except UnicodeDecodeError:
        raise error(Fault(str(path), "bytes", "UTF-8 text", "save the file as UTF-8")) from None


def parse(text: str, model: type[Model], place: str, error: type[NmmError]) -> tuple[Model, Source]:
    """Return the model of a TOML text, and its source with line numbers.

    Raises
    ------
    error
        The text is no TOML, is a file of another kind, or the model refuses it; a line for each
        fault.
    """
    try:
        data = tomllib.loads(text.removeprefix("\ufeff"))
    except ValueError as cause:  # also numbers of thousands of digits
        raise error(_syntax(str(cause), place)) from None
    except RecursionError:
        raise error(_deep(place)) from None
    if not _shallow(data):
        raise error(_deep(place))
    _refuse_other_kind(data, model, place, error)
    source = Source(place, text)
    return build(data, model, source, error), source


def build(data: dict[str, Any], model: type[Model], source: Source, error: type[NmmError]) -> Model:
    """Return the model of tables."""
    try:
        return model.model_validate(data)
    except ValidationError as cause:
        raise error(*report(cause, model, source)) from None


def _refuse_other_kind(
    data: dict[str, Any], model: type[Model], place: str, error: type[NmmError]
) -> None:
    """Raise one fault for a file of another kind, in place of one for each key."""
    wanted, own = OWN_KEYS.get(model.__name__, ("", data.keys()))
    if data.keys() & own:
        return
    for kind, keys in OWN_KEYS.values():
        if data.keys() & keys:
            raise error(Fault(place, kind, wanted, f"give the file of {wanted} here"))


def _table_of(keys: str) -> str:
    return f"[{'.'.join(re.findall(QUOTED, keys))}]"


def _deep(place: str) -> Fault:
    return Fault(place, "brackets within brackets", f"at most {DEEPEST} levels", "write it flatter")


def _shallow(data: dict[str, Any]) -> bool:
    """Whether lists and tables are nested at most `DEEPEST` levels deep."""
    level: list[Any] = [data]
    for _ in range(DEEPEST):
        inner = (one.values() if isinstance(one, dict) else one for one in level)
        level = [item for items in inner for item in items if isinstance(item, dict | list)]
        if not level:
            return True
    return False


def _syntax(message: str, place: str) -> Fault:
    match = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|(.*))\)", message)
    if match is None:
        return Fault(place, message, "TOML", "correct the text")
    reason, line, column, end = match.groups()
    # Tables that are given twice are named as tuples: ('cover', 'enrichment').
    reason = re.sub(rf"\(({QUOTED},? ?)+\)", lambda one: _table_of(one[0]), reason)
    where = f"{place}:{line}" if line else place
    position = f"at column {column}" if column else f"at {end}"
    return Fault(where, f"{reason} {position}", "TOML", "correct the text there or just before")
