"""Texts of joints that are dry, hold or soften, and of paths past the peak of their load."""

from nmm.verification.hard.generators.scenes.feature_texts.blocks import (
    TWO,
    monitor,
    pulled_edge,
    rock,
)

DRY = "[contact]\n[interfaces.i]\nfriction_angle = 0.4\n"
STIFF = "normal_stiffness = 1e10\nshear_stiffness = 1e10\n"
BONDS = "[formulation.contact]\nbond_stiffness = 100.0\n"
SOFTENS = """[contact]
[interfaces.i]
law = "linear_softening"
friction_angle = 0.5
cohesion = 2e6
tensile_strength = 1e6
bonded = true
fracture_energy = 1e4
normal_stiffness = 1e10
shear_stiffness = 1e10
"""
CONTROLLED = (
    rock()
    + TWO
    + SOFTENS
    + pulled_edge([[0, 2], [1, 2]], [2e4, 1e5])
    + monitor("o", [0.5, 1], "c")
    + monitor("u", [0.5, 1], "b")
    + '[loading]\nuntil = "failure"\n'
)
OPENED = """[loading.control]
type = "opening"
monitors = ["o", "u"]
direction = [0.0, 1.0]
increment = 5e-4
end = 4e-3
"""
MOVED = """[loading.control]
type = "displacement"
monitors = ["o"]
direction = [0.0, 1.0]
increment = 5e-4
end = 4e-3
"""
DISSIPATED = '[loading.control]\ntype = "dissipation"\nenergy = 500.0\nend_energy = 4e3\n'
EVENTS = '[loading.control]\ntype = "events"\nfall = 0.3\n'
HOLDS = DRY + "bonded = true\ncohesion = 1e8\ntensile_strength = 1e8\n"
FACTOR = "[strength_reduction]\nlowest = 0.8\nhighest = 3.0\n"
