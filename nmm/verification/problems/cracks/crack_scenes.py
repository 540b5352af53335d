"""What problems of growing cracks are put together from."""

from abc import abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Checks, SceneCase, limit

if TYPE_CHECKING:
    from nmm.stepping.run import Run

Line = list[list[float]]


class GrowingCrack(SceneCase):
    """A body whose cracks grow at their toughness."""

    formulations = ("dda",)
    modulus = 1.0
    poisson = 0.3
    slow = True

    @property
    @abstractmethod
    def tables(self) -> Sequence[str]:
        """Body, cracks, loads, supports, rule of growth and formulation."""

    def scene(self) -> str:
        """Return the body in plane strain."""
        matter = text.material("m", self.modulus, self.poisson, None)
        return text.scene('plane = "strain"', [matter, *self.tables])


def crack(name: str, points: Line) -> str:
    """Table of a crack."""
    return f'[[cracks]]\nname = "{name}"\npoints = {points}\n'


def grown(increment: float, most: float, resistance: str = "toughness = 1.0") -> str:
    """Table of growth at the toughness."""
    rule = f'increment = {increment}\nmax_growth = {most}\ncontrol = "toughness"\n'
    return f"[fracture]\n{resistance}\n{rule}"


def net(size: float, angle: float, kind: str = "triangles", options: str = "") -> str:
    """Table of a cover of degree 1, turned by an angle in degrees and shifted."""
    return (
        f'[formulation.cover]\ntype = "{kind}"\nfunctions = "monomials"\nsize = {size}\n'
        f"degree = 1\nangle = {float(np.radians(angle))!r}\nshift = [0.13, 0.27]\n{options}"
    )


def path(run: "Run", front: str) -> tuple[Floats, Floats]:
    """Place (n, 2) of a front in each step, and its K_I under a load factor of one."""
    history = run.history
    place = np.stack([history[f"fracture:{front}:{axis}"] for axis in "xy"], axis=1)
    return place, np.asarray(history[f"fracture:{front}:K_I"] / history["load_factor"])


def energy_kept(run: "Run") -> Checks:
    """How far the energy that growth freed is from what its toughness took."""
    missed = run.summary.audits["growth_energy"]
    return {"energy freed less taken, of the largest": limit(missed, 1e-3, "the benchmark's")}
