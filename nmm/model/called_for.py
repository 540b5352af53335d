"""What in a scene calls for each built-in effect, in the order in which effects act."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from nmm.scene.model import Scene


class EffectCall(NamedTuple):
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
    "initial velocity": EffectCall("[[initial_velocities]]", lambda s: bool(s.initial_velocities)),
    "initial stress": EffectCall("[[initial_stresses]]", lambda s: bool(s.initial_stresses)),
    "changed materials": EffectCall(
        "[[stages]] with materials", lambda s: any(one.materials for one in s.stages)
    ),
    "gravity": EffectCall("[gravity]", lambda s: s.gravity is not None),
    "heat": EffectCall("[heat]", lambda s: s.heat is not None),
    "seepage": EffectCall("[seepage]", lambda s: s.seepage is not None and not s.seepage.coupled),
    "consolidation": EffectCall(
        "[seepage] with coupled", lambda s: s.seepage is not None and s.seepage.coupled
    ),
    "joint flow": EffectCall(
        "[joint_flow]", lambda s: s.joint_flow is not None and not s.joint_flow.transient
    ),
    "transient joint flow": EffectCall(
        "[joint_flow] with transient", lambda s: s.joint_flow is not None and s.joint_flow.transient
    ),
    "water pressures": EffectCall("[[water_pressures]]", lambda s: bool(s.water_pressures)),
    "loads": EffectCall(
        "[[loads]] with force or traction",
        lambda s: any(load.force or load.traction for load in s.loads if not load.speed),
    ),
    "body loads": EffectCall(
        '[[loads]] of kind "body"', lambda s: any(load.density is not None for load in s.loads)
    ),
    "field loads": EffectCall(
        "[[loads]] with a field", lambda s: any(load.field is not None for load in s.loads)
    ),
    "pressures": EffectCall(
        '[[loads]] of kind "pressure"', lambda s: any(load.kind == "pressure" for load in s.loads)
    ),
    "moving loads": EffectCall(
        '[[loads]] of kind "moving"', lambda s: any(load.kind == "moving" for load in s.loads)
    ),
    "supports": EffectCall("[[supports]]", lambda s: bool(s.supports)),
    "bonded interfaces": EffectCall(
        "[interfaces.NAME] with bonded, and no [contact]",
        lambda s: s.contact is None and any(one.bonded for one in s.interfaces.values()),
    ),
    "inertia": EffectCall("[inertia]", lambda s: s.inertia is not None),
    "viscous boundaries": EffectCall(
        "[[viscous_boundaries]]", lambda s: bool(s.viscous_boundaries)
    ),
    "free fields": EffectCall("[[free_fields]]", lambda s: bool(s.free_fields)),
    "viscous damping": EffectCall(
        "[damping] with mass, stiffness or ratios, and no ground",
        lambda s: (
            s.damping is not None
            and s.damping.coefficients is not None
            and s.damping.ground is None
        ),
    ),
    "damping against the ground": EffectCall(
        "[damping] with ground", lambda s: s.damping is not None and s.damping.ground is not None
    ),
    "local damping": EffectCall(
        "[damping] with local", lambda s: s.damping is not None and s.damping.local is not None
    ),
    "springs": EffectCall("[[springs]]", lambda s: bool(s.springs)),
    "dashpots": EffectCall("[[dashpots]]", lambda s: bool(s.dashpots)),
    "bars": EffectCall("[[bars]]", lambda s: bool(s.bars)),
    "dowels": EffectCall("[bars.dowel]", lambda s: any(bar.dowel is not None for bar in s.bars)),
    "foundations": EffectCall("[[foundations]]", lambda s: bool(s.foundations)),
    "masses": EffectCall("[[masses]]", lambda s: bool(s.masses)),
    "contact": EffectCall("[contact]", lambda s: s.contact is not None),
    "fracture": EffectCall(
        "[fracture], without [inertia]", lambda s: s.fracture is not None and s.inertia is None
    ),
    "fracture in time": EffectCall(
        "[fracture] and [inertia]", lambda s: s.fracture is not None and s.inertia is not None
    ),
    "cohesive zones": EffectCall("[cohesive_zones]", lambda s: s.cohesive_zones is not None),
    "splitting": EffectCall("[splitting.MATERIAL]", lambda s: bool(s.splitting)),
    "unreleased forces": EffectCall(
        "[[stages]] with release", lambda s: any(one.release is not None for one in s.stages)
    ),
}
"""By the name of the effect."""


def called_for(scene: "Scene") -> dict[str, bool]:
    """Say for every built-in effect whether a scene names it."""
    return {name: call.made_by(scene) for name, call in CALLS.items()}
