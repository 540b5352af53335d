"""Blocks that split by their strength: at which load, along which plane, and what they do then."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase, holds
from nmm.verification.formulations import with_cover

if TYPE_CHECKING:
    from collections.abc import Sequence

    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.stepping.run import Run

# Concrete: cohesion, friction angle and tensile strength (Pa, degrees, Pa).
COHESION, PHI, TENSILE = 4.7e6, 37.0, 2.9e6
CRUSHED = 2 * COHESION * np.tan(np.radians(45 + PHI / 2))  # 18.853483 MPa


def strength(name: str, smallest: float, more: str = "", shear: bool = True) -> str:
    """Table of the strength of concrete; without ``shear`` tension alone splits."""
    sheared = f'cohesion = {COHESION}\nfriction_angle = "{PHI} deg"\n' if shear else ""
    return (
        f"[splitting.{name}]\ntensile_strength = {TENSILE}\n{sheared}"
        f"smallest_block = {smallest}\n{more}"
    )


def first_split(run: "Run", column: str) -> float:
    """Value of a column of the history in the last row before there are more bodies."""
    bodies = run.history["splitting:bodies"]
    return float(run.history[column][np.flatnonzero(bodies == bodies[0])[-1]])


def inner_faces(run: "Run") -> Floats:
    """Directions (degrees, 0 to 180) of the edges that lie inside the first outline."""
    edges = run.manifold.boundary
    first = run.topologies[0].elements.to_shapely()
    import shapely

    whole = shapely.union_all(first).buffer(-1e-6 * np.sqrt(run.manifold.body_area.sum()))
    inside = shapely.contains_xy(whole, (edges.start + edges.end) / 2)
    way = (edges.end - edges.start)[inside]
    return np.asarray(np.degrees(np.arctan2(way[:, 1], way[:, 0])) % 180, dtype=np.float64)


def apart(one: Floats, other: float) -> float:
    """Largest angle (degrees) between directions and another, which have no sense."""
    off = (one - other) % 180
    return float(np.minimum(off, 180 - off).max(initial=0.0)) if len(one) else np.inf


@dataclass(frozen=True)
class CrushedColumn(SceneCase):
    """A column under a growing pressure, in tension or in compression, on a smooth foot."""

    tension: bool = True
    name: ClassVar[str] = "C4 splitting"
    title: ClassVar[str] = "A column splits at its strength, along the plane of the envelope"
    source: ClassVar[str] = "Mohr and Coulomb with a tension cut-off; planes at 45 - phi / 2"
    formulations: ClassVar[tuple[str, ...]] = ("dda", "finite elements", "bilinear quads")
    width: ClassVar[float] = 0.1
    height: ClassVar[float] = 0.25

    @classmethod
    def variants(cls) -> "Sequence[CrushedColumn]":
        """Tension and compression."""
        return [cls(True), cls(False)]

    @property
    def variant(self) -> str:
        """See `Case.variant`."""
        return "in tension" if self.tension else "in compression"

    def scene(self) -> str:
        """Return the column, whose left edge may move up and down alone."""
        w, h = self.width, self.height
        pressure = 1e6 if self.tension else -1e7
        return text.scene(
            'title = "column"\nplane = "stress"\n[contact]\n[loading]\nuntil = "failure"\n'
            "[formulation.loading]\nincrement = 1.0\ntolerance = 1e-4\n",
            [
                text.material("concrete", modulus=27.5e9),
                text.interface("contact", 20.0),
                text.box("column", (0, 0), (w, h), "concrete"),
                strength("concrete", 5e-3),
                f'[[supports]]\nname = "foot"\nsegment = [[0, 0], [{w}, 0]]\nfix = ["y"]\n',
                f'[[supports]]\nname = "side"\nsegment = [[0, 0], [0, {h}]]\nfix = ["x"]\n',
                f'[[loads]]\nname = "head"\nkind = "edge"\nsegment = [[0, {h}], [{w}, {h}]]\n'
                f"traction = [0, {pressure}]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return nets with cells of a third of the width."""
        found = super().formulation(scene, name)
        if found.cover.size is None:
            return found
        return with_cover(found, size=self.width / 3)

    def measure(self, run: "Run") -> Checks:
        """Compare the load of the first split and its planes."""
        load = first_split(run, "load_factor")
        if self.tension:
            found = apart(inner_faces(run), 0.0)
            return {
                "strength (MPa)": Check(load, TENSILE / 1e6, 1e-4, "the tolerance of the load"),
                "plane from the load's normal (deg)": Check(
                    1 + found, 1.0, 1e-3, "springs of the supports turn the block by 1e-6"
                ),
            }
        checks = {
            "strength (MPa)": Check(
                10 * load, float(CRUSHED) / 1e6, 1e-4, "the tolerance of the load"
            )
        }
        pieces = run.topologies[1].elements
        if len(pieces) == 4:  # blocks: elements of a net are not the pieces
            wedge = pieces.points - [self.width / 2, self.height / 2]
            ends = wedge[np.abs(np.abs(wedge[:, 0]) - self.width / 2) < 1e-9]
            ends = ends[np.abs(np.abs(ends[:, 1]) - self.height / 2) > 1e-9]
            steep = np.degrees(np.arctan2(np.abs(ends[:, 1]), np.abs(ends[:, 0])))
            checks["planes from the loaded face (deg)"] = Check(
                float(steep.mean()), 45 + PHI / 2, 1e-6, "springs turn the block by 1e-6"
            )
        return checks


@dataclass(frozen=True)
class StressedBlock(SceneCase):
    """A block born with an even stress splits in the first instant, however it lies."""

    turn: float = 0.0
    name: ClassVar[str] = "SP6"
    title: ClassVar[str] = "The plane along which an even stress splits a block"
    source: ClassVar[str] = "(2, -1, 1.5) MPa: s1 = 2.6213203436 at 22.5 degrees"
    formulations: ClassVar[tuple[str, ...]] = ("dda", "degree 2", "bilinear quads")

    @classmethod
    def variants(cls) -> "Sequence[StressedBlock]":
        """Blocks turned with their stress."""
        return [cls(angle) for angle in (0.0, 20.0, 77.0)]

    @property
    def variant(self) -> str:
        """See `Case.variant`."""
        return f"turned by {self.turn:g} degrees"

    def scene(self) -> str:
        """Return one step of a nanosecond, in which nothing relaxes."""
        angle = np.radians(self.turn)
        c, s = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -s], [s, c]])
        stress = turn @ np.array([[2e6, 1.5e6], [1.5e6, -1e6]]) @ turn.T
        corners = text.turned(text.rectangle((-1.0, -0.5), (1.0, 0.5)), angle)
        return text.scene(
            'title = "block"\nplane = "stress"\nduration = 1e-9\n[inertia]\n[contact]\n'
            "[formulation.integrator]\nstep = 1e-9\n",
            [
                text.material("rock"),
                text.interface("contact", 30.0),
                text.block("block", "rock", corners),
                "[splitting.rock]\ntensile_strength = 2.5e6\nsmallest_block = 0.1\n",
                '[[initial_stresses]]\nblock = "block"\n'
                f"stress = {stress[[0, 1, 0], [0, 1, 1]].tolist()}\n",
            ],
        )

    def measure(self, run: "Run") -> Checks:
        """Compare the plane, and count the pieces."""
        off = apart(inner_faces(run), 112.5 + self.turn)
        return {
            "plane off (deg)": Check(1 + off, 1.0, 1e-6, "a step of 1 ns strains by 1e-10"),
            "pieces": Check(float(run.manifold.n_bodies), 2.0, 0.0, "it splits once"),
        }


@dataclass(frozen=True)
class CutBar(SceneCase):
    """A bar under even tension, held at its ends, splits in the middle; its faces fly apart."""

    name: ClassVar[str] = "SP2"
    title: ClassVar[str] = "A stretched bar splits in the middle and closes again"
    source: ClassVar[str] = "d'Alembert: gap 2 s0 c t / E, 4 s0 L / E at 2 L / c, 0 at 4 L / c"
    formulations: ClassVar[tuple[str, ...]] = ("bilinear quads", "finite elements")
    stress: ClassVar[float] = 1e-3
    step: ClassVar[float] = 0.02

    def scene(self) -> str:
        """Return a bar of 2 m with E = rho = 1, whose strength is just below its stress."""
        return text.scene(
            f'title = "bar"\nplane = "stress"\nduration = 4.5\n[inertia]\n[contact]\n'
            f'[formulation.integrator]\ntype = "newmark"\nstep = {self.step}\n',
            [
                text.material("unit", modulus=1.0, poisson=0.0, density=1.0),
                text.interface("contact", 0.0),
                text.box("bar", (0, 0), (2, 0.1), "unit"),
                f"[splitting.unit]\ntensile_strength = {0.999 * self.stress}\n"
                "smallest_block = 0.05\nmost_blocks = 2\n",
                f'[[initial_stresses]]\nblock = "bar"\nstress = [{self.stress}, 0, 0]\n',
                '[[supports]]\nname = "left"\nsegment = [[0, 0], [0, 0.1]]\nfix = ["x", "y"]\n',
                '[[supports]]\nname = "right"\nsegment = [[2, 0], [2, 0.1]]\nfix = ["x", "y"]\n',
                text.monitor("one", (0.9999, 0.05), "bar"),
                text.monitor("other", (1.0001, 0.05), "bar"),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of a twentieth of a half."""
        return with_cover(super().formulation(scene, name), size=0.05)

    def measure(self, run: "Run") -> Checks:
        """Compare the gap in time, its largest value and when it closes."""
        history = run.history
        gap = history["monitor:other:ux"] - history["monitor:one:ux"]
        time = history["time"] - self.step  # it splits at the end of the first step
        unit = 2 * self.stress
        late = np.flatnonzero(time > 3.0)
        parts = ("kinetic", "strain", "contact", "support")
        energy = np.sum([history[f"{name}_energy"] for name in parts], axis=0)
        front = "a front is as wide as a few cells"
        return {
            "gap at 1 s (mm)": Check(
                1e3 * float(np.interp(1.0, time, gap)), 1e3 * unit, 0.02, front
            ),
            "largest gap (mm)": Check(1e3 * float(gap.max()), 2e3 * unit, 0.03, front),
            "closed at (s)": Check(float(time[late[gap[late].argmin()]]), 4.0, 0.02, front),
            "energy kept": holds(
                abs(float(energy[-1]) / float(energy[0]) - 1) < 0.01, "Newmark conserves it"
            ),
        }


@dataclass(frozen=True)
class SplitDisc(SceneCase):
    """A disc of one body between two forces splits along the line between them."""

    shear: bool = False
    name: ClassVar[str] = "SP5"
    title: ClassVar[str] = "The Brazilian test of a disc that splits"
    source: ClassVar[str] = "sx = 2 P / (pi D t), sy = -6 P / (pi D t) in the middle"
    formulations: ClassVar[tuple[str, ...]] = ("bilinear quads", "finite elements")
    size: ClassVar[float] = 0.1

    @classmethod
    def variants(cls) -> "Sequence[SplitDisc]":
        """A cut-off alone, and with the envelope, which is nearer."""
        return [cls(False), cls(True)]

    @property
    def variant(self) -> str:
        """See `Case.variant`."""
        return "with shear" if self.shear else "by tension alone"

    @property
    def slow(self) -> bool:
        """See `Case.slow`."""
        return True

    def scene(self) -> str:
        """Return a disc of 0.1 m, 0.1 m thick, pressed at two corners of its 72."""
        angle = np.pi * (2 * np.arange(72) / 72 - 0.5)
        r = self.size / 2
        ring = r * np.column_stack([np.cos(angle), np.sin(angle)])
        return text.scene(
            'title = "disc"\nplane = "stress"\nthickness = 0.1\n[contact]\n[loading]\n'
            'until = "failure"\n[formulation.loading]\nincrement = 2.0\ntolerance = 1e-3\n',
            [
                text.material("concrete", modulus=27.5e9),
                text.interface("contact", 20.0),
                text.block("disc", "concrete", ring),
                strength("concrete", 5e-3, "most_blocks = 4\n", self.shear),
                f'[[supports]]\nname = "foot"\npoint = [0, {-r}]\nfix = ["x", "y"]\n',
                f'[[supports]]\nname = "top"\npoint = [0, {r}]\nfix = ["x"]\n',
                f'[[loads]]\nname = "press"\nkind = "point"\npoint = [0, {r}]\n'
                "force = [0, -1000]\n",
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return cells of a fortieth of the diameter, laid so that the middle lies within one."""
        return with_cover(super().formulation(scene, name), size=self.size / 40, shift=(0.2, 0.3))

    def measure(self, run: "Run") -> Checks:
        """Compare the load in kN, and the plane."""
        area = np.pi * self.size * 0.1 / 2
        steep = np.tan(np.radians(45 + PHI / 2)) ** 2
        limit = float(CRUSHED / (3 + steep)) if self.shear else TENSILE
        checks = {
            "load of the first split (kN)": Check(
                first_split(run, "load_factor"), limit * area / 1e3, 0.02, "72 corners, 40 cells"
            )
        }
        if not self.shear:
            off = apart(inner_faces(run)[:4], 90.0)
            checks["plane off the line of forces (deg)"] = Check(
                1 + off, 1.0, 0.1, "the net does not lie evenly about the middle"
            )
        return checks
