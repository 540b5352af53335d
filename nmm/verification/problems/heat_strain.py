"""Strain of temperatures that are given: held bars, strips, discs, free bodies."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from nmm.study.samples import fields
from nmm.verification import text
from nmm.verification.base import MESHES, Check, Checks, SceneCase, limit
from nmm.verification.continuum import quarter
from nmm.verification.formulations import with_cover
from nmm.verification.reading import last_way, mean_stress

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

ROUNDING = "exact: the functions hold the answer; what is left is rounding"
GLUE = text.interface("glue", 0.0, more={"bonded": True})


def warm(
    name: str,
    modulus: float,
    poisson: float,
    expansion: float,
    conductivity: float | None = None,
) -> str:
    """Table of an elastic material that expands by ``expansion`` (1/K)."""
    conducts = "" if conductivity is None else f"conductivity = {conductivity!r}\n"
    plain = text.material(name, modulus, poisson, density=None)
    return f"{plain}thermal_expansion = {expansion!r}\n{conducts}"


def given(block: str, temperature: float, more: str = "") -> str:
    """Table of a temperature in a whole block."""
    return (
        f'[[temperatures]]\nname = "in {block}"\nblock = "{block}"\n'
        f"temperature = {temperature!r}\n{more}"
    )


def rollers(name: str, segment: Sequence[Sequence[float]], axis: str) -> str:
    """Table of a support of one component along a segment."""
    place = [[float(x) for x in point] for point in segment]
    return f'[[supports]]\nname = "{name}"\nsegment = {place}\nfix = ["{axis}"]\n'


def pinned(point: Sequence[float], axes: str, name: str) -> str:
    """Table of a support at a point."""
    return f'[[supports]]\nname = "{name}"\npoint = {list(point)}\nfix = {list(axes)}\n'.replace(
        "'", '"'
    )


@dataclass(frozen=True)
class Restrained(SceneCase):
    """A bar that is held in one direction or two; a gap that closes before it is."""

    name: ClassVar[str] = "TH2"
    title: ClassVar[str] = "A bar that may not expand"
    source: ClassVar[str] = "Hooke's law: s = -E alpha T, over 1 - nu for each direction held"
    formulations: ClassVar[tuple[str, ...]] = (*MESHES, "quads", "splines", "multipliers")
    plane: str = "stress"
    axes: str = "x"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both planes, held along x and along x and y."""
        return [cls(plane, axes) for plane in ("stress", "strain") for axes in ("x", "xy")]

    @property
    def variant(self) -> str:
        """Plane and directions."""
        return f"plane {self.plane}, {' and '.join(self.axes)} held"

    def scene(self) -> str:
        """Return a bar of 2 m by 1 m, 30 K warmer."""
        sides = {
            "x": [rollers("left", [(0, 0), (0, 1)], "x"), rollers("right", [(2, 0), (2, 1)], "x")],
            "y": [rollers("low", [(0, 0), (2, 0)], "y"), rollers("top", [(0, 1), (2, 1)], "y")],
        }
        held = [table for axis in self.axes for table in sides[axis]]
        held += [] if "y" in self.axes else [pinned((0.0, 0.0), "y", "foot")]
        head = f'title = "Restrained bar"\nplane = "{self.plane}"\n[heat]\n'
        bar = [warm("concrete", 30e9, 0.2, 1e-5), text.box("bar", (0, 0), (2, 1), "concrete")]
        return text.scene(head, [*bar, *held, given("bar", 30.0)])

    def measure(self, run: "Run") -> Checks:
        """Compare the stresses."""
        across = {"xy": -11.25e6, "x": -9e6}[self.axes]
        strained = {"xy": -15e6, "x": -11.25e6}[self.axes]
        stress = across if self.plane == "stress" else strained
        found = mean_stress(run)
        side = stress if "y" in self.axes else 0.0
        return {
            "sxx (Pa)": Check(float(found[0]), stress, 1e-9, ROUNDING),
            "syy (Pa)": Check(float(found[1]), side, 1e-9, ROUNDING, scale=abs(stress)),
        }


class ClosingGap(SceneCase):
    """A bar that expands through a gap and is pressed after that."""

    name, title = "TH2 gap", "A bar that closes a gap as it warms"
    source = "u = alpha T L up to the gap; then s = -E (alpha T - gap / L)"
    formulations = ("lagrange", "cone")

    def scene(self) -> str:
        """Return a bar of 2 m beside a wall at 0.2 mm, 30 K warmer."""
        head = (
            'title = "Gap"\nplane = "stress"\n[contact]\n[heat]\n'
            "[formulation.loading]\nincrement = 0.25\n"
        )
        gap = 2.0002
        return text.scene(
            head,
            [
                warm("concrete", 30e9, 0.0, 1e-5),
                text.material("wall", 30e15, 0.0, None),
                text.interface("contact", 0.0),
                text.box("bar", (0, 0), (2, 0.5), "concrete"),
                text.box("wall", (gap, -0.5), (1, 1.5), "wall"),
                text.held("wall"),
                rollers("left", [(0, 0), (0, 0.5)], "x"),
                rollers("low", [(0, 0), (2, 0)], "y"),
                given("bar", 30.0),
                given("wall", 0.0),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare the stress of the bar."""
        stress = float(run.stress[0, 0])
        give = "supports of blocks are springs of 1000 E; the wall is a million times stiffer"
        return {"sxx of the bar (Pa)": Check(stress, -6e6, 2e-3, give)}


class Bimetal(SceneCase):
    """Two layers that expand differently bend; lengths are a hundred times Timoshenko's."""

    name, title = "TH1", "Bimetal strip"
    source = "Timoshenko (1925): 8.393005828e-4 1/m, of plane stress away from the ends"
    formulations = ("manifold", "manifold degree 2", "quads degree 2")

    def scene(self) -> str:
        """Return a cantilever of 20 m, layers of 0.4 m and 0.6 m."""
        head = 'title = "Bimetal"\nplane = "stress"\n[heat]\n'
        return text.scene(
            head,
            [
                warm("steel", 200e9, 0.3, 12e-6),
                warm("zinc", 100e9, 0.3, 19e-6),
                GLUE,
                text.box("low", (0, 0), (20, 0.4), "steel"),
                text.box("top", (0, 0.4), (20, 0.6), "zinc"),
                rollers("wall", [(0, 0), (0, 1)], "x"),
                pinned((0.0, 0.4), "y", "foot"),
                given("low", 80.0),
                given("top", 80.0),
                text.monitor("tip", (20.0, 0.4), "low"),
                text.monitor("middle", (10.0, 0.4), "low"),
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare curvature between the middle and the root, and stresses across the middle."""
        middle = float(last_way(run, "middle")[1])
        curvature = -2 * middle / 10.0**2
        y = np.array([0.001, 0.399, 0.401, 0.999])
        found = fields(run, np.stack([np.full(4, 9.87), y], axis=1)).stress[:, 0]
        wanted = [-21.542048e6, 45.601998e6, -33.199001e6, 17.159034e6]
        names = ("at the bottom", "below the interface", "above it", "at the top")
        beam = "beam theory; stresses are read 1 mm from the faces, of 45.6 MPa"
        root = "the root's rollers lie within one thickness of where bending is even"
        checks = {"curvature (1/m)": Check(curvature, 8.393005828e-4, 5e-3, root)}
        for name, value, reference in zip(names, found.tolist(), wanted, strict=True):
            checks[f"sxx {name} (Pa)"] = Check(value, reference, 0.01, beam, scale=45.6e6)
        return checks


@dataclass(frozen=True)
class HotCore(SceneCase):
    """A disc with a hot core: the strain jumps at a line between blocks."""

    name: ClassVar[str] = "TH4"
    title: ClassVar[str] = "Disc with a hot core"
    source: ClassVar[str] = "Lamé's solution; core .5 m, disc 2 m, ten times as large as given"
    formulations: ClassVar[tuple[str, ...]] = ("manifold", "quads degree 2")
    plane: str = "stress"

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both planes."""
        return [cls("stress"), cls("strain")]

    @property
    def variant(self) -> str:
        """The plane."""
        return f"plane {self.plane}"

    def scene(self) -> str:
        """Return a quarter: 60 K in the core."""
        arc = quarter(1.0, 48)[::-1]
        head = f'title = "Core"\nplane = "{self.plane}"\n[heat]\n'
        return text.scene(
            head,
            [
                warm("alloy", 70e9, 0.3, 23e-6),
                GLUE,
                text.block("core", "alloy", np.concatenate([[[0, 0]], 0.5 * arc])),
                text.block("ring", "alloy", np.concatenate([2 * arc, 0.5 * arc[::-1]])),
                rollers("left", [(0, 0), (0, 2)], "x"),
                rollers("low", [(0, 0), (2, 0)], "y"),
                given("core", 60.0),
                given("ring", 0.0),
                text.monitor("rim", (2.0, 0.0), "ring"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return the formulation with cells of half the core."""
        return with_cover(super().formulation(scene, name), size=0.25)

    def measure(self, run: "Run") -> Checks:
        """Compare stresses of core and ring, and the widening."""
        factor = 1.0 if self.plane == "stress" else 1 / 0.7
        widening = 0.1725e-3 if self.plane == "stress" else 0.22425e-3
        a = np.cos(0.7), np.sin(0.7)
        places = np.array([[0.25 * a[0], 0.25 * a[1]], [1.2 * a[0], 1.2 * a[1]]])
        found = fields(run, places).stress
        hoop = found[1] @ [a[1] ** 2, a[0] ** 2, -2 * a[0] * a[1]]
        # Lamé in the ring: A (1 + b^2 / r^2) with A (1 - b^2 / c^2) the core's pressure.
        inner = -45.28125e6 * factor
        ring = inner / (1 - 16) * (1 + 4 / 1.44)
        near = "a point of a mesh of .25 m, of the stress of the core; the aim is 1 %"
        return {
            "sxx in the core (Pa)": Check(float(found[0, 0]), inner, 0.01, near),
            "hoop stress at 1.2 m (Pa)": Check(float(hoop), ring, 0.01, near, scale=-inner),
            "widening (m)": Check(float(last_way(run, "rim")[0]), widening, 0.01, "the aim"),
        }


@dataclass(frozen=True)
class LinearTemperature(SceneCase):
    """A temperature linear in x and y strains a free body and does not stress it."""

    name: ClassVar[str] = "TH5"
    title: ClassVar[str] = "Linear temperature of a free body"
    source: ClassVar[str] = "u = A (T0 x + gx (x2 - y2) / 2 + gy x y), v alike; no stress"
    formulations: ClassVar[tuple[str, ...]] = ("degree 2", "manifold", "quads", "manifold degree 2")
    plane: str = "stress"
    blocks: int = 1

    @classmethod
    def variants(cls) -> Sequence[Self]:
        """Return both planes, of one body and of two that are bonded."""
        return [cls(plane, blocks) for plane in ("stress", "strain") for blocks in (1, 2)]

    @property
    def variant(self) -> str:
        """Plane and number of blocks."""
        return f"plane {self.plane}, {self.blocks} blocks"

    def scene(self) -> str:
        """Return a body of 2 m by 1 m at 10 + 7 x - 4 y K, conducted between its edges."""
        width = 2.0 / self.blocks
        slope = "gradient = [7.0, -4.0]\n"
        conducts = text.interface("glue", 0.0, more={"bonded": True}) + 'conductance = "perfect"\n'
        boxes = [text.box(f"b{i}", (i * width, 0), (width, 1), "m") for i in range(self.blocks)]
        ends = [([0, 0], [0, 1]), ([2, 0], [2, 1]), ([0, 0], [2, 0]), ([0, 1], [2, 1])]
        edges = [
            f'[[temperatures]]\nname = "edge {i}"\nsegment = {list(ends)}\n'
            f"temperature = 10\n{slope}"
            for i, ends in enumerate(ends)
        ]
        # Springs at three points hold without stress.
        held = [pinned((0.0, 0.0), "xy", "foot"), pinned((0.0, 1.0), "x", "top")]
        head = f'title = "Linear temperature"\nplane = "{self.plane}"\n[heat]\n'
        tip = text.monitor("tip", (2.0, 1.0), f"b{self.blocks - 1}")
        material = warm("m", 30e9, 0.2, 1e-5, conductivity=2.0)
        return text.scene(head, [material, conducts, *boxes, *held, *edges, tip])

    def measure(self, run: "Run") -> Checks:
        """Compare the way of a corner; no stress may be left."""
        a = 1e-5 * (1.0 if self.plane == "stress" else 1.2)
        t, x, y, gx, gy = 10.0, 2.0, 1.0, 7.0, -4.0
        u = a * (t * x + gx * (x * x - y * y) / 2 + gy * x * y)
        v = a * (t * y + gx * x * y + gy * (y * y - x * x) / 2)
        # The support at the top turns the body back: it stands at x = 0.
        turn = a * gx * -(1.0) / 2
        u, v = u - turn * y, v + turn * x
        unit = 30e9 * 1e-5 * 20
        points = np.random.default_rng(1).uniform((0.01, 0.01), (1.99, 0.99), (40, 2))
        stress = float(np.abs(fields(run, points).stress).max()) / unit
        way = last_way(run, "tip")
        return {
            "stress over E alpha T": limit(stress, 1e-9, ROUNDING),
            "ux of a corner (m)": Check(float(way[0]), u, 1e-8, ROUNDING),
            "uy of a corner (m)": Check(float(way[1]), v, 1e-8, ROUNDING),
        }
