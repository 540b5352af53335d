"""What in a scene calls for each built-in effect, in the order in which effects act."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from nmm.scene.model import Scene


class Call(NamedTuple):
    """How scenes call for an effect.

    Attributes
    ----------
    key
        In words: the table of a scene file, and what must stand in it.
    made_by
        Whether a scene does.
    """

    key: str
    made_by: Callable[["Scene"], bool]


CALLS = {
    "initial velocity": Call("[[initial_velocities]]", lambda s: bool(s.initial_velocities)),
    "initial stress": Call("[[initial_stresses]]", lambda s: bool(s.initial_stresses)),
    "changed materials": Call(
        "[[stages]] with materials", lambda s: any(one.materials for one in s.stages)
    ),
    "gravity": Call("[gravity]", lambda s: s.gravity is not None),
    "heat": Call("[heat]", lambda s: s.heat is not None),
    "seepage": Call("[seepage]", lambda s: s.seepage is not None and not s.seepage.coupled),
    "consolidation": Call(
        "[seepage] with coupled", lambda s: s.seepage is not None and s.seepage.coupled
    ),
    "joint flow": Call(
        "[joint_flow]", lambda s: s.joint_flow is not None and not s.joint_flow.transient
    ),
    "transient joint flow": Call(
        "[joint_flow] with transient", lambda s: s.joint_flow is not None and s.joint_flow.transient
    ),
    "water pressures": Call("[[water_pressures]]", lambda s: bool(s.water_pressures)),
    "loads": Call(
        "[[loads]] with force or traction",
        lambda s: any(load.force or load.traction for load in s.loads if not load.speed),
    ),
    "body loads": Call(
        '[[loads]] of kind "body"', lambda s: any(load.density is not None for load in s.loads)
    ),
    "field loads": Call(
        "[[loads]] with a field", lambda s: any(load.field is not None for load in s.loads)
    ),
    "pressures": Call(
        '[[loads]] of kind "pressure"', lambda s: any(load.kind == "pressure" for load in s.loads)
    ),
    "moving loads": Call(
        '[[loads]] of kind "moving"', lambda s: any(load.kind == "moving" for load in s.loads)
    ),
    "supports": Call("[[supports]]", lambda s: bool(s.supports)),
    "bonded interfaces": Call(
        "[interfaces.NAME] with bonded, and no [contact]",
        lambda s: s.contact is None and any(one.bonded for one in s.interfaces.values()),
    ),
    "inertia": Call("[inertia]", lambda s: s.inertia is not None),
    "viscous boundaries": Call("[[viscous_boundaries]]", lambda s: bool(s.viscous_boundaries)),
    "free fields": Call("[[free_fields]]", lambda s: bool(s.free_fields)),
    "viscous damping": Call(
        "[damping] with mass, stiffness or ratios, and no ground",
        lambda s: (
            s.damping is not None
            and s.damping.coefficients is not None
            and s.damping.ground is None
        ),
    ),
    "damping against the ground": Call(
        "[damping] with ground", lambda s: s.damping is not None and s.damping.ground is not None
    ),
    "local damping": Call(
        "[damping] with local", lambda s: s.damping is not None and s.damping.local is not None
    ),
    "springs": Call("[[springs]]", lambda s: bool(s.springs)),
    "dashpots": Call("[[dashpots]]", lambda s: bool(s.dashpots)),
    "bars": Call("[[bars]]", lambda s: bool(s.bars)),
    "dowels": Call("[bars.dowel]", lambda s: any(bar.dowel is not None for bar in s.bars)),
    "foundations": Call("[[foundations]]", lambda s: bool(s.foundations)),
    "masses": Call("[[masses]]", lambda s: bool(s.masses)),
    "contact": Call("[contact]", lambda s: s.contact is not None),
    "fracture": Call(
        "[fracture], without [inertia]", lambda s: s.fracture is not None and s.inertia is None
    ),
    "fracture in time": Call(
        "[fracture] and [inertia]", lambda s: s.fracture is not None and s.inertia is not None
    ),
    "cohesive zones": Call("[cohesive_zones]", lambda s: s.cohesive_zones is not None),
    "splitting": Call("[splitting.MATERIAL]", lambda s: bool(s.splitting)),
    "unreleased forces": Call(
        "[[stages]] with release", lambda s: any(one.release is not None for one in s.stages)
    ),
}
"""By the name of the effect."""


def called_for(scene: "Scene") -> dict[str, bool]:
    """Say for every built-in effect whether a scene names it."""
    return {name: call.made_by(scene) for name, call in CALLS.items()}
