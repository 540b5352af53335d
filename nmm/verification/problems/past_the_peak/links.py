"""Links and columns side by side that break one by one, in the order of their strength."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

HELD = "supports of 1000 E over what is held give by 3e-4 of a link"
LINKS = (1.05, 0.82, 1.31, 0.64, 1.47, 0.93, 1.18, 0.71, 1.26, 1.02)
"""Strengths (N) of ten links of 1 N/um."""


def bundle(
    strengths: Sequence[float], control: str, stiffness: Sequence[float] | None = None
) -> str:
    """Return links of 1 m, driven together at their tops: the load factor is the way in um.

    Parameters
    ----------
    strengths
        Forces (N) at which they break.
    control
        Table of the path.
    stiffness
        Forces per length (N/m); 1 N/um where None.
    """
    width = 0.1
    tables = []
    for number, strength in enumerate(strengths):
        left = number * 0.3
        each = 1e6 if stiffness is None else stiffness[number]
        more = {"cohesion": 1e9, "bonded": True, "tensile_strength": strength / width}
        ends = [[left, 1], [left + width, 1]]
        tables += [
            text.material(f"rock{number}", modulus=each / width, poisson=0.0),
            text.material(f"f{number}", modulus=1e14, poisson=0.0),
            text.interface(f"i{number}", 30.0, (f"f{number}", f"rock{number}"), more),
            text.block(f"c{number}", f"rock{number}", text.rectangle((left, 0), (left + width, 1))),
            text.block(f"b{number}", f"f{number}", text.rectangle((left, -1), (left + width, 0))),
            text.fixed_block(f"b{number}"),
            text.fixed_edge(f"s{number}", ends) + "displacement = [0, 1e-6]\n",
        ]
    tables.append(text.monitor("top", (width / 2, 1), "c0"))
    head = 'plane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n'
    return text.scene(f"{head}[loading.control]\n{control}", tables)


def pull(run: "Run", count: int) -> Floats:
    """Force (steps,) on the tops of ``count`` links (N)."""
    forces = [run.history[f"reaction:s{number}:y"] for number in range(count)]
    return np.asarray(np.sum(forces, axis=0))


class PlatenColumns(SceneCase):
    """Columns of three heights between platens: each break drops the force by one of them."""

    name = "PA3"
    title = "Three columns between platens break one by one"
    source = "E A / L of 20, 10, 5 kN/mm, strengths of 200, 250, 400 N"
    strengths = (200.0, 250.0, 400.0)

    def scene(self) -> str:
        """Return the columns as links of their stiffness, led down by steps of 3 um."""
        control = (
            'type = "displacement"\nmonitors = ["top"]\ndirection = [0, 1]\n'
            'increment = "3 um"\nend = "90 um"\n'
        )
        return bundle(self.strengths, control, (20e6, 10e6, 5e6))

    def measure(self, run: "Run") -> Checks:
        way, force = run.history["load_factor"], pull(run, 3)
        events = np.flatnonzero(np.diff(run.history["broken"]) > 0)
        known = zip((10.0, 25.0, 80.0), (350.0, 375.0, 400.0), (150.0, 125.0, 0.0), strict=True)
        checks = {"breaks": Check(float(len(events)), 3.0, 0.0, "one at a time")}
        for event, (where, before, after) in zip(events, known, strict=False):
            label = f"break at {where:g} um"
            checks |= {
                f"{label}: way (um)": Check(float(way[event]), where, 1e-3, HELD),
                f"{label}: force before (N)": Check(
                    float(force[event]), before, 1e-8, "events are located"
                ),
                f"{label}: force after (N)": Check(
                    float(force[event + 1]), after, 1e-4, HELD, 350.0
                ),
            }
        return checks


class FibreBundle(SceneCase):
    """Ten equal links: each event breaks the weakest that is left."""

    name = "PA4"
    title = "Ten links break one by one, the third at the largest force"
    source = "F_k = (n - k + 1) f_k: Daniels 1945"

    def scene(self) -> str:
        """Return the links, from event to event."""
        return bundle(LINKS, 'type = "events"\n')

    def measure(self, run: "Run") -> Checks:
        order = np.sort(LINKS)
        known = order * np.arange(len(LINKS), 0, -1)
        force, way = pull(run, len(LINKS)), run.history["load_factor"]
        if len(force) != len(known):
            return {"events": Check(float(len(force)), float(len(known)), 0.0, "one a link")}
        checks = {
            f"force at break {number + 1} (N)": Check(
                float(force[number]), float(known[number]), 1e-8, "events are located"
            )
            for number in range(len(known))
        }
        off = float(np.abs(way / order - 1).max())
        return checks | {"ways off": limit(off, 1e-3, HELD)}
