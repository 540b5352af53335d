"""Seldom keys of formulations: nets, degrees, factors of springs, masses, ends of steps."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import Site

OPTIONS: dict[str, Document] = {
    "penalty": {"iteration": "settle"},
    "augmented": {"scale": 3.0, "growth": 4.0},
    "lagrange": {"rescue": 50},
    "cone": {"max_factorisations": 60},
    "barrier": {"max_passes": 150},
}
"""Other options of enforcements than the built-in ones."""


def net(scene: Document, site: Site) -> Document:
    """Turn and shift the net."""
    return _meshed(scene, {"angle": 0.3, "shift": [0.3, 0.2]})


def regions(scene: Document, site: Site) -> Document:
    """Let covers near a place, in a polygon or a block have another degree."""
    h = site.height
    near = {"point": [0.5 * site.width, 0.5 * h], "radius": 0.4 * h}
    polygon = {"polygon": [[0.0, 0.0], [site.width, 0.0], [0.0, h]]}
    chosen: list[Document] = [near, polygon, {"block": site.blocks[0]}]
    region = chosen[int(site.random.integers(3))]
    return _meshed(scene, {"regions": [{**region, "degree": 2}]})


def own_net(scene: Document, site: Site) -> Document:
    """Give a block a net of its own."""
    takes_nets = scene["formulation"]["cover"]["type"] in ("triangles", "quads")
    if len(scene["blocks"]) < 2 or not takes_nets:
        return {}
    size = 0.7 * scene["formulation"]["cover"]["size"]
    return _meshed(scene, {"nets": [{"block": site.blocks[0], "size": size, "angle": 0.4}]})


def enriched(scene: Document, site: Site) -> Document:
    """Let more covers, or none, carry functions of tips."""
    if "cracks" not in scene:
        return {}
    wide: Document = {"radius": 0.2 * site.height} if site.seldom(0.6) else {"tips": False}
    return _meshed(scene, {"enrichment": wide})


def springs(scene: Document, site: Site) -> Document:
    """Take other springs of contact and of joints, or options of an enforcement."""
    if "contact" not in scene:
        return {}
    table = dict(scene["formulation"].get("contact", {}))
    kind = table.get("enforcement", "penalty")
    if site.seldom(0.5):
        return _with(scene, "contact", {"options": OPTIONS.get(kind, {})})
    chosen = {"normal_penalty": 30.0, "shear_ratio": 0.4, "bond_stiffness": 2.0}
    return _with(scene, "contact", chosen)


def stiffness(scene: Document, site: Site) -> Document:
    """Take other factors of supports and glue."""
    supports, glue = scene["formulation"].get("supports", {}), scene["formulation"].get("glue", {})
    of_support: dict[str, Document] = {
        "penalty": {"stiffness": 1e3},
        "nitsche": {"gamma": 20.0, "ghost": 0.1},
    }
    of_glue: dict[str, Document] = {"spring": {"stiffness": 1e3}, "nitsche": {"gamma": 8.0}}
    made = _with(scene, "supports", of_support.get(supports.get("method", ""), {}))
    more = of_glue.get(glue.get("method", ""), {})
    return _with({**scene, **made}, "glue", more) if more else made


def in_time(scene: Document, site: Site) -> Document:
    """Lump masses, keep a part of the velocity, take other weights, or ask for an error."""
    if not site.moves:
        return {}
    table = scene["formulation"]["integrator"]
    options: dict[str, Document] = {
        "newmark": {"options": {"beta": 0.3025, "gamma": 0.6}},
        "generalized_alpha": {"options": {"rho_inf": 0.5}},
    }
    more: list[dict[str, Any]] = [{"mass": "lumped"}, options.get(table["type"], {})]
    bound = {"error": 0.05, "error_of": "bodies", "longest": 4 * site.step}
    more.append({"kinetic_factor": 0.9} if table["step"] != "auto" else bound)
    return _with(scene, "integrator", more[int(site.random.integers(3))])


def diffused(scene: Document, site: Site) -> Document:
    """Take the mean of both ends of steps of heat and water, or shorter steps."""
    transient = [scene[key] for key in ("heat", "seepage") if scene.get(key, {}).get("transient")]
    if not transient:
        return {}
    last = transient[0].get("duration", 8 * site.step)
    return _with(scene, "diffusion", {"theta": 0.5, "step": last / 13})


def solved(scene: Document, site: Site) -> Document:
    """Refine solutions more often, or hold increments to less."""
    if site.seldom(0.5) or site.moves:
        return _with(scene, "solver", {"options": {"refinements": 3}})
    return _with(scene, "loading", {"tolerance": 1e-3})


def stored(scene: Document, site: Site) -> Document:
    """Store checkpoints, and what frames hold beside displacement."""
    wanted = {"quantities": ["von_mises", "principal_stress"], "every_steps": 2}
    checkpoint = {"every_steps": 3}
    return {"output": {**wanted, **({"checkpoint": checkpoint} if site.seldom(0.6) else {})}}


def pieces(scene: Document, site: Site) -> Document:
    """Divide bars into other pieces."""
    return _with(scene, "bars", {"pieces": 13}) if "bars" in scene else {}


def _meshed(scene: Document, more: Document) -> Document:
    if scene["formulation"]["cover"]["type"] == "block":
        return {}
    return _with(scene, "cover", more)


def _with(scene: Document, name: str, more: Document) -> Document:
    """Return the formulation with more keys in one of its tables; none where there are none."""
    if not more:
        return {}
    formulation = scene["formulation"]
    return {"formulation": {**formulation, name: {**formulation.get(name, {}), **more}}}
