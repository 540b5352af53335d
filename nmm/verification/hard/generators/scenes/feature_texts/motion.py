"""Texts of motion: kinematics, integrators, flight, blocks that are built and set free."""

QUADRATIC = '[formulation.cover]\nfunctions = "monomials"\ndegree = 2\n'
FINITE = f'{QUADRATIC}[formulation.rotation]\nupdate = "finite"\n'
CONSERVING = f'{FINITE}[formulation.integrator]\ntype = "energy_momentum"\nstep = 0.002\n'
FLIGHT = """[[initial_velocities]]
block = "c"
velocity = [3.0, -40.0]
angular_velocity = 20.0
"""
IN_TIME = '[formulation.integrator]\ntype = "newmark"\nstep = 1e-4\n'
MOVING = "duration = 0.02\n"
STANDING = """[gravity]
[inertia]
[[viscous_boundaries]]
name = "base"
segment = [[0, 0], [1, 0]]
reactions = true
[[loads]]
name = "push"
kind = "edge"
segment = [[0, 1], [1, 1]]
traction = [1e5, 2e4]
[[stages]]
name = "in place"
loads = []
[[stages]]
name = "free"
supports = []
loads = ["push"]
duration = 0.02
[formulation.integrator]
type = "newmark"
"""
BUILT = """[gravity]
[[loads]]
name = "push"
kind = "edge"
segment = [[0, 2], [1, 2]]
block = "c"
traction = [2e3, -1e4]
[[stages]]
name = "one"
blocks = ["b"]
loads = []
[[stages]]
name = "two"
add = ["c"]
loads = ["push"]
[[stages]]
name = "three"
duration = 0.01
remove = ["c"]
"""
NEWMARK = '[formulation.integrator]\ntype = "newmark"\n'
