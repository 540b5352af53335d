"""Texts of blocks, their supports and tractions, and nets over them."""

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
CRACK = '[[cracks]]\nname = "k"\npoints = [[0.0, 0.5], [0.45, 0.5]]\n'
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
WEIGHT = "[gravity]\n"
INERTIA = "[inertia]\n"
