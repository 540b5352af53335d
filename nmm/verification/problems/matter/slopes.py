"""Factors of safety of slopes that joints cut into blocks: two joint sets, and toppling columns."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.problems.contact.columns import LeaningColumns
from nmm.verification.problems.matter.joint_forces import JointForces
from nmm.verification.text import G

if TYPE_CHECKING:
    from nmm.stepping.run import Run

DENSITY = 2600.0


@dataclass(frozen=True)
class JointedSlope(SceneCase):
    """A slope, 10 m high, cut by a bedding that comes out of its face and by cross joints.

    Where cross joints lean little every bed slides by itself: the factor is that of one block on a
    plane. Where they lean back, columns topple and push at the toe; the reference is then the least
    factor over which no forces at ends of joints carry the weight, by a linear programme of its
    own over polygons that shapely cuts. Friction finds such forces here up to the bracket's width,
    which it need not.
    """

    name = "PL5 slope"
    title = "Slope of two joint sets: strength reduction"
    source = "tan phi over tan of the bedding's dip; linear programme over forces"
    formulations = ("dda",)
    dips: tuple[float, float] = (35.0, 110.0)
    spacings: tuple[float, float] = (3.0, 4.0)
    friction: float = 45.0
    slides: bool = True

    face = 60.0
    height = 10.0
    behind = 20.0

    @classmethod
    def variants(cls) -> "tuple[JointedSlope, ...]":
        """Beds that slide, finer ones, and two nets whose columns topple."""
        return (
            cls(),
            cls((35.0, 110.0), (1.5, 2.0)),
            cls((20.0, 120.0), (3.0, 1.5), 45.0, slides=False),
            cls((30.0, 120.0), (3.0, 2.0), 40.0, slides=False),
        )

    @property
    def variant(self) -> str:
        dips, apart = (
            " and ".join(f"{one:g}" for one in two) for two in (self.dips, self.spacings)
        )
        return f"joints at {dips} degrees, {apart} m apart, " + (
            "slides" if self.slides else "topples"
        )

    @property
    def slow(self) -> bool:
        """Nets of sixty and more blocks take some seconds."""
        return self.spacings != (3.0, 4.0)

    @property
    def outline(self) -> Floats:
        """Corners (4, 2) of the jointed rock."""
        crest = self.height / float(np.tan(np.radians(self.face)))
        far = self.behind
        return np.array([(0.0, 0.0), (far, 0.0), (far, self.height), (crest, self.height)])

    @property
    def origins(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """A point on a joint of either set."""
        return (0.0, 0.7), (float(self.outline[3, 0]) + 1.5, self.height)

    @property
    def joint(self) -> str:
        """The joints' interface."""
        return text.interface("joint", self.friction)

    def scene(self) -> str:
        """Return the slope on and before rock that is held."""
        far, high = self.behind, self.height
        base = [(-6, -4), (far + 4, -4), (far + 4, high), (far, high), (far, 0), (0, 0), (-6, 0)]
        return text.scene(
            'title = "Jointed slope"\nplane = "strain"\n',
            [
                text.material("rock", 10e9, 0.25, DENSITY),
                self.joint,
                text.block("base", "rock", base),
                text.block("slope", "rock", self.outline),
                *(
                    f'[[joint_sets]]\nname = "set {n}"\nblock = "slope"\ndip = "{dip} deg"\n'
                    f"spacing = {apart}\norigin = {list(at)}\n"
                    for n, (dip, apart, at) in enumerate(
                        zip(self.dips, self.spacings, self.origins, strict=True)
                    )
                ),
                text.fixed_block("base"),
                "[gravity]\n[contact]\n[strength_reduction]\n",
            ],
        )

    @property
    def factor(self) -> float:
        """The factor that fails: closed form where beds slide, linear programme elsewhere."""
        if self.slides:
            tangents = np.tan(np.radians([self.friction, self.dips[0]]))
            return float(tangents[0] / tangents[1])
        return self.bound()

    def bound(self, cohesion: float = 0.0) -> float:
        """Least factor over which no forces at ends of joints carry the weight."""
        blocks, ground = self.pieces()
        forces = JointForces.of(blocks, ground, DENSITY * G)
        return forces.factor(float(np.tan(np.radians(self.friction))), cohesion)

    def pieces(self) -> tuple[list[Any], Any]:
        """Polygons between the joints, and the ground below and behind."""
        from shapely import LineString, Polygon
        from shapely.ops import polygonize, unary_union

        whole = Polygon(self.outline)
        lines: list[Any] = [whole.boundary]
        for dip, apart, at in zip(self.dips, self.spacings, self.origins, strict=True):
            along = np.array([np.cos(np.radians(dip)), np.sin(np.radians(dip))])
            across = np.array([-along[1], along[0]])
            for n in range(-60, 61):
                middle = np.array(at) + n * apart * across
                lines.append(LineString([middle - 100 * along, middle + 100 * along]))
        pieces = polygonize(unary_union(lines))
        blocks = [one for one in pieces if whole.contains(one.representative_point())]
        far, high = self.behind, self.height
        return blocks, Polygon(
            [(0, -1), (far + 1, -1), (far + 1, high), (far, high), (far, 0), (0, 0)]
        )

    def measure(self, run: "Run") -> Checks:
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        strained = "rigid bodies in the reference, which strain by 1e-4 here"
        return {
            "factor that fails": Check(high, self.factor, 1e-4, strained),
            "width of the bracket": Check(high - low, 0.01, 1e-9, "as asked", bound="at_most"),
            "failing is the structure's": holds(run.summary.status == "converged", "it is shown"),
        }


@dataclass(frozen=True)
class ToppledSlope(LeaningColumns):
    """The columns of Goodman and Bray, with friction to spare, by strength reduction.

    Limit equilibrium in which each column topples or slides holds down to tan phi = 0.7855. It
    is no bound: states without those assumptions exist below. What is found from columns without
    load is within the bracket's width of it.
    """

    name = "PL5 toppling"
    title = "Leaning columns: strength reduction"
    source = "Goodman and Bray 1976: tan phi = 0.7855"
    formulations = ("dda", "rigid")
    friction: float = 45.0
    needed = 0.7855
    # Two frictions: the factor of their tangents differs, the friction needed does not.
    parameters: ClassVar = {"friction": (45.0, 50.0)}
    slow = True

    def scene(self) -> str:
        """Return the columns, whose factor of safety is sought."""
        return self._scene("[strength_reduction]\n")

    def measure(self, run: "Run") -> Checks:
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        most, reason = float(np.tan(np.radians(self.friction))), "width of the bracket, 0.01"
        return {
            "friction that holds": Check(most / low, self.needed, 0.01, reason),
            "friction that fails": Check(most / high, self.needed, 0.01, reason),
            "failing is the structure's": holds(run.summary.status == "converged", "it is shown"),
        }
