"""What tables of splitting must not contradict; works on unvalidated tables."""

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]


def splitting_contradictions(data: Mapping[str, Any]) -> Iterator[Finding]:
    """Yield materials that do not exist, and what blocks cannot split without or beside."""
    named, materials = data.get("splitting"), data.get("materials")
    if not isinstance(named, Mapping) or not named:
        return
    known = list(materials) if isinstance(materials, Mapping) else []
    for name in named:
        if name not in known:
            expected = "the name of a material"
            yield ("splitting", name), f'"{name}"', expected, suggestion(name, known)
    if "contact" not in data:
        remedy = "add [contact] and an interface, through which the pieces meet"
        yield ("splitting",), "no [contact]", "a scene with contact", remedy
    if data.get("stages"):
        remedy = "remove [splitting], or [[stages]]"
        yield ("splitting",), "[splitting] with [[stages]]", "one of the two", remedy
