"""Texts of plates with a crack, and of the nets and loads that tests of cracks share."""

from collections.abc import Sequence

from nmm.verification import text

# The load of `notched_plate`: 1 Pa along its upper edge.
PULLED = "\n" + text.pulled_edge("up", [[0, 0.5], [1, 0.5]], [0, 1.0])

# What pulls a body of 2 m by 2 m apart, above and below the level of the origin, by 1 MPa.
PULLED_APART = "\n" + text.pulled_edge("up", [(0, 1), (2, 1)], (0, 1e6))
PULLED_APART += text.pulled_edge("down", [(0, -1), (2, -1)], (0, -1e6))

# Two halves of that body side by side, of materials of their own.
HALVES_APART = "".join(
    text.material(side, 1e9, 0.3, None) + text.box(side, (x, -1), (1, 2), side)
    for side, x in (("left", 0), ("right", 1))
)


def cracked_plate(crack: Sequence[Sequence[float]], pull: float = 1.0, more: str = "") -> str:
    """Return a plate of 1 m by 2 m about the level of the origin, held below and pulled above.

    Parameters
    ----------
    crack
        Its points (m).
    pull
        Traction (Pa) on the upper edge.
    more
        Tables besides.
    """
    return text.scene(
        'plane = "strain"',
        [
            text.material("m", 1.0, 0.3, None),
            text.box("b", (0, -1), (1, 2), "m"),
            f'[[cracks]]\nname = "c"\npoints = {[list(point) for point in crack]}\n',
            text.pulled_edge("up", ((0, 1), (1, 1)), (0, pull)),
            text.fixed_edge("floor", ((0, -1), (1, -1))),
            more,
        ],
    )


def notched_plate(fracture: str, pulled: str = PULLED, tip: float = 0.3) -> str:
    """Return a plate of 1 m by 1 m that stands on its lower edge, with a crack from the left.

    Parameters
    ----------
    fracture
        Keys of ``[fracture]``.
    pulled
        Tables of what pulls it.
    tip
        Where the "notch" ends (m).
    """
    return text.scene(
        'plane = "strain"',
        [
            text.material("m", 1.0, 0.3, None),
            text.box("plate", (0, -0.5), (1, 1), "m"),
            f'[[cracks]]\nname = "notch"\npoints = [[-0.1, 0.0], [{tip}, 0.0]]\n',
            text.fixed_edge("floor", ((0, -0.5), (1, -0.5))),
            pulled,
            f"[fracture]\n{fracture}\n",
        ],
    )


def turned_net(size: float, angle: float = 0.3, shift: Sequence[float] = (0.13, 0.27)) -> str:
    """Return a formulation: triangles of degree 1, of which no line meets an edge of the scenes."""
    return (
        f'[cover]\ntype = "triangles"\nsize = {size}\nangle = {angle}\nshift = {list(shift)}\n'
        'degree = 1\n[supports]\nmethod = "nitsche"\n'
    )
