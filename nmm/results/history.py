"""The history file: one line a step, appended and flushed, so that a killed run stays readable."""

import csv
import io
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TextIO

import numpy as np

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.results.files import write_text


class HistoryFile:
    """Writer of `history.csv`.

    The first row fixes the header. A row with new names rewrites the file once with the longer
    header; a value that a row does not give is an empty cell.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._names: list[str] = []
        self._stream: TextIO | None = None

    def append(self, values: Mapping[str, float]) -> None:
        """Write one row and flush it."""
        fresh = [name for name in values if name not in self._names]
        if fresh:
            self._widen(fresh)
        assert self._stream is not None
        self._stream.write(_line([_cell(values.get(name)) for name in self._names]))
        self._stream.flush()

    def close(self) -> None:
        """Close the file; a later `append` would fail."""
        if self._stream is not None:
            self._stream.close()

    def _widen(self, fresh: Sequence[str]) -> None:
        """Put new columns behind the others, with empty cells in the rows written before."""
        self.close()
        old = self._path.read_text().splitlines()[1:] if self._names else []
        self._names += fresh
        padding = "," * len(fresh)
        write_text(self._path, _line(self._names) + "".join(f"{line}{padding}\n" for line in old))
        self._stream = self._path.open("a", newline="")


def _cell(value: float | None) -> str:
    """Return the shortest text that reads back as the same number, nothing for None."""
    return "" if value is None else repr(float(value))


def _line(cells: Sequence[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()


def read_history(path: Path) -> dict[str, Floats]:
    """Read the columns of a history file; an empty cell is nan.

    A last line without its line end was cut off by a kill and is left out.

    Raises
    ------
    NmmError
        When a line has another number of cells than the header, or a cell is not a number.
    """
    if not path.exists():
        return {}
    text = path.read_text()
    lines = list(csv.reader(text[: text.rfind("\n") + 1].splitlines()))
    if not lines:
        return {}
    names, body = lines[0], lines[1:]
    table = np.full((len(body), len(names)), np.nan)
    for number, cells in enumerate(body):  # text to numbers, once at reading
        table[number] = _numbers(path, number + 2, cells, len(names))
    return {name: table[:, column] for column, name in enumerate(names)}


def _numbers(path: Path, line: int, cells: Sequence[str], expected: int) -> list[float]:
    if len(cells) != expected:
        raise NmmError(
            f"{os.fspath(path)}, line {line}: {len(cells)} cells: expected {expected} as in the "
            "header: restore the file or delete the line"
        )
    try:
        return [float(cell) if cell else np.nan for cell in cells]
    except ValueError as fault:
        raise NmmError(f"{os.fspath(path)}, line {line}: {fault}: expected a number") from fault
