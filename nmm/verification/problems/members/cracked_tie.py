"""A reinforced tie whose bond slides: how far from a crack its concrete is pulled, how much."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import converged

if TYPE_CHECKING:
    from nmm.stepping.run import Run

LENGTH, BLOCKS, JACK, DEPTH, DIAMETER = 1.08, 36, 0.06, 0.1, 16e-3
STEEL = np.pi * DIAMETER**2 / 4
# Blocks lie under the bar as well: their area is that of the concrete without it.
NET = DEPTH**2 - STEEL
TENSILE, BOND = 2.9e6, 5.8e6


class CrackedTie(SceneCase):
    """From a crack on a bar hands its force to the concrete, over a length that its bond sets.

    Where that is done the concrete cracks again, so that cracks lie one such length apart or more.
    The ends of the tie are such cracks. Pieces of the bar are as long as the blocks, so that each
    block takes what slides along it.
    """

    name = "BO3"
    title = "Tie between cracks under constant bond"
    source = "N = f (A_c + n A_s), length f A_c / (tau pi d) (CEB-FIP Model Code)"
    way = 2.45e-4

    def scene(self) -> str:
        """Return a row of blocks on a bar that two jacks pull, nearly to its first crack."""
        wide, end = LENGTH / BLOCKS, LENGTH + JACK
        return text.scene(
            f'title = "Tie"\nplane = "stress"\nthickness = {NET / DEPTH!r}\n[contact]\n[loading]\n'
            '[formulation.rotation]\nupdate = "small"\n[formulation.loading]\nincrement = 0.02\n',
            [
                text.material("concrete", 30e9, 0.0, None),
                text.material("rig", 1e15, 0.0, None),
                text.interface("joint", 45.0, ("concrete", "concrete"))
                + f"bonded = true\ncohesion = 1e8\ntensile_strength = {TENSILE!r}\n",
                text.interface("crack", 0.0, ("concrete", "rig")),
                *(
                    text.box(f"b{i}", (i * wide, -DEPTH / 2), (wide, DEPTH), "concrete")
                    for i in range(BLOCKS)
                ),
                text.box("left", (-JACK, -DEPTH / 2), (JACK, DEPTH), "rig"),
                text.box("right", (LENGTH, -DEPTH / 2), (JACK, DEPTH), "rig"),
                f'[[bars]]\nname = "bar"\npoints = [[{-JACK}, 0], [{end}, 0]]\nends = "fixed"\n'
                f"diameter = {DIAMETER!r}\nyoung_modulus = 200e9\n"
                f'[bars.bond]\nlaw = "plastic"\nstiffness = 1e12\nstrength = {BOND!r}\n',
                text.fixed_block("left"),
                '[[supports]]\nname = "pull"\nblock = "right"\nfix = ["x", "y"]\n'
                f"displacement = [{self.way!r}, 0]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        frame, wide = run.frames[-1], LENGTH / BLOCKS
        joint = np.round(frame.contact_position[:, 0] / wide).astype(int)
        carried = np.bincount(joint, frame.contact_force[:, 0], minlength=BLOCKS + 1)
        most, force = float(carried.max()), float(run.history["bars:bar:force"][-1])
        slope = float(np.mean([carried[1:3] / wide / [1, 2], carried[-2:-4:-1] / wide / [1, 2]]))
        rate, nothing = BOND * np.pi * DIAMETER, "in the middle nothing slides"
        return {
            "force of the next crack (N)": Check(
                force * TENSILE * NET / most, 32304.12, 1e-4, nothing
            ),
            "concrete takes up along the bar (N/m)": Check(slope, rate, 1e-3, "the bond's yield"),
            "length of transfer (m)": Check(
                TENSILE * NET / slope, 97.4718e-3, 1e-3, "it follows from the slope"
            ),
            "concrete is near its strength": holds(
                0.95 < most / (TENSILE * NET) < 1, "by the choice of the way"
            ),
            "at rest": holds(converged(run), "every increment is in equilibrium"),
        }
