"""Blocks that split by their strength: at which load, along which plane, and what they do then."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from integration.arrays import Floats
from nmm.verification import text
from nmm.verification.base import Check, Checks, SceneCase
from nmm.verification.formulations import with_cover

if TYPE_CHECKING:
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
    name = "C4 splitting"
    title = "A column splits at its strength, along the plane of the envelope"
    source = "Mohr and Coulomb with a tension cut-off; planes at 45 - phi / 2"
    formulations = ("dda", "finite elements", "bilinear quads")
    width = 0.1
    height = 0.25
    parameters: ClassVar = {"tension": (True, False)}

    @property
    def variant(self) -> str:
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
                text.fixed_edge("foot", [[0, 0], [w, 0]], "y"),
                text.fixed_edge("side", [[0, 0], [0, h]], "x"),
                text.pulled_edge("head", [[0, h], [w, h]], [0, pressure]),
            ],
        )

    def formulation(self, scene: "Scene", name: str) -> "Formulation":
        """Return nets with cells of a third of the width."""
        found = super().formulation(scene, name)
        if found.cover.size is None:
            return found
        return with_cover(found, size=self.width / 3)

    def measure(self, run: "Run") -> Checks:
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
    name = "SP6"
    title = "The plane along which an even stress splits a block"
    source = "(2, -1, 1.5) MPa: s1 = 2.6213203436 at 22.5 degrees"
    formulations = ("dda", "degree 2", "bilinear quads")
    parameters: ClassVar = {"turn": (0.0, 20.0, 77.0)}
    label = "turned by {0.turn:g} degrees"

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
        off = apart(inner_faces(run), 112.5 + self.turn)
        return {
            "plane off (deg)": Check(1 + off, 1.0, 1e-6, "a step of 1 ns strains by 1e-10"),
            "pieces": Check(float(run.manifold.n_bodies), 2.0, 0.0, "it splits once"),
        }
