"""A block-like cover defined here gets the same treatment as the built-in ones."""

import sys
from dataclasses import dataclass
from importlib import metadata
from importlib.metadata import EntryPoint
from itertools import pairwise
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import nmm
from integration.polygons import Polygons
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import product
from nmm.errors import NmmError
from nmm.formulation import Formulation
from nmm.geometry.tessellation.block_cover import BlockCover, PieceGlue, WholeBlocks
from nmm.geometry.tessellation.sub_blocks import MESHES, SubBlocks
from nmm.scene import parse_scene
from nmm.testing import check_block_cover
from nmm.verification import text

ME = Path(__file__).stem
WALL = text.scene(
    'plane = "strain"\nduration = 0.02\n[gravity]\n[inertia]\n[contact]\n',
    [
        text.material("rock", modulus=1e9, density=2500.0),
        text.interface("any", 30.0),
        text.box("base", (-1, -1), (3, 1)),
        text.box("top", (0, 0.001), (1, 0.999)),
        text.fixed_block("base"),
    ],
)
PRESSED = text.scene(
    'plane = "stress"\n',
    [
        text.material("rock", modulus=2e9, poisson=0.0, density=2500.0),
        text.box("column", (0, 0), (1, 3)),
        '[[supports]]\nname = "foot"\nsegment = [[0, 0], [1, 0]]\nfix = ["x", "y"]\n',
        '[[loads]]\nname = "press"\nkind = "edge"\nsegment = [[0, 3], [1, 3]]\n'
        "traction = [0, -4e6]\n",
        '[[monitors]]\nname = "head"\npoint = [0.5, 3]\n',
        '[[monitors]]\nname = "sole"\npoint = [0.5, 0]\n',
    ],
)


@dataclass(frozen=True)
class Stones(BlockCover):
    """Whole blocks under another name."""


@dataclass(frozen=True)
class Boulders(BlockCover):
    """Whole blocks that are quadratic unless the formulation says otherwise."""

    usual_functions: ClassVar[str] = "monomials"
    usual_degree: ClassVar[int | None] = 2


@dataclass(frozen=True)
class Divided(SubBlocks):
    """Sub-blocks under another name."""


@dataclass(frozen=True)
class Courses(BlockCover):
    """Rectangles divided into courses as high as the size, glued by Nitsche's terms."""

    divides: ClassVar[bool] = True
    lowest: float = 1.0

    def divided(self, blocks, size, angle, shift):
        """Return the courses from below; the lowest may be lower than the others."""
        pieces, source = [], []
        for number in range(len(blocks)):
            points = blocks.take([number]).points
            (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
            heights = [low, *np.arange(low + self.lowest * size, high - 1e-9, size), high]
            for a, b in pairwise(heights):
                pieces.append(np.array([[left, a], [right, a], [right, b], [left, b]]))
                source.append(number)
        return Polygons.from_vertices(pieces), np.array(source)

    @property
    def piece_glue(self):
        """See `BlockCover.piece_glue`."""
        return PieceGlue("nitsche")


STIFFNESS = 1e9  # Pa/m


@dataclass(frozen=True)
class Carpet(Imposition):
    """Springs of 1 GPa/m."""

    @classmethod
    def of(cls, model, interface, method):
        """See `Imposition.of`."""
        return cls(interface)

    def matrix(self, state):
        """See `Imposition.matrix`."""
        unknowns, rows = self.interface.rows(state)
        return product(
            (unknowns, rows), (unknowns, STIFFNESS * self.interface.area[:, None, None] * rows)
        )

    def point_forces(self, state, jump):
        """See `Imposition.point_forces`."""
        return -STIFFNESS * self.interface.area[:, None] * jump

    def force(self, state, jump):
        """See `Imposition.force`."""
        return self.interface.spread(state, self.point_forces(state, jump))


@dataclass(frozen=True)
class Carpeted(Courses):
    """Courses on a method of glue that is defined here too."""

    @property
    def piece_glue(self):
        """See `BlockCover.piece_glue`."""
        return PieceGlue(f"{ME}:Carpet")


@pytest.fixture(autouse=True)
def importable(monkeypatch):
    monkeypatch.setitem(sys.modules, ME, sys.modules[__name__])


def run(scene, cover, **tables):
    formulation = Formulation.model_validate({"cover": cover, **tables})
    return nmm.run(parse_scene(scene), formulation, allow_code=[ME])


@pytest.mark.parametrize(
    "cover", [WholeBlocks(), *(SubBlocks(mesh=one) for one in MESHES), Stones(), Courses()]
)
def test_a_cover_of_blocks_keeps_what_all_promise(cover):
    check_block_cover(cover)


FLYING = text.scene(
    'plane = "stress"\nduration = "1 s"\n[inertia]\n',
    [
        text.material("rock", modulus=1e9, density=2500.0),
        text.box("stone", (0, 0), (1, 0.6)),
        '[[initial_velocities]]\nblock = "stone"\nvelocity = [2, 0]\nangular_velocity = 1.5\n',
    ],
)
LINEAR = {"rotation": {"update": "linear"}, "integrator": {"step": "0.02 s"}}
SUB_BLOCKS = {"size": 0.5, "options": {"mesh": "quads"}}


@pytest.mark.parametrize(
    ("scene", "own", "built_in", "cover", "tables"),
    [
        (WALL, "Stones", "block", {}, {}),
        (WALL, "Stones", "block", {"functions": "monomials", "degree": 2}, {}),
        # The classical update lays whole blocks anew, whatever their cover is called.
        (FLYING, "Stones", "block", {}, LINEAR),
        (WALL, "Divided", "sub_blocks", SUB_BLOCKS, {}),
    ],
)
def test_a_block_cover_under_another_name_has_the_same_digits(scene, own, built_in, cover, tables):
    kinds = (f"{ME}:{own}", built_in)
    one, other = (run(scene, {"type": kind, **cover}, **tables) for kind in kinds)
    assert one.history.keys() == other.history.keys()
    np.testing.assert_array_equal(one.frames[-1].points, other.frames[-1].points)
    assert np.ptp(one.frames[-1].points - one.frames[0].points) > 1e-5  # something moved


@pytest.mark.parametrize(("kind", "unknowns"), [("Stones", 6), ("Boulders", 12)])
def test_functions_that_are_not_named_are_those_usual_for_the_type(kind, unknowns):
    done = run(WALL, {"type": f"{ME}:{kind}"})
    assert done.manifold.n_unknowns == 2 * unknowns  # of two blocks


def test_an_installed_package_offers_a_cover_by_name(monkeypatch):
    def offered(group):
        return [EntryPoint("stones", f"{ME}:Stones", group)] if group == "nmm.cover" else []

    monkeypatch.setattr(metadata, "entry_points", offered)
    done = nmm.run(parse_scene(WALL), Formulation.model_validate({"cover": {"type": "stones"}}))
    assert done.manifold.n_unknowns == 12


@pytest.mark.parametrize(("lowest", "courses"), [(1.0, 6), (0.5, 7)])
def test_blocks_divided_and_glued_by_ones_own_cover_shorten_as_a_column(lowest, courses):
    cover = {"type": f"{ME}:Courses", "size": 0.5, "options": {"lowest": lowest}}
    done = run(PRESSED, cover)
    assert len(done.manifold.elements) == courses
    shorter = done.history["monitor:sole:uy"][-1] - done.history["monitor:head:uy"][-1]
    # p h / E = 4e6 * 3 / 2e9, to rounding: Nitsche's terms give by nothing.
    assert shorter == pytest.approx(6e-3, rel=1e-9)


def test_pieces_are_held_by_a_method_of_glue_of_ones_own():
    done = run(PRESSED, {"type": f"{ME}:Carpeted", "size": 0.5})
    shorter = done.history["monitor:sole:uy"][-1] - done.history["monitor:head:uy"][-1]
    # Five joints that give by 4e6 Pa / 1e9 Pa/m each, on the column's own 6e-3.
    assert shorter == pytest.approx(6e-3 + 5 * 4e-3, rel=1e-9)


@pytest.mark.parametrize(
    ("cover", "said"),
    [
        ({"type": f"{ME}:Stones", "size": 0.1}, "blocks have no net"),
        ({"type": f"{ME}:Stones", "options": {"mesh": "quads"}}, "mesh: expected no option"),
        ({"type": f"{ME}:Courses"}, "the size of a cell in m"),
        ({"type": f"{ME}:Courses", "size": 1, "options": {"lowest": "half"}}, "a number"),
        ({"type": f"{ME}:Stones", "nets": [{"block": "column", "size": 1}]}, "its own cover"),
    ],
)
def test_what_a_block_cover_of_ones_own_cannot_take_is_told(cover, said):
    with pytest.raises(NmmError, match=said):
        run(PRESSED, cover)
