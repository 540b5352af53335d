"""Tables of values over places and times, which loads and supports name as fields."""

from __future__ import annotations

from pydantic import Field, model_validator

from nmm.scene.fields import Frozen, Number, Text, fault

ROWS = "rows [x, y, fx, fy], or [t, x, y, fx, fy] for values over time"


class FieldTable(Frozen):
    """Values at places, linear between them, from a file of columns or given here.

    Columns are x, y (m) and two values, or t (s), x, y and two values, with the same places at
    every time. Places on one line are interpolated along it, others over triangles between them;
    times before the first and after the last have its values.
    """

    file: Text | None = Field(
        default=None, description="a file of numbers, beside the scene", examples=["pressures.csv"]
    )
    rows: tuple[tuple[Number, ...], ...] | None = Field(
        default=None, description=ROWS, examples=[[[0, 0, 1e5, 0], [0, 10, 0, 0]]]
    )
    scale: Number = Field(
        default=1.0, description="a factor on the values, to SI units", examples=[1000.0]
    )

    @model_validator(mode="after")
    def _check(self) -> FieldTable:
        if (self.file is None) == (self.rows is None):
            shown = "no numbers" if self.file is None else "file and rows"
            raise fault(shown, "file or rows", "give one of the two")
        if self.rows is not None:
            check_rows(self.rows)
        return self


def check_rows(rows: tuple[tuple[float, ...], ...]) -> None:
    """Refuse rows of wrong or different widths, and fewer than two rows.

    Raises
    ------
    PydanticCustomError
        With the number of the first wrong row.
    """
    for number, row in enumerate(rows, start=1):
        if len(row) not in (4, 5) or len(row) != len(rows[0]):
            remedy = "give every row the same columns"
            raise fault(f"row {number} of {len(row)} numbers", ROWS, remedy)
    if len(rows) < 2:
        raise fault(f"{len(rows)} rows", "at least two places", "add rows")
