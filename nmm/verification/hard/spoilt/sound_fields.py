"""Sound scenes of heat and water in bodies and in their joints."""

from nmm.verification.hard.spoilt.sound_texts import HEAD, HELD, SQUARE, UPPER

HEATED = f"""{HEAD}conductivity = 2.5
conductivity_2 = 2.0
axis_angle = 0.4
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
hydraulic_conductivity_2 = 5e-7
specific_storage = 1e-5
drainable_porosity = 0.1
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
