"""Numbers of files beside a scene, read into it, so that a scene is complete by itself.

Run folders, hashes and published cases then contain the numbers and depend on no other file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from pydantic_core import PydanticCustomError

from nmm.errors import Fault, SceneError
from nmm.scene.tables.loading.columns import PEER_ENDINGS, record_of, rows_of
from nmm.scene.tables.loading.fields import check_rows

if TYPE_CHECKING:
    from nmm.scene.faults import Source
    from nmm.scene.tables.loading.fields import FieldTable
    from nmm.scene.tables.shaking.records import RecordTable

Table = TypeVar("Table", "RecordTable", "FieldTable")


def with_numbers(
    records: Mapping[str, RecordTable], fields: Mapping[str, FieldTable], source: Source
) -> tuple[dict[str, RecordTable], dict[str, FieldTable]]:
    """Return the tables of a scene, those that name files with their numbers instead.

    Raises
    ------
    SceneError
        All faults of all files, by their line and that of the scene.
    """
    faults: list[Fault | str] = []
    read = (
        _all("records", records, _record, source, faults),
        _all("fields", fields, _field, source, faults),
    )
    if faults:
        raise SceneError(*faults)
    return read


def _all(
    kind: str,
    tables: Mapping[str, Table],
    read: Callable[[Table, Path], Table],
    source: Source,
    faults: list[Fault | str],
) -> dict[str, Table]:
    """Read the files of tables, and collect faults."""
    found, folder = dict(tables), Path(source.name).parent
    for name, table in tables.items():
        if table.file is not None:
            try:
                found[name] = read(table, folder / table.file)
            except SceneError as error:
                place = source.place(kind, name, "file")
                faults += [f"{place}: {fault}" for fault in error.faults]
    return found


def _record(table: RecordTable, path: Path) -> RecordTable:
    _refuse_peer(table, path)
    pairs, values = record_of(path, table.step)
    if len(pairs) + len(values) < 2:
        remedy = "give the whole record"
        raise SceneError(Fault(str(path), "one value", "at least two", remedy))
    own = {"file": None, "samples": tuple(pairs) or None, "values": tuple(values) or None}
    return table.model_copy(update=own)


def _refuse_peer(table: RecordTable, path: Path) -> None:
    """Refuse keys that contradict a file of PEER's data base, and a missing unit.

    Its numbers are in g, cm/s or cm, so that a missing unit must not mean SI.
    """
    holds = PEER_ENDINGS.get(path.suffix.lower())
    if holds is None:
        return
    if table.quantity != holds:
        found, remedy = f'quantity = "{table.quantity}"', f'write quantity = "{holds}"'
        raise SceneError(Fault(str(path), found, f'"{holds}", as it ends', remedy))
    if table.unit is None:
        remedy = 'write for example unit = "g", or "cm/s", "cm"'
        raise SceneError(Fault(str(path), "no unit", "that of its third line", remedy))
    if table.step is not None:
        found, expected = f"step = {table.step:g}", "none, as the file says its own"
        raise SceneError(Fault(str(path), found, expected, "remove step"))


def _field(table: FieldTable, path: Path) -> FieldTable:
    rows = rows_of(path)
    numbers = tuple(tuple(row) for _, row in rows)
    try:
        check_rows(numbers)
    except PydanticCustomError as error:
        said = error.context or {}
        told = (str(said[key]) for key in ("value", "expected", "remedy"))
        raise SceneError(Fault(str(path), *told)) from None
    return table.model_copy(update={"file": None, "rows": numbers})
