"""Records of motion over time: samples of acceleration, velocity or displacement."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

from pydantic import Field, model_validator

from nmm.errors import shown
from nmm.scene.fields import Frozen, Number, Samples, Text, Time, fault
from nmm.scene.units import UnitError, convert

UNITS = {"acceleration": "m/s^2", "velocity": "m/s", "displacement": "m"}
STANDARD_GRAVITY = 9.80665


class RecordTable(Frozen):
    """A motion over time, linear between its samples.

    It is given by a file or here, by `samples` or by `values` at equal steps. A file has two
    columns, time and value, or one column of values with a `step`, or is one of the PEER NGA data
    base (`.AT2`, `.VT2`, `.DT2`), which says its step itself and asks for its `unit`. Before its
    first sample a record is at rest; after its last one acceleration is zero and velocity stays.
    """

    file: Text | None = Field(
        default=None, description="a file of numbers, beside the scene", examples=["kobe.at2"]
    )
    samples: Samples | None = Field(
        default=None,
        description="pairs [t, value] with t increasing, a time in s",
        examples=[[[0, 0], [1, 2]]],
    )
    values: tuple[Number, ...] | None = Field(
        default=None, description="a list of values, with a step", examples=[[0, 0.6, 1.8, 0]]
    )
    step: Time | None = Field(
        default=None, gt=0, description="the time between values in s, > 0", examples=["10 ms"]
    )
    quantity: Literal["acceleration", "velocity", "displacement"] = Field(
        default="acceleration",
        description='"acceleration", "velocity" or "displacement"',
        examples=["velocity"],
    )
    unit: Text | None = Field(
        default=None,
        description='a unit of the numbers; "g" is 9.80665 m/s2; SI when not given',
        examples=["g"],
    )
    scale: Number = Field(default=1.0, description="a factor on the values", examples=[0.5])
    start: Time = Field(
        default=0.0,
        ge=-1e9,
        le=1e9,
        description="a time in s, at most 1e9, at which the record's time is zero",
        examples=["1 s"],
    )
    baseline: Literal["none", "velocity", "displacement"] = Field(
        default="none",
        description='"none", "velocity" or "displacement": what is taken from the acceleration, a '
        "constant so that the motion ends at rest, or a line so that it ends at rest where it "
        "began",
        examples=["displacement"],
    )

    @model_validator(mode="after")
    def _check(self) -> RecordTable:
        given = [key for key in ("file", "samples", "values") if getattr(self, key) is not None]
        if len(given) != 1:
            remedy = "give one of them and remove the others"
            raise fault(", ".join(given) or "no numbers", "file, samples or values", remedy)
        if self.values is not None and self.step is None:
            raise fault("values without step", "the time between them", 'add step = "10 ms"')
        if self.samples is not None and self.step is not None:
            raise fault("step with samples", "one of the two", "remove step: samples have times")
        if self.baseline != "none" and self.quantity != "acceleration":
            expected = 'quantity = "acceleration" with a baseline correction'
            raise fault(f'quantity = "{self.quantity}"', expected, "remove baseline")
        self._factor()
        self._check_times()
        return self

    def _check_times(self) -> None:
        numbers = self.samples if self.samples is not None else self.values
        if numbers is not None and len(numbers) < 2:
            raise fault(f"{len(numbers)} samples", "at least two", "give the whole record")
        for number, (one, then) in enumerate(pairwise(self.samples or ())):
            if one[0] >= then[0]:
                place = f"t = {then[0]:g} after {one[0]:g} (sample {number + 2})"
                raise fault(place, "times that increase", "sort them and remove equal times")

    def _factor(self) -> float:
        """SI values of one unit of the record, times its scale."""
        si = UNITS[self.quantity]
        if self.unit is None:
            return self.scale
        if self.unit == "g" and self.quantity == "acceleration":
            return self.scale * STANDARD_GRAVITY
        try:
            return self.scale * convert(f"1 {self.unit}", si)
        except UnitError as error:
            raise fault(shown(self.unit), f"a unit of {si}", error.remedy) from None

    @property
    def times_and_values(self) -> tuple[list[float], list[float]]:
        """Times in s of the run, and values in SI units, scaled.

        Raises
        ------
        ValueError
            A file that was not read.
        """
        if self.values is not None and self.step is not None:
            pairs = [(number * self.step, value) for number, value in enumerate(self.values)]
        elif self.samples is not None:
            pairs = list(self.samples)
        else:
            raise ValueError(f"{self.file} was not read")
        factor = self._factor()
        return [self.start + t for t, _ in pairs], [factor * value for _, value in pairs]
