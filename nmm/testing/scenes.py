"""Texts of small scenes that several tests share: bars, a block on a slab, a pile with water."""

from collections.abc import Mapping, Sequence

import numpy as np

from nmm.verification import text

# A block of 1 m by 1 m on a floor, and one of 1 m by 2 m on it; loads and stages follow.
STACKED = """
title = "column"
plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000
[[blocks]]
name = "lower"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "upper"
material = "rock"
vertices = [[0, 1], [1, 1], [1, 3], [0, 3]]
[gravity]
acceleration = [0, -10]
[contact]
[interfaces.any]
between = "any"
friction_angle = 0.5
[[supports]]
name = "floor"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
[[monitors]]
name = "top"
point = [0.5, 1]
block = "lower"
"""


def pulled_bar(
    materials: Sequence[str],
    blocks: Sequence[tuple[str, str]],
    interface: str = "",
    plane: str = "stress",
    stress: float = 1.0,
    ends: Sequence[float] | None = None,
) -> str:
    """Return blocks 1 m high in a row from the origin, held at the left and pulled at the right.

    Without Poisson's ratios each grows by ``stress / E`` times its length; "end" is the monitor of
    the right end.

    Parameters
    ----------
    materials, interface
        Tables.
    blocks
        Name and material of each, from the left.
    stress
        Traction (Pa) at the right end.
    ends
        Where each block ends (m); after 1 m each where not given.
    """
    places = [0, *(ends or range(1, len(blocks) + 1))]
    row = zip(blocks, places[:-1], places[1:], strict=True)
    n = places[-1]
    return text.scene(
        f'plane = "{plane}"',
        [
            *materials,
            interface,
            *(text.block(name, made, text.rectangle((a, 0), (b, 1))) for (name, made), a, b in row),
            text.fixed_edge("left", ((0, 0), (0, 1))),
            text.pulled_edge("pull", [[n, 0], [n, 1]], [stress, 0]),
            text.monitor("end", (n, 0.5), blocks[-1][0]),
        ],
    )


def block_on_slab(poisson: float, supports: Sequence[str], inertia: str = "") -> str:
    """Return a block of .6 m on a slab of 2 m by .5 m, which ``supports`` hold from below.

    The two weigh 9.81 * 2000 * 1.36 N; "top" is the monitor of the block's upper side. ``inertia``
    are keys of scenes in time, ahead of all tables.
    """
    return text.scene(
        f'{inertia}plane = "strain"\n[contact]\n[gravity]\n',
        [
            text.material("m", 1e7, poisson, 2000.0),
            text.interface("i", 30.0),
            text.box("base", (0, 0), (2, 0.5), "m"),
            text.block("top", "m", text.rectangle((0.7, 0.5), (1.3, 1.1))),
            *supports,
            text.monitor("top", (1, 1.1), "top"),
        ],
    )


def roller_and_pin(height: float = 1.0) -> str:
    """Return tables that hold the left end of a bar from the origin: along it, and its corner."""
    left = text.fixed_edge("left", [(0, 0), (0, height)], "x")
    return left + text.fixed_point("pin", (0, 0), "y")


def floor_and_pin(width: float = 1.0) -> str:
    """Return tables that hold what stands on the x axis: its foot upright, its corner along it."""
    base = text.fixed_edge("base", [(0, 0), (width, 0)], "y")
    return base + text.fixed_point("pin", (0, 0), "x")


def salt_block(law: str, constants: str, loads: Mapping[str, float], head: str = "") -> str:
    """Return a block of 1 m by 1 m that creeps, on a floor, with monitors at its top and foot.

    Parameters
    ----------
    law, constants
        Of its matter, besides 10 GPa and 0.25.
    loads
        Tractions on its top (MPa) by name.
    head
        Keys of the scene.
    """
    return text.scene(
        f'plane = "strain"\n{head}',
        [
            f'[materials.salt]\nlaw = "{law}"\nyoung_modulus = "10 GPa"\npoisson_ratio = 0.25\n'
            f"{constants}\n",
            text.box("block", (0, 0), (1, 1), "salt"),
            floor_and_pin(),
            *(
                text.pulled_edge(name, [[0, 1], [1, 1]], [0, 1e6 * pull])
                for name, pull in loads.items()
            ),
            text.monitor("top", (0.5, 1), "block"),
            text.monitor("foot", (0.5, 0), "block"),
        ],
    )


def biaxial_test(dilation: float, more: str = "") -> str:
    """Return a block of soil that a plate presses by 2 % under 100 kPa from its side.

    Its law is Mohr-Coulomb's: cohesion 20 kPa, friction 30 degrees, ``dilation`` in degrees. It
    yields at ``2 c cos / (1 - sin) + 100 (1 + sin) / (1 - sin)`` kPa. ``more`` are tables besides.
    """
    return text.scene(
        'plane = "strain"',
        [
            '[materials.soil]\nlaw = "mohr_coulomb"\nyoung_modulus = "50 MPa"\n'
            'poisson_ratio = 0.25\ncohesion = "20 kPa"\nfriction_angle = "30 deg"\n'
            f'dilation_angle = "{dilation} deg"\n',
            text.box("soil", (0, 0), (1, 1), "soil"),
            text.fixed_edge("left", ((0, 0), (0, 1)), "x"),
            text.fixed_edge("base", ((0, 0), (1, 0)), "y"),
            text.fixed_edge("plate", ((0, 1), (1, 1)), "y") + "displacement = [0, -0.02]\n",
            text.pulled_edge("side", [[1, 0], [1, 1]], [-100e3, 0]),
            text.monitor("side", (1, 0.5), "soil"),
            text.monitor("top", (0.5, 1), "soil"),
            '[loading]\nscaled = ["plate"]\n',
            more,
        ],
    )


def column_on_ground(gravity: bool = True, reactions: bool = True, incoming: bool = True) -> str:
    """Return a column of 2 m by 4 m in time, held by its foot, on a viscous boundary.

    Parameters
    ----------
    gravity, incoming
        Whether it has weight, and whether "wave" comes from below.
    reactions
        Whether the boundary takes on what a support exerts that a stage takes away.
    """
    wave = 'incoming = { x = "wave" }\n' if incoming else ""
    return text.scene(
        'title = "column on ground that goes on"\nplane = "strain"\n',
        [
            text.material("soil", 100e6, 0.25, 2000.0),
            text.box("soil", (0, 0), (2, 4), "soil"),
            "[gravity]\n" if gravity else "",
            "[inertia]\n",
            "[records.wave]\nvalues = [0, 0.1, 0.3, 0.1, 0, 0, 0, 0, 0]\nstep = 0.01\n"
            'quantity = "velocity"\n',
            text.fixed_edge("bottom", ((0, 0), (2, 0))),
            '[[viscous_boundaries]]\nname = "base"\nsegment = [[0, 0], [2, 0]]\n'
            f"reactions = {str(reactions).lower()}\n{wave}",
        ],
    )


def wet_pile(aperture: str = "0.2 mm") -> str:
    """Return tables of two blocks of 2 m by 1 m on a held one, with water in their joints.

    The joints let water through by their ``aperture``; it stands 1.5 m high at the left end of
    the lying joint.
    """
    blocks = {"base": ((0, -1), (4, 1)), "left": ((0, 0), (2, 1)), "right": ((2, 0), (2, 1))}
    return text.scene(
        text.material("rock", 10e9, 0.2, 2500.0),
        [
            text.interface("joint", 40.0, more={"normal_stiffness": 1e10, "shear_stiffness": 1e10}),
            f'aperture = "{aperture}"\nresidual_aperture = "0.01 mm"\n',
            *(text.box(name, *place) for name, place in blocks.items()),
            text.fixed_block("base"),
            '[[joint_heads]]\nname = "in"\npoint = [0, 0]\nhead = 1.5\n',
        ],
    )


def block_on_incline(slope: float, friction: float, cohesion: float = 0.0, search: str = "") -> str:
    """Return a block of 1 m by 0.5 m on an incline, whose factor of safety is sought.

    Without cohesion it is ``tan(friction) / tan(slope)``.

    Parameters
    ----------
    slope, friction
        In degrees.
    cohesion
        Pa.
    search
        Keys of ``[strength_reduction]``.
    """
    angle = np.radians(slope)
    along = np.array([np.cos(angle), np.sin(angle)])
    off = 0.5 * np.array([-along[1], along[0]])
    above = 3 * along + off, 2 * along + off
    ground = 6 * np.array([[0.0, 0.0], [along[0], 0.0], along])
    return text.scene(
        'plane = "strain"\n[gravity]\n[contact]',
        [
            text.material("rock", 1e9, 0.2, 2000.0),
            text.interface("joint", friction, more={"cohesion": cohesion}),
            text.block("slope", "rock", ground),
            text.block("block", "rock", np.array([2 * along, 3 * along, *above])),
            text.fixed_block("slope"),
            f"[strength_reduction]\n{search}\n",
        ],
    )
