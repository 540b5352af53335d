"""Sound texts of what most scenes have: blocks, supports, loads, contact, covers, a formulation."""

HEAD = """plane = "strain"
[materials.m]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2000
"""
SQUARE = """[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
"""
UPPER = """[[blocks]]
name = "c"
material = "m"
vertices = [[0, 1], [1, 1], [1, 2], [0, 2]]
"""
HELD = """[[supports]]
name = "s"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
"""
STATIC = f"""{HEAD}{SQUARE}{HELD}[gravity]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, "-1 kPa"]
[[monitors]]
name = "o"
point = [1, 1]
[[reference]]
quantity = "monitor:o:uy"
value = -1
tolerance = 1
source = "x"
[loading]
scaled = ["l"]
until = 1
"""
DYNAMIC = f"""duration = 0.01
{HEAD}{SQUARE}[[blocks]]
name = "c"
material = "m"
vertices = [[0.2, 1], [0.8, 1], [0.8, 1.5], [0.2, 1.5]]
[[supports]]
name = "hold"
block = "b"
fix = ["x", "y"]
[gravity]
acceleration = [0, -9.81]
[inertia]
[contact]
[interfaces.i]
between = ["m", "m"]
friction_angle = "30 deg"
cohesion = 1e5
tensile_strength = 1e4
bonded = true
restitution = 0.5
[[initial_velocities]]
block = "c"
velocity = [0.1, 0]
angular_velocity = 0.1
[[initial_stresses]]
block = "b"
stress = [0, -1e3, 0]
[formulation.integrator]
step = "1 ms"
"""
JOINTED = f"""seed = 3
{HEAD}{SQUARE}[[tessellations]]
name = "v"
material = "m"
region = [[2, 0], [3, 0], [3, 1], [2, 1]]
blocks = 4
seed = 1
smoothing = 1
[[joint_sets]]
name = "j"
block = "b"
dip = 0.3
spacing = 0.4
origin = [0.5, 0.5]
dip_scatter = "1 deg"
[[supports]]
name = "s"
block = "b"
fix = ["x", "y"]
[[supports]]
name = "t"
block = "v"
fix = ["x", "y"]
[contact]
[interfaces.i]
friction_angle = 0.5
"""
CRACKED = f"""{HEAD}{SQUARE}{HELD}[[cracks]]
name = "k"
points = [[0.5, 1], [0.5, 0.55]]
[gravity]
[formulation.cover]
type = "triangles"
size = 0.3
degree = 1
angle = 0.2
shift = [0.1, 0.2]
[formulation.cover.enrichment]
radius = 0.1
[[formulation.cover.regions]]
degree = 0
point = [0, 0]
radius = 0.3
[formulation.supports]
method = "nitsche"
"""
NETS = f"""{HEAD}{SQUARE}{HELD}[[blocks]]
name = "c"
material = "m"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
holes = [[[1.3, 0.3], [1.7, 0.3], [1.7, 0.7], [1.3, 0.7]]]
[interfaces.i]
friction_angle = 0.5
cohesion = 1e5
tensile_strength = 1e5
bonded = true
[gravity]
[formulation.cover]
type = "quads"
size = 0.5
[[formulation.cover.nets]]
block = "c"
size = 0.4
[formulation.glue]
method = "nitsche"
gamma = 4.0
"""
COVERS = {
    "graded": 'type = "graded"\nsize = 0.3\noptions = { focus = [[0.5, 0.5]], growth = 0.3 }\n',
    "splines": 'type = "bspline"\nsize = 0.4\n',
    "discs": 'type = "mls"\nsize = 0.4\ndegree = 0\n',
    "sub-blocks": 'type = "sub_blocks"\nsize = 0.5\n'
    'options = { mesh = "quads", glue = "nitsche" }\n',
    "rigid": 'type = "block"\nfunctions = "rigid"\n',
}
METHOD = """title = "all tables"
[cover]
type = "triangles"
size = 0.5
degree = 1
[supports]
method = "penalty"
stiffness = 1e4
[glue]
method = "spring"
stiffness = 1e4
[contact]
enforcement = "cone"
normal_penalty = 10
points = "auto"
joint_points = "gauss"
options = { tolerance = 1e-8 }
[integrator]
type = "newmark"
step = "1 ms"
kinetic_factor = 0.9
options = { beta = 0.3, gamma = 0.6 }
[rotation]
update = "exact"
[loading]
increment = 0.5
tolerance = 0.01
[solver]
type = "lu"
"""
