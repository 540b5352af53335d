"""What other tables of a drawn scene rule out is left out of it: refusals show little."""

from collections import Counter

import numpy as np

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.oracles.seen_again import LAWS

OF_BONDS = ("dissipation", "events")
"""Controls that follow bonds as they break."""


def possible(scene: Document) -> Document:
    """Return a scene without the paths, parts, bonds and heads that it would be refused for."""
    return _with_heads_at_joints(_with_whole_cracks(_linear_parts(_with_a_path(scene))))


def _with_a_path(scene: Document) -> Document:
    """Paths are followed in matter that is linear, and some along bonds alone."""
    control = scene.get("loading", {}).get("control")
    if control is None:
        return scene
    bonded = any(table.get("bonded") for table in scene["interfaces"].values())
    apart = len(scene["blocks"]) > 1 or bool({"tessellations", "joint_sets"} & set(scene))
    follows = control["type"] not in OF_BONDS or (bonded and apart)
    held = [scene["formulation"].get(part, {}).get("method") for part in ("supports", "glue")]
    follows = follows and "lagrange" not in held
    if follows and _laws(scene) <= set(LAWS):
        return scene
    loading = {key: value for key, value in scene["loading"].items() if key != "control"}
    return {**scene, "loading": {**loading, "maximum_factor": 20.0}}


def _linear_parts(scene: Document) -> Document:
    """Some parts ask for matter that is linear, and terms of bonds for whole volumes too."""
    formulation, laws = scene["formulation"], _laws(scene)
    ruled_out: list[tuple[str, str, str]] = []
    if not laws <= set(LAWS):
        ruled_out += [("contact", "bonds", "nitsche"), ("glue", "method", "nitsche")]
        ruled_out += [("cover", "volumetric", "projected"), ("supports", "method", "nitsche")]
    elif formulation.get("cover", {}).get("volumetric") == "projected":
        ruled_out += [("contact", "bonds", "nitsche")]
    if not laws <= {"elastic", "neo_hookean"} or "fracture" in scene:
        ruled_out += [("rotation", "update", "finite"), ("integrator", "type", "energy_momentum")]
    for table, key, value in ruled_out:
        formulation = _without(formulation, table, key, value)
    return {**scene, "formulation": formulation}


def _without(formulation: Document, table: str, key: str, value: str) -> Document:
    """Leave a key out of a table where it has a value."""
    found = formulation.get(table, {})
    if found.get(key) != value:
        return formulation
    return {**formulation, table: {name: one for name, one in found.items() if name != key}}


def _laws(scene: Document) -> set[str]:
    return {table.get("law", "elastic") for table in scene["materials"].values()}


def _with_whole_cracks(scene: Document) -> Document:
    """Faces of cracks are bonded where an interface is."""
    if any(table.get("bonded") for table in scene["interfaces"].values()):
        return scene
    cracks = scene.get("cracks", [])
    if not any(crack.get("bonded") for crack in cracks):
        return scene
    return {**scene, "cracks": [{**crack, "bonded": False} for crack in cracks]}


def _with_heads_at_joints(scene: Document) -> Document:
    """Joints take their heads where they end; without any they carry no water."""
    ends = _ends(scene)
    heads = [one for one in scene.get("joint_heads", []) if "point" in one or _ended(one, ends)]
    if "joint_flow" not in scene or len(heads) == len(scene["joint_heads"]):
        return scene
    if heads:
        return {**scene, "joint_heads": heads}
    return {key: value for key, value in scene.items() if key not in ("joint_flow", "joint_heads")}


def _ends(scene: Document) -> list[tuple[float, float]]:
    """Return the corners that blocks share."""
    corners = Counter((x, y) for block in scene["blocks"] for x, y in block["vertices"])
    return [corner for corner, blocks in corners.items() if blocks > 1]


def _ended(head: Document, ends: list[tuple[float, float]]) -> bool:
    """Say whether a joint ends on the segment of a head, which is upright."""
    (x, low), (_, high) = head["segment"]
    low, high = sorted((low, high))
    return any(np.isclose(x, at) and low <= y <= high for at, y in ends)
