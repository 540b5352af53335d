"""Sound scenes of what acts on bodies and in them, one table or more of every effect among them."""

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
name = "v"
kind = "body"
block = "b"
field = ["1e3 * sin(x)", "-1e3 * max(0, y)"]
[[initial_stresses]]
block = "all"
stress = [0, "-1 kPa", 0]
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
[formulation.cover]
type = "triangles"
size = 0.4
degree = 1
volumetric = "projected"
[[formulation.cover.regions]]
degree = 2
polygon = [[0, 0], [0.5, 0], [0.5, 0.5]]
"""
HEATED = f"""{HEAD}conductivity = 2.5
heat_capacity = 900
thermal_expansion = 1e-5
{SQUARE}[[blocks]]
name = "c"
material = "m"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[interfaces.i]
friction_angle = 0.5
bonded = true
cohesion = 1e6
tensile_strength = 1e6
conductance = "100 W/m^2/K"
{HELD}[[cracks]]
name = "k"
points = [[0.5, 1], [0.5, 0.55]]
conductance = "perfect"
[heat]
reference = "20 degC"
transient = true
initial = "25 degC"
duration = "2 h"
[[temperatures]]
name = "hot"
segment = [[0, 0], [0, 1]]
temperature = "80 degC"
gradient = [0, 10]
about = [0, 0.5]
history = [[0, 0], [1, 1]]
[[heat_fluxes]]
name = "flux"
segment = [[2, 0], [2, 0.5]]
flux = "200 W/m^2"
[[heat_sources]]
name = "source"
block = "c"
power = "500 W/m^3"
[[convections]]
name = "air"
segment = [[0, 1], [1, 1]]
coefficient = "10 W/m^2/K"
temperature = "20 degC"
[formulation.diffusion]
theta = 0.5
step = "20 min"
[formulation.cover]
type = "quads"
size = 0.5
degree = 1
"""
SEEPING = f"""{HEAD}hydraulic_conductivity = 1e-6
specific_storage = 1e-5
biot = 0.8
{SQUARE}{HELD}[[cracks]]
name = "k"
points = [[0.5, 1], [0.5, 0.55]]
leakage = "perfect"
[seepage]
unit_weight = "9.81 kN/m^3"
transient = true
initial = 1.0
duration = "2 h"
[[heads]]
name = "lake"
segment = [[0, 0], [0, 1]]
head = 2.0
gradient = [0, 0.1]
about = [0, 0]
[[inflows]]
name = "rain"
segment = [[0.6, 1], [1, 1]]
velocity = "1e-8 m/s"
[formulation.cover]
type = "triangles"
size = 0.5
degree = 1
"""
JOINTS_UNDER_WATER = f"""{HEAD}{SQUARE}{UPPER}{HELD}[interfaces.i]
friction_angle = "30 deg"
residual_friction_angle = "20 deg"
normal_stiffness = "10 GPa/m"
shear_stiffness = "5 GPa/m"
dilation_angle = "5 deg"
dilation_slip = "5 mm"
aperture = "0.2 mm"
residual_aperture = "0.02 mm"
[contact]
[gravity]
[joint_flow]
viscosity = "1 mPa s"
unit_weight = 9810
[[joint_heads]]
name = "in"
point = [0, 1]
head = 3.0
[[joint_heads]]
name = "out"
point = [1, 1]
head = 1.0
history = [[0, 1], [1, 0.5]]
"""
FILLING = JOINTS_UNDER_WATER.replace(
    "[joint_flow]\n",
    """[joint_flow]
transient = true
initial = 2.0
duration = "1 s"
bulk_modulus = "2.2 GPa"
""",
)
CONSOLIDATING = (
    SEEPING.replace("transient = true\n", "transient = true\ncoupled = true\n")
    + '[formulation.supports]\nmethod = "penalty"\n'
)
DISSIPATED = """type = "dissipation"
energy = "1 mJ"
end_energy = "1 J"
"""
OPENING = """type = "opening"
monitors = ["o", "u"]
direction = [0, -1]
increment = "1 um"
end = "5 um"
"""
SOFTENING = f"""{HEAD}{SQUARE}{UPPER}{HELD}[interfaces.i]
law = "bilinear_softening"
friction_angle = "30 deg"
cohesion = "2 MPa"
tensile_strength = "1 MPa"
bonded = true
fracture_energy = "500 J/m^2"
shear_fracture_energy = "1500 J/m^2"
[contact]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 2], [1, 2]]
traction = [0, "1 kPa"]
[loading]
until = "failure"
maximum_factor = 10.0
[loading.control]
{DISSIPATED}fall = 0.2
[formulation.contact]
max_passes = 30
"""
PULLED = f"""{HEAD}{SQUARE}{UPPER}{HELD}[interfaces.i]
friction_angle = "30 deg"
cohesion = "2 MPa"
tensile_strength = "1 MPa"
bonded = true
[contact]
[[monitors]]
name = "o"
point = [1, 2]
[[monitors]]
name = "u"
point = [1, 1]
block = "b"
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 2], [1, 2]]
traction = [0, "1 kPa"]
[loading]
until = "failure"
maximum_factor = 1e4
motion_after_failure = "1 ms"
[formulation.loading]
increment = 10.0
tolerance = 0.05
"""
OPENED = f"""{SOFTENING.replace(DISSIPATED, OPENING)}bonds = "spring"
bond_stiffness = 2.0
shear_ratio = 0.5
[[monitors]]
name = "o"
point = [1, 1]
block = "c"
[[monitors]]
name = "u"
point = [1, 1]
block = "b"
"""
GROWING = f"""{HEAD}{SQUARE}{HELD}[[cracks]]
name = "k"
points = [[0, 0.5], [0.45, 0.5]]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, "1 kPa"]
[fracture]
criterion = "energy_release"
energy = "100 J/m^2"
increment = 0.1
max_growth = 0.3
control = "toughness"
together = 0.1
radius = 0.25
[output]
quantities = ["crack_opening"]
[formulation.cover]
type = "quads"
size = 0.12
degree = 1
[formulation.cover.enrichment]
tips = true
"""
ZONES = f"""{HEAD}{SQUARE}{HELD}[interfaces.i]
friction_angle = 0.5
cohesion = "2 MPa"
tensile_strength = "1 MPa"
bonded = true
[contact]
[[cracks]]
name = "k"
points = [[0, 0.5], [0.45, 0.5]]
[[loads]]
name = "l"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [0, "1 kPa"]
[cohesive_zones]
increment = 0.1
length = 0.2
ahead = 0.5
nucleation = true
max_growth = 0.3
[formulation.cover]
type = "quads"
size = 0.2
degree = 1
"""
SPLITTING = f"""duration = 0.01
{HEAD}{SQUARE}[[blocks]]
name = "c"
material = "m"
vertices = [[0.2, 1], [0.8, 1], [0.8, 1.5], [0.2, 1.5]]
{HELD}[gravity]
[inertia]
[contact]
[interfaces.i]
between = ["m", "m"]
friction_angle = "30 deg"
[splitting.m]
law = "mohr_coulomb"
tensile_strength = "2 MPa"
cohesion = "4 MPa"
friction_angle = "37 deg"
smallest_block = "20 mm"
most_blocks = 20
judged_at = "elements"
[[initial_velocities]]
block = "c"
velocity = [0, -5]
[formulation.integrator]
type = "newmark"
step = "auto"
error = 0.1
error_of = "bodies"
shortest = "1 us"
longest = "2 ms"
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
[formulation.cover]
type = "quads"
size = 0.5
degree = 0
"""
YIELDING = f"""{HEAD}law = "mohr_coulomb"
cohesion = "20 kPa"
friction_angle = "20 deg"
dilation_angle = "10 deg"
tensile_strength = "5 kPa"
{SQUARE}{HELD}[materials.w]
law = "orthotropic"
young_modulus = "10 GPa"
young_modulus_2 = "1 GPa"
young_modulus_3 = "1 GPa"
poisson_ratio = 0.3
poisson_ratio_13 = 0.3
poisson_ratio_23 = 0.2
shear_modulus = "0.7 GPa"
axis_angle = "30 deg"
density = 500
[materials.s]
law = "von_mises"
young_modulus = "200 GPa"
poisson_ratio = 0.3
yield_stress = "250 MPa"
hardening_modulus = "2 GPa"
density = 7800
[materials.d]
law = "drucker_prager"
young_modulus = "1 GPa"
poisson_ratio = 0.3
cohesion = 1e5
friction_angle = 0.3
match = "compression"
density = 2000
[[blocks]]
name = "c"
material = "w"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[blocks]]
name = "e"
material = "s"
vertices = [[2, 0], [3, 0], [3, 1], [2, 1]]
[[blocks]]
name = "f"
material = "d"
vertices = [[3, 0], [4, 0], [4, 1], [3, 1]]
[interfaces.i]
friction_angle = 0.5
bonded = true
cohesion = 1e7
tensile_strength = 1e7
[gravity]
[[initial_stresses]]
block = "b"
stress = [-1000, -2000, 0]
across = -1000
[strength_reduction]
lowest = 0.5
highest = 4.0
tolerance = 0.1
[formulation.cover]
type = "quads"
size = 0.5
degree = 1
"""
CREEPING = f"""duration = 100
{HEAD}law = "burgers"
viscosity = "1e18 Pa s"
delayed_modulus = "5 GPa"
delayed_viscosity = "1e16 Pa s"
{SQUARE}{HELD}[gravity]
[formulation.integrator]
step = 10
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
EFFECTS = {
    **{"shaken": SHAKEN, "members": MEMBERS, "loaded": LOADED, "heated": HEATED},
    **{"seeping": SEEPING, "joints under water": JOINTS_UNDER_WATER, "softening": SOFTENING},
    **{"filling": FILLING, "consolidating": CONSOLIDATING},
    **{
        "pulled": PULLED,
        "opened": OPENED,
        "growing": GROWING,
        "zones": ZONES,
        "splitting": SPLITTING,
        "staged": STAGED,
        "yielding": YIELDING,
    },
    **{"creeping": CREEPING, "rolled over": ROLLED_OVER},
}
"""Scenes by name."""
