"""Sound scenes of matter that yields and creeps."""

from nmm.verification.hard.spoilt.sound_texts import HEAD, HELD, SQUARE

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
[materials.v]
law = "von_mises"
young_modulus = "20 MPa"
poisson_ratio = 0.45
yield_stress = "80 kPa"
softening_energy = "500 J/m^2"
residual_stress = "40 kPa"
density = 1800
[materials.d]
law = "drucker_prager"
young_modulus = "1 GPa"
poisson_ratio = 0.3
cohesion = 1e5
friction_angle = 0.3
match = "compression"
softening_energy = "5 kJ/m^2"
residual_cohesion = 2e4
dilation_angle = 0.1
residual_friction_angle = 0.2
residual_dilation_angle = 0.0
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
