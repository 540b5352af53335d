"""Which effects there are, and those of one's own.

An effect that a scene does not name is not imported.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from pydantic import ValidationError

from nmm.effects.base import Effect, Setup
from nmm.errors import Fault, FormulationError, NmmError, SceneError
from nmm.model.called_for import CALLS
from nmm.model.origin import shifted
from nmm.registry import Registry
from nmm.scene.fields import Frozen

if TYPE_CHECKING:
    from nmm.scene.model import Scene

EFFECTS: Registry[type[Effect]] = Registry(
    "effect",
    Effect,
    {
        "initial velocity": "nmm.effects.initial.initial_velocity:InitialVelocity",
        "initial stress": "nmm.effects.initial.initial_stress:InitialStress",
        "changed materials": "nmm.effects.initial.changed_materials:ChangedMaterials",
        "gravity": "nmm.effects.gravity:Gravity",
        "heat": "nmm.heat.temperature:Heat",
        "seepage": "nmm.water.seepage:Seepage",
        "consolidation": "nmm.water.consolidation:Consolidation",
        "joint flow": "nmm.water.joints.steady_flow:JointFlow",
        "transient joint flow": "nmm.water.joints.storage:JointStorage",
        "water pressures": "nmm.water.pressures:WaterPressures",
        "loads": "nmm.effects.loading.loads:Loads",
        "body loads": "nmm.effects.loading.body_loads:BodyLoads",
        "field loads": "nmm.effects.loading.field_loads:FieldLoads",
        "pressures": "nmm.effects.loading.pressures:SurfacePressures",
        "moving loads": "nmm.effects.loading.moving_loads:MovingLoads",
        "supports": "nmm.constraints.supports:Supports",
        "bonded interfaces": "nmm.constraints.ties.bonded_interfaces:BondedInterfaces",
        "inertia": "nmm.effects.inertia:Inertia",
        "viscous boundaries": "nmm.effects.motion.viscous_boundaries:ViscousBoundaries",
        "free fields": "nmm.effects.motion.free_fields:FreeFields",
        "viscous damping": "nmm.effects.damping.viscous:ViscousDamping",
        "damping against the ground": "nmm.effects.damping.viscous:GroundDamping",
        "local damping": "nmm.effects.damping.local:LocalDamping",
        "springs": "nmm.effects.members.springs:PointSprings",
        "dashpots": "nmm.effects.members.dashpots:PointDashpots",
        "bars": "nmm.effects.members.bars:BarMembers",
        "dowels": "nmm.effects.members.dowels:Dowels",
        "foundations": "nmm.effects.members.foundations:Foundations",
        "masses": "nmm.effects.members.masses:PointMasses",
        "contact": "nmm.effects.contact:Contact",
        "fracture": "nmm.fracture.growth.crack_growth:CrackGrowth",
        "fracture in time": "nmm.fracture.growth.motion.in_time:GrowthInTime",
        "cohesive zones": "nmm.fracture.cohesive.zones:CohesiveZones",
        "splitting": "nmm.splitting.splitting:Splitting",
        "unreleased forces": "nmm.effects.unreleased:UnreleasedForces",
        "artificial joints": "nmm.constraints.ties.artificial_joints:ArtificialJoints",
    },
)
"""Built-in effects by name, or a user's own."""

OWN_EFFECTS: Registry[type[Effect]] = Registry("effect", Effect)
"""Those of installed packages, or a user's own."""

GLUE = "artificial joints"
"""Not the scene's but the formulation's: what holds sub-blocks together."""

OWN = "effects."
"""Before the names of effects of one's own, which are those of their tables."""


def own_effect(scene: "Scene", name: str) -> tuple[type[Effect], Frozen]:
    """Return the class and the table, as its class reads it, of ``[effects.NAME]``.

    Raises
    ------
    FormulationError
        When the class is not known, or may not or cannot be imported.
    SceneError
        All keys of the table that it refuses, one line each.
    """
    from nmm.scene.faults import report

    table = scene.effects[name]
    if table.type in EFFECTS.table:
        remedy = f"built-in effects have tables of their own: write {_table_of(table.type)}"
        fault = Fault("type", f'"{table.type}"', 'an effect of your own, "module:Class"', remedy)
        raise FormulationError(fault)
    kind = OWN_EFFECTS.load(table.type)
    source = replace(scene.source, root=(*scene.source.root, "effects", name))
    try:
        return kind, kind.Table.model_validate(table.given)
    except ValidationError as error:
        raise SceneError(*report(error, kind.Table, source)) from None


def _table_of(name: str) -> str:
    """Return in words what calls for a built-in effect."""
    return "[formulation.glue]" if name == GLUE else CALLS[name].key


def with_table(setup: Setup, effect: str) -> Setup:
    """Return what an effect is built from: with its table where it is one of one's own."""
    if not effect.startswith(OWN):
        return setup
    _, table = own_effect(setup.scene, effect.removeprefix(OWN))
    moved: Any = shifted(table, -setup.origin) if setup.origin.any() else table
    return replace(setup, table=moved)


def make_own(setup: Setup, name: str) -> Effect:
    """Build the effect of a table of one's own.

    Raises
    ------
    NmmError
        When it cannot be built.
    """
    kind, _ = own_effect(setup.scene, name)
    try:
        return kind.from_setup(with_table(setup, OWN + name))
    except NmmError:
        raise
    except Exception as error:  # the code of an effect may raise anything
        place = setup.scene.source.place("effects", name)
        why = f"{type(error).__name__}: {' '.join(str(error).split())}"
        expected = "an effect that can be built"
        raise SceneError(Fault(place, kind.__name__, expected, why)) from error
