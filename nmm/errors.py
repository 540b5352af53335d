"""Errors of `nmm`: one line a fault, naming where, the value, what was expected and what to do."""

from __future__ import annotations

import json
from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong, in the order in which a user reads it.

    Attributes
    ----------
    place
        Where: file, line and key path as far as they are known.
    value
        What was found there.
    expected
        What would have been accepted.
    remedy
        What to do.
    """

    place: str
    value: str
    expected: str
    remedy: str

    def __str__(self) -> str:
        return printable(f"{self.place}: {self.value}: expected {self.expected}: {self.remedy}")


def shown(value: object, width: int = 60) -> str:
    """Return a value as a file writes it, texts quoted, shortened to a width."""
    try:
        number = isinstance(value, float)  # which may be no JSON
        text = repr(value) if number else json.dumps(value, default=str, ensure_ascii=False)
    except (TypeError, ValueError, RecursionError):  # a program may hand over anything
        text = repr(value)
    return text if len(text) <= width else text[: width - 3] + "..."


def printable(text: str) -> str:
    """Return a text with the signs that would move or colour a terminal written as escapes."""
    if text.isprintable():
        return text
    return "".join(one if one.isprintable() else repr(one)[1:-1] for one in text)


def in_a_line(error: Exception) -> str:
    """Return the message of an error in one line; one not raised on purpose with its class."""
    kind = "" if isinstance(error, NmmError) else f"{type(error).__name__}: "
    return " ".join(f"{kind}{error}".split())


class NmmError(ValueError):
    """Base of all errors raised on purpose; `faults` holds every fault found, one line each.

    Parameters
    ----------
    *faults
        `Fault` objects or ready lines. The message is one line a fault.
    """

    faults: tuple[Fault | str, ...]

    def __init__(self, *faults: Fault | str) -> None:
        self.faults = tuple(one if isinstance(one, Fault) else printable(one) for one in faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class SceneError(NmmError):
    """The scene cannot be read or contradicts itself."""


class GeometryError(NmmError):
    """The blocks of a scene, or the places of its supports and loads, are not usable."""


class FormulationError(NmmError):
    """The formulation cannot be read, or one of its parts does not exist or refuses its options."""


class SolveError(NmmError):
    """A step was not solved: the line names step, contact, residual and remedy.

    ``singular`` says that the load moves a part that nothing holds.
    """

    def __init__(self, *faults: Fault | str, singular: bool = False) -> None:
        super().__init__(*faults)
        self.singular = singular


class StorageError(NmmError):
    """A file or folder of a run cannot be written or read: the line names it and what to do."""


class DamageError(StorageError):
    """A file of a run folder is missing, cut off or altered."""


class NmmWarning(UserWarning):
    """What a caller should know though nothing is refused, such as a damaged run folder."""
