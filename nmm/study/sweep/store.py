"""The folder of a study: one JSON file a case, written as a whole or not at all."""

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from nmm.plain_file import plain
from nmm.study.cases.record import Record
from nmm.study.cases.variants import StudyCase


@dataclass(frozen=True)
class Store:
    """Records of cases, by their content.

    Attributes
    ----------
    folder
        Holds ``KEY.json`` for each case that has been run.
    """

    folder: Path

    def path(self, key: str) -> Path:
        """Return the file of a case."""
        return self.folder / f"{key}.json"

    def keep(self, record: Record) -> None:
        """Write a record; readers see the old file or the whole new one."""
        self.folder.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=self.folder, suffix=".part")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(record.to_json() + "\n")
        os.replace(name, self.path(record.key))

    def find(self, case: StudyCase, quantities: Sequence[str]) -> Record | None:
        """Return the record of a case under its present name; None when it has to be run.

        A file that cannot be read, or lacks a quantity that is asked for, counts as none.
        """
        try:
            record = Record.from_json(plain(self.path(case.key)).read_text(encoding="utf-8"))
        except (OSError, ValueError, TypeError, KeyError):
            return None
        if record.valid and not set(quantities) <= set(record.quantities):
            return None
        return replace(record, name=case.name, settings=dict(case.settings))
