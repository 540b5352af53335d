"""A method of a user's own that holds interfaces: one class serves supports and glue alike."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

import nmm
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.constraints.imposition import IMPOSITIONS, Imposition, Method
from nmm.constraints.interface import Interface, Triplets, product
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.testing import check_imposition
from nmm.testing.scenes import pulled_bar
from nmm.verification import text

STIFFNESS = 50.0


@dataclass(frozen=True)
class Carpet(Imposition):
    """Soft springs of 50 Pa/m, whatever the material."""

    @classmethod
    def of(cls, model: Model, interface: Interface, method: Method) -> "Carpet":
        return cls(interface)

    def matrix(self, state: State) -> Triplets:
        unknowns, rows = self.interface.rows(state)
        area = self.interface.area[:, None, None]
        return product((unknowns, rows), (unknowns, STIFFNESS * area * rows))

    def force(self, state: State, jump: Floats) -> Floats:
        return self.interface.spread(state, self.point_forces(state, jump))

    def point_forces(self, state: State, jump: Floats) -> Floats:
        return np.asarray(-STIFFNESS * self.interface.area[:, None] * jump)

    def energy(self, state: State, jump: Floats) -> float:
        return STIFFNESS / 2 * float(np.sum(self.interface.area[:, None] * jump**2))


@dataclass(frozen=True)
class Bed(Carpet):
    """The same, which may be laid in ground that carries a stress at first."""

    stretch: Floats | float = 0.0

    @property
    def springs(self) -> Floats:
        return STIFFNESS * self.interface.area

    def laid(self, stretch: Floats) -> "Bed":
        return replace(self, stretch=stretch)

    def point_forces(self, state: State, jump: Floats) -> Floats:
        return super().point_forces(state, jump - self.stretch)

    def laid_energy(self, state: State, jump: Floats) -> float:
        return -STIFFNESS * float(np.sum(self.interface.area[:, None] * jump * self.stretch))


BAR = pulled_bar(
    [text.material("m", 100.0, 0.0, None)],
    [("left", "m"), ("right", "m")],
    text.interface("glue", 0.0, more={"bonded": True}),
)
COVERS = {
    "block": '[cover]\ntype = "block"\n',
    "mesh": '[cover]\ntype = "triangles"\nsize = 0.4\nangle = 0.3\n',
}


@pytest.mark.parametrize("cover", COVERS)
def test_one_class_of_ones_own_holds_supports_and_glue_on_every_cover(cover: str) -> None:
    own = f'method = "{__name__}:Carpet"\n'
    chosen = COVERS[cover] + "[supports]\n" + own + "[glue]\n" + own
    done = nmm.run(parse_scene(BAR, "bar"), parse_formulation(chosen), allow_code=[__name__])
    assert done.summary.status == "converged", done.summary.sentence
    # Two bars of E = 100 under a stress of 1, and two carpets of 50 Pa/m.
    assert done.history["monitor:end:ux"][-1] == pytest.approx(2 / 100 + 2 / STIFFNESS, rel=1e-9)
    assert done.history["reaction:left:x"][-1] == pytest.approx(-1.0, rel=1e-9)
    assert done.history["support_energy"][-1] == pytest.approx(2 * 0.5 / STIFFNESS, rel=1e-9)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize(("springs", "way"), [("Bed", 0.0), ("Carpet", 1 / STIFFNESS)])
def test_springs_of_ones_own_that_can_be_laid_carry_the_initial_stress(
    cover: str, springs: str, way: float
) -> None:
    # The pull of 1 holds the bar in balance; springs laid without stress open by 1 / 50.
    stress = '[[initial_stresses]]\nblock = "all"\nstress = [1.0, 0.0, 0.0]\n'
    chosen = COVERS[cover] + f'[supports]\nmethod = "{__name__}:{springs}"\n'
    scene = parse_scene(BAR + stress, "bar")
    done = nmm.run(scene, parse_formulation(chosen), allow_code=[__name__])
    assert done.summary.status == "converged", done.summary.sentence
    assert done.history["monitor:end:ux"][-1] == pytest.approx(way, rel=1e-9, abs=1e-12)
    assert done.history["reaction:left:x"][-1] == pytest.approx(-1.0, rel=1e-9)


def test_an_unknown_method_is_told_by_its_line() -> None:
    chosen = COVERS["mesh"] + '[supports]\nmethod = "nitche"\n'
    with pytest.raises(FormulationError, match=r'method.*"nitche".*did you mean "nitsche"'):
        nmm.run(parse_scene(BAR, "bar"), parse_formulation(chosen))


@pytest.mark.parametrize("degree", [0, 1, 2])
@pytest.mark.parametrize("kind", sorted(IMPOSITIONS.table))
def test_a_built_in_method_keeps_what_all_promise(kind: str, degree: int) -> None:
    check_imposition(IMPOSITIONS.load(kind), degree)


def test_a_method_of_ones_own_is_held_to_the_same() -> None:
    check_imposition(Carpet)
