"""Building blocks of the models: the frozen base, and the types of quantities.

Every field has a description that completes "expected ...", and where useful an example; fault
reports are made of them (see `faults.py`).
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

from nmm.errors import shown
from nmm.scene.units import EXAMPLES, UnitError, convert

# Magnitudes beyond these are mistakes, whose products overflow or vanish.
LARGEST, SMALLEST = 1e30, 1e-30
# Largest count.
MOST = 10**18
# Deepest nesting of tables.
DEEPEST = 16


class Frozen(BaseModel):
    """Base of all scene and formulation models: immutable, closed, finite numbers only."""

    # Tables within a scene are checked by the scene's own validator: none is built for each.
    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True, defer_build=True
    )


def fault(value: object, expected: str, remedy: str) -> PydanticCustomError:
    """Error to raise in a validator; `faults.py` turns it into a line of the report."""
    context = {"value": str(value), "expected": expected, "remedy": remedy}
    return PydanticCustomError("fault", "expected {expected}: {remedy}", context)


@dataclass(frozen=True, slots=True)
class InUnit(BeforeValidator):
    """Marks a type whose values have a unit, read as numbers in it or as texts.

    Attributes
    ----------
    unit
        SI unit, a key of `nmm.scene.units.COMMON`, or "any".
    """

    unit: str = "1"


def quantity(unit: str, smallest: float = 0.0) -> InUnit:
    """Return a validator that accepts a number in `unit`, or a text of number and unit.

    Its magnitude is at most `LARGEST`, and zero or at least ``smallest``.
    """

    def read(value: object) -> object:
        if isinstance(value, bool):
            raise fault(shown(value), f"a number in {unit}", "write a number, not true or false")
        if isinstance(value, str):
            try:
                value = convert(value, unit)
            except UnitError as error:
                raise fault(shown(value), error.expected, error.remedy) from None
        if isinstance(value, int | float) and abs(value) > LARGEST:
            said = value if isinstance(value, float) else "too many digits"
            raise fault(said, f"a number up to 1e30 in {unit}", "check the number and its unit")
        if isinstance(value, int | float) and 0 < abs(value) < smallest:
            raise fault(value, f"0, or at least {smallest:g} in {unit}", "check the number")
        # Adding 0.0 turns -0.0 into 0.0, so that both give the same scene hash.
        return float(value) + 0.0 if isinstance(value, int | float) else value

    return InUnit(read, float | str, unit)


def _time_or_auto(value: object) -> object:
    """A time above zero in s, or the word "auto"."""
    if value == "auto":
        return value
    time = quantity("s", SMALLEST).func(value)  # type: ignore[call-arg]
    if not (isinstance(time, float) and time > 0):
        remedy = 'write for example step = "1 ms", or step = "auto"'
        raise fault(shown(value), 'a step in s, > 0, or "auto"', remedy)
    return time


def _listed(value: object) -> object:
    """Convert arrays given from Python to lists."""
    return value.tolist() if hasattr(value, "tolist") else value


def plain_data(value: object) -> object:
    """Refuse values other than numbers, texts, booleans, lists and tables, and deep nesting."""
    level = [value]
    for _ in range(DEEPEST):
        for item in level:
            if isinstance(item, int | float) and not abs(item) <= LARGEST:
                said = item if isinstance(item, float) else "too many digits"
                raise fault(said, "a number up to 1e30", "check the number")
            if item is not None and not isinstance(
                item, str | int | float | list | tuple | Mapping
            ):
                kinds = "numbers, texts, true or false, lists and tables"
                raise fault(item, kinds, "write it as one of them")
        parts = [one for one in level if isinstance(one, list | tuple | Mapping)]
        level = [x for one in parts for x in (one.values() if isinstance(one, Mapping) else one)]
        if not level:
            return value
    raise fault("tables within tables", f"at most {DEEPEST} levels", "write it flatter")


def _ring(value: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
    if len(value) < 4 and value[0] == value[-1]:
        remedy = "add the others; the first need not be repeated"
        raise fault(f"{len(value) - 1} points and the first again", "three points", remedy)
    return value


def _within_a_turn(value: float) -> float:
    """Refuse more than a whole turn: degrees written without their unit."""
    if abs(value) <= math.tau:
        return value
    remedy = 'numbers are radians; write for example "30 deg"'
    raise fault(value, "an angle within a whole turn, 2 pi rad", remedy)


def _friction(value: float) -> float:
    if 0 <= value < math.pi / 2:
        return value
    remedy = 'numbers are radians; write for example friction_angle = "37 deg"'
    raise fault(value, "a friction angle in [0, pi/2) rad", remedy)


Number = Annotated[float, quantity("1")]
Coordinate = Annotated[float, quantity("m")]
Length = Annotated[float, quantity("m", SMALLEST)]
Time = Annotated[float, quantity("s", SMALLEST)]
TimeOrAuto = Annotated[float | Literal["auto"], BeforeValidator(_time_or_auto)]
Angle = Annotated[float, quantity("rad"), AfterValidator(_within_a_turn)]
FrictionAngle = Annotated[float, quantity("rad"), AfterValidator(_friction)]
Force = Annotated[float, quantity("N", SMALLEST)]
Energy = Annotated[float, quantity("J", SMALLEST)]
Stress = Annotated[float, quantity("Pa", SMALLEST)]
Density = Annotated[float, quantity("kg/m^3", SMALLEST)]
ForceDensity = Annotated[float, quantity("N/m^3", SMALLEST)]
SpringStiffness = Annotated[float, quantity("Pa/m", SMALLEST)]
SurfaceEnergy = Annotated[float, quantity("J/m^2", SMALLEST)]
Velocity = Annotated[float, quantity("m/s")]
Acceleration = Annotated[float, quantity("m/s^2")]
AngularVelocity = Annotated[float, quantity("rad/s")]
AnyQuantity = Annotated[float, quantity("any")]


def _countable(number: int) -> int:
    """Refuse counts beyond 64 bits, as they are kept in arrays."""
    if abs(number) > MOST:
        raise fault(number, f"a whole number of at most {MOST:.0e}", "give a smaller one")
    return number


# Strict: 1.5, "3" and true are no counts, and "yes" is no boolean.
Count = Annotated[int, Field(strict=True), AfterValidator(_countable)]
Flag = Annotated[bool, Field(strict=True)]


class Coordinates:
    """Marks a type of places, whose values move with the origin of the scene."""


# A place. A direction or a displacement is a pair of lengths.
Point = Annotated[
    tuple[Coordinate, Coordinate],
    BeforeValidator(_listed),
    Coordinates(),
    Field(description="a point [x, y] in m"),
]
Segment = Annotated[tuple[Point, Point], BeforeValidator(_listed)]
Ring = Annotated[
    tuple[Point, ...], BeforeValidator(_listed), Field(min_length=3), AfterValidator(_ring)
]
Line = Annotated[tuple[Point, ...], BeforeValidator(_listed), Field(min_length=2)]
History = Annotated[tuple[tuple[Number, Number], ...], BeforeValidator(_listed)]
# Pairs of a time, in s where it is a number, and a value.
Samples = Annotated[
    tuple[tuple[Annotated[float, quantity("s")], Number], ...], BeforeValidator(_listed)
]

# Characters with another meaning in a terminal, a table of numbers or a file name: control and
# formatting characters, line ends, brackets, quotes, slashes.
_STRANGE = r"\p{C}\p{Zl}\p{Zp}\[\]\"/\\"
# "." and ":" separate parts of names in results ("beam.12", "monitor:top:ux").
Name = Annotated[str, Field(pattern=rf"^[^.:\s{_STRANGE}][^.:{_STRANGE}]*$")]
NAME = 'a name without ".", ":", brackets, quotes, slashes and line breaks'
# A block, or one piece "beam.12" of a tessellated or cut block.
BlockName = Annotated[str, Field(pattern=rf"^[^.:\s{_STRANGE}][^:{_STRANGE}]*$")]
# Name of a material or an interface.
TableName = Annotated[str, Field(pattern=rf"^[^{_STRANGE}]+$", description=NAME)]
# One line, and a text that may have several.
Text = Annotated[str, Field(pattern=r"^[^\p{Cc}\p{Zl}\p{Zp}]*$")]
Prose = Annotated[str, Field(pattern=r"^([^\p{Cc}\p{Zl}\p{Zp}]|[\n\t])*$")]
# A registry name, or "module:Name" for a part of one's own.
PART_NAME = r"^[A-Za-z_]\w*$|^[A-Za-z_][\w.]*:[A-Za-z_]\w*$"
PartName = Annotated[str, Field(pattern=PART_NAME)]
Options = Annotated[dict[str, Any], BeforeValidator(plain_data)]


def example(unit: str) -> list[object]:
    """Return an example for a field in `unit`."""
    return [EXAMPLES[unit]]
