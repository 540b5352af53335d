"""What is no table of its own and can be left out: keys within tables of scene and formulation.

Each takes copies of both and returns them changed, None where there is nothing to leave out.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from nmm.model.build import WHERE_GIVEN

Tables = dict[str, Any]
Changed = tuple[Tables, Tables] | None
Change = Callable[[Tables, Tables], Changed]

YIELDS = ("von_mises", "mohr_coulomb", "drucker_prager")
CREEPS = ("maxwell", "kelvin", "standard_solid", "burgers")


def _without_dowels(scene: Tables, formulation: Tables) -> Changed:
    """With bars that joints cross as if they were cables."""
    dowels = [bar.pop("dowel", None) for bar in scene.get("bars", ())]
    return (scene, formulation) if any(dowels) else None


def _released(scene: Tables, formulation: Tables) -> Changed:
    """With all that removed blocks exerted released at once."""
    shares = [stage.pop("release", None) for stage in scene.get("stages", ())]
    named = any(share is not None for share in shares)
    return (scene, formulation) if named else None


def _unchanged(scene: Tables, formulation: Tables) -> Changed:
    """With the materials that blocks have at first."""
    changed = [stage.pop("materials", None) for stage in scene.get("stages", ())]
    return (scene, formulation) if any(changed) else None


def _lasting(scene: Tables, formulation: Tables) -> Changed:
    """With matter that yields and keeps its strength."""
    soft = [one for one in scene.get("materials", {}).values() if "softening_energy" in one]
    for material in soft:
        for key in [key for key in material if key.startswith(("softening_", "residual_"))]:
            del material[key]
    return (scene, formulation) if soft else None


def _elastic(laws: tuple[str, ...], scene: Tables, formulation: Tables) -> Changed:
    """With matter of some laws that is elastic in place of them."""
    found = [one for one in scene.get("materials", {}).values() if one.get("law") in laws]
    for material in found:
        # An angle of axes that such matter has is of its conductivities.
        for key in ("law", *(key for key in WHERE_GIVEN if key != "axis_angle")):
            material.pop(key, None)
    return (scene, formulation) if found else None


def _frictionless(scene: Tables, formulation: Tables) -> Changed:
    """Without friction between bodies that may slide; cohesion stays."""
    laws = scene.get("interfaces", {}).values()
    rough = [law for law in laws if law.get("friction_angle")]
    if not rough or "contact" not in scene:
        return None
    for law in rough:
        law["friction_angle"] = 0.0
        law.pop("dilation_angle", None)
    return scene, formulation


def _undamped(scene: Tables, formulation: Tables) -> Changed:
    """With all of the velocity at the end of a step."""
    table = formulation.get("integrator", {})
    if "inertia" not in scene or table.get("kinetic_factor", 1.0) == 1.0:
        return None
    table["kinetic_factor"] = 1.0
    return scene, formulation


def _small(scene: Tables, formulation: Tables) -> Changed:
    """With axes of bodies that stay."""
    table = formulation.setdefault("rotation", {})
    if table.get("update") == "small":
        return None
    table["update"] = "small"
    return scene, formulation


CHANGES: dict[str, Change] = {
    "dowels": _without_dowels,
    "unreleased forces": _released,
    "changed materials": _unchanged,
    "softening of matter": _lasting,
    "yield": partial(_elastic, YIELDS),
    "creep": partial(_elastic, CREEPS),
    "friction": _frictionless,
    "kinetic damping": _undamped,
    "finite rotation": _small,
}
"""By what is left out."""
