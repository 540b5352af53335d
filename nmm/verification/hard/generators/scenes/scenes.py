"""Random small scenes over every key: each is drawn whole, and seen once from elsewhere."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np

from nmm.verification.hard.cases.base import Document, HardCase, HardClass
from nmm.verification.hard.generators.scenes import acting, bodies, matter
from nmm.verification.hard.generators.scenes.approximated import formulated
from nmm.verification.hard.generators.scenes.possible import possible
from nmm.verification.hard.generators.scenes.site import DENSITY, Site, merged
from nmm.verification.hard.generators.scenes.staged import staged
from nmm.verification.hard.oracles.seen_again import ways
from nmm.verification.hard.oracles.whole import sound

KINDS = {
    **{"rest": 0.36, "time": 0.32, "flight": 0.06, "failure": 0.1},
    **{"creep": 0.05, "safety": 0.05, "stages": 0.06},
}
"""How scenes run, and how often they run so."""

ACTS = ("loads", "gravity", "initial_stresses", "heat", "seepage", "records")
"""Tables of which one at least moves something."""

SOILS = ("mohr_coulomb", "drucker_prager")

STEPS = 8
"""Of scenes in time."""


class Scenes(HardClass):
    """One random scene a seed: two to six blocks or some fifty cells, few steps."""

    name = "scenes"
    title = "random scenes of any bodies, laws, loads, members, water, heat, growth, stages, parts"
    oracle = (
        "equilibrium, momentum, work = energy, nobody through anybody, summary = history = frames, "
        "what runs is what is named, nothing refused late; and one of: the same bytes again, the "
        "same after a shift, turn, mirror, in other units, another order, beside effects of no "
        "weight, under loads times -2.5"
    )
    share = 100

    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield the scene of a seed."""
        random = np.random.default_rng([seed, 97])
        kind = str(random.choice(list(KINDS), p=list(KINDS.values())))
        scene, parts = _flight(random) if kind == "flight" else standing(random, kind)[:2]
        scene = possible(scene)
        seen = str(random.choice(list(ways(scene))))
        label = f"seed {seed}, {kind}, {', '.join(parts.values())}, {seen}"
        yield HardCase(label, scene, partial(sound, way=seen), {**parts, "kind": kind})


def _flight(random: np.random.Generator) -> tuple[Document, dict[str, str]]:
    scene, size = bodies.flight(random)
    modulus = scene["materials"]["rock"]["young_modulus"]
    step = float(scene["duration"] / 25)
    names = tuple(table["name"] for table in scene["blocks"])
    ends = names[0], names[-1]
    site = Site(random, size, 0.5 * size, modulus, step, "time", names, ends)
    scene = {**scene, "duration": STEPS * step, "formulation": {}}
    return formulated(scene, site, meshed=False)


def standing(random: np.random.Generator, kind: str) -> tuple[Document, dict[str, str], Site]:
    """Return a scene of a wall, the parts that it names, and the measures of its wall."""
    scene, height = bodies.wall(random)
    modulus = float(10.0 ** random.uniform(7, 10.5))
    step = float(height * (DENSITY / modulus) ** 0.5 * 10.0 ** random.uniform(-1.5, 0.5))
    names = tuple(table["name"] for table in scene["blocks"])
    width = float(scene["supports"][0]["segment"][1][0])
    ends = _at([0.0, height], scene), _at([width, height], scene)
    site = Site(random, width, height, modulus, step, kind, names, ends)
    meshed = _cracks(site) and len(names) == 1
    scene = merged(merged(scene, matter.materials(site)), matter.joints(site))
    if meshed:
        scene = bodies.with_a_crack(scene, random)
    elif kind == "time" and site.seldom(0.3):
        scene = bodies.with_a_falling_block(scene, height, step, random)
    if len(scene["blocks"]) > 1 or (meshed and site.seldom(0.5)):
        scene = merged(scene, {"contact": {}} if site.seldom(0.75) else {})
    scene = _acted_on(scene, site, meshed)
    for add in _KINDS.get(kind, ()):
        scene = merged(scene, add(site))
    if site.kind == "stages":
        scene = merged(scene, staged(scene, site))
    fielded = "heat" in scene or "seepage" in scene
    return *formulated(scene, site, meshed or fielded), site


def _at(corner: list[float], scene: Document) -> str:
    """Name of the first block with a corner."""
    return next(str(table["name"]) for table in scene["blocks"] if corner in table["vertices"])


def _cracks(site: Site) -> bool:
    return site.kind in ("rest", "time") and site.seldom(0.35)


def _acted_on(scene: Document, site: Site, meshed: bool) -> Document:
    chosen = dict(acting.SHARES)
    if site.moves:
        chosen |= acting.IN_TIME
        scene = merged(scene, {"inertia": {}, "duration": STEPS * site.step})
        if site.seldom(0.08):
            scene = {**scene, **acting.shaken(site)}
    if meshed:
        chosen["growth"] = (acting.grown, 0.5)
    elif "contact" in scene and site.kind in ("rest", "time"):
        chosen["splitting"] = (acting.split, 0.08)
        chosen["joint water"] = (acting.joint_water, 0.06)
    for add, share in chosen.values():
        if site.seldom(share):
            scene = merged(scene, add(site))
    if not any(key in scene for key in ACTS) or (site.kind == "failure" and "loads" not in scene):
        scene = merged(scene, acting.loads(site))
    return _with_constants(scene)


def _with_constants(scene: Document) -> Document:
    """Give matter and joints what heat and water ask of them."""
    rock, joint = dict(scene["materials"]["rock"]), dict(scene["interfaces"]["joint"])
    if "heat" in scene:
        rock |= {"conductivity": 2.0, "heat_capacity": 800.0, "thermal_expansion": 1e-5}
        joint |= {"conductance": "perfect"}
    if "seepage" in scene:
        rock |= {"hydraulic_conductivity": 1e-4, "specific_storage": 1e-3, "biot": 0.9}
        joint |= {"leakage": "perfect"}
    if "joint_flow" in scene:
        joint |= {"aperture": 2e-4, "residual_aperture": 2e-5}
    if rock.get("law") in SOILS:  # the stress across takes part in their yield
        scene = {**scene, "plane": "strain"}
    return {**scene, "materials": {"rock": rock}, "interfaces": {"joint": joint}}


def _creeping(site: Site) -> Document:
    return {"duration": STEPS * site.step}


def _failing(site: Site) -> Document:
    """Return a load that grows until failure, along a path in half of them."""
    table: dict[str, Any] = {"until": "failure"}
    if site.seldom(0.5):
        last = f"at {site.blocks[-1]}"
        way = {"monitors": [last], "direction": site.vector(1.0), "end": 1e-3 * site.height}
        energy = 1e-9 * site.modulus * site.height**2
        table["control"] = [
            {"type": "displacement", "increment": 2e-4 * site.height, **way},
            {"type": "dissipation", "energy": energy, "end_energy": 5 * energy},
            {"type": "events", "fall": 0.5},
        ][int(site.random.integers(3))]
    else:
        table["maximum_factor"] = 20.0
    return {"loading": table, "contact": {}}


def _safe(site: Site) -> Document:
    return {"strength_reduction": {"lowest": 0.8, "highest": 2.0, "tolerance": 0.1}}


_KINDS: dict[str, tuple[Callable[[Site], Document], ...]] = {
    **{"creep": (_creeping,), "failure": (_failing,), "safety": (_safe,)},
}
