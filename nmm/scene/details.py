"""Details of errors of pydantic, of which one error may have many."""

from typing import Any

from pydantic_core import InitErrorDetails, PydanticCustomError


def detail(path: tuple[str | int, ...], value: str, expected: str, remedy: str) -> InitErrorDetails:
    """Return a contradiction of tables as a detail of an error of pydantic."""
    context = {"value": value, "expected": expected, "remedy": remedy}
    error = PydanticCustomError("fault", "expected {expected}: {remedy}", context)
    return InitErrorDetails(type=error, loc=path, input=value)


def again(item: Any) -> InitErrorDetails:
    """Return a detail of an error that was raised as one of another error."""
    error = PydanticCustomError(item["type"], item["msg"], item.get("ctx"))
    return InitErrorDetails(type=error, loc=item["loc"], input=item["input"])
