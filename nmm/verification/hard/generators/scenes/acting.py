"""What acts on random scenes: loads, motions, members, water and heat, each drawn by itself."""

from collections.abc import Callable
from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import DENSITY, Site


def loads(site: Site) -> Document:
    """Return one to three loads of any kind."""
    kinds = ["edge", "point", "body", "pressure", *["moving"] * site.moves]
    made: list[dict[str, Any]] = []
    for number in range(int(site.random.integers(1, 4))):
        kind = site.one_of(*kinds)
        table: dict[str, Any] = {"name": f"load {number}", "kind": kind}
        stress = site.stress
        if kind == "edge":
            table |= {"segment": site.top, "traction": site.vector(stress)}
        elif kind == "point":
            table |= {"point": site.top[1], "force": site.vector(0.1 * stress * site.height)}
        elif kind == "body":
            table |= {"block": site.blocks[0], "density": site.vector(stress / site.height)}
        elif kind == "pressure":
            table |= {"segment": site.right, "pressure": stress}
        else:
            table |= {"segment": site.top, "force": site.vector(0.1 * stress * site.height)}
            table |= {"speed": site.width / (10 * site.step), "spread": 0.2 * site.width}
        if kind != "moving" and site.seldom(0.25):
            table["history"] = site.history()
        made.append(table)
    return {"loads": made}


def weight(site: Site) -> Document:
    """Return weight, of any direction in some."""
    size = site.stress / DENSITY / site.height
    way = site.vector(size) if site.seldom(0.3) else [0.0, -size]
    return {"gravity": {"acceleration": way}}


def given_stress(site: Site) -> Document:
    """Return a stress of the start."""
    stress = [*site.vector(site.stress), float(0.3 * site.stress)]
    return {"initial_stresses": [{"block": "all", "stress": stress}]}


def moved_support(site: Site) -> Document:
    """Return a part of the top that is moved by some strain."""
    table: dict[str, Any] = {"name": "pushed", "segment": site.top, "fix": ["x", "y"]}
    table["displacement"] = site.vector(1e-4 * site.height)
    if site.moves or site.seldom(0.3):
        table["history"] = site.history()
    return {"supports": [table]}


def shaken(site: Site) -> Document:
    """Return a record that the foot follows."""
    peak = float(0.02 * site.height / (8 * site.step) ** 2)
    samples = [[0.0, 0.0], [3 * site.step, peak], [8 * site.step, -peak]]
    foot = [[0.0, 0.0], [site.width, 0.0]]
    held = {"name": "held", "segment": foot, "fix": ["x", "y"], "motion": {"x": "quake"}}
    return {"records": {"quake": {"samples": samples}}, "supports": [held]}


def members(site: Site) -> Document:
    """Return springs, bars with dowels or bond, dashpots, masses and foundations, some of them."""
    stiff, h, w = 0.01 * site.modulus, site.height, site.width
    inside = [[0.3 * w, 0.15 * h], [0.55 * w, 0.85 * h]]
    bar: dict[str, Any] = {
        **{"name": "bolt", "points": inside, "diameter": 0.02 * h},
        **{"young_modulus": 10 * site.modulus, "yield_stress": 5e-3 * site.modulus},
    }
    if site.seldom(0.6):
        slips = [1e-4 * h, 2e-3 * h]
        bar["bond"] = {"law": "bilinear", "strength": 1e-4 * site.modulus, "slips": slips}
        if site.seldom(0.5):
            bar["dowel"] = {"bedding_stiffness": 0.1 * site.modulus}
            if site.seldom(0.5):
                bar["dowel"]["yield_force"] = 1e-6 * site.modulus * h
    spring: dict[str, Any] = {
        **{"name": "spring", "points": [site.top[1], [1.5 * w, 1.2 * h]]},
        **{"blocks": [site.corners[1], "ground"], "stiffness": stiff},
        **{"carries": site.one_of("both", "tension", "compression")},
    }
    if site.seldom(0.3):
        spring["yield_force"] = 1e-5 * site.modulus * h
    made: Document = {
        "springs": [spring],
        "bars": [bar],
        "masses": [
            {"name": "mass", "point": inside[1], "mass": 0.1 * DENSITY * h * w},
        ],
        "foundations": [
            {
                **{"name": "soil", "segment": site.right, "normal_stiffness": stiff / h},
                **{"shear_stiffness": 0.5 * stiff / h},
                "carries": site.one_of("both", "compression"),
            }
        ],
    }
    if site.moves:
        viscosity = 0.1 * (site.modulus * DENSITY) ** 0.5 * h
        made["dashpots"] = [
            {
                **{"name": "damper", "points": [site.top[0], [-0.5 * w, 1.1 * h]]},
                **{"blocks": [site.corners[0], "ground"], "viscosity": viscosity},
            }
        ]
    chosen = {key: value for key, value in made.items() if site.seldom(0.45)}
    weighs = site.moves or "masses" not in chosen
    return chosen if weighs else {**weight(site), **chosen}


def damping(site: Site) -> Document:
    """Return damping by mass, stiffness, both, or local."""
    rate = 0.1 / (8 * site.step)
    kinds: list[Document] = [
        {"mass": rate},
        {"stiffness": 0.2 * site.step},
        {"mass": rate, "stiffness": 0.1 * site.step},
        {"local": 0.3},
    ]
    return {"damping": kinds[int(site.random.integers(len(kinds)))]}


def boundary(site: Site) -> Document:
    """Return an edge that lets waves go."""
    return {"viscous_boundaries": [{"name": "beyond", "segment": site.right}]}


def water(site: Site) -> Document:
    """Return water that presses on an edge, to a level or linear."""
    unit = site.stress / site.height
    table: dict[str, Any] = {"name": "lake", "segment": site.left, "unit_weight": unit}
    if site.seldom(0.5):
        return {"water_pressures": [{**table, "level": 0.7 * site.height}]}
    del table["unit_weight"]
    return {"water_pressures": [{**table, "pressures": [site.stress, 0.0]}]}


def heat(site: Site) -> Document:
    """Return heat that flows through from a warm edge."""
    table: dict[str, Any] = {"transient": site.seldom(0.5)}
    if table["transient"] and not site.moves:
        table["duration"] = 1e3 * site.height**2
    warm = {"name": "warm", "segment": site.left, "temperature": 20.0}
    made: Document = {"heat": table, "temperatures": [warm]}
    if site.seldom(0.5):
        cold = {"name": "air", "segment": site.right, "coefficient": 5.0, "temperature": -5.0}
        made["convections"] = [cold]
    if site.seldom(0.3):
        made["heat_sources"] = [{"name": "source", "power": 3.0}]
    return made


def seepage(site: Site) -> Document:
    """Return water that seeps through from an edge with a higher head."""
    unit = site.stress / site.height
    table: dict[str, Any] = {"unit_weight": unit, "transient": site.seldom(0.4)}
    h = site.height
    if table["transient"]:
        table |= {"initial": 0.3 * h}
        table |= {} if site.moves else {"duration": 1e3 * h}
    heads = [
        {"name": "high", "segment": site.left, "head": h},
        {"name": "low", "segment": site.right, "head": 0.3 * h},
    ]
    return {"seepage": table, "heads": heads}


def joint_water(site: Site) -> Document:
    """Return water in joints, with heads along two edges."""
    h = site.height
    heads = [
        {"name": "in", "segment": site.left, "head": 0.9 * h},
        {"name": "out", "segment": site.right, "head": 0.5 * h},
    ]
    return {"joint_flow": {"unit_weight": site.stress / h}, "joint_heads": heads}


def grown(site: Site) -> Document:
    """Return cracks that grow, or cohesive zones."""
    piece = 0.1 * site.height
    if site.seldom(0.6):
        energy = site.modulus * 1e-8 * site.height
        kinds = ("hoop_stress", "strain_energy_density", "energy_release", "straight_ahead")
        table = {"criterion": site.one_of(*kinds), "energy": energy, "increment": piece}
        if not site.moves and site.seldom(0.4):
            table["control"] = "toughness"
        return {"fracture": {**table, "max_growth": 2 * piece}}
    return {"cohesive_zones": {"increment": piece, "ahead": 0.5, "max_growth": 2 * piece}}


def split(site: Site) -> Document:
    """Return a strength of the blocks beyond which they split."""
    strength = 3e-4 * site.modulus
    table = {"tensile_strength": strength, "cohesion": 3 * strength, "friction_angle": 0.5}
    return {"splitting": {"rock": {**table, "smallest_block": 0.15 * site.height}}}


SHARES: dict[str, tuple[Callable[[Site], Document], float]] = {
    "loads": (loads, 0.7),
    "weight": (weight, 0.5),
    "given stress": (given_stress, 0.12),
    "moved support": (moved_support, 0.12),
    "members": (members, 0.2),
    "water": (water, 0.12),
    "heat": (heat, 0.1),
    "seepage": (seepage, 0.08),
}
"""What may act in any scene, and how often it does."""

IN_TIME: dict[str, tuple[Callable[[Site], Document], float]] = {
    "damping": (damping, 0.2),
    "boundary": (boundary, 0.1),
}
"""What acts on inertia."""
