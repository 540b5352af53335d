"""Local functions defined here get the same treatment as the built-in ones."""

from functools import cached_property

import numpy as np
import pytest

from covers.local_functions.polynomials import LocalFunctions
from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.geometry.tessellation.cover_types import LOCAL_FUNCTIONS
from nmm.materials.elastic import Elastic
from nmm.model.from_polygons import solid
from nmm.scene.read import parse_scene
from nmm.stepping.run import run
from nmm.testing.cracked_plates import cracked_plate
from nmm.verification import text
from nmm.verification.continuum import polygon

CRACKED = cracked_plate([(0, 0), (0.3, 0.1)], 0.1, text.monitor("corner", (0, 1), "b"))
NET = '[cover]\ntype = "triangles"\nsize = 0.15\nangle = 0.4\nfunctions = "{}"\n'
NEAR = "[[cover.regions]]\ndegree = 2\npoint = [0, 0]\nradius = 0.4\n"
BODY = polygon(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))


class Mixed(LocalFunctions):
    """Complete polynomials in sums and differences of both components."""

    @cached_property
    def combination(self) -> Floats:
        return np.kron(np.eye(self.n_functions), [[1.0, 1.0], [1.0, -1.0]])


class Plain(LocalFunctions):
    """Linear polynomials alone, without functions of tips."""

    any_degree = False
    enriched = False


@pytest.fixture(autouse=True)
def _own_functions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(LOCAL_FUNCTIONS.table, "mixed", f"{__name__}:Mixed")
    monkeypatch.setitem(LOCAL_FUNCTIONS.table, "plain", f"{__name__}:Plain")


def corner(functions: str, degree: str = "degree = 1\n") -> tuple[Floats, list[str]]:
    """Displacement (2,) of a corner beside the crack's mouth, and what a run warns of."""
    done = run(parse_scene(CRACKED), parse_formulation(NET.format(functions) + degree))
    moved = [done.history[f"monitor:corner:{axis}"][-1] for axis in ("ux", "uy")]
    return np.array(moved), done.summary.warnings


def test_functions_of_ones_own_carry_tips_as_monomials_of_the_same_span_do() -> None:
    own, warned = corner("mixed")
    built_in, _ = corner("monomials")
    assert not warned
    # Ends of two solutions of one system in other unknowns.
    np.testing.assert_allclose(own, built_in, rtol=1e-8)


def test_functions_that_say_so_carry_no_tips_until_the_formulation_asks() -> None:
    _, warned = corner("plain", degree="")
    assert any("1 crack tips without tip functions" in one for one in warned)
    asked, warned = corner("plain", degree="[cover.enrichment]\n")
    assert not warned
    np.testing.assert_allclose(asked, corner("monomials")[0], rtol=1e-8)


def test_regions_raise_the_degree_of_functions_of_ones_own() -> None:
    cover = parse_formulation(NET.format("mixed") + "degree = 1\n" + NEAR).cover
    manifold = solid(BODY, cover, [Elastic(1.0, 0.3)], "stress").manifold
    built_in = cover.model_copy(update={"functions": "monomials"})
    plain = solid(BODY, built_in, [Elastic(1.0, 0.3)], "stress").manifold
    assert manifold.n_unknowns == plain.n_unknowns
    assert all(group.combination is not None for group in manifold.groups)


@pytest.mark.parametrize(
    ("functions", "rest", "expected"),
    [
        ("mixed", "", "degree: not given"),
        ("plain", "degree = 2\n", r"degree: 2: expected 1 with functions = .plain"),
        ("plain", NEAR, "expected a mesh of polynomials"),
    ],
)
def test_degrees_are_asked_as_the_functions_say(functions: str, rest: str, expected: str) -> None:
    cover = parse_formulation(NET.format(functions) + rest).cover
    with pytest.raises(FormulationError, match=expected):
        solid(BODY, cover, [Elastic(1.0, 0.3)], "stress")
