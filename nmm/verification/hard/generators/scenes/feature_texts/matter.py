"""Texts of soil, of heat and water through a year, of cracks that grow and blocks that split."""

SOIL = """law = "mohr_coulomb"
cohesion = 2e4
friction_angle = 0.5
dilation_angle = 0.0
"""
WARM = """conductivity = 2.0
heat_capacity = 800.0
thermal_expansion = 1e-5
hydraulic_conductivity = 1e-6
"""
SEASONS = """[heat]
transient = true
duration = 1.7e6
[[temperatures]]
name = "winter"
segment = [[0, 0], [0, 1]]
temperature = -5.0
[[temperatures]]
name = "summer"
segment = [[1, 0], [1, 1]]
temperature = 20.0
[seepage]
[[heads]]
name = "low"
segment = [[0, 0], [0, 1]]
head = 1.0
[[heads]]
name = "high"
segment = [[1, 0], [1, 1]]
head = 3.0
[[water_pressures]]
name = "flood"
segment = [[1, 0], [1, 1]]
level = 3.0
[[stages]]
name = "winter"
heat = ["winter"]
water = ["low"]
[[stages]]
name = "summer"
heat = ["summer"]
water = ["low", "high", "flood"]
[formulation.loading]
increment = 0.2
"""
GROWS = """[fracture]
criterion = "hoop_stress"
energy = 100.0
increment = 0.05
max_growth = 0.2
"""
ZONE = """[cohesive_zones]
increment = 0.1
length = 0.2
ahead = 0.5
max_growth = 0.3
"""
FALL = """[splitting.m]
tensile_strength = 5e4
cohesion = 1e6
friction_angle = 0.6
smallest_block = 0.02
most_blocks = 20
"""
