"""Files of numbers in columns, with every fault by the line of the file.

Values are separated by blanks, commas, semicolons or tabs. Comments after "#" or "%", empty lines
and a header of words are skipped; words further down are faults.
"""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

from nmm.errors import Fault, SceneError
from nmm.plain_file import plain
from nmm.scene.document import LARGEST_FILE
from nmm.scene.fields import LARGEST

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_PEER = re.compile(r"NPTS\s*=?\s*(\d+)\s*,?.*?DT\s*=?\s*([\d.eE+-]+)", re.IGNORECASE)
PEER_ENDINGS = {".at2": "acceleration", ".vt2": "velocity", ".dt2": "displacement"}
"""Quantity of files of the PEER NGA data base, by their ending."""
# A step longer than this multiple of the median is a gap.
GAP = 1.5

Row = tuple[int, list[float]]


def rows_of(path: Path) -> list[Row]:
    """Return the numbers of each line with numbers, with the number of the line.

    Raises
    ------
    SceneError
        The file does not exist or is no text, or has lines that are no numbers.
    """
    lines = _lines(path)
    faults: list[Fault | str] = []
    found: list[Row] = []
    for number, line in enumerate(lines, start=1):
        text = line.split("#")[0].split("%")[0].strip().strip("\ufeff")
        if not text:
            continue
        try:
            found.append((number, [_number(part) for part in _SEPARATOR.split(text)]))
        except ValueError:
            if found:  # words at the head name the columns
                remedy = "correct the line; comments begin with #"
                faults.append(Fault(f"{path}:{number}", f'"{text[:40]}"', "numbers", remedy))
    if faults:
        raise SceneError(*faults)
    if not found:
        raise SceneError(Fault(str(path), "no number", "columns of numbers", "check the file"))
    return found


def record_of(path: Path, step: float | None) -> tuple[list[tuple[float, float]], list[float]]:
    """Return the pairs of time and value of a file, or its values alone if a step is given.

    Returns
    -------
    pairs, or none and the values at equal steps; of a PEER file pairs.

    Raises
    ------
    SceneError
        By line: no numbers, times that do not increase, gaps, another number of values than said.
    """
    if path.suffix.lower() in PEER_ENDINGS:
        return _peer(path), []
    rows = rows_of(path)
    widths = {len(row) for _, row in rows}
    if step is not None:
        if widths != {1}:
            wide = next(number for number, row in rows if len(row) != 1)
            remedy = "remove step, if the file has times"
            raise _fault(path, wide, "more than one column", "one, as a step is given", remedy)
        return [], [row[0] for _, row in rows]
    for number, row in rows:
        if len(row) != 2:
            remedy = "keep time and value; give a step for a file of one column"
            raise _fault(path, number, f"{len(row)} columns", "two: time and value", remedy)
    _check_times(path, rows)
    return [(row[0], row[1]) for _, row in rows], []


def _peer(path: Path) -> list[tuple[float, float]]:
    lines = _lines(path)
    heads = [(row, _PEER.search(line)) for row, line in enumerate(lines, start=1)]
    number, match = next((one for one in heads if one[1] is not None), (0, None))
    if match is None:
        expected = 'a line "NPTS= ..., DT= ... SEC"'
        raise SceneError(Fault(str(path), "no such line", expected, "check the file"))
    count, step, values = int(match[1]), float(match[2]), list[float]()
    for row, line in enumerate(lines[number:], start=number + 1):
        for part in line.split():
            try:
                values.append(_number(part))
            except ValueError:
                raise _fault(path, row, f'"{part}"', "numbers", "correct the line") from None
    if len(values) != count:
        found = f"{len(values)} values"
        raise _fault(path, number, found, f"{count}, as NPTS says", "restore the missing lines")
    return [(step * i, value) for i, value in enumerate(values)]


def _check_times(path: Path, rows: list[Row]) -> None:
    """Refuse times that do not increase, and gaps, as of missing lines."""
    steps = [after[0] - before[0] for (_, before), (_, after) in pairwise(rows)]
    usual = sorted(steps)[len(steps) // 2] if steps else 0.0
    faults: list[Fault | str] = []
    for (number, row), step in zip(rows[1:], steps, strict=True):
        if step <= 0:
            expected = "times that increase"
            faults.append(_line(path, number, f"t = {row[0]:g}", expected, "sort the lines"))
        elif step > GAP * usual:
            expected = f"the next value {usual:g} s after the last"
            remedy = "restore the missing lines, or give samples in the scene"
            faults.append(_line(path, number, f"a gap of {step:g} s", expected, remedy))
    if faults:
        raise SceneError(*faults)


def _lines(path: Path) -> list[str]:
    try:
        if path.stat().st_size > LARGEST_FILE:
            expected = f"at most {LARGEST_FILE / 1e6:.0f} MB"
            raise SceneError(Fault(str(path), "too long", expected, "cut the file"))
        return plain(path).read_text(encoding="utf-8-sig").splitlines()
    except OSError as cause:
        reason = cause.strerror or str(cause)
        remedy = "check the path, which counts from the scene's folder"
        raise SceneError(Fault(str(path), reason, "a file of numbers", remedy)) from None
    except UnicodeDecodeError:
        raise SceneError(Fault(str(path), "bytes", "text", "save the file as UTF-8")) from None


def _number(text: str) -> float:
    value = float(text)
    if not abs(value) <= LARGEST:
        raise ValueError(text)
    return value


def _line(path: Path, line: int, value: str, expected: str, remedy: str) -> Fault:
    return Fault(f"{path}:{line}", value, expected, remedy)


def _fault(path: Path, line: int, value: str, expected: str, remedy: str) -> SceneError:
    return SceneError(_line(path, line, value, expected, remedy))
