"""Variants of scenes and formulations: values set by dotted keys, and their content hashes."""

import hashlib
import itertools
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import prod
from pathlib import Path
from typing import Any

from nmm.capacity import refuse
from nmm.errors import FormulationError, NmmError
from nmm.formulation import Formulation, as_tables, read_formulation
from nmm.formulation import canonical_text as formulation_text
from nmm.scene import Scene, build_scene
from nmm.scene import canonical_text as scene_text
from nmm.scene.document import build
from nmm.scene.faults import Source
from nmm.study.cases.block_covers import blocks_of
from nmm.study.cases.record import labelled
from nmm.trust import given

SIZE = "formulation.cover.size"
CASE = 1e5
"""Bytes of a case, measured over small scenes and rounded up."""


@dataclass(frozen=True)
class StudyCase:
    """One run of a study.

    Attributes
    ----------
    name
        Formulation's title or file name.
    scene, formulation
        What is run.
    settings
        What this case differs in, by dotted key.
    folder
        Folder of the scene file, where parts of one's own lie; empty when there is no file.
    allow_code
        Modules whose parts may be imported: those that are allowed where the case is made.
    """

    name: str
    scene: Scene
    formulation: Formulation
    settings: Mapping[str, Any] = field(default_factory=dict)
    folder: str = ""
    allow_code: tuple[str, ...] = field(default_factory=lambda: tuple(sorted(given().modules)))

    @property
    def key(self) -> str:
        """Content hash: equal for equal scenes and formulations, whatever their files."""
        content = scene_text(self.scene) + formulation_text(self.formulation)
        return hashlib.sha256(content.encode()).hexdigest()

    @property
    def label(self) -> str:
        """Name and settings in words."""
        return labelled(self.name, self.settings)


def with_settings(case: StudyCase, settings: Mapping[str, Any]) -> StudyCase:
    """Return a case with values changed; keys of formulations begin with ``formulation.``.

    A key is a path through tables and arrays (``tessellations.0.seed``,
    ``formulation.cover.size``).

    Raises
    ------
    NmmError
        When a path leads nowhere, or scene or formulation refuses the value.
    """
    tables = case.scene.model_dump(mode="json", by_alias=True, exclude_none=True)
    method = as_tables(case.formulation)
    for path, value in settings.items():
        first, _, rest = path.partition(".")
        if first == "formulation":
            _set(method, rest, value)
        else:
            _set(tables, path, value)
    return replace(
        case,
        scene=build_scene(tables, case.scene.source.name),
        formulation=build(method, Formulation, Source(case.name), FormulationError),
        settings={**case.settings, **settings},
    )


def cases_of(
    scene: Scene, formulations: Mapping[str, Formulation], vary: Mapping[str, Sequence[Any]]
) -> list[StudyCase]:
    """Return one case for each formulation and combination of values, none of them twice.

    The size of a cover means nothing to blocks: their formulations get no such setting.

    Raises
    ------
    NmmError
        Of a value that a file refuses, and of more cases than memory holds.
    """
    count = len(formulations) * prod(len(values) for values in vary.values())
    refuse("[vary]", f"{count:,} cases", count * CASE, "give fewer values, or fewer keys")
    found: dict[tuple[str, str], StudyCase] = {}
    file = Path(scene.source.name)
    folder = str(file.resolve().parent) if file.is_file() else ""
    for name, formulation in formulations.items():
        kind = blocks_of(formulation.cover)
        blocks = kind is not None and not kind.divides
        for settings in grid(vary):
            apt = {key: value for key, value in settings.items() if not (blocks and key == SIZE)}
            case = with_settings(StudyCase(name, scene, formulation, folder=folder), apt)
            found.setdefault((name, case.key), case)
    return list(found.values())


def read_formulations(paths: Sequence[Path]) -> dict[str, Formulation]:
    """Read formulation files by title, or by file name where they have none or share it."""
    read = [(path, read_formulation(path)) for path in paths]
    titles = [one.title for _, one in read]
    named = {
        one.title if one.title and titles.count(one.title) == 1 else path.stem: one
        for path, one in read
    }
    if len(named) < len(read):
        raise NmmError(
            f"formulations: {', '.join(str(path) for path in paths)}: two have one name: expected "
            "titles that differ: give them"
        )
    return named


def grid(vary: Mapping[str, Sequence[Any]]) -> list[dict[str, Any]]:
    """Return all combinations of the values of several keys."""
    return [dict(zip(vary, values, strict=True)) for values in itertools.product(*vary.values())]


def value_of(text: str) -> Any:
    """Return a value given on a command line: a JSON literal, else the text.

    Text may be a quantity with a unit such as ``2 ms``.
    """
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return text


def _set(tables: Any, path: str, value: Any) -> None:
    *way, last = path.split(".")
    place: Any = tables
    named: Any = tables.get(way[0]) if way and way[0] in ("materials", "interfaces") else None
    try:
        for part in way:
            if isinstance(place, list):
                place = place[int(part)]
            elif place is named:  # a material or interface that the scene does not have
                place = place[part]
            else:
                place = place.setdefault(part, {})
        if isinstance(place, list):
            place[int(last)] = value
        else:
            place[last] = value
    except (KeyError, IndexError, ValueError, TypeError, AttributeError) as fault:
        raise NmmError(
            f"setting {path}: leads nowhere in the file: expected a path of keys and numbers such "
            "as tessellations.0.seed: correct it"
        ) from fault
