"""Memory of members that are taken away: one that is put in again is a new one."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.scene.tables.members import DOWEL, MEMBERS

if TYPE_CHECKING:
    from nmm.scene.model import Scene


def without_members_gone(
    memory: Mapping[str, Floats], before: "Scene", now: "Scene"
) -> Mapping[str, Floats]:
    """Return what effects remember without what members knew that ``now`` are there no more.

    Their plastic ways and slips count from a stretch that went with them.
    """
    there = _names(now)
    gone = {name + part for name in _names(before) - there for part in ("", DOWEL)} - there
    return {name: of for name, of in memory.items() if name not in gone} if gone else memory


def _names(scene: "Scene") -> set[str]:
    return {one.name for table in MEMBERS for one in getattr(scene, table)}
