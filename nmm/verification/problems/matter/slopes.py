"""Factors of safety of slopes that joints cut into blocks: two joint sets, and toppling columns."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.problems.columns import LeaningColumns
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

    name: ClassVar[str] = "PL5 slope"
    title: ClassVar[str] = "Slope of two joint sets: strength reduction"
    source: ClassVar[str] = "tan phi over tan of the bedding's dip; linear programme over forces"
    formulations: ClassVar[tuple[str, ...]] = ("dda",)
    dips: tuple[float, float] = (35.0, 110.0)
    spacings: tuple[float, float] = (3.0, 4.0)
    friction: float = 45.0
    slides: bool = True

    face: ClassVar[float] = 60.0
    height: ClassVar[float] = 10.0
    behind: ClassVar[float] = 20.0

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
        """Dips, spacings, and how it fails."""
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

    def scene(self) -> str:
        """Return the slope on and before rock that is held."""
        far, high = self.behind, self.height
        base = [(-6, -4), (far + 4, -4), (far + 4, high), (far, high), (far, 0), (0, 0), (-6, 0)]
        return text.scene(
            'title = "Jointed slope"\nplane = "strain"\n',
            [
                text.material("rock", 10e9, 0.25, DENSITY),
                text.interface("joint", self.friction),
                text.block("base", "rock", base),
                text.block("slope", "rock", self.outline),
                *(
                    f'[[joint_sets]]\nname = "set {n}"\nblock = "slope"\ndip = "{dip} deg"\n'
                    f"spacing = {apart}\norigin = {list(at)}\n"
                    for n, (dip, apart, at) in enumerate(
                        zip(self.dips, self.spacings, self.origins, strict=True)
                    )
                ),
                text.held("base"),
                "[gravity]\n[contact]\n[strength_reduction]\n",
            ],
        )

    @property
    def factor(self) -> float:
        """The factor that fails: closed form where beds slide, linear programme elsewhere."""
        if self.slides:
            tangents = np.tan(np.radians([self.friction, self.dips[0]]))
            return float(tangents[0] / tangents[1])
        low, high = 1.0, 4.0
        blocks, ground = self._pieces()
        balance, weight = _balance(blocks, ground)
        while high - low > 1e-5:
            middle = (low + high) / 2
            slope = float(np.tan(np.radians(self.friction))) / middle
            low, high = (middle, high) if _carries(balance, weight, slope) else (low, middle)
        return high

    def _pieces(self) -> tuple[list[Any], Any]:
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
        """Compare the bracket with the reference."""
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        strained = "rigid bodies in the reference, which strain by 1e-4 here"
        return {
            "factor that fails": Check(high, self.factor, 1e-4, strained),
            "width of the bracket": Check(high - low, 0.01, 1e-9, "as asked", bound="at_most"),
            "failing is the structure's": holds(run.summary.status == "converged", "it is shown"),
        }


def _balance(blocks: list[Any], ground: Any) -> tuple[Floats, Floats]:
    """Rows (3 n, 2 m) of forces at both ends of every joint, and weights (3 n,) of the blocks."""
    bodies = [*blocks, ground]
    columns = []
    for a, one in enumerate(blocks):
        for b in range(a + 1, len(bodies)):
            shared = one.intersection(bodies[b])
            if shared.length < 1e-6:
                continue
            for part in getattr(shared, "geoms", [shared]):
                corners = np.array(part.coords)
                for face in pairwise(corners):
                    if np.hypot(*(face[1] - face[0])) > 1e-6:
                        columns += _of_joint(np.array(face), a, b, blocks)
    weight = np.zeros(3 * len(blocks))
    weight[1::3] = [-DENSITY * G * one.area for one in blocks]
    return np.array(columns).T, weight


def _of_joint(ends: Floats, a: int, b: int, blocks: list[Any]) -> list[Floats]:
    """Columns (3 n,) of pressure and shear at both ends of a joint, on the blocks beside it."""
    along = (ends[1] - ends[0]) / np.hypot(*(ends[1] - ends[0]))
    normal = np.array([-along[1], along[0]])
    if (np.array(blocks[a].centroid.coords[0]) - ends[0]) @ normal < 0:
        normal = -normal
    found = []
    for end in ends:
        for push in (normal, along):
            column = np.zeros(3 * len(blocks))
            for body, sign in ((a, 1.0), (b, -1.0)):
                if body < len(blocks):
                    arm = end - np.array(blocks[body].centroid.coords[0])
                    column[3 * body : 3 * body + 2] += sign * push
                    column[3 * body + 2] += sign * (arm[0] * push[1] - arm[1] * push[0])
            found.append(column)
    return found


def _carries(balance: Floats, weight: Floats, slope: float) -> bool:
    """Whether pressures and shear forces within friction carry the weight."""
    from scipy import optimize
    from scipy.sparse import csr_array, eye_array, kron

    m = balance.shape[1] // 2
    pair = np.array([[-slope, 1.0], [-slope, -1.0]])
    linprog: Any = optimize.linprog
    found = linprog(
        np.zeros(2 * m),
        A_ub=csr_array(kron(eye_array(m), pair)),
        b_ub=np.zeros(2 * m),
        A_eq=csr_array(balance),
        b_eq=-weight,
        bounds=[(0.0, None), (None, None)] * m,
        method="highs",
    )
    return bool(found.status == 0)


@dataclass(frozen=True)
class ToppledSlope(LeaningColumns):
    """The columns of Goodman and Bray, with friction to spare, by strength reduction.

    Limit equilibrium in which each column topples or slides holds down to tan phi = 0.7855. It
    is no bound: states without those assumptions exist below. What is found from columns without
    load is within the bracket's width of it.
    """

    name: ClassVar[str] = "PL5 toppling"
    title: ClassVar[str] = "Leaning columns: strength reduction"
    source: ClassVar[str] = "Goodman and Bray 1976: tan phi = 0.7855"
    formulations: ClassVar[tuple[str, ...]] = ("dda", "rigid")
    friction: float = 45.0
    needed: ClassVar[float] = 0.7855

    @classmethod
    def variants(cls) -> "tuple[ToppledSlope, ...]":
        """Two frictions: the factor of their tangents differs, the friction needed does not."""
        return (cls(45.0), cls(50.0))

    @property
    def slow(self) -> bool:
        """Ten seconds."""
        return True

    def scene(self) -> str:
        """Return the columns, whose factor of safety is sought."""
        return self._scene("[strength_reduction]\n")

    def measure(self, run: "Run") -> Checks:
        """Compare the friction of the last that hold and the first that fail."""
        low, high = run.summary.factor_of_safety or np.nan, run.summary.factor_that_fails or np.nan
        most, reason = float(np.tan(np.radians(self.friction))), "width of the bracket, 0.01"
        return {
            "friction that holds": Check(most / low, self.needed, 0.01, reason),
            "friction that fails": Check(most / high, self.needed, 0.01, reason),
            "failing is the structure's": holds(run.summary.status == "converged", "it is shown"),
        }
