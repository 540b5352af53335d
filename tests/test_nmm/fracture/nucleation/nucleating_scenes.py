"""Bodies without cracks, with a rule by which one begins."""

from collections.abc import Sequence

from nmm.verification import text
from nmm.verification.problems.cracks.nucleation import Box

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
