"""Seldom keys of shapes: holes, sets of joints, Voronoi blocks."""

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import Site


def holed(scene: Document, site: Site) -> Document:
    """Cut a hole into a single block."""
    if len(scene["blocks"]) > 1 or "cracks" in scene or "bars" in scene:
        return {}
    block, (w, h) = scene["blocks"][0], (site.width, site.height)
    ring = [[0.6 * w, 0.6 * h], [0.8 * w, 0.62 * h], [0.78 * w, 0.8 * h]]
    watched = {"name": "beside", "point": [0.1 * w, 0.9 * h], "block": block["name"]}
    return {"blocks!": [{**block, "holes": [ring]}], "monitors!": [watched]}


def jointed(scene: Document, site: Site) -> Document:
    """Cut all blocks by a set of joints that does not reach through."""
    if (
        "stages" in scene
        or "cracks" in scene
        or len(scene["blocks"]) > 2
        or "control" in scene.get("loading", {})
    ):
        return {}
    table = {"name": "bedding", "dip": 0.3, "spacing": 0.45 * site.height, "seed": 3}
    table |= {"dip_scatter": 0.05, "spacing_scatter": 0.03 * site.height}
    table |= {"origin": [0.5 * site.width, 0.4 * site.height]}
    return {"joint_sets": [table]}


def tessellated(scene: Document, site: Site) -> Document:
    """Put a Voronoi wall in the place of a single block, after all else."""
    taken = ("cracks", "bars", "stages", "fracture", "cohesive_zones", "masses", "springs")
    named = [*scene.get("loads", []), *scene.get("supports", [])]
    named += [*scene.get("dashpots", []), *scene["formulation"]["cover"].get("regions", [])]
    names = {one["block"] for one in named if "block" in one} - {"all"}
    controlled = "control" in scene.get("loading", {})
    block, *others = scene["blocks"]
    if others or any(key in scene for key in taken) or names or controlled or "holes" in block:
        return {}
    table = {"name": "stone", "material": block["material"], "region": block["vertices"]}
    table |= {"blocks": 5, "seed": int(site.random.integers(100)), "shortest_edge": 0.1}
    watched = {"name": "high", "point": [0.31 * site.width, 0.97 * site.height]}
    return {"blocks!": [], "tessellations": [table], "monitors!": [watched]}
