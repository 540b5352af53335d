"""All rules of a scene, asked of its tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from pydantic import BaseModel

from nmm.scene.rules.bonds import bonded_crack_contradictions, cohesive_contradictions
from nmm.scene.rules.course import course_contradictions
from nmm.scene.rules.cracks import fracture_contradictions
from nmm.scene.rules.fields import heat_contradictions, water_contradictions
from nmm.scene.rules.matter import matter_contradictions
from nmm.scene.rules.members import member_contradictions
from nmm.scene.rules.motion import motion_contradictions
from nmm.scene.rules.named import name_contradictions
from nmm.scene.rules.output import output_contradictions
from nmm.scene.rules.splitting import splitting_contradictions
from nmm.scene.rules.stages import stage_contradictions
from nmm.scene.rules.strength_reduction import reduction_contradictions
from nmm.scene.rules.unread_tables import Finding, Tables

RULES: tuple[Callable[[Tables], Iterator[Finding]], ...] = (
    name_contradictions,
    matter_contradictions,
    course_contradictions,
    output_contradictions,
    stage_contradictions,
    heat_contradictions,
    water_contradictions,
    motion_contradictions,
    member_contradictions,
    fracture_contradictions,
    bonded_crack_contradictions,
    cohesive_contradictions,
    splitting_contradictions,
    reduction_contradictions,
)


def contradictions(data: object) -> list[Finding]:
    """Return all contradictions of the tables of a scene; malformed entries are skipped."""
    plain = _plain(data)
    if not isinstance(plain, Mapping):
        return []
    return [finding for rule in RULES for finding in rule(plain)]


def _plain(data: object) -> object:
    """Plain tables from tables that may contain models or None, as of a scene built in Python."""
    if isinstance(data, BaseModel):
        return data.model_dump(exclude_unset=True, exclude_none=True, by_alias=True)
    if isinstance(data, Mapping):
        return {key: _plain(value) for key, value in data.items() if value is not None}
    if isinstance(data, list | tuple) and any(isinstance(item, BaseModel) for item in data):
        return [_plain(item) for item in data]
    return data
