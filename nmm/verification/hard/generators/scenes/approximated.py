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
from nmm.verification.hard.generators.scenes.site import Site


def formulated(scene: Document, site: Site, meshed: bool) -> tuple[Document, dict[str, str]]:
    """Return a scene with a formulation, and the parts it names.

    Half of all values are those of the built-in default, so that a part is met beside many others.
    """
    degrees = (0, 1) if site.seldom(0.8) else (2,)
    covers = meshes(float(site.random.uniform(0.4, 0.8)) * site.height, degrees)
    chosen = covers if meshed or site.seldom(0.4) else BLOCKS
    cover = site.one_of(*chosen)
    parts = {"cover": cover}
    values: dict[str, Any] = {"cover": chosen[cover]}
    if "contact" in scene:
        parts["enforcement"] = "penalty" if site.seldom(0.4) else site.one_of(*enforcements())
        if "control" in scene.get("loading", {}):  # paths are followed on springs alone
            parts["enforcement"] = "penalty"
        values["contact.enforcement"] = parts["enforcement"]
        values |= _joints(site)
    elif site.seldom(0.5):
        values["glue.method"] = parts["glue"] = site.one_of(*glue_methods())
    if cover not in BLOCKS and site.seldom(0.4):
        parts["supports"] = site.one_of(*support_methods())
        values["supports.method"] = parts["supports"]
    if site.moves:
        touching = integrators_of_contact() if "contact" in scene else integrators()
        parts["integrator"] = site.one_of(*touching)
        values |= with_integrator(parts["integrator"])
        values["integrator.step"] = "auto" if site.seldom(0.1) else site.step
    elif site.kind == "creep":
        values["integrator.step"] = site.step
    if site.seldom(0.15) and parts.get("integrator") != "energy_momentum":
        values["rotation.update"] = site.one_of("finite", "exact", "small")
    if cover not in BLOCKS and site.seldom(0.05):
        values["cover.volumetric"] = "projected"
    if site.seldom(0.2):
        parts["solver"] = site.one_of(*solvers())
        values["solver.type"] = parts["solver"]
    if not site.moves:
        values["loading.increment"] = float(site.random.choice([1.0, 0.5, 0.3]))
    values["loading.max_steps"] = 40
    return with_parts(scene, values), parts


def _joints(site: Site) -> dict[str, Any]:
    values: dict[str, Any] = {}
    if site.seldom(0.2):
        values["contact.points"] = site.one_of("vertices", "faces")
    if site.seldom(0.2):
        values["contact.joint_points"] = site.one_of("corners", "gauss")
    if site.seldom(0.2):
        values["contact.bonds"] = site.one_of("spring", "nitsche")
    return values
