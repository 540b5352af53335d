"""Sound scenes of what acts on bodies from outside: motion, members, loads, stages."""

from nmm.verification.hard.spoilt.sound_texts import HEAD, HELD, SQUARE, UPPER

SHAKEN = f"""duration = 0.02
{HEAD}{SQUARE}[records.quake]
samples = [[0, 0], [0.01, 1], [0.02, 0]]
unit = "g"
scale = 0.5
start = "1 ms"
baseline = "velocity"
[records.wave]
values = [0, 0.1, 0.2, 0]
step = "5 ms"
quantity = "velocity"
[[supports]]
name = "s"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
motion = {{ x = "quake" }}
[[blocks]]
name = "g"
material = "m"
vertices = [[3, 0], [5, 0], [5, 1], [3, 1]]
[[viscous_boundaries]]
name = "v"
segment = [[3, 0], [5, 0]]
incoming = {{ y = "wave" }}
density = "2400 kg/m^3"
p_velocity = "2100 m/s"
s_velocity = "1200 m/s"
reactions = false
[[free_fields]]
name = "f"
segment = [[5, 0], [5, 1]]
base = "v"
block = "g"
[inertia]
[damping]
mass = "1 1/s"
stiffness = "0.1 ms"
ground = "s"
[[monitors]]
name = "o"
point = [1, 1]
[output]
every_time = "5 ms"
every_steps = 3
quantities = ["von_mises", "principal_stress"]
pictures = false
paraview = false
[output.checkpoint]
every_steps = 5
[formulation.integrator]
type = "generalized_alpha"
mass = "lumped"
step = "1 ms"
options = {{ rho_inf = 0.7 }}
[formulation.loading]
budget = "10 min"
max_steps = 100
"""
MEMBERS = f"""duration = 0.01
{HEAD}{SQUARE}{UPPER}[interfaces.i]
friction_angle = 0.5
damping = 0.1
[contact]
[inertia]
[damping]
ratios = [0.05, 0.04]
frequencies = ["2 Hz", "10 Hz"]
local = 0.1
[[foundations]]
name = "soil"
segment = [[0, 0], [1, 0]]
block = "b"
normal_stiffness = "20 MPa/m"
shear_stiffness = 1e6
carries = "compression"
[[springs]]
name = "k"
points = [[1, 0.5], [2, 0.5]]
blocks = ["b", "ground"]
stiffness = "10 MN/m"
force = "2 kN"
carries = "tension"
yield_force = "1 MN"
[[dashpots]]
name = "d"
points = [[1, 1.5], [2, 1.5]]
blocks = ["c", "ground"]
viscosity = "5 kN s/m"
[[bars]]
name = "bolt"
points = [[0.5, 0.2], [0.5, 1.8]]
diameter = "25 mm"
number = 0.5
young_modulus = "200 GPa"
yield_stress = "500 MPa"
hardening_modulus = "1 GPa"
carries = "tension"
pretension = "1 kN"
ends = ["fixed", "free"]
[bars.bond]
law = "model_code"
strength = "8 MPa"
slips = ["1 mm", "2 mm", "5 mm"]
residual_strength = 1e5
exponent = 0.4
[bars.dowel]
bedding_stiffness = "50 MPa"
bending_stiffness = 3800.0
yield_force = "60 kN"
[[masses]]
name = "machine"
point = [0.5, 2]
block = "c"
mass = "200 kg"
[formulation.bars]
pieces = 5
[formulation.integrator]
step = "1 ms"
"""
LOADED = f"""{HEAD}{SQUARE}{HELD}[fields.table]
rows = [[0, 0, 1e3, 0], [0, 2, 0, 0]]
scale = 2.0
[[supports]]
name = "t"
segment = [[0, 1], [0.2, 1]]
fix = ["x"]
displacement = [1e-4, 0]
[[loads]]
name = "p"
kind = "point"
point = [1, 0.5]
force = ["1 kN", 0]
history = [[0, 0], [1, 1]]
[[loads]]
name = "q"
kind = "pressure"
segment = [[1, 0], [1, 1]]
pressure = "1 kPa"
[[loads]]
name = "e"
kind = "edge"
segment = [[0, 0], [0, 1]]
field = "table"
[[loads]]
name = "g"
kind = "body"
density = [0, "-1 kN/m^3"]
[[loads]]
name = "v"
kind = "body"
block = "b"
field = ["1e3 * sin(x)", "-1e3 * max(0, y)"]
[[initial_stresses]]
block = "all"
surface = "1 m"
unit_weight = "20 kN/m^3"
ratio = 0.5
ratio_across = 0.5
surcharge = "1 kPa"
[[monitors]]
name = "o"
point = [1, 1]
[[water_pressures]]
name = "w"
segment = [[0, 0], [0, 1]]
pressures = ["10 kPa", 0]
[[water_pressures]]
name = "u"
segment = [[0, 0], [1, 0]]
phreatic_line = [[-1, 1], [2, 0.5]]
unit_weight = 9810
[[water_pressures]]
name = "v"
segment = [[0, 1], [1, 1]]
pressure = "10 kPa"
[formulation.cover]
type = "triangles"
size = 0.4
degree = 1
volumetric = "projected"
[[formulation.cover.regions]]
degree = 2
polygon = [[0, 0], [0.5, 0], [0.5, 0.5]]
"""
STAGED = f"""{HEAD}{SQUARE}{HELD}{UPPER}[interfaces.i]
friction_angle = 0.5
[contact]
[gravity]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 2], [1, 2]]
traction = [0, "-1 kPa"]
[[springs]]
name = "k"
points = [[1, 0.5], [2, 0.5]]
blocks = ["b", "ground"]
stiffness = 1e6
[[water_pressures]]
name = "lake"
segment = [[0, 0], [0, 1]]
level = 0.8
[[stages]]
name = "first"
blocks = ["b"]
loads = []
supports = ["s"]
members = []
[[stages]]
name = "second"
add = ["c"]
members = ["k"]
cover = {{ degree = 1 }}
[[stages]]
name = "third"
remove = ["c"]
water = ["lake"]
release = 0.5
reset_displacements = true
[formulation.cover]
type = "quads"
size = 0.5
degree = 0
"""
ROLLED_OVER = f"""duration = 0.1
{HEAD}{SQUARE}{HELD}[inertia]
[[loads]]
name = "wheel"
kind = "moving"
segment = [[0, 1], [1, 1]]
force = [0, "-1 kN"]
speed = "10 m/s"
start = "10 ms"
spread = 0.1
[[tessellations]]
name = "v"
material = "m"
region = [[2, 0], [3, 0], [3, 1], [2, 1]]
blocks = 4
shortest_edge = 0.1
keep = [[2.5, 1]]
[[joint_sets]]
name = "j"
block = "b"
dip = 0.3
spacing = 0.5
spacing_scatter = 0.05
persistence = 0.8
trace = 2.0
trace_scatter = 0.2
[interfaces.i]
friction_angle = 0.5
[contact]
[output]
events = ["shape_changes", "first_slip"]
[formulation.cover]
type = "triangles"
size = 0.4
degree = 1
"""
