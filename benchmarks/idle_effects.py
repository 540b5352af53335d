"""Effects that a scene names and that do nothing in it, each beside the same scene without it.

Two scenes stand under most of them: a *wall* of bricks under gravity in contact, and a *bar*, a
loaded body of triangles with a stone at rest far from it. Tables are those of a scene file.
"""

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from typing import Any

from whole_scenes import wall

from nmm.scene.model import Scene

Tables = dict[str, Any]
STEP = 1e-3
"""Length of a step (s)."""
NEVER = 1e20
"""A stress or an intensity (Pa, Pa m^0.5) that no load here comes near to."""
NOTHING = 1e-30
"""The least stiffness, viscosity or mass that a scene may have."""
COURSES, CELL = 10, 0.1
"""Courses of the wall, with as many bricks each; size of the bar's cells (m)."""
ALWAYS = ("supports", "inertia", "bonded interfaces", "artificial joints", "cohesive zones")
"""Effects that are never idle: what holds, glues and moves, and zones that stand for tips."""


@dataclass(frozen=True)
class Idle:
    """An effect without work.

    Attributes
    ----------
    effects
        Names of the effects that only the idle scene calls for; none of what is no effect but a
        law, a stage or more blocks.
    without, idle
        Make the tables of the scene without and with it, of a run of so many steps.
    shared
        Blocks that both scenes have, the first ones; None is all.
    within
        Share of the displacements that it changes at most; None where it does a little.
    """

    effects: tuple[str, ...]
    without: Callable[[int], Tables]
    idle: Callable[[int], Tables]
    shared: int | None = None
    within: float | None = 1e-12

    def scenes(self, steps: int) -> tuple[Scene, Scene]:
        """Return the scene without the effect and the one in which it is idle."""
        return Scene.model_validate(self.without(steps)), Scene.model_validate(self.idle(steps))


def bricks(steps: int) -> Tables:
    """Return a wall of bricks under gravity."""
    tables = wall(COURSES**2, steps * STEP).model_dump(exclude_unset=True, by_alias=True)
    return {**deepcopy(tables), "formulation": {"integrator": {"step": STEP}}}


def bar(steps: int) -> Tables:
    """Return a loaded bar of triangles, and a stone that nothing touches; in time."""
    return {
        "title": "bar",
        "plane": "strain",
        "duration": steps * STEP,
        "materials": {"rock": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2000.0}},
        "blocks": [_block("bar", 0.0, 0.0, 2.0, 1.0), _block("stone", 6.0, 0.0, 7.0, 1.0)],
        "supports": [_support("root", [[0, 0], [0, 1]])],
        "loads": [_load("pull", kind="edge", segment=[[2, 0], [2, 1]], traction=[1e4, -1e4])],
        "inertia": {},
        "formulation": {
            "cover": {"type": "triangles", "size": CELL, "degree": 1},
            "integrator": {"type": "newmark", "step": STEP},
            "supports": {"method": "penalty"},
        },
    }


def begun_anew(steps: int) -> Tables:
    """Return the bar with steps that know no acceleration, so that stages change nothing."""
    return _more(bar, formulation={"integrator": {"type": "shi"}})(steps)


def still_bar(steps: int) -> Tables:
    """Return the bar without inertia, its load brought on in as many increments."""
    tables = {key: value for key, value in bar(steps).items() if key not in ("duration", "inertia")}
    tables["blocks"] = tables["blocks"][:1]
    tables["loading"] = {"until": 1.0}
    tables["formulation"] = {
        "cover": {"type": "triangles", "size": CELL, "degree": 1},
        "loading": {"increment": 1 / steps},
    }
    return tables


def cracked_bar(steps: int) -> Tables:
    """Return the bar in statics with a crack."""
    return {**still_bar(steps), "cracks": [{"name": "notch", "points": [[0.9, 1.0], [0.9, 0.6]]}]}


def swinging_crack(steps: int) -> Tables:
    """Return the same in time."""
    return {**bar(steps), "cracks": [{"name": "notch", "points": [[0.9, 1.0], [0.9, 0.6]]}]}


def falling(steps: int) -> Tables:
    """Return 25 blocks that fall freely, a width apart."""
    places = [(2.0 * i, 2.0 * j) for i in range(5) for j in range(5)]
    return {
        **_moving(steps),
        "blocks": [_block(f"b{n}", x, y, x + 1, y + 1) for n, (x, y) in enumerate(places)],
    }


def tower(steps: int, friction: float) -> Tables:
    """Return ten blocks one upon another that do not widen as they are pressed."""
    blocks = [_block(f"b{n}", 0.0, 1.0 * n, 1.0, n + 1.0) for n in range(10)]
    tables = {
        **_moving(steps),
        "blocks": blocks,
        "supports": [{"name": "base", "block": "b0", "fix": ["x", "y"]}],
        "contact": {},
        "interfaces": {"dry": {"friction_angle": friction}},
    }
    tables["materials"]["rock"]["poisson_ratio"] = 0.0
    return tables


def slider(steps: int, wall_beside: bool) -> Tables:
    """Return a block that is pushed along a held one once all is at rest, a wall beside or none."""
    found = bricks(steps)
    pair = [_block("bed", -20.0, -1.0, -10.0, 0.0), _block("sled", -19.0, 0.0, -18.0, 0.5)]
    held = [{"name": "bed", "block": "bed", "fix": ["x", "y"]}]
    found["blocks"] = pair + (list(found["blocks"]) if wall_beside else [])
    found["supports"] = held + (list(found["supports"]) if wall_beside else [])
    found["loads"] = [_load("push", kind="point", point=[-18.5, 0.25], force=[2e4, 0.0])]
    pushed = {"name": "pushed", "loads": ["push"], "duration": found.pop("duration")}
    return {**found, "stages": [{"name": "rest", "loads": []}, pushed]}


def on_still_ground(steps: int) -> Tables:
    """Return the bar on a support that a record without motion moves."""
    record = {"values": [0.0, 0.0, 0.0], "step": steps * STEP / 2}
    found = {**bar(steps), "records": {"quiet": record}}
    found["supports"] = [{**found["supports"][0], "motion": {"x": "quiet"}}]
    return found


def beside_ground(steps: int) -> Tables:
    """Return the bar, and under the stone a viscous boundary."""
    return _more(bar, viscous_boundaries=[_BASE])(steps)


def closed_joints(steps: int, **flow: Any) -> Tables:
    """Return the wall with water at no pressure in joints without aperture."""
    height = [0.25 * course for course in range(COURSES + 1)]
    heads = [
        {"name": f"h{n}", "segment": [[-1, y], [COURSES, y]], "head": y}
        for n, y in enumerate(height)
    ]
    return _more(bricks, interfaces={"dry": {"aperture": 0.0}}, joint_flow=flow, joint_heads=heads)(
        steps
    )


def _more(base: Callable[[int], Tables], **tables: Any) -> Callable[[int], Tables]:
    """Return what makes the tables of a scene with others; lists are lengthened."""

    def made(steps: int) -> Tables:
        found = base(steps)
        for key, value in tables.items():
            known = found.get(key)
            if isinstance(known, list | tuple):
                found[key] = [*known, *value]
            elif isinstance(known, Mapping):
                found[key] = _deep(known, value)
            else:
                found[key] = value
        return found

    return made


def _deep(known: Mapping[str, Any], more: Mapping[str, Any]) -> Tables:
    """Return tables with the keys of others, table by table."""
    both = {
        key: _deep(known[key], value) if isinstance(known.get(key), Mapping) else value
        for key, value in more.items()
    }
    return {**known, **both}


def _moving(steps: int) -> Tables:
    found = bricks(steps)
    return {key: found[key] for key in found if key not in ("blocks", "supports", "contact")}


def _staged(base: Callable[[int], Tables], *shares: float) -> Callable[[int], Tables]:
    """Return what makes a scene in stages of these shares of its time."""

    def made(steps: int) -> Tables:
        found = base(steps)
        whole = found.pop("duration")
        stages = [{"name": f"s{n}", "duration": one * whole} for n, one in enumerate(shares)]
        return {**found, "stages": stages}

    return made


def _without_stone(**more: float) -> Callable[[int], Tables]:
    """Return what makes the bar in two stages, in the second of which the stone is gone."""

    def made(steps: int) -> Tables:
        found = _staged(begun_anew, 0.5, 0.5)(steps)
        found["stages"][1] |= {"remove": ["stone"], **more}
        return found

    return made


def _renamed(**more: object) -> Callable[[int], Tables]:
    """Return what makes the bar in two stages, with a second material that is as the first."""

    def made(steps: int) -> Tables:
        found = _staged(begun_anew, 0.5, 0.5)(steps)
        found["materials"]["twin"] = dict(found["materials"]["rock"])
        found["stages"][1] |= more
        return found

    return made


def _block(name: str, left: float, low: float, right: float, high: float) -> Tables:
    ring = [[left, low], [right, low], [right, high], [left, high]]
    return {"name": name, "material": "rock", "vertices": ring}


def _support(name: str, segment: list[list[float]]) -> Tables:
    return {"name": name, "segment": segment, "fix": ["x", "y"]}


def _load(name: str, **keys: Any) -> Tables:
    return {"name": name, **keys}


def _idle(effect: str, base: Callable[[int], Tables], **tables: Any) -> Idle:
    return Idle((effect,), base, _more(base, **tables))


def _law(**keys: Any) -> Idle:
    return Idle((), bar, _more(bar, materials={"rock": keys}))


# Its table lays other functions about tips, and with them the answer is another.
_TOUGH = {"toughness": NEVER, "increment": 0.1}
_TOP = [[0.0, 1.0], [2.0, 1.0]]
_BASE = {"name": "base", "segment": [[6, 0], [7, 0]]}
_WET = {"materials": {"rock": {"hydraulic_conductivity": 1e-6, "biot": 0.0}}}
_STORING = {"materials": {"rock": {"specific_storage": 1e-6}}}
_WARM = {"materials": {"rock": {"thermal_expansion": 1e-5, "conductivity": 2.0}}}
_BRICK = {"points": [[1.25, -0.2], [1.25, 1.2]]}
_BOLT = {
    "name": "bolt",
    **_BRICK,
    "diameter": 0.02,
    "young_modulus": 2e11,
    "bond": {"law": "linear", "stiffness": 1e10},
}

IDLE: dict[str, Idle] = {
    "contact: blocks that do not meet": _idle("contact", falling, contact={}),
    "contact: a wall at rest beside a block that slides": Idle(
        (),
        lambda steps: slider(steps, False),
        lambda steps: slider(steps, True),
        shared=2,
        within=1e-8,
    ),
    "contact without friction, beside one that never slides": Idle(
        (), lambda steps: tower(steps, 0.6), lambda steps: tower(steps, 0.0)
    ),
    "plasticity that stays elastic: von Mises": _law(law="von_mises", yield_stress=NEVER),
    "plasticity that stays elastic: Mohr-Coulomb": _law(
        law="mohr_coulomb", cohesion=NEVER, friction_angle=0.5, dilation_angle=0.5
    ),
    "creep too slow to be seen": _law(law="maxwell", viscosity=1e29),
    "a spring of no stiffness": _idle(
        "springs", bricks, springs=[{"name": "s", **_BRICK, "stiffness": NOTHING}]
    ),
    "a cable that hangs slack": Idle(
        ("springs",),
        bricks,
        _more(bricks, springs=[{"name": "s", **_BRICK, "stiffness": 1e7, "carries": "tension"}]),
        within=1e-8,  # a step that is solved twice, and contacts to no more
    ),
    "a dashpot of no viscosity": _idle(
        "dashpots", bricks, dashpots=[{"name": "d", **_BRICK, "viscosity": NOTHING}]
    ),
    "a bar of no stiffness": _idle(
        "bars", bricks, bars=[{"name": "b", **_BRICK, "area": 1e-3, "young_modulus": 1e-20}]
    ),
    "a bonded bar of no stiffness": _idle(
        "bars",
        bricks,
        bars=[{**_BOLT, "young_modulus": 1e-20, "bond": {"law": "linear", "stiffness": 1e-20}}],
    ),
    "a dowel of no stiffness": Idle(
        ("bars", "dowels"),
        bricks,
        _more(
            bricks,
            bars=[
                {
                    "name": "b",
                    **_BRICK,
                    "diameter": 0.02,
                    "young_modulus": 1e-20,
                    "dowel": {"bedding_stiffness": 1e-20},
                }
            ],
        ),
        within=1e-8,
    ),
    "a bolt in a wall at rest": Idle(("bars",), bricks, _more(bricks, bars=[_BOLT]), within=None),
    "a foundation of no stiffness": _idle(
        "foundations",
        bricks,
        foundations=[
            {"name": "f", "segment": [[0.0, -0.25], [1.0, -0.25]], "normal_stiffness": NOTHING}
        ],
    ),
    "a mass of nothing": _idle(
        "masses", bricks, masses=[{"name": "m", "point": [1.3, 1.1], "mass": NOTHING}]
    ),
    "viscous damping of zero": _idle(
        "viscous damping", bar, damping={"mass": 0.0, "stiffness": 0.0}
    ),
    "damping against ground of zero": _idle(
        "damping against the ground", on_still_ground, damping={"mass": 0.0, "ground": "root"}
    ),
    "local damping of zero": _idle("local damping", bar, damping={"local": 0.0}),
    "a record without motion": Idle((), bar, on_still_ground),
    "heat at a uniform temperature": _idle(
        "heat",
        _more(bar, **_WARM),
        heat={},
        temperatures=[{"name": "t", "block": "all", "temperature": 0.0}],
    ),
    "heat that is stored and does not flow": _idle(
        "heat",
        _more(bar, materials={"rock": {**_WARM["materials"]["rock"], "heat_capacity": 800.0}}),
        heat={"transient": True},
    ),
    "seepage that presses on nothing": _idle(
        "seepage",
        _more(bar, **_WET),
        seepage={},
        heads=[{"name": "h", "block": "all", "head": 1.0}],
    ),
    "soil whose water is given whole": _idle(
        "consolidation",
        _more(_more(bar, **_WET), **_STORING),
        seepage={"coupled": True, "transient": True, "initial": 1.0},
        heads=[{"name": "h", "block": "all", "head": 1.0}],
    ),
    "water in joints that are closed": Idle(("joint flow",), bricks, closed_joints),
    "water that is stored in joints that are closed": Idle(
        ("transient joint flow",), bricks, partial(closed_joints, transient=True, initial=0.0)
    ),
    "water below all edges": _idle(
        "water pressures",
        bricks,
        water_pressures=[{"name": "w", "block": "base", "level": -3.0}],
    ),
    "gravity of zero": _idle("gravity", bar, gravity={"acceleration": [0.0, 0.0]}),
    "an initial velocity of zero": _idle(
        "initial velocity", bar, initial_velocities=[{"block": "bar", "velocity": [0.0, 0.0]}]
    ),
    "an initial stress of zero": _idle(
        "initial stress", bar, initial_stresses=[{"block": "bar", "stress": [0.0, 0.0, 0.0]}]
    ),
    "a load of zero": _idle(
        "loads", bricks, loads=[_load("l", kind="point", point=[1.3, 1.1], force=[0.0, 0.0])]
    ),
    "a load on volume of zero": _idle(
        "body loads", bar, loads=[_load("l", kind="body", density=[0.0, 0.0])]
    ),
    "a field of zero": _idle(
        "field loads", bar, loads=[_load("l", kind="edge", segment=_TOP, field=["0*x", "0*t"])]
    ),
    "a pressure of zero": _idle(
        "pressures", bar, loads=[_load("l", kind="pressure", segment=_TOP, pressure=0.0)]
    ),
    "a moving load of zero": _idle(
        "moving loads",
        bar,
        loads=[_load("l", kind="moving", segment=_TOP, force=[0.0, 0.0], speed=20.0)],
    ),
    "a viscous boundary that no wave reaches": _idle(
        "viscous boundaries", bar, viscous_boundaries=[_BASE]
    ),
    "a free field at rest": _idle(
        "free fields",
        beside_ground,
        free_fields=[{"name": "left", "segment": [[6, 0], [6, 1]], "base": "base"}],
    ),
    "a crack that does not grow": Idle(
        ("fracture",), cracked_bar, _more(cracked_bar, fracture=_TOUGH), within=None
    ),
    "a crack that does not grow in time": Idle(
        ("fracture in time",), swinging_crack, _more(swinging_crack, fracture=_TOUGH), within=None
    ),
    "blocks that do not split": _idle(
        "splitting",
        bricks,
        splitting={"rock": {"tensile_strength": NEVER, "smallest_block": 0.1}},
    ),
    "a second stage that changes nothing": Idle(
        (), _staged(begun_anew, 1.0), _staged(begun_anew, 0.5, 0.5)
    ),
    "a release of what exerted nothing": Idle(
        ("unreleased forces",), _without_stone(), _without_stone(release=0.5)
    ),
    "a material that changes its name alone": Idle(
        ("changed materials",), _renamed(), _renamed(materials={"bar": "twin"})
    ),
}
"""By what is idle, as a row of the page says it."""
