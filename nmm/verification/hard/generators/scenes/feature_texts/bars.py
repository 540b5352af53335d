"""Texts of bars, foundations, springs, dashpots and masses."""

BOLT = """[[bars]]
name = "bolt"
points = [[0.3, 0.3], [0.7, 1.9]]
diameter = 0.05
young_modulus = 2e11
yield_stress = 5e8
{bond}
"""
BOND = """[bars.bond]
law = "bilinear"
strength = 1e6
slips = [1e-4, 2e-3]
residual_strength = 1e5
"""
MEMBERS = """[[foundations]]
name = "soil"
segment = [[0, 0], [1, 0]]
normal_stiffness = 2e7
shear_stiffness = 1e7
[[springs]]
name = "k"
points = [[1, 1.2], [2, 1.5]]
blocks = ["c", "ground"]
stiffness = 1e7
force = 2e3
[[dashpots]]
name = "d"
points = [[0, 1.5], [-1, 1.7]]
blocks = ["c", "ground"]
viscosity = 5e4
[[masses]]
name = "machine"
point = [0.5, 2]
block = "c"
mass = 500.0
"""
