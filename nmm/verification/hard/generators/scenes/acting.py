"""What acts on random scenes: loads, motions, members, water and heat, each drawn by itself."""

from collections.abc import Callable
from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.place import DENSITY, Place


def loads(place: Place) -> Document:
    """Return one to three loads of any kind."""
    kinds = ["edge", "point", "body", "pressure", *["moving"] * place.moves]
    made: list[dict[str, Any]] = []
    for number in range(int(place.random.integers(1, 4))):
        kind = place.one_of(*kinds)
        table: dict[str, Any] = {"name": f"load {number}", "kind": kind}
        stress = place.stress
        if kind == "edge":
            table |= {"segment": place.top, "traction": place.vector(stress)}
        elif kind == "point":
            table |= {"point": place.top[1], "force": place.vector(0.1 * stress * place.height)}
        elif kind == "body":
            table |= {"block": place.blocks[0], "density": place.vector(stress / place.height)}
        elif kind == "pressure":
            table |= {"segment": place.right, "pressure": stress}
        else:
            table |= {"segment": place.top, "force": place.vector(0.1 * stress * place.height)}
            table |= {"speed": place.width / (10 * place.step), "spread": 0.2 * place.width}
        if kind != "moving" and place.seldom(0.25):
            table["history"] = place.history()
        made.append(table)
    return {"loads": made}


def weight(place: Place) -> Document:
    """Return weight, of any direction in some."""
    size = place.stress / DENSITY / place.height
    way = place.vector(size) if place.seldom(0.3) else [0.0, -size]
    return {"gravity": {"acceleration": way}}


def given_stress(place: Place) -> Document:
    """Return a stress of the start."""
    stress = [*place.vector(place.stress), float(0.3 * place.stress)]
    return {"initial_stresses": [{"block": "all", "stress": stress}]}


def moved_support(place: Place) -> Document:
    """Return a part of the top that is moved by some strain."""
    table: dict[str, Any] = {"name": "pushed", "segment": place.top, "fix": ["x", "y"]}
    table["displacement"] = place.vector(1e-4 * place.height)
    if place.moves or place.seldom(0.3):
        table["history"] = place.history()
    return {"supports": [table]}


def shaken(place: Place) -> Document:
    """Return a record that the foot follows."""
    peak = float(0.02 * place.height / (8 * place.step) ** 2)
    samples = [[0.0, 0.0], [3 * place.step, peak], [8 * place.step, -peak]]
    foot = [[0.0, 0.0], [place.width, 0.0]]
    held = {"name": "held", "segment": foot, "fix": ["x", "y"], "motion": {"x": "quake"}}
    return {"records": {"quake": {"samples": samples}}, "supports": [held]}


def members(place: Place) -> Document:
    """Return springs, bars with dowels or bond, dashpots, masses and foundations, some of them."""
    stiff, h, w = 0.01 * place.modulus, place.height, place.width
    inside = [[0.3 * w, 0.15 * h], [0.55 * w, 0.85 * h]]
    bar: dict[str, Any] = {
        **{"name": "bolt", "points": inside, "diameter": 0.02 * h},
        **{"young_modulus": 10 * place.modulus, "yield_stress": 5e-3 * place.modulus},
    }
    if place.seldom(0.6):
        slips = [1e-4 * h, 2e-3 * h]
        bar["bond"] = {"law": "bilinear", "strength": 1e-4 * place.modulus, "slips": slips}
        if place.seldom(0.5):
            bar["dowel"] = {"bedding_stiffness": 0.1 * place.modulus}
            if place.seldom(0.5):
                bar["dowel"]["yield_force"] = 1e-6 * place.modulus * h
    spring: dict[str, Any] = {
        **{"name": "spring", "points": [place.top[1], [1.5 * w, 1.2 * h]]},
        **{"blocks": [place.corners[1], "ground"], "stiffness": stiff},
        **{"carries": place.one_of("both", "tension", "compression")},
    }
    if place.seldom(0.3):
        spring["yield_force"] = 1e-5 * place.modulus * h
    made: Document = {
        "springs": [spring],
        "bars": [bar],
        "masses": [
            {"name": "mass", "point": inside[1], "mass": 0.1 * DENSITY * h * w},
        ],
        "foundations": [
            {
                **{"name": "soil", "segment": place.right, "normal_stiffness": stiff / h},
                **{"shear_stiffness": 0.5 * stiff / h},
                "carries": place.one_of("both", "compression"),
            }
        ],
    }
    if place.moves:
        viscosity = 0.1 * (place.modulus * DENSITY) ** 0.5 * h
        made["dashpots"] = [
            {
                **{"name": "damper", "points": [place.top[0], [-0.5 * w, 1.1 * h]]},
                **{"blocks": [place.corners[0], "ground"], "viscosity": viscosity},
            }
        ]
    chosen = {key: value for key, value in made.items() if place.seldom(0.45)}
    weighs = place.moves or "masses" not in chosen
    return chosen if weighs else {**weight(place), **chosen}


def damping(place: Place) -> Document:
    """Return damping by mass, stiffness, both, or local."""
    rate = 0.1 / (8 * place.step)
    kinds: list[Document] = [
        {"mass": rate},
        {"stiffness": 0.2 * place.step},
        {"mass": rate, "stiffness": 0.1 * place.step},
        {"local": 0.3},
    ]
    return {"damping": kinds[int(place.random.integers(len(kinds)))]}


def boundary(place: Place) -> Document:
    """Return an edge that lets waves go."""
    return {"viscous_boundaries": [{"name": "beyond", "segment": place.right}]}


def water(place: Place) -> Document:
    """Return water that presses on an edge, to a level or linear."""
    unit = place.stress / place.height
    table: dict[str, Any] = {"name": "lake", "segment": place.left, "unit_weight": unit}
    if place.seldom(0.5):
        return {"water_pressures": [{**table, "level": 0.7 * place.height}]}
    del table["unit_weight"]
    return {"water_pressures": [{**table, "pressures": [place.stress, 0.0]}]}


def heat(place: Place) -> Document:
    """Return heat that flows through from a warm edge."""
    table: dict[str, Any] = {"transient": place.seldom(0.5)}
    if table["transient"] and not place.moves:
        table["duration"] = 1e3 * place.height**2
    warm = {"name": "warm", "segment": place.left, "temperature": 20.0}
    made: Document = {"heat": table, "temperatures": [warm]}
    if place.seldom(0.5):
        cold = {"name": "air", "segment": place.right, "coefficient": 5.0, "temperature": -5.0}
        made["convections"] = [cold]
    if place.seldom(0.3):
        made["heat_sources"] = [{"name": "source", "power": 3.0}]
    return made


def seepage(place: Place) -> Document:
    """Return water that seeps through from an edge with a higher head."""
    unit = place.stress / place.height
    table: dict[str, Any] = {"unit_weight": unit, "transient": place.seldom(0.4)}
    h = place.height
    if table["transient"]:
        table |= {"initial": 0.3 * h}
        table |= {} if place.moves else {"duration": 1e3 * h}
    heads = [
        {"name": "high", "segment": place.left, "head": h},
        {"name": "low", "segment": place.right, "head": 0.3 * h},
    ]
    return {"seepage": table, "heads": heads}


def joint_water(place: Place) -> Document:
    """Return water in joints, with heads along two edges."""
    h = place.height
    heads = [
        {"name": "in", "segment": place.left, "head": 0.9 * h},
        {"name": "out", "segment": place.right, "head": 0.5 * h},
    ]
    return {"joint_flow": {"unit_weight": place.stress / h}, "joint_heads": heads}


def grown(place: Place) -> Document:
    """Return cracks that grow, or cohesive zones."""
    piece = 0.1 * place.height
    if place.seldom(0.6):
        energy = place.modulus * 1e-8 * place.height
        kinds = ("hoop_stress", "strain_energy_density", "energy_release", "straight_ahead")
        table = {"criterion": place.one_of(*kinds), "energy": energy, "increment": piece}
        if not place.moves and place.seldom(0.4):
            table["control"] = "toughness"
        return {"fracture": {**table, "max_growth": 2 * piece}}
    return {"cohesive_zones": {"increment": piece, "ahead": 0.5, "max_growth": 2 * piece}}


def split(place: Place) -> Document:
    """Return a strength of the blocks beyond which they split."""
    strength = 3e-4 * place.modulus
    table = {"tensile_strength": strength, "cohesion": 3 * strength, "friction_angle": 0.5}
    return {"splitting": {"rock": {**table, "smallest_block": 0.15 * place.height}}}


SHARES: dict[str, tuple[Callable[[Place], Document], float]] = {
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

IN_TIME: dict[str, tuple[Callable[[Place], Document], float]] = {
    "damping": (damping, 0.2),
    "boundary": (boundary, 0.1),
}
"""What acts on inertia."""
