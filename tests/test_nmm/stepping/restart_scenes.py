"""Scenes that are stopped and gone on with: texts by name, each of a second or two.

They are read by tests as a file beside them; together they have every effect that carries
something from step to step.
"""

import re

from nmm.testing.scenes import column_on_ground, wet_pile

HEAD = """
title = "restart"
plane = "strain"
[materials.rock]
density = 2500
young_modulus = "1 GPa"
poisson_ratio = 0.2
"""

BRICK = """
[[blocks]]
name = "brick{number}"
material = "rock"
vertices = [[{left}, {low}], [{right}, {low}], [{right}, {high}], [{left}, {high}]]
"""


def bricks() -> str:
    """Return two courses of bricks, the upper one shifted, a little above each other."""
    places = [(0.0, 0.001), (0.505, 0.001), (1.01, 0.001), (0.25, 0.303), (0.755, 0.303)]
    return "".join(
        BRICK.format(number=number, left=x, right=x + 0.5, low=y, high=y + 0.3)
        for number, (x, y) in enumerate(places)
    )


WALL = (
    'duration = "40 ms"'
    + HEAD
    + """
[inertia]
[gravity]
[contact]
[interfaces.dry]
friction_angle = "25 deg"
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
{bricks}
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[initial_velocities]]
block = "brick4"
velocity = [1, 0]
[[monitors]]
name = "top"
point = [1, 0.6]
block = "brick4"
[output]
every_time = "10 ms"
{checkpoint}
[formulation.integrator]
{integrator}
[formulation.contact]
enforcement = "{enforcement}"
"""
).replace("{bricks}", bricks())

SLOPE = (
    'duration = "60 ms"'
    + HEAD
    + """
seed = 3
[inertia]
[gravity]
[contact]
[interfaces.joint]
friction_angle = "15 deg"
[[blocks]]
name = "slope"
material = "rock"
vertices = [[0, 2], [30, 2], [30, 20], [16, 20], [8, 6], [0, 6]]
[[blocks]]
name = "base"
material = "rock"
vertices = [[-10, 0], [34, 0], [34, 2], [-10, 2]]
[[joint_sets]]
name = "one"
block = "slope"
dip = "35 deg"
spacing = 4.5
[[joint_sets]]
name = "two"
block = "slope"
dip = "110 deg"
spacing = 4.5
[[supports]]
name = "held"
block = "base"
fix = ["x", "y"]
[output]
every_steps = 5
{checkpoint}
[formulation.integrator]
step = "2 ms"
"""
).replace("seed = 3\n[inertia]", "[inertia]")

BEAM = (
    HEAD
    + """
[interfaces.concrete]
bonded = true
cohesion = "4.7 MPa"
tensile_strength = "2.9 MPa"
friction_angle = "37 deg"
[[tessellations]]
name = "beam"
material = "rock"
region = [[0, 0], [0.4, 0], [0.4, 0.1], [0, 0.1]]
blocks = 14
seed = 1
[[supports]]
name = "pin"
point = [0.05, 0]
fix = ["x", "y"]
[[supports]]
name = "roller"
point = [0.35, 0]
fix = ["y"]
[[loads]]
name = "plate"
kind = "edge"
segment = [[0.19, 0.1], [0.21, 0.1]]
traction = [0, "-5 MPa"]
[contact]
[loading]
until = "failure"
maximum_factor = 40
[output]
events = ["bond_breaks"]
{checkpoint}
[formulation.loading]
increment = 0.1
tolerance = 0.01
"""
)

SOFTENING = """
title = "bar"
plane = "stress"
thickness = 0.01
[materials.rock]
young_modulus = "30 GPa"
poisson_ratio = 0.0
[interfaces.i]
law = "linear_softening"
friction_angle = 0.6
cohesion = 3e6
tensile_strength = 3e6
bonded = true
fracture_energy = 100.0
normal_stiffness = 3e15
[[blocks]]
name = "a"
material = "rock"
vertices = [[0, 0], [0.05, 0], [0.05, 0.01], [0, 0.01]]
[[blocks]]
name = "b"
material = "rock"
vertices = [[0.05, 0], [0.1, 0], [0.1, 0.01], [0.05, 0.01]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 0.01]]
fix = ["x", "y"]
[[supports]]
name = "right"
segment = [[0.1, 0], [0.1, 0.01]]
fix = ["x", "y"]
displacement = [8e-5, 0]
[contact]
[loading]
until = 1.0
[output]
every_steps = 3
{checkpoint}
[formulation.loading]
increment = 0.05
tolerance = 1e-4
"""

MESH = (
    'duration = "12 ms"'
    + HEAD
    + """
[inertia]
[gravity]
[contact]
[interfaces.any]
friction_angle = "20 deg"
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 1e-5], [1, 1e-5], [1, 0.5], [0, 0.6]]
[[initial_velocities]]
block = "stone"
velocity = [0.5, 0]
[[supports]]
name = "held"
segment = [[-1, -1], [3, -1]]
fix = ["x", "y"]
[output]
every_steps = 4
{checkpoint}
[formulation.cover]
type = "triangles"
size = 0.8
degree = 1
[formulation.integrator]
step = "1 ms"
[formulation.supports]
method = "{method}"
[formulation.contact]
enforcement = "{enforcement}"
"""
)

RELAXED = (
    HEAD
    + """
[gravity]
[contact]
[interfaces.dry]
friction_angle = "35 deg"
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "low"
material = "rock"
vertices = [[0, 0.001], [1, 0.001], [1, 0.5], [0, 0.5]]
[[blocks]]
name = "high"
material = "rock"
vertices = [[0.3, 0.502], [1.2, 0.502], [1.2, 1], [0.3, 1]]
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "point"
point = [0.3, 0.75]
block = "high"
force = [2000, 0]
[loading]
until = 1.0
[output]
{checkpoint}
[formulation.loading]
increment = 0.1
tolerance = 1e-3
"""
)

PLASTIC = """
title = "cycle"
plane = "stress"
[materials.steel]
law = "von_mises"
young_modulus = "200 GPa"
poisson_ratio = 0.3
density = 7800.0
yield_stress = "250 MPa"
hardening_modulus = "20 GPa"
[[blocks]]
name = "bar"
material = "steel"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[supports]]
name = "left"
segment = [[0, 0], [0, 1]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = ["300 MPa", 0]
history = [[0, 0], [1, 1], [2, 0]]
[[monitors]]
name = "tip"
point = [2, 0.5]
[output]
every_steps = 3
{checkpoint}
"""
PLASTIC_LOADED = (
    PLASTIC
    + """
[loading]
until = 2.0
scaled = []
[formulation.loading]
increment = 0.2
[formulation.cover]
type = "triangles"
size = 0.7
degree = 0
[formulation.supports]
method = "lagrange"
"""
)
PLASTIC_MOVING = (
    "duration = 0.002\n"
    + PLASTIC.replace("[[0, 0], [1, 1], [2, 0]]", "[[0, 0], [4e-4, 1], [1, 1]]")
    + """
[inertia]
[formulation.integrator]
type = "newmark"
step = 1e-4
"""
)

CLASSICAL = (
    'duration = "50 ms"'
    + HEAD
    + """
[inertia]
[gravity]
[[blocks]]
name = "top"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[initial_velocities]]
block = "top"
velocity = [3, 4]
angular_velocity = 20
[output]
every_steps = 3
{checkpoint}
[formulation.integrator]
step = "2 ms"
[formulation.rotation]
update = "linear"
"""
)

GLUED = (
    HEAD
    + """
[interfaces.any]
bonded = true
friction_angle = "37 deg"
[[blocks]]
name = "left"
material = "rock"
vertices = [[1e7, 0], [10000001, 0], [10000001, 1], [1e7, 1]]
[[blocks]]
name = "right"
material = "rock"
vertices = [[10000001, 0], [10000002, 0], [10000002, 1], [10000001, 1]]
[[initial_stresses]]
block = "left"
stress = [1000, 0, 0]
[[supports]]
name = "wall"
segment = [[1e7, 0], [1e7, 1]]
fix = ["x", "y"]
[[supports]]
name = "driven"
segment = [[10000002, 0], [10000002, 1]]
fix = ["x"]
displacement = [1e-3, 0]
[loading]
until = 1.0
[output]
{checkpoint}
[formulation.loading]
increment = 0.1
[formulation.supports]
method = "lagrange"
[formulation.glue]
method = "lagrange"
[formulation.cover]
type = "quads"
size = 0.4
degree = 1
"""
)

LAID = (
    GLUED.replace("[loading]\nuntil = 1.0\n", "")
    .replace(
        '[formulation.supports]\nmethod = "lagrange"', '[formulation.supports]\nmethod = "penalty"'
    )
    .replace('[formulation.glue]\nmethod = "lagrange"', '[formulation.glue]\nmethod = "spring"')
    .replace("increment = 0.1", "increment = 0.5")
    + """
[[stages]]
name = "in place"
[[stages]]
name = "let go"
supports = ["wall"]
cover = { size = 0.3 }
[[stages]]
name = "held again"
supports = ["wall", "driven"]
[[stages]]
name = "coarser"
cover = { size = 0.5 }
"""
)

STAGED = """
title = "stages"
plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "lower"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "upper"
material = "rock"
vertices = [[0.2, 1], [1, 1], [1, 2], [0, 2]]
[gravity]
[inertia]
[contact]
[interfaces.any]
between = "any"
friction_angle = 0.5
[[supports]]
name = "floor"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[monitors]]
name = "top"
point = [0.5, 1]
block = "lower"
[output]
every_steps = 3
{checkpoint}
[[stages]]
name = "rest"
[[stages]]
name = "free"
duration = 0.006
remove = ["upper"]
[[stages]]
name = "finer"
duration = 0.006
add = ["upper"]
cover = { degree = 2 }
[formulation.cover]
type = "triangles"
size = 0.8
degree = 1
[formulation.integrator]
step = 1e-3
"""

RELEASED = """
title = "released"
plane = "strain"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[materials.weathered]
young_modulus = 5e8
poisson_ratio = 0.2
density = 2000
[[blocks]]
name = "ground"
material = "rock"
vertices = [[0, 0], [3, 0], [3, 2], [0, 2]]
holes = [[[1, 0.5], [2, 0.5], [2, 1.5], [1, 1.5]]]
[[blocks]]
name = "core"
material = "rock"
vertices = [[1, 0.5], [2, 0.5], [2, 1.5], [1, 1.5]]
[gravity]
[interfaces.any]
between = "any"
friction_angle = 0.5
bonded = true
[[supports]]
name = "floor"
segment = [[0, 0], [3, 0]]
fix = ["x", "y"]
[[monitors]]
name = "top"
point = [1.5, 2]
[output]
every_steps = 3
{checkpoint}
[[stages]]
name = "in place"
[[stages]]
name = "dug"
remove = ["core"]
release = 0.5
[[stages]]
name = "open"
release = 1.0
materials = { ground = "weathered" }
[formulation.cover]
type = "quads"
size = 0.8
degree = 1
[formulation.loading]
increment = 0.25
"""

SHAKEN = """
title = "shaken"
plane = "strain"
duration = {duration}
[materials.soil]
density = 2000
young_modulus = "450 MPa"
poisson_ratio = 0.25
[[blocks]]
name = "soil"
material = "soil"
vertices = [[0, 0], [8, 0], [8, 6], [0, 6]]
[records.wave]
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
[[monitors]]
name = "top"
point = [4, 6]
[inertia]
[damping]
ratios = [0.05, 0.05]
frequencies = [5, 50]
local = 0.1
[output]
every_steps = 4
{checkpoint}
{stages}
[formulation.cover]
type = "triangles"
size = 3
degree = 1
[formulation.integrator]
type = "newmark"
step = 2e-3
[formulation.solver]
type = "superlu"
"""
SHAKEN_STAGES = """
[[stages]]
name = "first"
duration = 0.012
[[stages]]
name = "finer"
duration = 0.012
cover = { degree = 2 }
"""
LEFT_STANDING = (
    column_on_ground()
    + """[output]
every_steps = 3
{checkpoint}
[[stages]]
name = "in place"
[[stages]]
name = "shaken"
supports = []
duration = 0.04
[[stages]]
name = "shaken on"
duration = 0.02
[formulation.cover]
type = "quads"
size = 0.9
degree = 1
[formulation.integrator]
type = "newmark"
step = 0.004
"""
)
SEASONS = """
title = "wall in winter and summer"
plane = "strain"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000
conductivity = 2.0
heat_capacity = 800
thermal_expansion = 1e-5
hydraulic_conductivity = 1e-6
[[blocks]]
name = "wall"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 3], [0, 3]]
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
[[supports]]
name = "bottom"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[output]
every_steps = 3
{checkpoint}
[[stages]]
name = "winter"
heat = ["inside"]
water = ["foot"]
[[stages]]
name = "summer"
heat = ["summer"]
water = ["foot", "flood"]
[formulation.cover]
type = "quads"
size = 0.6
degree = 1
[formulation.loading]
increment = 0.2
"""
SETTLING_SOIL = """
title = "soil that settles as its water leaves"
plane = "strain"
[materials.soil]
young_modulus = "10 MPa"
poisson_ratio = 0.2
hydraulic_conductivity = 1e-7
specific_storage = 1e-6
[[blocks]]
name = "soil"
material = "soil"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[seepage]
coupled = true
transient = true
initial = 1.0
duration = "1 h"
[[heads]]
name = "top"
segment = [[0, 1], [2, 1]]
head = 1.0
[[loads]]
name = "fill"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, -5e4]
[[supports]]
name = "bottom"
segment = [[0, 0], [2, 0]]
fix = ["x", "y"]
[output]
every_steps = 3
{checkpoint}
[formulation.cover]
type = "quads"
size = 0.6
degree = 1
[formulation.supports]
method = "penalty"
[formulation.loading]
increment = 0.1
"""
FILLING_JOINT = (
    """
title = "joint that fills and opens"
plane = "strain"
[contact]
[gravity]
[joint_flow]
transient = true
initial = 0.0
duration = "10 min"
"""
    + wet_pile("0.1 mm")
    + """[output]
every_steps = 3
{checkpoint}
[formulation.loading]
increment = 0.1
"""
)
SHAKEN_ON_ROCK = """
duration = 0.03
title = "shaken block"
plane = "strain"
[materials.rock]
density = 2500
young_modulus = "1 GPa"
poisson_ratio = 0.2
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [3, -1], [3, 0], [-1, 0]]
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 0.001], [1, 0.001], [1, 0.5], [0, 0.6]]
[records.shake]
samples = [[0, 0], [0.01, 6], [0.02, -6], [0.03, 0]]
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
motion = { x = "shake" }
[inertia]
[gravity]
[contact]
[damping]
stiffness = 1e-4
local = 0.2
[interfaces.dry]
friction_angle = "25 deg"
[output]
every_steps = 4
{checkpoint}
[formulation.integrator]
step = 1e-3
"""

RUBBER = """
duration = 0.16
title = "rubber that lands"
plane = "strain"
[materials.rubber]
law = "neo_hookean"
density = 1.0
young_modulus = 100.0
poisson_ratio = 0.3
[[blocks]]
name = "floor"
material = "rubber"
vertices = [[-1, -0.5], [2, -0.5], [2, 0], [-1, 0]]
[[blocks]]
name = "strip"
material = "rubber"
vertices = [[0, 0.1], [1, 0.3], [0.95, 0.5], [-0.05, 0.3]]
[[supports]]
name = "held"
segment = [[-1, -0.5], [2, -0.5]]
fix = ["x", "y"]
[[initial_velocities]]
block = "strip"
velocity = [0, -1]
angular_velocity = 2
[inertia]
[contact]
[interfaces.dry]
friction_angle = "25 deg"
[output]
every_steps = 4
{checkpoint}
[formulation.cover]
type = "triangles"
size = 0.6
degree = 1
[formulation.rotation]
update = "finite"
[formulation.integrator]
type = "energy_momentum"
step = 0.02
"""
BENT = """
title = "strip that bends"
plane = "stress"
[materials.rubber]
young_modulus = 1e6
poisson_ratio = 0.0
[[blocks]]
name = "strip"
material = "rubber"
vertices = [[0, 0], [10, 0], [10, 0.2], [0, 0.2]]
[[supports]]
name = "held"
segment = [[0, 0], [0, 0.2]]
fix = ["x", "y"]
[[loads]]
name = "up"
kind = "edge"
segment = [[10, 0], [10, 0.2]]
traction = [0, 300]
[[loads]]
name = "press"
kind = "pressure"
segment = [[5, 0], [10, 0]]
pressure = 3.0
[loading]
until = 1.0
[output]
{checkpoint}
[formulation.cover]
type = "quads"
size = 1.0
degree = 1
[formulation.rotation]
update = "finite"
[formulation.loading]
increment = 0.1
"""

BOX = """
[[blocks]]
name = "{name}"
material = "rock"
vertices = [[0, {low}], [1, {low}], [1, {high}], [0, {high}]]
"""
CRUSHED = (
    'duration = "12 ms"'
    + HEAD
    + BOX.format(name="floor", low=-1, high=0)
    + BOX.format(name="stone", low=0, high=0.6)
    + """
[inertia]
[contact]
[interfaces.dry]
friction_angle = "25 deg"
[[supports]]
name = "held"
segment = [[0, -1], [1, -1]]
fix = ["x", "y"]
[[initial_velocities]]
block = "stone"
velocity = [0, -5]
[splitting.rock]
tensile_strength = 5e4
smallest_block = 0.05
most_blocks = 8
[output]
every_steps = 4
{checkpoint}
[formulation.integrator]
step = 1e-3
"""
)
NOTCHED = (
    HEAD
    + BOX.format(name="plate", low=0, high=1)
    + """
[[cracks]]
name = "notch"
points = [[0, 0.5], [0.45, 0.5]]
[[supports]]
name = "held"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [5e4, 1e6]
[output]
every_steps = 4
{checkpoint}
[formulation.cover]
type = "quads"
size = 0.125
degree = 1
"""
)
GROWING = """
[fracture]
energy = 100.0
increment = 0.05
max_growth = 0.2
"""
GROWING_STAGES = """
[[stages]]
name = "in time"
duration = 4e-3
[[stages]]
name = "at rest"
loads = []
[[stages]]
name = "in time again"
duration = 5e-4
loads = ["pull"]
"""
IN_STAGES = """
[[stages]]
name = "first"
duration = "6 ms"
[[stages]]
name = "second"
duration = "6 ms"
"""
SHI = 'step = "2 ms"'
NEWMARK = 'type = "newmark"\nstep = "2 ms"'
OWN_NEWMARK = 'type = "newmark"\nstep = "2 ms"\n[formulation.integrator.options]\ngamma = 0.6'
BY_ERROR = 'type = "newmark"\nstep = "auto"\nerror = 0.1\nshortest = "0.1 ms"'
IN_TIME = '[formulation.integrator]\ntype = "newmark"\nstep = 1e-4\n'
ALPHA = 'type = "generalized_alpha"\nstep = "2 ms"'


def by_error(scene: str) -> str:
    """Return a scene whose steps are as long as a large error lets."""
    rule = r"(\[formulation\.integrator\][^\[]*?)\bstep = [^\n]*"
    return re.sub(rule, r'\1step = "auto"\nerror = 0.3', scene)


SCENES = {
    "wall": WALL.replace("{integrator}", SHI).replace("{enforcement}", "penalty"),
    "wall newmark": WALL.replace("{integrator}", NEWMARK).replace("{enforcement}", "penalty"),
    "wall by error": WALL.replace("{integrator}", BY_ERROR).replace("{enforcement}", "penalty"),
    "cone by error": WALL.replace("{integrator}", BY_ERROR).replace("{enforcement}", "cone"),
    "wall alpha": WALL.replace("{integrator}", ALPHA).replace("{enforcement}", "penalty"),
    "wall carried": WALL.replace("{integrator}", OWN_NEWMARK).replace("{enforcement}", "cone"),
    "wall cone": WALL.replace("{integrator}", SHI).replace("{enforcement}", "cone"),
    "wall barrier": WALL.replace("{integrator}", SHI).replace("{enforcement}", "barrier"),
    "wall augmented": WALL.replace("{integrator}", SHI).replace("{enforcement}", "augmented"),
    "wall lagrange": WALL.replace("{integrator}", SHI).replace("{enforcement}", "lagrange"),
    "slope": SLOPE,
    "bonds break": BEAM,
    "softening": SOFTENING,
    "mesh": MESH.replace("{method}", "auto").replace("{enforcement}", "penalty"),
    "mesh multipliers": MESH.replace("{method}", "lagrange").replace("{enforcement}", "cone"),
    "relaxed": RELAXED,
    "plastic": PLASTIC_LOADED,
    "plastic in time": PLASTIC_MOVING,
    "plastic by error": by_error(PLASTIC_MOVING),
    "classical update": CLASSICAL,
    "glued": GLUED,
    "laid springs": LAID,
    "stages": STAGED,
    "released": RELEASED,
    "shaken": SHAKEN.replace("{duration}", "0.03").replace("{stages}", ""),
    "stone by error": by_error(SHAKEN_ON_ROCK),
    "shaken stages": SHAKEN.replace("duration = {duration}", "").replace("{stages}", SHAKEN_STAGES),
    "shaken stone": SHAKEN_ON_ROCK,
    "left standing": LEFT_STANDING,
    "seasons": SEASONS,
    "settling soil": SETTLING_SOIL,
    "filling joint": FILLING_JOINT,
    "rubber": RUBBER,
    "bent": BENT,
    "crushed": CRUSHED,
    "crushed in stages": CRUSHED.replace('duration = "12 ms"', "") + IN_STAGES,
    "growing in time": "duration = 1e-3\n" + NOTCHED + GROWING + "[inertia]\n" + IN_TIME,
    "growing in stages": NOTCHED + GROWING + GROWING_STAGES + "[inertia]\n" + IN_TIME,
}


def scene_of(name: str, checkpoint: str = "") -> str:
    """Return the text of a scene with a line about checkpoints in its ``[output]``."""
    return SCENES[name].replace("{checkpoint}", checkpoint)
