"""Seldom keys of heat and water: lines, one pressure, fluxes, slopes, storage, seasons, stages."""

from collections import Counter
from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import Site


def water_lines(scene: Document, site: Site) -> Document:
    """Let water press up to a sloping table, by one pressure, or in a crack."""
    h, unit = site.height, site.stress / site.height
    lake: dict[str, Any] = {"name": "sloping", "segment": site.right}
    if "cracks" in scene and site.seldom(0.6):
        crack = {"name": "pumped", "crack": scene["cracks"][0]["name"], "pressure": site.stress}
        return {"water_pressures": [crack]}
    if site.seldom(0.5):
        line = [[-h, 0.9 * h], [3 * h, 0.4 * h]]
        return {"water_pressures": [{**lake, "phreatic_line": line, "unit_weight": unit}]}
    return {"water_pressures": [{**lake, "pressure": site.stress}]}


def fluxes(scene: Document, site: Site) -> Document:
    """Let heat or water in through the top."""
    made: Document = {}
    if "heat" in scene:
        made["heat_fluxes"] = [{"name": "sun", "segment": site.top, "flux": 200.0 / site.height}]
        heat = {**scene["heat"], "reference": 10.0}
        made["heat"] = {**heat, "initial": 15.0} if heat["transient"] else heat
    if "seepage" in scene:
        made["inflows"] = [{"name": "rain", "segment": site.top, "velocity": 1e-6}]
    return made


def slopes_of_heads(scene: Document, site: Site) -> Document:
    """Let temperatures and heads grow along the edge where they are prescribed."""
    made: Document = {}
    for key, value in (("temperatures", 5.0 / site.height), ("heads", 0.2)):
        if key in scene:
            first, *others = scene[key]
            sloping = {**first, "gradient": [0.0, value], "about": [0.0, 0.5 * site.height]}
            made[f"{key}!"] = [sloping, *others]
    return made


def seeping(scene: Document, site: Site) -> Document:
    """Let water have a free surface, or strain squeeze it out where it is transient."""
    if "seepage" not in scene:
        return {}
    table = dict(scene["seepage"])
    key = "coupled" if table["transient"] and site.seldom(0.7) else "free_surface"
    made: Document = {"seepage": {**table, key: True}}
    if key == "free_surface" and table["transient"]:
        rock = {**scene["materials"]["rock"], "drainable_porosity": 0.2}
        made["materials"] = {**scene["materials"], "rock": rock}
    return made


def stored_in_joints(scene: Document, site: Site) -> Document:
    """Let joints store water, which comes in and goes out at their ends."""
    ends = _ends(scene, site)
    if "joint_flow" not in scene or len(ends) < 2:
        return {}
    heads = [
        {"name": "in", "point": ends[0], "head": 0.9 * site.height},
        {"name": "out", "point": ends[-1], "head": 0.5 * site.height},
    ]
    more: dict[str, Any] = {"transient": True, "initial": 0.3 * site.height, "viscosity": 2e-3}
    if not site.moves:
        more["duration"] = 10.0
    return {"joint_flow": {**scene["joint_flow"], **more}, "joint_heads!": heads}


def _ends(scene: Document, site: Site) -> list[list[float]]:
    """Return the places on the sides and the top of the wall where joints end."""
    corners = Counter(tuple(one) for block in scene["blocks"] for one in block["vertices"])
    return [
        [x, y]
        for (x, y), blocks in corners.items()
        if blocks > 1 and (x in (0.0, site.width) or y == site.height)
    ]


def seasons(scene: Document, site: Site) -> Document:
    """Let temperatures, heads and surroundings follow histories of their own."""
    made: Document = {}
    for key in ("temperatures", "convections", "heat_sources", "heads", "joint_heads"):
        if key in scene:
            first, *others = scene[key]
            made[f"{key}!"] = [{**first, "history": site.history()}, *others]
    if "water_pressures" in scene and site.seldom(0.5):
        tables = scene["water_pressures"]
        made["water_pressures!"] = [{**one, "history": site.history()} for one in tables]
    return made


def by_stages(scene: Document, site: Site) -> Document:
    """Let what heats and wets act in some stages alone."""
    if "stages" not in scene:
        return {}
    kinds = {
        "heat": ("temperatures", "heat_fluxes", "heat_sources", "convections"),
        "water": ("water_pressures", "heads", "inflows", "joint_heads"),
    }
    first, second, *others = scene["stages"]
    for key, tables in kinds.items():
        names = [one["name"] for table in tables for one in scene.get(table, [])]
        if names:
            second = {**second, key: [name for name in names if site.seldom(0.5)]}
    return {"stages!": [first, second, *others]} if {"heat", "water"} & set(second) else {}
