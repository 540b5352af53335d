"""Whether a model that was read says all that its file says: nothing dropped, nothing turned."""

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel


def lost(data: Mapping[str, Any], model: BaseModel) -> Iterator[str]:
    """Yield the key paths of a file whose values the model does not have as they stand there.

    Texts of number and unit are numbers in the model, and numbers may be expressions there; all
    else must be equal, and of one kind.
    """
    said = model.model_dump(by_alias=True, exclude_unset=True)
    yield from _lost(data, said, ())


def _lost(given: Any, said: Any, path: tuple[str, ...]) -> Iterator[str]:
    if isinstance(given, Mapping):
        for key, value in given.items():
            if not isinstance(said, Mapping) or key not in said:
                yield ".".join((*path, key))
            else:
                yield from _lost(value, said[key], (*path, key))
    elif isinstance(given, list):
        if not isinstance(said, list | tuple) or len(said) != len(given):
            yield ".".join(path)
            return
        for number, (one, other) in enumerate(zip(given, said, strict=True)):
            yield from _lost(one, other, (*path, str(number)))
    elif not _same(given, said):
        yield ".".join(path)


def _same(given: object, said: object) -> bool:
    if isinstance(given, bool) or isinstance(said, bool):
        return given is said
    if isinstance(said, str) and isinstance(given, int | float):
        return float(said) == given  # an expression that is a number
    if isinstance(given, str) and isinstance(said, float):
        return any(sign.isdigit() for sign in given)  # with a unit, which the reader converted
    if isinstance(given, int) and isinstance(said, float):
        return float(given) == said  # which rounds beyond 2^53
    return given == said
