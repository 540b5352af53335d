"""Edges that are held while bodies bend by any angle: none of their stress is the support's."""

from itertools import pairwise

import numpy as np
import pytest

import nmm
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.audits.table import THRESHOLDS
from nmm.verification import text
from nmm.verification.continuum import quarter

COVERS = {
    "finite elements": 'type = "triangles"\ndegree = 0',
    "triangles": 'type = "triangles"\ndegree = 1',
    "quads": 'type = "quads"\ndegree = 1\nangle = 0.3\nshift = [0.2, 0.1]',
    "splines": 'type = "bspline"\ndegree = 0',
}
LAMBDA, MU = 0.3 / 1.3 / 0.4, 1 / 2.6
STRETCHES = np.array([1.4, 0.8])
STRAIN = (STRETCHES**2 - 1) / 2
FLOAT = float(np.log(STRETCHES.prod()))
# Cauchy stress along and across, in plane strain, of a modulus of 1 and a Poisson's ratio of 0.3.
STRESS = {
    "elastic": STRETCHES**2 * (LAMBDA * STRAIN.sum() + 2 * MU * STRAIN) / STRETCHES.prod(),
    "neo_hookean": (MU * (STRETCHES**2 - 1) + LAMBDA * FLOAT) / STRETCHES.prod(),
}
SQUARE = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]


def formulation(cover, size, more=""):
    return parse_formulation(
        f"[cover]\n{COVERS[cover]}\nsize = {size}\n[loading]\nincrement = 0.5\n"
        f'[rotation]\nupdate = "finite"\n{more}'
    )


def stretched_text(law="elastic"):
    """A square that is held all around where an even stretch takes its edges."""
    sides = [
        text.fixed_edge(f"side {n}", [start, SQUARE[n - 3]]) + 'field = ["0.4*x", "-0.2*y"]\n'
        for n, start in enumerate(SQUARE)
    ]
    return (
        'title = "Square"\nplane = "strain"\n[loading]\nuntil = 1.0\n[materials.m]\n'
        f'law = "{law}"\nyoung_modulus = 1.0\npoisson_ratio = 0.3\ndensity = 1.0\n'
        + text.block("square", "m", SQUARE)
        + "".join(sides)
    )


def stretched(law="elastic"):
    return parse_scene(stretched_text(law))


@pytest.mark.parametrize("law", STRESS)
@pytest.mark.parametrize("cover", COVERS)
def test_a_square_held_all_around_is_stretched_evenly_on_two_cells(cover, law):
    found = nmm.run(stretched(law), formulation(cover, 0.5))
    off = np.abs(found.stress - [*STRESS[law], 0.0]).max()
    # Rounding; springs in place of Nitsche's terms leave 0.8 to 4 %.
    assert off < 1e-10 * np.abs(STRESS[law]).max()
    assert found.summary.status == "converged"


@pytest.mark.parametrize(("stiffness", "told"), [("", True), ("stiffness = 1e4\n", False)])
def test_springs_along_edges_that_give_way_are_told(stiffness, told):
    springs = f'[supports]\nmethod = "penalty"\n{stiffness}'
    found = nmm.run(stretched(), formulation("triangles", 0.5, springs))
    # Stress is off by 3.9 % of its largest, and by 0.16 % with springs of 1e4.
    assert (found.summary.audits["soft_supports"] > THRESHOLDS["soft_supports"].warns) == told
    assert any("soft_supports" in one for one in found.summary.warnings) == told


def test_nitsches_method_is_refused_in_time_where_it_keeps_no_energy():
    scene = parse_scene(
        'title = "Square"\nplane = "strain"\nduration = 0.1\n[inertia]\n'
        + text.material("m", 1.0, 0.3, 1.0)
        + text.block("square", "m", SQUARE)
        + text.fixed_edge("base", SQUARE[:2])
    )
    with pytest.raises(FormulationError, match=r'method: "nitsche".*no inertia, contact'):
        nmm.run(scene, formulation("quads", 0.5, '[supports]\nmethod = "nitsche"\n'))


EFFECTS = """
import numpy as np

from nmm.effects.base import Effect


class Idle(Effect):
    # What pushes nothing, as a load of zero.

    @classmethod
    def from_setup(cls, setup):
        return cls()

    def force(self, state, end):
        return np.zeros(len(state.deformation))

    def work(self, before, after):
        return 0.0


class Stressed(Idle):
    # What adds a stress, of zero.

    def stress_at(self, elements, points, time):
        return np.zeros((len(elements), 3))


class Known(Stressed):
    # What says that edges need not know of it.

    @classmethod
    def beyond_strain(cls):
        return False
"""


@pytest.mark.parametrize(
    ("kind", "held"), [("Idle", True), ("Stressed", False), ("Known", True)], ids=str
)
def test_edges_know_their_traction_beside_an_effect_of_ones_own_that_adds_no_stress(
    kind, held, tmp_path
):
    module, place = f"beside_edges_{kind.lower()}", tmp_path / "scene.toml"
    (tmp_path / f"{module}.py").write_text(EFFECTS)
    place.write_text(f'{stretched_text()}[effects.own]\ntype = "{module}:{kind}"\n')
    found = nmm.run(nmm.read_scene(place), formulation("triangles", 0.5), allow_code=[module])
    off = np.abs(found.stress - [*STRESS["elastic"], 0.0]).max()
    # Springs, which need no traction, leave 0.8 to 4 %.
    assert (off < 1e-10 * np.abs(STRESS["elastic"]).max()) == held
    assert found.summary.status == "converged"


def ring(law, pressure, sides=32):
    """A quarter of a ring of radii 1 and 2, polygons of the area of their circles, blown up."""
    wide = np.sqrt(np.pi / 2 / (sides * np.sin(np.pi / 2 / sides)))
    inner = wide * quarter(1.0, sides)
    return parse_scene(
        'title = "Ring"\nplane = "strain"\n[loading]\nuntil = 1.0\n[materials.m]\n'
        f'law = "{law}"\nyoung_modulus = 1.0\npoisson_ratio = 0.3\n'
        + text.block("ring", "m", np.concatenate([inner, 2 * inner[::-1]]))
        + text.fixed_edge("x", [(0, wide), (0, 2 * wide)], "x")
        + text.fixed_edge("y", [(wide, 0), (2 * wide, 0)], "y")
        + "".join(
            f'[[loads]]\nname = "p{n}"\nkind = "pressure"\npressure = {pressure}\n'
            f"segment = [{start.tolist()}, {end.tolist()}]\n"
            for n, (start, end) in enumerate(pairwise(inner))
        )
        + text.monitor("inner", (wide, 0), "ring")
        + text.monitor("outer", (2 * wide, 0), "ring")
    )


@pytest.mark.parametrize(
    ("law", "inner", "outer"),
    # d(R P_rr)/dR = P_tt by collocation to 1e-9, with P_rr = -p r / R within, at p = 0.08 E.
    [("elastic", 0.16514633, 0.09837762), ("neo_hookean", 0.19247390, 0.12686193)],
)
def test_a_ring_is_blown_up_as_its_radial_equation_says(law, inner, outer):
    scene = ring(law, 0.08)
    more = '[loading]\nincrement = 0.5\n[rotation]\nupdate = "finite"\n'
    cover = '[cover]\ntype = "quads"\nsize = 0.5\ndegree = 2\n'
    found = nmm.run(scene, parse_formulation(cover + more))
    assert found.summary.status == "converged"
    # Cells of half of the inner radius, 0.16 %, and a polygon.
    for name, way in (("inner", inner), ("outer", outer)):
        assert found.history[f"monitor:{name}:ux"][-1] == pytest.approx(way, rel=3e-3)
