"""Stages of random scenes: which blocks, loads, supports and members are there in each."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.places import has_place
from nmm.verification.hard.generators.scenes.site import Site

MEMBERS = ("springs", "bars", "masses", "foundations")
STAND = ("water_pressures", "temperatures", "convections", "heads")
"""Tables of which all are there in all stages."""


def staged(scene: Document, site: Site) -> Document:
    """Return two to five stages of a scene that is otherwise whole.

    A block arrives and may leave again; between these loads come and go, as do members and what
    holds another place than the foot. What has no place without the block is there with it alone.
    """
    comes = _comes(scene, site)
    there = tuple(name for name in site.blocks if name != comes)
    stages: list[dict[str, Any]] = [{"name": "one", "loads": []}, {"name": "two"}]
    stages[1] |= _chosen(scene, site)
    if site.seldom(0.5):
        stages.append({"name": "three", **_chosen(scene, site)})
    if comes:
        stages[0] |= {**_placed(scene, there), "blocks": list(there), "loads": []}
        stages[1]["add"] = [comes]
        if site.seldom(0.5):  # forces of a stage fade in the next one, where their place must be
            stages.append({"name": "bare", **_placed(scene, there)})
            stages.append({"name": "end", "remove": [comes]})
    return {"stages": stages}


def _comes(scene: Document, site: Site) -> str:
    """Return the last block without which the foot, and all that stands, has a place; or none."""
    stands = [scene["supports"][0], *(one for key in STAND for one in scene.get(key, []))]
    for last in reversed(site.blocks):
        others = tuple(name for name in site.blocks if name != last)
        if others and all(has_place(one, scene, others) for one in stands):
            return last
    return ""


def _placed(scene: Document, there: tuple[str, ...]) -> dict[str, list[str]]:
    """Return names of all that has a place on the blocks that are there."""
    groups = {"loads": ("loads",), "supports": ("supports",), "members": MEMBERS}
    return {
        key: [
            str(one["name"])
            for table in tables
            for one in scene.get(table, [])
            if has_place(one, scene, there)
        ]
        for key, tables in groups.items()
        if any(scene.get(table) for table in tables)
    }


def _chosen(scene: Document, site: Site) -> dict[str, Any]:
    """Return what is named in a stage of all blocks: each kind is named in about half of them."""
    whole = _placed(scene, site.blocks)
    foot, *others = whole.pop("supports")
    chosen: dict[str, Any] = {
        key: [name for name in names if site.seldom(0.6)]
        for key, names in whole.items()
        if names and site.seldom(0.5)
    }
    if others and site.seldom(0.5):
        chosen["supports"] = [foot, *(name for name in others if site.seldom(0.5))]
    return chosen
