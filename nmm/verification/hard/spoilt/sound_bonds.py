"""Sound scenes of bonds that soften, cracks that grow and blocks that split."""

from nmm.verification.hard.spoilt.sound_texts import HEAD, HELD, SQUARE, UPPER

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
[fracture.nucleation]
tensile_strength = "1 MPa"
length = "60 mm"
crack_length = "40 mm"
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
