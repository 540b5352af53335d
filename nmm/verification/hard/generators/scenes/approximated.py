"""Formulations of random scenes: any cover, enforcement, integrator, solver and imposition."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.cases.parts import (
    BLOCKS,
    enforcements,
    glue_methods,
    integrators,
    integrators_of_contact,
    meshes,
    solvers,
    support_methods,
    with_integrator,
    with_parts,
)
from nmm.verification.hard.generators.scenes.place import Place


def formulated(scene: Document, place: Place, meshed: bool) -> tuple[Document, dict[str, str]]:
    """Return a scene with a formulation, and the parts it names.

    Half of all values are those of the built-in default, so that a part is met beside many others.
    """
    degrees = (0, 1) if place.seldom(0.8) else (2,)
    covers = meshes(float(place.random.uniform(0.4, 0.8)) * place.height, degrees)
    chosen = covers if meshed or place.seldom(0.4) else BLOCKS
    cover = place.one_of(*chosen)
    parts = {"cover": cover}
    values: dict[str, Any] = {"cover": chosen[cover]}
    if "contact" in scene:
        parts["enforcement"] = "penalty" if place.seldom(0.4) else place.one_of(*enforcements())
        if "control" in scene.get("loading", {}):  # paths are followed on springs alone
            parts["enforcement"] = "penalty"
        values["contact.enforcement"] = parts["enforcement"]
        values |= _joints(place)
    elif place.seldom(0.5):
        values["glue.method"] = parts["glue"] = place.one_of(*glue_methods())
    if cover not in BLOCKS and place.seldom(0.4):
        parts["supports"] = place.one_of(*support_methods())
        values["supports.method"] = parts["supports"]
    if place.moves:
        touching = integrators_of_contact() if "contact" in scene else integrators()
        parts["integrator"] = place.one_of(*touching)
        values |= with_integrator(parts["integrator"])
        values["integrator.step"] = "auto" if place.seldom(0.1) else place.step
    elif place.kind == "creep":
        values["integrator.step"] = place.step
    if place.seldom(0.15) and parts.get("integrator") != "energy_momentum":
        values["rotation.update"] = place.one_of("finite", "exact", "small")
    if cover not in BLOCKS and place.seldom(0.05):
        values["cover.volumetric"] = "projected"
    if place.seldom(0.2):
        parts["solver"] = place.one_of(*solvers())
        values["solver.type"] = parts["solver"]
    if not place.moves:
        values["loading.increment"] = float(place.random.choice([1.0, 0.5, 0.3]))
    values["loading.max_steps"] = 40
    return with_parts(scene, values), parts


def _joints(place: Place) -> dict[str, Any]:
    values: dict[str, Any] = {}
    if place.seldom(0.2):
        values["contact.points"] = place.one_of("vertices", "faces")
    if place.seldom(0.2):
        values["contact.joint_points"] = place.one_of("corners", "gauss")
    if place.seldom(0.2):
        values["contact.bonds"] = place.one_of("spring", "nitsche")
    return values
