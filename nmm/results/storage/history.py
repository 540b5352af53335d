"""The history file: one line a step, handed to the system whole, so that a kill leaves lines.

A line is one write; where the disk takes a part of it only, that part is taken back.
"""

import csv
import io
import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from nmm.errors import DamageError
from nmm.plain_file import plain
from nmm.results.storage.writing import told, write_text


class HistoryFile:
    """Writer of `history.csv`.

    The first row fixes the header. A row with new names rewrites the file once with the longer
    header; a value that a row does not give is an empty cell.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._names: list[str] = []
        self._handle: int | None = None
        self._size = 0

    @property
    def columns(self) -> tuple[str, ...]:
        """Names in the head so far."""
        return tuple(self._names)

    @classmethod
    def cut(cls, path: Path, columns: Sequence[str], rows: int) -> "HistoryFile":
        """Return the writer of a file that goes on after its first rows, under these columns.

        Raises
        ------
        DamageError
            When it holds fewer rows, or rows of other columns.
        """
        made = cls(path)
        if not columns:
            path.unlink(missing_ok=True)
            return made
        with told(path):
            text = plain(path).read_text("utf-8", errors="replace") if path.exists() else ""
        lines = text.split("\n")[:-1][: rows + 1]
        if faults := read_history(path, "\n".join([*lines, ""]))[1]:
            raise DamageError(faults[0])
        table = list(csv.reader(lines))
        wide = len(columns)
        if len(table) <= rows or table[0][:wide] != list(columns):
            raise DamageError(
                f"{path}: {max(len(table) - 1, 0)} lines of it can be read: expected the {rows} "
                "before the checkpoint under the same columns: restore it or run the scene again"
            )
        # Columns that came later stand behind the others.
        content = "".join(_line(cells[:wide]) for cells in table)
        write_text(path, content)
        made._open(list(columns), len(content.encode()))
        return made

    def append(self, values: Mapping[str, float]) -> None:
        """Hand one row to the system.

        Raises
        ------
        StorageError
            When the system refuses; the rows before are left.
        """
        fresh = [name for name in values if name not in self._names]
        if fresh:
            self._widen(fresh)
        assert self._handle is not None
        line = _line([_cell(values.get(name)) for name in self._names]).encode()
        with told(self.path):
            try:
                _write(self._handle, line)
            except BaseException:
                with suppress(OSError):
                    os.ftruncate(self._handle, self._size)
                raise
        self._size += len(line)

    def close(self) -> None:
        """Close the file; a later `append` would fail."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None

    def _widen(self, fresh: Sequence[str]) -> None:
        """Put new columns behind the others, with empty cells in the rows written before."""
        header = _line(self._names) if self._names else ""
        with told(self.path):
            old = self.path.read_text()[len(header) :].split("\n")[:-1] if header else []
        names, padding = [*self._names, *fresh], "," * len(fresh)
        content = _line(names) + "".join(f"{line}{padding}\n" for line in old)
        write_text(self.path, content)
        self._open(names, len(content.encode()))

    def _open(self, names: list[str], size: int) -> None:
        """Append from now on to what stands in the file."""
        self.close()
        with told(self.path):
            self._handle = os.open(self.path, os.O_WRONLY | os.O_APPEND)
        self._names, self._size = names, size


def _write(handle: int, line: bytes) -> None:
    while line:  # once, unless the disk takes a part only
        line = line[os.write(handle, line) :]


def _cell(value: float | None) -> str:
    """Return the shortest text that reads back as the same number, nothing for None."""
    return "" if value is None else repr(float(value))


def _line(cells: Sequence[str]) -> str:
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="\n").writerow(cells)
    return buffer.getvalue()


def read_history(path: Path, text: str) -> tuple[dict[str, Floats], list[str]]:
    """Read the columns of a history file; an empty cell is nan.

    A last line without its line end was cut off by a kill and is left out.

    Returns
    -------
    The columns by name, and a sentence for each line that was altered, which is left out.
    """
    lines = csv.reader(io.StringIO(text[: text.rfind("\n") + 1], newline=""))
    faults: list[str] = []
    body: list[list[float]] = []
    names: list[str] = []
    try:
        names = next(lines, [])
        for cells in lines:  # text to numbers, once at reading
            row, wrong = _numbers(cells, len(names))
            if wrong:
                faults.append(
                    f"{path}, line {lines.line_num}: {wrong}: the line is left out: restore the "
                    "file or run the scene again"
                )
            else:
                body.append(row)
    except csv.Error as fault:
        faults.append(
            f"{path}, line {lines.line_num}: {fault}: expected lines of numbers: what follows is "
            "left out; restore the file or run the scene again"
        )
    if not names:
        return {}, faults
    table = np.array(body).reshape(len(body), len(names))
    return {name: table[:, column] for column, name in enumerate(names)}, faults


def _numbers(cells: Sequence[str], expected: int) -> tuple[list[float], str]:
    if len(cells) != expected:
        return [], f"{len(cells)} cells: expected {expected} as in the header"
    try:
        return [float(cell) if cell else np.nan for cell in cells], ""
    except ValueError as fault:
        return [], f"{fault}: expected a number"
