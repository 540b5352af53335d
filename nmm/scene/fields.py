"""Building stones of the models: the frozen base and the quantity types.

Every field has a description, written so that it completes "expected ...", and where useful an
example; the fault report is made of them (see `faults.py`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

from nmm.scene.units import EXAMPLES, UnitError, convert

# No integer beyond it is a floating-point number.
LARGEST = 10**308


class Frozen(BaseModel):
    """Base of all scene and formulation models: immutable, closed, finite numbers only."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True
    )


def fault(value: object, expected: str, remedy: str) -> PydanticCustomError:
    """Error to raise in a validator; `faults.py` turns it into a line of the report."""
    context = {"value": str(value), "expected": expected, "remedy": remedy}
    return PydanticCustomError("fault", "expected {expected}: {remedy}", context)


def quantity(unit: str) -> BeforeValidator:
    """Validator that accepts a number in `unit` or a text of number and unit."""

    def read(value: object) -> object:
        if isinstance(value, bool):
            raise fault(value, f"a number in {unit}", "write a number, not true or false")
        if isinstance(value, str):
            try:
                value = convert(value, unit)
            except UnitError as error:
                raise fault(repr(value), error.expected, error.remedy) from None
        if isinstance(value, int) and abs(value) > LARGEST:
            raise fault("too many digits", f"a number in {unit}", "write it as 1e9, and check it")
        # Adding 0.0 turns -0.0 into 0.0, so that both give the same scene hash.
        return float(value) + 0.0 if isinstance(value, int | float) else value

    return BeforeValidator(read, json_schema_input_type=float | str)


def _listed(value: object) -> object:
    """Arrays given from Python become lists."""
    return value.tolist() if hasattr(value, "tolist") else value


Number = Annotated[float, quantity("1")]
Length = Annotated[float, quantity("m")]
Time = Annotated[float, quantity("s")]
Angle = Annotated[float, quantity("rad")]
Force = Annotated[float, quantity("N")]
Stress = Annotated[float, quantity("Pa")]
Density = Annotated[float, quantity("kg/m^3")]
ForceDensity = Annotated[float, quantity("N/m^3")]
SpringStiffness = Annotated[float, quantity("Pa/m")]
SurfaceEnergy = Annotated[float, quantity("J/m^2")]
Velocity = Annotated[float, quantity("m/s")]
Acceleration = Annotated[float, quantity("m/s^2")]
AngularVelocity = Annotated[float, quantity("rad/s")]
AnyQuantity = Annotated[float, quantity("any")]

# Strict: 1.5, "3" and true are no numbers of things, "yes" is no truth value.
Count = Annotated[int, Field(strict=True)]
Flag = Annotated[bool, Field(strict=True)]


class Coordinates:
    """Mark of a type that says where in a scene: its values move when the scene does."""


# A place. What is only a direction or a way, a displacement, is a pair of lengths.
Point = Annotated[tuple[Length, Length], BeforeValidator(_listed), Coordinates()]
Segment = Annotated[tuple[Point, Point], BeforeValidator(_listed)]
Ring = Annotated[tuple[Point, ...], BeforeValidator(_listed), Field(min_length=3)]
History = Annotated[tuple[tuple[Number, Number], ...], BeforeValidator(_listed)]

# "." and ":" separate parts of names in results ("beam.12", "monitor:top:ux").
Name = Annotated[str, Field(pattern=r"^[^.:\s][^.:]*$")]
# A block, or one piece "beam.12" of a tessellated or cut block.
BlockName = Annotated[str, Field(pattern=r"^[^.:\s][^:]*$")]
# A registry name, or "module:Name" for a part of one's own.
PartName = Annotated[str, Field(pattern=r"^[A-Za-z_]\w*$|^[A-Za-z_][\w.]*:[A-Za-z_]\w*$")]
Options = Mapping[str, Any]


def example(unit: str) -> list[object]:
    """Example for a field in `unit`."""
    return [EXAMPLES[unit]]
