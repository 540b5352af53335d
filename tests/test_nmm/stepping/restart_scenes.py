"""Scenes that are stopped and gone on with: texts by name, each of a second or two.

They are read by tests as a file beside them; together they have every effect that carries
something from step to step.
"""

import re

from nmm.testing.scenes import column_on_ground, wet_pile
from nmm.verification import text

ROCK = text.material("rock", 1e9, 0.2, 2500.0)
LIGHT_ROCK = text.material("rock", 1e9, 0.2, 2000.0)
FALLS = "[inertia]\n[gravity]\n[contact]\n"
HELD_FLOOR = '[[supports]]\nname = "held"\nblock = "floor"\nfix = ["x", "y"]\n'


def opening(title: str = "restart", plane: str = "strain", duration: float | None = None) -> str:
    """Return the keys ahead of all tables; ``duration`` in s."""
    span = "" if duration is None else f"duration = {duration}\n"
    return f'title = "{title}"\nplane = "{plane}"\n{span}'


def box(
    name: str, left: float, low: float, right: float, high: float, material: str = "rock"
) -> str:
    """Return the table of an upright rectangular block."""
    return text.block(name, material, text.rectangle((left, low), (right, high)))


def thrown(block: str, velocity: list[float], spin: float | None = None) -> str:
    """Return the table of a block that moves as the run begins."""
    turns = "" if spin is None else f"angular_velocity = {spin}\n"
    return f'[[initial_velocities]]\nblock = "{block}"\nvelocity = {velocity}\n{turns}'


def monitor(name: str, point: list[float]) -> str:
    """Return the table of a monitor of the block that is there."""
    return f'[[monitors]]\nname = "{name}"\npoint = {point}\n'


def dry(friction: float, name: str = "dry") -> str:
    """Return the table of joints with a friction angle in degrees."""
    return text.interface(name, friction)


def every(steps: int) -> str:
    """Return the table of a run that stores a frame each so many steps."""
    return f"[output]\nevery_steps = {steps}\n"


def cover(kind: str, size: float, degree: int = 1) -> str:
    """Return the table of a cover."""
    return f'[formulation.cover]\ntype = "{kind}"\nsize = {size}\ndegree = {degree}\n'


def method(part: str, name: str) -> str:
    """Return the table of how supports or glue are imposed."""
    return f'[formulation.{part}]\nmethod = "{name}"\n'


def increment(share: float, tolerance: float | None = None) -> str:
    """Return the table of how a load grows."""
    within = "" if tolerance is None else f"tolerance = {tolerance}\n"
    return f"[formulation.loading]\nincrement = {share}\n{within}"


def integrator(step: float, rule: str = "") -> str:
    """Return the table of steps of a length (s) by a rule, the default's where none is named."""
    named = f'type = "{rule}"\n' if rule else ""
    return f"[formulation.integrator]\n{named}step = {step}\n"


def stage(name: str, keys: str = "") -> str:
    """Return the table of a stage."""
    return f'[[stages]]\nname = "{name}"\n{keys}\n'


def wall(rule: str, enforcement: str = "penalty") -> str:
    """Return two courses of bricks, the upper one shifted, a little above each other."""
    places = [(0.0, 0.001), (0.505, 0.001), (1.01, 0.001), (0.25, 0.303), (0.755, 0.303)]
    return text.scene(
        opening(duration=0.04),
        [
            ROCK,
            FALLS,
            dry(25.0),
            box("floor", -1, -1, 3, 0),
            *(box(f"brick{n}", x, y, x + 0.5, y + 0.3) for n, (x, y) in enumerate(places)),
            HELD_FLOOR,
            thrown("brick4", [1, 0]),
            text.monitor("top", (1, 0.6), "brick4"),
            '[output]\nevery_time = "10 ms"\n',
            rule,
            f'[formulation.contact]\nenforcement = "{enforcement}"\n',
        ],
    )


def joint_set(name: str, dip: float) -> str:
    """Return the table of joints that cut the slope, a dip in degrees."""
    return f'[[joint_sets]]\nname = "{name}"\nblock = "slope"\ndip = "{dip} deg"\nspacing = 4.5\n'


SLOPE = text.scene(
    opening(duration=0.04),
    [
        ROCK,
        FALLS,
        dry(15.0, "joint"),
        text.block("slope", "rock", [(0, 2), (30, 2), (30, 20), (16, 20), (8, 6), (0, 6)]),
        box("base", -10, 0, 34, 2),
        joint_set("one", 35),
        joint_set("two", 110),
        HELD_FLOOR.replace("floor", "base"),
        every(5),
        integrator(2e-3),
    ],
)

BEAM = text.scene(
    opening(),
    [
        ROCK,
        text.interface(
            "concrete", 37.0, more={"bonded": True, "cohesion": 4.7e6, "tensile_strength": 2.9e6}
        ),
        """[[tessellations]]
name = "beam"
material = "rock"
region = [[0, 0], [0.4, 0], [0.4, 0.1], [0, 0.1]]
blocks = 14
seed = 1
""",
        text.fixed_point("pin", (0.05, 0)),
        text.fixed_point("roller", (0.35, 0), "y"),
        text.pulled_edge("plate", [(0.19, 0.1), (0.21, 0.1)], (0, -5e6)),
        '[contact]\n[loading]\nuntil = "failure"\nmaximum_factor = 40\n',
        '[output]\nevents = ["bond_breaks"]\n',
        increment(0.1, 0.01),
    ],
)

SOFTENING = text.scene(
    opening("bar", "stress") + "thickness = 0.01\n",
    [
        text.material("rock", 30e9, 0.0, None),
        """[interfaces.i]
law = "linear_softening"
friction_angle = 0.6
cohesion = 3e6
tensile_strength = 3e6
bonded = true
fracture_energy = 100.0
normal_stiffness = 3e15
""",
        box("a", 0, 0, 0.05, 0.01),
        box("b", 0.05, 0, 0.1, 0.01),
        text.fixed_edge("left", [(0, 0), (0, 0.01)]),
        text.fixed_edge("right", [(0.1, 0), (0.1, 0.01)]) + "displacement = [8e-5, 0]\n",
        "[contact]\n[loading]\nuntil = 1.0\n",
        every(3),
        increment(0.05, 1e-4),
    ],
)


def mesh(supports: str, enforcement: str) -> str:
    """Return a stone that slides on a floor, both of finite elements."""
    return text.scene(
        opening(duration=0.012),
        [
            ROCK,
            FALLS,
            dry(20.0, "any"),
            box("floor", -1, -1, 3, 0),
            text.block("stone", "rock", [(0, 1e-5), (1, 1e-5), (1, 0.5), (0, 0.6)]),
            thrown("stone", [0.5, 0]),
            text.fixed_edge("held", [(-1, -1), (3, -1)]),
            every(4),
            cover("triangles", 0.8),
            integrator(1e-3),
            method("supports", supports),
            f'[formulation.contact]\nenforcement = "{enforcement}"\n',
        ],
    )


RELAXED = text.scene(
    opening(),
    [
        ROCK,
        "[gravity]\n[contact]\n",
        dry(35.0),
        box("floor", -1, -1, 3, 0),
        box("low", 0, 0.001, 1, 0.5),
        box("high", 0.3, 0.502, 1.2, 1),
        HELD_FLOOR,
        '[[loads]]\nname = "push"\nkind = "point"\npoint = [0.3, 0.75]\nblock = "high"\n'
        "force = [2000, 0]\n",
        "[loading]\nuntil = 1.0\n[output]\n",
        increment(0.1, 1e-3),
    ],
)


def plastic(history: list[list[float]], more: list[str], duration: float | None = None) -> str:
    """Return a bar of steel that is pulled beyond its yield stress."""
    return text.scene(
        opening("cycle", "stress", duration),
        [
            """[materials.steel]
law = "von_mises"
young_modulus = "200 GPa"
poisson_ratio = 0.3
density = 7800.0
yield_stress = "250 MPa"
hardening_modulus = "20 GPa"
""",
            box("bar", 0, 0, 2, 1, "steel"),
            text.fixed_edge("left", [(0, 0), (0, 1)]),
            text.pulled_edge("pull", [(2, 0), (2, 1)], (300e6, 0)) + f"history = {history}\n",
            monitor("tip", [2, 0.5]),
            every(3),
            *more,
        ],
    )


PLASTIC_LOADED = plastic(
    [[0, 0], [1, 1], [2, 0]],
    [
        "[loading]\nuntil = 2.0\nscaled = []\n",
        increment(0.2),
        cover("triangles", 0.7, 0),
        method("supports", "lagrange"),
    ],
)
PLASTIC_MOVING = plastic(
    [[0, 0], [4e-4, 1], [1, 1]], ["[inertia]\n", integrator(1e-4, "newmark")], 0.002
)

CLASSICAL = text.scene(
    opening(duration=0.05),
    [
        ROCK,
        "[inertia]\n[gravity]\n",
        box("top", 0, 0, 1, 1),
        thrown("top", [3, 4], 20),
        every(3),
        integrator(2e-3),
        '[formulation.rotation]\nupdate = "linear"\n',
    ],
)


def glued(supports: str, glue: str, share: float, more: str = "") -> str:
    """Return two glued blocks far from the origin, the right one driven, under a stress."""
    a, b, c = 1e7, 10000001, 10000002
    return text.scene(
        opening(),
        [
            ROCK,
            text.interface("any", 37.0, more={"bonded": True}),
            box("left", a, 0, b, 1),
            box("right", b, 0, c, 1),
            '[[initial_stresses]]\nblock = "left"\nstress = [1000, 0, 0]\n',
            text.fixed_edge("wall", [(a, 0), (a, 1)]),
            text.fixed_edge("driven", [(c, 0), (c, 1)], "x") + "displacement = [1e-3, 0]\n",
            "[output]\n",
            increment(share),
            method("supports", supports),
            method("glue", glue),
            cover("quads", 0.4),
            more,
        ],
    )


LAID = (
    stage("in place")
    + stage("let go", 'supports = ["wall"]\ncover = { size = 0.3 }')
    + stage("held again", 'supports = ["wall", "driven"]')
    + stage("coarser", "cover = { size = 0.5 }")
)

STAGED = text.scene(
    opening("stages", "stress"),
    [
        LIGHT_ROCK,
        box("lower", 0, 0, 1, 1),
        text.block("upper", "rock", [(0.2, 1), (1, 1), (1, 2), (0, 2)]),
        FALLS,
        '[interfaces.any]\nbetween = "any"\nfriction_angle = 0.5\n',
        text.fixed_edge("floor", [(0, 0), (1, 0)]),
        text.monitor("top", (0.5, 1), "lower"),
        every(3),
        stage("rest"),
        stage("free", 'duration = 0.006\nremove = ["upper"]'),
        stage("finer", 'duration = 0.006\nadd = ["upper"]\ncover = { degree = 2 }'),
        cover("triangles", 0.8),
        integrator(1e-3),
    ],
)

CORE = text.rectangle((1, 0.5), (2, 1.5))
RELEASED = text.scene(
    opening("released"),
    [
        LIGHT_ROCK,
        text.material("weathered", 5e8, 0.2, 2000.0),
        box("ground", 0, 0, 3, 2) + f"holes = [{CORE.tolist()}]\n",
        text.block("core", "rock", CORE),
        "[gravity]\n",
        '[interfaces.any]\nbetween = "any"\nfriction_angle = 0.5\nbonded = true\n',
        text.fixed_edge("floor", [(0, 0), (3, 0)]),
        monitor("top", [1.5, 2]),
        every(3),
        stage("in place"),
        stage("dug", 'remove = ["core"]\nrelease = 0.5'),
        stage("open", 'release = 1.0\nmaterials = { ground = "weathered" }'),
        cover("quads", 0.8),
        increment(0.25),
    ],
)


def shaken(stages: str = "", duration: float | None = None) -> str:
    """Return soil on ground that shakes, beside ground that does, under loads of all kinds."""
    return text.scene(
        opening("shaken", duration=duration),
        [
            text.material("soil", 450e6, 0.25, 2000.0),
            box("soil", 0, 0, 8, 6, "soil"),
            """[records.wave]
values = [0, 0.3, -0.2, 0.1, 0, 0]
step = 0.01
[[viscous_boundaries]]
name = "base"
segment = [[0, 0], [8, 0]]
incoming = { x = "wave" }
[[free_fields]]
name = "left"
segment = [[0, 0], [0, 6]]
base = "base"
[[loads]]
name = "truck"
kind = "moving"
segment = [[1, 6], [8, 6]]
force = [0, "-10 kN"]
speed = "100 m/s"
[[loads]]
name = "water"
kind = "pressure"
segment = [[8, 0], [8, 6]]
pressure = "10 kPa"
[[loads]]
name = "wind"
kind = "edge"
segment = [[0, 6], [8, 6]]
field = ["1e3*sin(200*t)*x", "0"]
""",
            monitor("top", [4, 6]),
            "[inertia]\n[damping]\nratios = [0.05, 0.05]\nfrequencies = [5, 50]\nlocal = 0.1\n",
            every(4),
            stages,
            cover("triangles", 3),
            integrator(2e-3, "newmark"),
            '[formulation.solver]\ntype = "superlu"\n',
        ],
    )


SHAKEN_STAGES = stage("first", "duration = 0.012") + stage(
    "finer", "duration = 0.012\ncover = { degree = 2 }"
)
LEFT_STANDING = text.scene(
    column_on_ground(),
    [
        every(3),
        stage("in place"),
        stage("shaken", "supports = []\nduration = 0.04"),
        stage("shaken on", "duration = 0.02"),
        cover("quads", 0.9),
        integrator(0.004, "newmark"),
    ],
)
SEASONS = text.scene(
    opening("wall in winter and summer"),
    [
        LIGHT_ROCK,
        """conductivity = 2.0
heat_capacity = 800
thermal_expansion = 1e-5
hydraulic_conductivity = 1e-6
[gravity]
[heat]
transient = true
duration = "20 days"
[[temperatures]]
name = "inside"
segment = [[0, 0], [0, 3]]
temperature = 5.0
[[temperatures]]
name = "summer"
segment = [[1, 0], [1, 3]]
temperature = 20.0
[seepage]
[[heads]]
name = "foot"
segment = [[0, 0], [1, 0]]
head = 0.0
[[water_pressures]]
name = "flood"
segment = [[1, 0], [1, 3]]
level = 2.0
""",
        box("wall", 0, 0, 1, 3),
        text.fixed_edge("bottom", [(0, 0), (1, 0)]),
        every(3),
        stage("winter", 'heat = ["inside"]\nwater = ["foot"]'),
        stage("summer", 'heat = ["summer"]\nwater = ["foot", "flood"]'),
        cover("quads", 0.6),
        increment(0.2),
    ],
)
SETTLING_SOIL = text.scene(
    opening("soil that settles as its water leaves"),
    [
        text.material("soil", 10e6, 0.2, None),
        """hydraulic_conductivity = 1e-7
specific_storage = 1e-6
[seepage]
coupled = true
transient = true
initial = 1.0
duration = "1 h"
[[heads]]
name = "top"
segment = [[0, 1], [2, 1]]
head = 1.0
""",
        box("soil", 0, 0, 2, 1, "soil"),
        text.pulled_edge("fill", [(0, 1), (1, 1)], (0, -5e4)),
        text.fixed_edge("bottom", [(0, 0), (2, 0)]),
        every(3),
        cover("quads", 0.6),
        method("supports", "penalty"),
        increment(0.1),
    ],
)
FILLING_JOINT = text.scene(
    opening("joint that fills and opens"),
    [
        "[contact]\n[gravity]\n"
        '[joint_flow]\ntransient = true\ninitial = 0.0\nduration = "10 min"\n',
        wet_pile("0.1 mm"),
        every(3),
        increment(0.1),
    ],
)
SHAKEN_ON_ROCK = text.scene(
    opening("shaken block", duration=0.03),
    [
        ROCK,
        box("floor", -1, -1, 3, 0),
        text.block("stone", "rock", [(0, 0.001), (1, 0.001), (1, 0.5), (0, 0.6)]),
        "[records.shake]\nsamples = [[0, 0], [0.01, 6], [0.02, -6], [0.03, 0]]\n",
        HELD_FLOOR + 'motion = { x = "shake" }\n',
        FALLS,
        "[damping]\nstiffness = 1e-4\nlocal = 0.2\n",
        dry(25.0),
        every(4),
        integrator(1e-3),
    ],
)

RUBBER = text.scene(
    opening("rubber that lands", duration=0.16),
    [
        text.material("rubber", 100.0, 0.3, 1.0) + 'law = "neo_hookean"\n',
        box("floor", -1, -0.5, 2, 0, "rubber"),
        text.block("strip", "rubber", [(0, 0.1), (1, 0.3), (0.95, 0.5), (-0.05, 0.3)]),
        text.fixed_edge("held", [(-1, -0.5), (2, -0.5)]),
        thrown("strip", [0, -1], 2),
        "[inertia]\n[contact]\n",
        dry(25.0),
        every(4),
        cover("triangles", 0.6),
        '[formulation.rotation]\nupdate = "finite"\n',
        integrator(0.02, "energy_momentum"),
    ],
)
BENT = text.scene(
    opening("strip that bends", "stress"),
    [
        text.material("rubber", 1e6, 0.0, None),
        box("strip", 0, 0, 10, 0.2, "rubber"),
        text.fixed_edge("held", [(0, 0), (0, 0.2)]),
        text.pulled_edge("up", [(10, 0), (10, 0.2)], (0, 300)),
        '[[loads]]\nname = "press"\nkind = "pressure"\nsegment = [[5, 0], [10, 0]]\n'
        "pressure = 3.0\n",
        "[loading]\nuntil = 1.0\n[output]\n",
        cover("quads", 1.0),
        '[formulation.rotation]\nupdate = "finite"\n',
        increment(0.1),
    ],
)


def crushed(stages: str = "", duration: float | None = None) -> str:
    """Return a stone that splits as it hits the floor."""
    return text.scene(
        opening(duration=duration),
        [
            ROCK,
            box("floor", 0, -1, 1, 0),
            box("stone", 0, 0, 1, 0.6),
            "[inertia]\n[contact]\n",
            dry(25.0),
            text.fixed_edge("held", [(0, -1), (1, -1)]),
            thrown("stone", [0, -5]),
            "[splitting.rock]\ntensile_strength = 5e4\nsmallest_block = 0.05\nmost_blocks = 8\n",
            every(4),
            integrator(1e-3),
            stages,
        ],
    )


def growing(stages: str = "", duration: float | None = None) -> str:
    """Return a notched plate whose crack grows once the pull has come to it, after 1.3 ms."""
    return text.scene(
        opening(duration=duration),
        [
            ROCK,
            box("plate", 0, 0, 1, 1),
            '[[cracks]]\nname = "notch"\npoints = [[0, 0.5], [0.45, 0.5]]\n',
            text.fixed_edge("held", [(0, 0), (1, 0)]),
            text.pulled_edge("pull", [(0, 1), (1, 1)], (5e4, 1e6)),
            every(4),
            cover("quads", 0.125),
            "[fracture]\nenergy = 100.0\nincrement = 0.05\nmax_growth = 0.05\n",
            stages,
            "[inertia]\n",
            integrator(2e-4, "newmark"),
        ],
    )


GROWING_STAGES = (
    stage("in time", "duration = 1.4e-3")
    + stage("at rest", "loads = []")
    + stage("in time again", 'duration = 4e-4\nloads = ["pull"]')
)
CRUSHED_STAGES = stage("first", 'duration = "6 ms"') + stage("second", 'duration = "6 ms"')
SHI, NEWMARK = integrator(2e-3), integrator(2e-3, "newmark")
OWN_NEWMARK = NEWMARK + "[formulation.integrator.options]\ngamma = 0.6\n"
BY_ERROR = NEWMARK.replace("0.002", '"auto"') + 'error = 0.3\nshortest = "0.1 ms"\n'


def by_error(scene: str) -> str:
    """Return a scene whose steps are as long as a large error lets."""
    rule = r"(\[formulation\.integrator\][^\[]*?)\bstep = [^\n]*"
    return re.sub(rule, r'\1step = "auto"\nerror = 0.3', scene)


SCENES = {
    "wall": wall(SHI),
    "wall newmark": wall(NEWMARK),
    "wall by error": wall(BY_ERROR),
    "cone by error": wall(BY_ERROR, "cone"),
    "wall alpha": wall(integrator(2e-3, "generalized_alpha")),
    "wall carried": wall(OWN_NEWMARK, "cone"),
    "wall cone": wall(SHI, "cone"),
    "wall barrier": wall(SHI, "barrier"),
    "wall augmented": wall(SHI, "augmented"),
    "wall lagrange": wall(SHI, "lagrange"),
    "slope": SLOPE,
    "bonds break": BEAM,
    "softening": SOFTENING,
    "mesh": mesh("auto", "penalty"),
    "mesh multipliers": mesh("lagrange", "cone"),
    "relaxed": RELAXED,
    "plastic": PLASTIC_LOADED,
    "plastic in time": PLASTIC_MOVING,
    "plastic by error": by_error(PLASTIC_MOVING),
    "classical update": CLASSICAL,
    "glued": glued("lagrange", "lagrange", 0.1, "[loading]\nuntil = 1.0\n"),
    "laid springs": glued("penalty", "spring", 0.5, LAID),
    "stages": STAGED,
    "released": RELEASED,
    "shaken": shaken(duration=0.03),
    "stone by error": by_error(SHAKEN_ON_ROCK),
    "shaken stages": shaken(SHAKEN_STAGES),
    "shaken stone": SHAKEN_ON_ROCK,
    "left standing": LEFT_STANDING,
    "seasons": SEASONS,
    "settling soil": SETTLING_SOIL,
    "filling joint": FILLING_JOINT,
    "rubber": RUBBER,
    "bent": BENT,
    "crushed": crushed(duration=0.012),
    "crushed in stages": crushed(CRUSHED_STAGES),
    "growing in time": growing(duration=1.6e-3),
    "growing in stages": growing(GROWING_STAGES),
}


CHECKPOINT = "checkpoint = { every_steps = 4 }"
"""A line for the ``[output]`` of a scene."""


def scene_of(name: str, checkpoint: str = "") -> str:
    """Return the text of a scene with a line about checkpoints in its ``[output]``."""
    return SCENES[name].replace("[output]\n", f"[output]\n{checkpoint}\n")
