"""A uniform pressure between blocks: the contact patch test, over faces and at corners alone."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.geometry.tessellation.cover_types import block_cover
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds, limit
from nmm.verification.formulations import with_cover_keys
from nmm.verification.reading import converged

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run


@dataclass(frozen=True)
class ContactPatch(SceneCase):
    """A uniform pressure passes from one block to another, whatever the covers of either.

    The tops of both blocks carry the pressure, but for the part of the lower that the upper covers.
    """

    name = "B20"
    title = "Contact patch test, 1 x 1 on 3 x 1 with covers that do not match"
    source = "Uniform stress -1 (Taylor and Papadopoulos 1991)"
    formulations: ClassVar[tuple[str, ...]] = (
        *("dda", "degree 2", "degree 3", "finite elements", "manifold", "manifold degree 2"),
        *("bilinear quads", "quads", "quads degree 2"),
    )
    points = "faces"
    enforcement: str = "penalty"
    parameters: ClassVar = {"enforcement": ("penalty", "lagrange", "augmented", "cone")}
    label = "{0.enforcement}"

    def scene(self) -> str:
        """Return both blocks, free to widen."""
        loads = [
            ("middle", "upper", -0.5, 0.5, 1.0),
            ("left", "lower", -1.5, -0.5, 0.0),
            ("right", "lower", 0.5, 1.5, 0.0),
        ]
        return text.scene(
            'title = "Contact patch test"\nplane = "stress"\n[contact]\n'
            f'[formulation.contact]\nenforcement = "{self.enforcement}"\n'
            f'points = "{self.points}"\n',
            [
                text.material("soft", modulus=1000.0, poisson=0.3, density=None),
                text.interface("smooth", 0.0),
                text.block("lower", "soft", text.rectangle((-1.5, -1), (1.5, 0))),
                text.block("upper", "soft", text.rectangle((-0.5, 0), (0.5, 1))),
                text.fixed_edge("foot", [[-1.5, -1], [1.5, -1]], "y"),
                *text.pins({"lower": (0.0, -1.0), "upper": (0.0, 1.0)}),
                *(
                    f'[[loads]]\nname = "press {side}"\nkind = "edge"\nblock = "{block}"\n'
                    f"segment = [[{low}, {height}], [{high}, {height}]]\ntraction = [0, -1]\n"
                    for side, block, low, high, height in loads
                ),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return meshes with a net of its own for the upper block."""
        found = super().formulation(scene, name)
        if block_cover(found.cover) is not None:
            return found
        return with_cover_keys(
            found,
            angle=np.radians(17),
            shift=(0.3, 0.2),
            nets=[{"block": "upper", "size": 0.23, "angle": -np.radians(11)}],
        )

    def measure(self, run: "Run") -> Checks:
        miss = float(np.abs(run.stress - [0.0, -1.0, 0.0]).max())
        if not converged(run):
            return {"in equilibrium": holds(False, run.summary.sentence)}
        most = 1e-8
        reason = "the springs give way evenly; turn of covers by 1e-3 of the strain squared"
        if self.enforcement != "penalty":
            reason = "residual 1e-8 of the load"
        if self.enforcement in ("augmented", "cone"):
            # They reach the stress through points that stand for little.
            most, reason = 5e-7, "gaps within 1e-7 of what forces press in; small cut cells"
        return {"largest error of stress (Pa)": limit(miss, most, reason)}


class NodeToSegment(ContactPatch):
    """Springs of one stiffness at all corners: no uniform stress but by chance."""

    name = "B20 corners"
    title = "The contact patch test fails with contact at corners alone"
    points = "vertices"
    formulations = ("finite elements", "manifold", "quads")
    parameters: ClassVar = {"enforcement": ("penalty",)}

    def measure(self, run: "Run") -> Checks:
        """Say by how much the stress is off."""
        miss = float(np.abs(run.stress - [0.0, -1.0, 0.0]).max())
        reason = "known fault of contact at corners; 0.2 to 1.1 measured"
        return {"largest error of stress (Pa)": Check(miss, 0.1, 0.0, reason, bound="at_least")}
