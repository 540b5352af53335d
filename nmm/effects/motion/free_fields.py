"""The effect: free-field boundaries, driven by columns of ground beside the model."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.places import Place
from nmm.effects.acting_place import edge_place
from nmm.effects.base import Setup
from nmm.effects.motion.driven_edges import DrivenEdges
from nmm.effects.motion.edge_dashpots import EdgeDashpots, ground_of
from nmm.effects.motion.ground_column import Drive, GroundColumn, still
from nmm.effects.motion.record import motions_of
from nmm.errors import Fault, GeometryError, SceneError
from nmm.geometry.tessellation.cover_types import highest_degree

if TYPE_CHECKING:
    from nmm.scene.tables.shaking.boundaries import FreeFieldTable

# Linear elements of a column for each edge of the mesh beside functions of higher degree; beside
# linear elements it is one, so that waves are equally fast in both.
FINER = 6
# Share of the shear stiffness beyond which an upright strain shears the ground.
LEANING = 1e-9
# Of coordinates: levels nearer to a node of a column lie on it.
ROUNDED_LEVEL = 64 * float(np.finfo(float).eps)


@dataclass(frozen=True)
class FreeField:
    """One side of a model: its dashpots, and its columns.

    Attributes
    ----------
    dashpots
        Dashpots on the edge.
    columns
        Columns of motion along x (S-waves) and along y (P-waves).
    lateral
        (m,) horizontal over vertical stress of P-waves.
    """

    dashpots: EdgeDashpots
    columns: tuple[GroundColumn, GroundColumn]
    lateral: Floats

    @property
    def driven(self) -> bool:
        """A free field always moves with its base."""
        return True

    def traction(self, time: float) -> Floats:
        """Tractions (m, 2) of the free field on the edge, by its stress and its velocity (Pa)."""
        height, level = self.columns[0].height, self.dashpots.place.position[:, 1]
        velocity = [np.interp(level, height, one.velocity(time)) for one in self.columns]
        beside = _beside(height, level)
        shear, along = (one.stress(time)[beside].mean(axis=0) for one in self.columns)
        normal = self.dashpots.place.normal
        assert normal is not None
        side = normal[:, 0]
        stress = np.stack([side * self.lateral * along, side * shear], axis=1)
        return stress + self.dashpots.tractions(np.stack(velocity, axis=1))


class FreeFields(DrivenEdges):
    """Sides of a model beyond which the ground is level and extends to infinity."""

    name = "free fields"

    def __init__(self, sides: list[FreeField], n_unknowns: int) -> None:
        super().__init__(sides, n_unknowns)
        self.sides = sides

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[free_fields]]``."""
        found = [_side(setup, one) for one in setup.scene.free_fields]  # a handful
        return cls(found, setup.model.manifold.n_unknowns)

    @property
    def about(self) -> str:
        counts = [len(one.columns[0].modulus) for one in self.sides]
        return f"columns of {' and '.join(map(str, counts))} elements"


def _beside(height: Floats, level: Floats) -> Ints:
    """Elements (2, m) of a column below and above levels (m,): two at a node, else twice one.

    Points in the middle of an edge of the mesh lie on nodes, where rounding would choose.
    """
    near = ROUNDED_LEVEL * max(float(np.abs(height).max()), float(height[-1] - height[0]))
    sides = [np.searchsorted(height, level + way) - 1 for way in (-near, near)]
    return np.clip(sides, 0, len(height) - 2)


def _side(setup: Setup, table: "FreeFieldTable") -> FreeField:
    model = setup.model
    order = 2 * max(model.manifold.degree, 1)
    place = edge_place(setup, "free_fields", table, order)
    linear = highest_degree(setup.formulation.cover) == 0
    height, element = _layers(place, 1 if linear else FINER)
    _refuse_leaning(setup, table, model.elasticity[element])
    damping = setup.scene.damping
    factors = (None if damping is None else damping.coefficients) or (0.0, 0.0)
    step = setup.formulation.integrator.fixed_step
    assert step is not None  # others are refused
    columns = []
    for axis, entry in enumerate((2, 1)):  # shear along x, pressure along y
        modulus = model.elasticity[element, entry, entry]
        base = _base(setup, table, axis, float(model.density[element[0]] * modulus[0]) ** 0.5)
        made_of = height, modulus, model.density[element], factors, step, base
        columns.append(GroundColumn(*made_of, _dragging(setup, axis)))
    elasticity = model.elasticity[place.elements]
    lateral = elasticity[:, 0, 1] / elasticity[:, 1, 1]
    return FreeField(EdgeDashpots.of(model, place), (columns[0], columns[1]), lateral)


def _refuse_leaning(setup: Setup, table: "FreeFieldTable", elasticity: Floats) -> None:
    """Refuse ground in which waves that go up are neither upright nor level.

    Raises
    ------
    SceneError
        By the line of the free field.
    """
    if (np.abs(elasticity[:, 1, 2]) > LEANING * elasticity[:, 2, 2]).any():
        place = setup.scene.source.of_name("free_fields", table.name, "segment")
        value, expected = "beside matter with axes that lean", "axes along x and y"
        remedy = "make axis_angle of its material 0 or 90 deg, or remove the free field"
        raise SceneError(Fault(place, value, expected, remedy))


def _layers(place: Place, finer: int) -> tuple[Floats, Floats]:
    """Nodes (k + 1,) of a column from below (m), and the element (k,) of the model beside each."""
    assert place.piece is not None
    first = np.flatnonzero(np.diff(place.piece, prepend=-1))
    length = np.add.reduceat(place.weight, first)
    middle = np.add.reduceat(place.weight * place.position[:, 1], first) / length
    order = np.argsort(middle)
    low, high = (middle - length / 2)[order], (middle + length / 2)[order]
    shares = np.arange(finer) / finer
    nodes = (low[:, None] + shares * (high - low)[:, None]).ravel()
    return np.append(nodes, high[-1]), np.repeat(place.elements[first][order], finer)


def _base(
    setup: Setup, table: "FreeFieldTable", axis: int, own: float
) -> tuple[float | None, Drive]:
    """Return impedance and incoming velocity below a column; or None and its displacement."""
    scene = setup.scene
    boundary = next((one for one in scene.viscous_boundaries if one.name == table.base), None)
    if boundary is not None:
        ground, wave = ground_of(boundary), motions_of(scene, boundary.incoming).get(axis)
        impedance = own if ground is None else float(ground[1 - axis])
        return impedance, still if wave is None else wave.velocity_at
    support = next((one for one in scene.supports if one.name == table.base), None)
    if support is None:
        raise GeometryError(
            f"[[free_fields]] {table.name}: base {table.base} is not there in this stage: "
            "expected the boundary below: keep it, or remove the free field"
        )
    motion = motions_of(scene, support.motion).get(axis)
    return None, still if motion is None else motion.displacement_at


def _dragging(setup: Setup, axis: int) -> Drive:
    """Return the velocity of the ground against which mass damps: axes at rest if none is named."""
    scene = setup.scene
    ground = None if scene.damping is None else scene.damping.ground
    named = [one.motion for one in scene.supports if ground is not None and one.name == ground]
    motion = motions_of(scene, named[0]).get(axis) if named else None
    return still if motion is None else motion.velocity_at
