"""Bodies without cracks, with a rule by which one begins."""

from collections.abc import Sequence

from nmm.verification import text

Box = Sequence[Sequence[float]]
# One increment to the place where a crack begins, and no growth after it.
ONCE = 'control = "toughness"\nmax_growth = 1e-3\n'


def body(tables: Sequence[str], rule: str, nucleation: str, head: str = "") -> str:
    """Return a scene in plane strain of matter of modulus 1 and toughness 1."""
    return text.scene(
        f'plane = "strain"\n{head}',
        [
            text.material("m", 1.0, 0.3, 1.0 if head else None),
            *tables,
            f"[fracture]\ntoughness = 1.0\nincrement = 0.1\n{rule}",
            f"[fracture.nucleation]\n{nucleation}\n",
        ],
    )


def plate(box: Box) -> str:
    """Return a block between two corners."""
    return text.block("plate", "m", text.rectangle(*box))


def led(box: Box, stress: Sequence[str]) -> list[str]:
    """Return tractions of a stress [xx, yy, xy] of x and y on all sides, and what holds a plate."""
    (x0, y0), (x1, y1) = box
    xx, yy, xy = stress
    sides = [
        ("right", [[x1, y0], [x1, y1]], (xx, xy)),
        ("left", [[x0, y1], [x0, y0]], (f"-({xx})", f"-({xy})")),
        ("up", [[x1, y1], [x0, y1]], (xy, yy)),
        ("down", [[x0, y0], [x1, y0]], (f"-({xy})", f"-({yy})")),
    ]
    loads = [
        f'[[loads]]\nname = "{name}"\nkind = "edge"\nsegment = {at}\nfield = ["{x}", "{y}"]\n'
        for name, at, (x, y) in sides
    ]
    pins = [("one", [x0, y0], '"x", "y"'), ("other", [x1, y0], '"y"')]
    held = [
        f'[[supports]]\nname = "{name}"\npoint = {at}\nfix = [{fix}]\n' for name, at, fix in pins
    ]
    return loads + held
