"""A flat truss of two bars that snaps through: its load at given ways, and its limit load."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.reading import last_way

if TYPE_CHECKING:
    from nmm.stepping.run import Run

SPAN, RISE, STIFFNESS = 10.0, 1.0, 1e6
LIMIT = 379.19801295


def truss(head: str, tables: Sequence[str]) -> str:
    """Return half of the truss, one bar hinged at the origin whose other end moves up and down.

    Springs of 1000 E hold its ends: they soften it by 2e-5.
    """
    width = 0.1
    end = np.array([SPAN, RISE])
    side = width / 2 * np.array([-RISE, SPAN]) / np.hypot(SPAN, RISE)
    return text.scene(
        f'title = "Two-bar truss"\nplane = "stress"\n{head}'
        '[formulation.rotation]\nupdate = "finite"\n',
        [
            text.material("steel", STIFFNESS / width, 0.0, None),
            text.block("bar", "steel", [-side, end - side, end + side, side]),
            text.fixed_point("hinge", [0, 0]),
            text.monitor("apex", end, "bar"),
            *tables,
        ],
    )


@dataclass(frozen=True)
class PushedTruss(SceneCase):
    """The apex is led down a given way; bars take any strain in Green's measure."""

    way: float = 1.0
    name = "PA1"
    title = "Two-bar truss, led through and beyond its flat position"
    source = "P = E A (h - w) (2 h w - w^2) / L^3: Green's strain"
    # Ways before and past the limit, flat, pulled, and stress-free below.
    parameters: ClassVar = {"way": (0.2, 0.42264973, 0.5, 1.0, 1.5, 2.0, 2.2)}
    label = "w = {0.way:g} h"

    def scene(self) -> str:
        """Return the bar with its end led down."""
        return truss(
            "",
            [text.fixed_point("apex", [SPAN, RISE]) + f"displacement = [0, {-self.way * RISE}]\n"],
        )

    def measure(self, run: "Run") -> Checks:
        w, cube = self.way, np.hypot(SPAN, RISE) ** 3
        exact = STIFFNESS * (RISE - w) * (2 * RISE * w - w**2) / cube
        found = -2 * float(run.history["reaction:apex:y"][-1])
        return {"load (N)": Check(found, float(exact), 5e-5, "springs of the supports", LIMIT)}


class SnappedTruss(SceneCase):
    """The load on the apex grows until nothing balances it."""

    name = "PA1 limit"
    title = "Two-bar truss, largest load"
    source = "dP / dw = 0 at w = h (1 - 1 / sqrt 3): 379.19801295 N"

    def scene(self) -> str:
        """Return the bar with half of the load."""
        return truss(
            '[loading]\nuntil = "failure"\n'
            "[formulation.loading]\nincrement = 50.0\ntolerance = 1e-5\n",
            [
                text.fixed_point("apex", [SPAN, RISE], "x"),
                f'[[loads]]\nname = "push"\nkind = "point"\npoint = [{SPAN}, {RISE}]\n'
                "force = [0, -0.5]\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        load = run.summary.failure_factor
        way = -last_way(run, "apex")[1]
        return {
            "limit load (N)": Check(
                load or 0.0, LIMIT, 5e-5, "springs of the supports, the bracket"
            ),
            "limit point shown": holds(
                run.summary.status == "failure_load", "the stiffness vanishes"
            ),
            "way of the apex (m)": Check(
                float(way), 1 - 1 / np.sqrt(3), 1e-2, "goes as the root of the bracket: 3e-3"
            ),
        }
