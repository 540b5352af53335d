"""A lever on a row of links that break one after the other, from its far end to its hinge."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase

if TYPE_CHECKING:
    from nmm.stepping.run import Run

PLACES = (0.2, 0.4, 0.6, 0.8, 1.0)
"""Places (m) of links of 1 N/um and 1 kN, from the hinge."""
STIFFNESS, STRENGTH, ARM = 1e6, 1e3, 1.5
WIDTH = 0.004


def known() -> list[tuple[float, float]]:
    """Return the turn (rad) and the load (N) at which each link breaks, the farthest first."""
    found = []
    for left in range(len(PLACES), 0, -1):
        turn = STRENGTH / (STIFFNESS * PLACES[left - 1])
        found.append((turn, STIFFNESS * turn * sum(x**2 for x in PLACES[:left]) / ARM))
    return found


class Lever(SceneCase):
    """The load falls from link to link: bonds that open like a zip."""

    name = "PA5"
    title = "A lever breaks its links one after the other"
    source = "P l = k turn sum(x^2) of the links left; the farthest breaks first"
    places = PLACES

    def scene(self) -> str:
        """Return a rigid lever, hinged at its left end, on columns that are bonded to it."""
        tables = [
            text.material("steel", modulus=1e11, poisson=0.0),
            text.block("lever", "steel", text.rectangle((0, 1), (1.6, 1.2))),
            '[[supports]]\nname = "hinge"\npoint = [0, 1]\nblock = "lever"\nfix = ["x", "y"]\n',
            text.pulled_edge("push", [[ARM - 0.01, 1.2], [ARM + 0.01, 1.2]], [0, 50.0]),
            text.monitor("tip", (ARM, 1.2), "lever"),
        ]
        for number, place in enumerate(self.places):
            ends = (place - WIDTH / 2, 0), (place + WIDTH / 2, 1)
            more = {"cohesion": 1e9, "bonded": True, "tensile_strength": STRENGTH / WIDTH}
            tables += [
                text.material(f"rock{number}", modulus=STIFFNESS / WIDTH, poisson=0.0),
                text.block(f"link{number}", f"rock{number}", text.rectangle(*ends)),
                text.interface(f"bond{number}", 30.0, ("steel", f"rock{number}"), more),
                text.fixed_edge(f"foot{number}", [[ends[0][0], 0], [ends[1][0], 0]]),
            ]
        head = 'plane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n'
        return text.scene(f'{head}[loading.control]\ntype = "events"\n', tables)

    def measure(self, run: "Run") -> Checks:
        load, turn = run.history["load_factor"][::2], run.history["monitor:tip:uy"][::2] / ARM
        number = len(run.history["load_factor"])
        checks = {"points that break": Check(float(number), 2.0 * len(PLACES), 0.0, "two a link")}
        why = (
            "a link of 4 mm bends: at most 0.6 % by its far point, as much by the turn of its bond"
        )
        for place, one, there, found in zip(
            PLACES[::-1], known(), turn.tolist(), np.asarray(load).tolist(), strict=False
        ):
            checks |= {
                f"link at {place:g} m: turn": Check(there, one[0], 1.2e-2, why),
                f"link at {place:g} m: load (N)": Check(found, one[1], 1.2e-2, why),
            }
        return checks
