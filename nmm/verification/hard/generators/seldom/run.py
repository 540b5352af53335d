"""Seldom keys of how scenes run: growth, stages, splitting, loads that grow alone."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import Site


def growth(scene: Document, site: Site) -> Document:
    """Let cracks begin, divide, or grow together."""
    if "fracture" in scene:
        table = dict(scene["fracture"])
        if site.seldom(0.5):
            strength = 2e-4 * site.modulus
            kind = site.one_of("strength", "coupled")
            table["nucleation"] = {"tensile_strength": strength, "criterion": kind, "number": 1}
        if site.seldom(0.5):
            table["parallel_stress"] = True
        if site.moves:
            table |= {"branching": 0.4, "speed": site.one_of("freund", "rayleigh")}
        else:
            table |= {"together": 0.0}
        return {"fracture": table}
    if "cohesive_zones" in scene:
        more = {"nucleation": True, "length": 0.15 * site.height}
        return {"cohesive_zones": {**scene["cohesive_zones"], **more}}
    return {}


def split_at_elements(scene: Document, site: Site) -> Document:
    """Let blocks split where their stress is largest."""
    tables = scene.get("splitting", {})
    more = {"judged_at": "elements", "most_blocks": 12}
    return {"splitting": {key: {**one, **more} for key, one in tables.items()}} if tables else {}


def scaled(scene: Document, site: Site) -> Document:
    """Let one load grow, the others stand; or show the motion after failure."""
    if site.kind == "failure" and "control" not in scene["loading"] and site.seldom(0.5):
        shown = {"motion_after_failure": 4 * site.step}
        return {"loading": {**scene["loading"], **shown}}
    if site.kind not in ("rest", "failure") or not scene.get("loads"):
        return {}
    name = scene["loads"][0]["name"]
    return {"loading": {**scene.get("loading", {}), "scaled": [name]}}


def staged(scene: Document, site: Site) -> Document:
    """Let stages take time, change matter or the cover, release slowly, count anew."""
    if "stages" not in scene:
        return {}
    first, *others = scene["stages"]
    more: list[dict[str, Any]] = [
        {"reset_displacements": True},
        {"duration": 1.0},
        {"cover": {"degree": 2}} if scene["formulation"]["cover"]["type"] != "block" else {},
        {"materials": {site.blocks[0]: "soft"}},
    ]
    changed = [{**one, **more[int(site.random.integers(4))]} for one in others]
    changed = [{**one, "release": 0.5} if "remove" in one else one for one in changed]
    rock = scene["materials"]["rock"]
    soft = {**rock, "young_modulus": 0.5 * rock["young_modulus"]}
    made: Document = {"stages!": [first, *changed]}
    if any("materials" in one for one in changed):
        made["materials"] = {**scene["materials"], "soft": soft}
    return made
