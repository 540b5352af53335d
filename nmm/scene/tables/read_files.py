"""What a scene takes from files beside it, taken into it: a scene is complete by itself.

Run folders, hashes and published cases then hold the numbers and depend on no other file.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from nmm.errors import Fault, SceneError
from nmm.scene.tables.columns import all_faults, record_of

if TYPE_CHECKING:
    from nmm.scene.faults import Source
    from nmm.scene.model import Scene
    from nmm.scene.tables.records import RecordTable


def with_files(scene: Scene, source: Source) -> Scene:
    """Return a scene with the numbers of the files that it names.

    Raises
    ------
    SceneError
        Every fault of every file, by its line.
    """
    folder, errors = Path(source.name).parent, list[SceneError]()
    records: dict[str, RecordTable] = {}
    for name, table in scene.records.items():
        records[name] = table
        if table.file is not None:
            try:
                records[name] = _read(table, folder / table.file, source, name)
            except SceneError as error:
                errors.append(error)
    if errors:
        raise SceneError(*all_faults(errors))
    return scene.model_copy(update={"records": records})


def _read(table: RecordTable, path: Path, source: Source, name: str) -> RecordTable:
    pairs, values = record_of(path, table.step)
    if len(pairs) + len(values) < 2:
        place, found = source.place("records", name, "file"), f"{path}: one value"
        raise SceneError(Fault(place, found, "at least two", "give the whole record"))
    read: dict[str, Any] = {"file": None, "samples": tuple(pairs) or None}
    return table.model_copy(update={**read, "values": tuple(values) or None})
