"""Local functions of one's own: a block that swells alike in all directions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest

import nmm
from covers.local_functions.polynomials import Monomials, Rigid, RigidStrain
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.testing import check_local_functions
from nmm.verification import text


@dataclass(frozen=True)
class Swelling(RigidStrain):
    """Rigid motion and one strain, the same in all directions."""

    @cached_property
    def combination(self):
        whole = super().combination
        return np.column_stack([whole[:, :3], whole[:, 3] + whole[:, 4]])


@dataclass(frozen=True)
class Twice(RigidStrain):
    """One function that is there twice."""

    @cached_property
    def combination(self):
        return super().combination[:, [0, 1, 2, 2]]


SCENE = text.scene(
    'plane = "stress"',
    [
        text.material("rock", 10e9, 0.2, density=None),
        text.block("strip", "rock", text.rectangle((0, 0), (2, 1))),
        text.fixed_point("middle", (1, 0.5)),
        text.fixed_point("no turn", (1.5, 0.5), "y"),
        text.pulled_edge("pull", [[2, 0], [2, 1]], [1e6, 0]),
        text.pulled_edge("pull back", [[0, 0], [0, 1]], [-1e6, 0]),
        text.monitor("corner", (2, 1), "strip"),
    ],
)


def formulation(functions):
    return parse_formulation(f"[cover]\ntype = 'block'\nfunctions = '{functions}'\n")


def test_a_block_takes_half_of_the_mean_strain_in_every_direction():
    """Of all equal strains e that of least energy: 2 e E / (1 - nu) = p."""
    own = formulation(f"{__name__}:Swelling")
    done = nmm.run(parse_scene(SCENE), own, allow_code=[__name__])
    strain = 1e6 * (1 - 0.2) / (2 * 10e9)
    for name, length in (("ux", 1.0), ("uy", 0.5)):
        assert done.history[f"monitor:corner:{name}"][-1] == pytest.approx(
            strain * length, rel=1e-4
        )


def test_functions_of_ones_own_need_the_word_of_the_user():
    with pytest.raises(FormulationError, match=f"--allow-code {__name__}"):
        nmm.run(parse_scene(SCENE), formulation(f"{__name__}:Swelling"))


@pytest.mark.parametrize(
    "functions", [*map(Monomials, range(4)), RigidStrain(), Rigid(), Swelling()], ids=repr
)
def test_functions_hold_what_is_promised(functions):
    check_local_functions(functions)


def test_functions_that_depend_on_each_other_are_found():
    with pytest.raises(AssertionError, match="4 functions: 3 of them independent"):
        check_local_functions(Twice())
