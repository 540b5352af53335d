"""Texts of scenes that small scenes of single features are put together from."""

from collections.abc import Sequence

from nmm.verification import text

HEAD = """plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000.0
{material}
"""


def rock(material: str = "") -> str:
    """Return a material of rock, with more keys."""
    return HEAD.format(material=material)


def box(name: str, left: float, low: float, right: float, high: float) -> str:
    """Return an upright block."""
    corners = [[left, low], [right, low], [right, high], [left, high]]
    return f'[[blocks]]\nname = "{name}"\nmaterial = "m"\nvertices = {corners}\n'


def fixed_edge(segment: Sequence[Sequence[float]], block: str) -> str:
    """Return a support along an edge of a block."""
    return (
        f'[[supports]]\nname = "held"\nblock = "{block}"\nsegment = {segment}\nfix = ["x", "y"]\n'
    )


def pulled_edge(segment: Sequence[Sequence[float]], traction: Sequence[float]) -> str:
    """Return a traction (Pa) along an edge."""
    return text.pulled_edge("pull", segment, traction)


def monitor(name: str, point: Sequence[float], block: str) -> str:
    """Return a monitor at a point of a block."""
    return f'[[monitors]]\nname = "{name}"\npoint = {point}\nblock = "{block}"\n'


def quads(size: float, degree: int = 1) -> str:
    """Return a cover of quads."""
    return f'[formulation.cover]\ntype = "quads"\nsize = {size}\ndegree = {degree}\nangle = 0.0\n'


FLOOR = box("b", 0, 0, 1, 1) + fixed_edge([[0, 0], [1, 0]], "b")
HELD_BELOW = fixed_edge([[0, 0], [1, 0]], "b")
TWO = FLOOR + box("c", 0, 1, 1, 2)
SOFT = 'law = "neo_hookean"'
QUADRATIC = '[formulation.cover]\nfunctions = "monomials"\ndegree = 2\n'
FINITE = f'{QUADRATIC}[formulation.rotation]\nupdate = "finite"\n'
CONSERVING = f'{FINITE}[formulation.integrator]\ntype = "energy_momentum"\nstep = 0.002\n'
FLIGHT = """[[initial_velocities]]
block = "c"
velocity = [3.0, -40.0]
angular_velocity = 20.0
"""
DRY = "[contact]\n[interfaces.i]\nfriction_angle = 0.4\n"
STIFF = "normal_stiffness = 1e10\nshear_stiffness = 1e10\n"
BONDS = "[formulation.contact]\nbond_stiffness = 100.0\n"
IN_TIME = '[formulation.integrator]\ntype = "newmark"\nstep = 1e-4\n'
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
CRACK = '[[cracks]]\nname = "k"\npoints = [[0.0, 0.5], [0.45, 0.5]]\n'
MOVING = "duration = 0.02\n"
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
SLOPE = """[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [10, 0], [10, 5.773502691896258]]
[[blocks]]
name = "c"
material = "m"
vertices = [
    [5, 2.886751345948129], [8, 4.618802153517006],
    [7, 6.350852961085883], [4, 4.618802153517006],
]
[[supports]]
name = "held"
block = "b"
fix = ["x", "y"]
"""
HOLDS = DRY + "bonded = true\ncohesion = 1e8\ntensile_strength = 1e8\n"
FACTOR = "[strength_reduction]\nlowest = 0.8\nhighest = 3.0\n"
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
WEIGHT = "[gravity]\n"
INERTIA = "[inertia]\n"
NEWMARK = '[formulation.integrator]\ntype = "newmark"\n'
