"""Members on a ground that stays while supports follow records."""

from typing import TYPE_CHECKING

from nmm.scene.tables.members import GROUND

if TYPE_CHECKING:
    from nmm.scene.model import Scene


def still_ground(scene: "Scene") -> str:
    """Warn of members whose ground stays where it is beside supports with a motion; else empty."""
    moving = [one.name for one in scene.supports if one.motion]
    ended = (*scene.springs, *scene.dashpots, *scene.bars)
    still = [one.name for one in ended if GROUND in (one.blocks or ())]
    still += [bar.name for bar in scene.bars if GROUND in (bar.ends or ())]
    still = list(dict.fromkeys([*still, *(one.name for one in scene.foundations)]))
    if not moving or not still:
        return ""
    return (
        f"the ground of {', '.join(still)} stays where it is, beside that of support "
        f'"{moving[0]}", which moves: such a member is stretched by the whole way of the record; '
        "where it shall go along, end it on a block of the ground with that support"
    )
